// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "io/files/text.hpp"
#include "io/plans/plan_formats.hpp"

namespace cca {
namespace {

/// A field that other programs read back: in quotes, those inside doubled.
std::string quoted(const std::string& text) {
  std::string safe = "\"";
  for (const char c : text) {
    if (c == '"') safe += '"';
    safe += c;
  }
  return safe + "\"";
}

/// The fields of a row; quotes around one are taken off.
std::vector<std::string> fieldsOf(const std::string& row, char separator) {
  std::vector<std::string> fields(1);
  bool in_quotes = false;
  for (std::size_t k = 0; k < row.size(); ++k) {
    const char c = row[k];
    if (c == '"' && in_quotes && k + 1 < row.size() && row[k + 1] == '"') {
      fields.back() += c;
      ++k;
    } else if (c == '"') {
      in_quotes = !in_quotes;
    } else if (c == separator && !in_quotes) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  for (std::string& field : fields) field = std::string(withoutBlanks(field));
  return fields;
}

bool isUtf8(const std::string& text) {
  try {
    return !nlohmann::json(text).dump().empty();
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

double coordinate(const std::string& text, const std::string& where) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value))
    throw std::runtime_error(where + ": '" + text + "' is no finite number");
  return value;
}

}  // namespace

std::string roomsCsv(const FloorPlan& plan) {
  std::string text =
      "id,name,x,y,area_m2,perimeter_m,unseen_area_m2,open_border_m,doors,openings\n";
  for (const PlanRoom& room : plan.rooms) {
    int doors = 0, others = 0;
    for (const PlanOpening& opening : plan.openings) {
      if (opening.rooms[0] != room.id && opening.rooms[1] != room.id) continue;
      ++(opening.kind == OpeningKind::kDoor ? doors : others);
    }
    text += std::to_string(room.id) + "," + (room.name.empty() ? "" : quoted(room.name)) +
            formatted(",%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%d,%d\n", room.label.x(), room.label.y(),
                      room.area, room.perimeter, room.unseen_area, room.open_border, doors, others);
  }
  return text;
}

RoomLabels readRoomLabels(const std::string& text, const std::string& file) {
  std::istringstream rows(text);
  std::string row;
  std::getline(rows, row);
  // Where a comma stands for the point, spreadsheets write semicolons between fields.
  const char separator = row.find(';') != std::string::npos ? ';' : ',';
  const std::vector<std::string> header = fieldsOf(std::string(withoutMark(row)), separator);
  std::size_t column[3];
  const char* const names[3] = {"x", "y", "name"};
  for (int k = 0; k < 3; ++k) {
    const auto found = std::find(header.begin(), header.end(), names[k]);
    if (found == header.end())
      throw std::runtime_error(file + ": the header has no column " + names[k] +
                               " (it needs x, y and name)");
    column[k] = static_cast<std::size_t>(found - header.begin());
  }
  RoomLabels labels;
  for (int number = 2; std::getline(rows, row); ++number) {
    if (withoutBlanks(row).empty()) continue;
    std::vector<std::string> fields = fieldsOf(row, separator);
    const std::string where = file + ", row " + std::to_string(number);
    for (int k = 0; k < 3; ++k) {
      if (column[k] >= fields.size())
        throw std::runtime_error(where + ", column " + names[k] + ": missing");
    }
    if (separator == ';') {
      for (const int k : {0, 1})
        std::replace(fields[column[k]].begin(), fields[column[k]].end(), ',', '.');
    }
    if (fields[column[2]].empty()) throw std::runtime_error(where + ", column name: empty");
    if (!isUtf8(fields[column[2]]))
      throw std::runtime_error(where + ", column name: must be UTF-8 text");
    labels.push_back({{coordinate(fields[column[0]], where + ", column x"),
                       coordinate(fields[column[1]], where + ", column y")},
                      fields[column[2]]});
  }
  return labels;
}

RoomLabels roomLabelsOfFile(const std::string& path) {
  return readRoomLabels(contentOf(path), path);
}

RoomLabels nameRooms(FloorPlan& plan, const RoomLabels& labels) {
  RoomLabels outside;
  for (const auto& label : labels) {
    const int id = roomAt(plan, label.first);
    if (id == 0) {
      outside.push_back(label);
      continue;
    }
    std::string& name = plan.rooms[static_cast<std::size_t>(id - 1)].name;
    if (name.empty()) name = label.second;
  }
  return outside;
}

}  // namespace cca
