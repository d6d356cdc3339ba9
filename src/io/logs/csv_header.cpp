// SPDX-License-Identifier: BSD-3-Clause
#include "csv_header.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <utility>

#include "io/files/text.hpp"

namespace cca {
namespace {

/// rad; a bearing beyond is told in degrees.
constexpr double kLargestBearing = 2.0 * M_PI + 0.01;
/// Of the spacing of angles in a header, which are rounded to a digit or two.
constexpr double kAngleOff = 0.25;
constexpr double kMostCsvBeams = 1e6;  // no laser has as many; more would be damage

/// What a name ends in, and what its numbers are to be multiplied by.
constexpr std::pair<std::string_view, double> kSuffixes[] = {{"_deg", kRadiansPerDegree},
                                                             {"_rad", 1.0},
                                                             {"_ns", 1e-9},
                                                             {"_us", 1e-6},
                                                             {"_ms", 1e-3},
                                                             {"_sec", 1.0},
                                                             {"_s", 1.0},
                                                             {"_m", 1.0}};

bool endsIn(std::string_view text, std::string_view end) {
  return text.size() > end.size() && text.substr(text.size() - end.size()) == end;
}

/// Lower case, without what programs put before a name.
std::string plainName(std::string_view name) {
  std::string plain;
  for (const char c : name) plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (!plain.empty() && (plain.front() == '%' || plain.front() == '#')) plain.erase(0, 1);
  plain.erase(0, plain.rfind('/') + 1);  // all where there is none: npos + 1 is 0
  for (const std::string_view prefix : {"field.", "header."}) {
    if (plain.rfind(prefix, 0) == 0) plain.erase(0, prefix.size());
  }
  return std::string(withoutBlanks(plain));
}

/// Takes a suffix off a name. @return  its unit; nothing where it has none.
std::optional<double> takeUnit(std::string& name) {
  for (const auto& [suffix, unit] : kSuffixes) {
    if (!endsIn(name, suffix)) continue;
    name.erase(name.size() - suffix.size());
    return unit;
  }
  return std::nullopt;
}

/// The number of a range's name: 12 of ranges12, range_12, ranges[12], r12.
std::optional<std::size_t> numberedRange(const std::string& name) {
  std::string_view rest = name;
  for (const std::string_view word : {"ranges", "range", "r"}) {
    if (rest.rfind(word, 0) != 0) continue;
    rest.remove_prefix(word.size());
    break;
  }
  if (rest.size() == name.size()) return std::nullopt;
  if (!rest.empty() && (rest.front() == '_' || rest.front() == '[' || rest.front() == '.'))
    rest.remove_prefix(1);
  if (!rest.empty() && rest.back() == ']') rest.remove_suffix(1);
  const bool is_number =
      !rest.empty() &&
      std::all_of(rest.begin(), rest.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  const auto number = is_number ? numberOf(rest) : std::nullopt;
  if (!number || *number > kMostCsvBeams) return std::nullopt;
  return static_cast<std::size_t>(*number);
}

struct NamedAngle {
  double angle;                ///< as written
  std::optional<double> unit;  ///< as the name tells
};

std::optional<NamedAngle> angleNamed(std::string name) {
  const std::optional<double> unit = takeUnit(name);
  const auto angle = numberOf(name);
  if (!angle || !std::isfinite(*angle)) return std::nullopt;
  return NamedAngle{*angle, unit};
}

/// Sorts the columns of a header by what their names say.
class CsvColumns {
 public:
  explicit CsvColumns(const std::vector<std::string_view>& names) {
    for (std::size_t k = 0; k < names.size(); ++k) {
      std::string name = plainName(names[k]);
      if (const auto angle = angleNamed(name)) {
        angles_.emplace_back(*angle, k);
      } else if (const auto number = numberedRange(name)) {
        if (!numbered_.emplace(*number, k).second)
          throw MalformedLine("header: range " + std::to_string(*number) + " is there twice");
      } else {
        const auto unit = takeUnit(name);
        if (unit) has_unit_.push_back(name);
        // Of two that are named alike, the first.
        named_.emplace(name, CsvQuantity{k, 0.0, unit.value_or(1.0)});
      }
    }
  }

  std::size_t ranges() const { return std::max(angles_.size(), numbered_.size()); }
  const std::vector<std::pair<NamedAngle, std::size_t>>& angles() const { return angles_; }
  const std::map<std::size_t, std::size_t>& numbered() const { return numbered_; }

  std::optional<CsvQuantity> find(const std::string& name) const {
    const auto found = named_.find(name);
    return found == named_.end() ? std::nullopt : std::optional(found->second);
  }
  bool hasUnit(const std::string& name) const {
    return std::find(has_unit_.begin(), has_unit_.end(), name) != has_unit_.end();
  }
  void share(std::string name, double value) {
    const double unit = takeUnit(name).value_or(1.0);
    named_.emplace(name, CsvQuantity{std::nullopt, unit * value});
  }

  /// x, y and theta, or yaw; nothing where the header has none of them.
  std::optional<std::array<CsvQuantity, 3>> pose(const std::string& prefix) const {
    const auto x = find(prefix + "x"), y = find(prefix + "y");
    auto theta = find(prefix + "theta");
    if (!theta) theta = find(prefix + "yaw");
    if (!x && !y && !theta) return std::nullopt;
    if (!x || !y || !theta)
      throw MalformedLine("header: a pose needs all of " + prefix + "x, " + prefix + "y, " +
                          prefix + "theta");
    return std::array<CsvQuantity, 3>{*x, *y, *theta};
  }

 private:
  std::vector<std::pair<NamedAngle, std::size_t>> angles_;
  std::map<std::size_t, std::size_t> numbered_;
  std::map<std::string, CsvQuantity> named_;
  std::vector<std::string> has_unit_;
};

/// Ranges whose columns are named by their angles.
void takeAngles(const CsvColumns& columns, CsvHeader& header) {
  const auto& angles = columns.angles();
  const bool is_in_degrees = std::any_of(angles.begin(), angles.end(), [](const auto& named) {
    return named.first.unit == kRadiansPerDegree || std::abs(named.first.angle) > kLargestBearing;
  });
  const auto bearing = [&](std::size_t k) {
    const NamedAngle& named = angles[k].first;
    return named.angle * named.unit.value_or(is_in_degrees ? kRadiansPerDegree : 1.0);
  };
  const double first = bearing(0);
  const double step = (bearing(angles.size() - 1) - first) / static_cast<double>(angles.size() - 1);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    const double off = std::abs(bearing(k) - first - static_cast<double>(k) * step);
    if (!(off <= kAngleOff * std::abs(step))) {
      throw MalformedLine(
          formatted("header: the angles that name the ranges must be spaced evenly; %g is not (a "
                    "header that says the angles is needed)",
                    angles[k].first.angle));
    }
    header.ranges.push_back(angles[k].second);
  }
  header.angle_min = CsvQuantity{std::nullopt, first};
  header.angle_increment = CsvQuantity{std::nullopt, step};
}

/// Ranges that are numbered, from 0 or 1 on.
void takeNumbered(const CsvColumns& columns, CsvHeader& header) {
  const auto& numbered = columns.numbered();
  const std::size_t first = numbered.begin()->first;
  if (first > 1 || numbered.rbegin()->first - first + 1 != numbered.size())
    throw MalformedLine("header: ranges must be numbered from 0 or 1 on, without a gap");
  for (const auto& [number, column] : numbered) header.ranges.push_back(column);
  header.angle_min = columns.find("angle_min");
  header.angle_max = columns.find("angle_max");
  header.angle_increment = columns.find("angle_increment");
  if (!header.angle_min || (!header.angle_increment && !header.angle_max)) {
    throw MalformedLine(
        "header: angle_min, and angle_increment or angle_max, are needed beside numbered ranges "
        "(columns, or a line '# angle_min=-1.57 angle_max=1.57' above)");
  }
}

/// The separator that a header has most of.
char separatorOf(std::string_view line) {
  char best = ',';
  for (const char c : {';', '\t'}) {
    if (std::count(line.begin(), line.end(), c) > std::count(line.begin(), line.end(), best))
      best = c;
  }
  return best;
}

}  // namespace

void addToPreamble(std::string_view comment, CsvPreamble& preamble) {
  std::string text(comment);
  for (char& c : text) {
    if (c == '=' || c == ':' || c == ',' || c == ';' || c == '#') c = ' ';
  }
  std::string name;
  for (std::string_view rest = withoutBlanks(text); !rest.empty(); rest = withoutBlanks(rest)) {
    const std::size_t end = std::min(rest.find_first_of(" \t"), rest.size());
    const std::string_view word = rest.substr(0, end);
    const auto number = numberOf(word);
    if (number && std::isfinite(*number) && !name.empty()) preamble.emplace_back(name, *number);
    name = number ? "" : plainName(word);
    rest.remove_prefix(end);
  }
}

std::vector<std::string_view> rowFields(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t end = std::min(line.find(separator), line.size());
    std::string_view field = line.substr(0, end);
    // Tabs are blanks as well.
    while (!field.empty() && (field.front() == ' ' || field.front() == '"')) field.remove_prefix(1);
    while (!field.empty() && (field.back() == ' ' || field.back() == '"' || field.back() == '\r'))
      field.remove_suffix(1);
    fields.push_back(field);
    if (end == line.size()) break;
    line.remove_prefix(end + 1);
  }
  return fields;
}

bool namesRanges(std::string_view line) {
  const std::vector<std::string_view> fields = rowFields(line, separatorOf(line));
  try {
    return fields.size() > 1 && CsvColumns(fields).ranges() > 1;
  } catch (const MalformedLine&) {
    return true;
  }
}

CsvHeader readCsvHeader(std::string_view line, const CsvPreamble& preamble) {
  CsvHeader header;
  header.separator = separatorOf(line);
  std::vector<std::string_view> names = rowFields(line, header.separator);
  if (names.size() > 1 && names.back().empty()) names.pop_back();
  header.columns = names.size();
  CsvColumns columns(names);
  for (const auto& [name, value] : preamble) columns.share(name, value);
  if (columns.ranges() < 2) throw MalformedLine("header: names no two ranges");
  if (!columns.angles().empty() && !columns.numbered().empty())
    throw MalformedLine("header: ranges are named by angles and by numbers; one of both is needed");
  columns.numbered().empty() ? takeAngles(columns, header) : takeNumbered(columns, header);
  header.range_min = columns.find("range_min");
  header.range_max = columns.find("range_max");
  for (const char* name : {"stamp", "timestamp", "time"}) {
    if (header.time || !columns.find(name)) continue;
    header.time = columns.find(name);
    header.guesses_time_unit = !columns.hasUnit(name);
  }
  header.odometry = columns.pose("odom_");
  if (!header.odometry) header.odometry = columns.pose("");
  header.corrected = columns.pose("pose_");
  return header;
}

}  // namespace cca
