// SPDX-License-Identifier: BSD-3-Clause
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string_view>

#include "io/files/text.hpp"
#include "plan_reader_formats.hpp"

namespace cca {
namespace {

/// m, of a drawing unit, by $INSUNITS: inches, feet, miles, mm, cm, m, km.
constexpr double kMetresOfUnits[] = {1.0, 0.0254, 0.3048, 1609.344, 0.001, 0.01, 1.0, 1000.0};

/// Doors stand open, areas and notes are no walls (layer names of the AIA); ours are among them.
constexpr std::string_view kLayersOfNoWalls[] = {"A-DOOR", "A-OPNG", "A-AREA",
                                                 "A-ANNO", "A-DIMS", "TRAJECTORY"};

struct DxfGroup {
  int code;
  std::string_view value;
};

/// The groups of a file, one after the other: a line with a code, and one with a value.
class GroupReader {
 public:
  GroupReader(std::string_view text, const std::string& name) : text_(text), name_(name) {
    if (text_.substr(0, 18) == "AutoCAD Binary DXF") {
      throw std::runtime_error(name + ": is a binary DXF; save it as ASCII");
    }
  }

  /// @return  false at the end.
  bool next(DxfGroup& group) {
    std::string_view code, value;
    if (!line(code)) return false;
    if (!line(value)) {
      if (code.empty()) return false;
      fail("a group code without a value: the file ends there");
    }
    const auto result = std::from_chars(code.data(), code.data() + code.size(), group.code);
    if (result.ec != std::errc() || result.ptr != code.data() + code.size()) {
      fail("'" + std::string(code.substr(0, 40)) +
           "' is no group code: a DXF has a code (a number) "
           "and a value on alternate lines");
    }
    group.value = value;
    return true;
  }

  double number(const DxfGroup& group) const {
    double value = 0.0;
    const std::string_view text = group.value.substr(group.value.substr(0, 1) == "+" ? 1 : 0);
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || !std::isfinite(value)) {
      fail("'" + std::string(group.value.substr(0, 40)) + "' of group " +
           std::to_string(group.code) + " is no finite number");
    }
    return value;
  }

 private:
  [[noreturn]] void fail(const std::string& complaint) const {
    throw std::runtime_error(name_ + ", line " + std::to_string(row_) + ": " + complaint);
  }
  bool line(std::string_view& found) {
    if (at_ >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    found = withoutBlanks(text_.substr(at_, end - at_));
    at_ = end + 1;
    ++row_;
    return true;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int row_ = 0;
};

/// One thing of the drawing, as far as it is told so far.
struct Entity {
  std::string type, layer;
  std::vector<Eigen::Vector2d> points;  ///< groups 10 and 20, 11 and 21
  double radius = 0.0, from_deg = 0.0, to_deg = 360.0;
  int flags = 0;
};

class DxfPlan {
 public:
  DxfPlan(const std::string& text, const std::string& name, double scale)
      : groups_(text, name), scale_(scale) {
    plan_.kind = "DXF";
    DxfGroup group{};
    bool has_section = false;
    while (groups_.next(group)) {
      if (group.code == 0) {
        finish();
        entity_ = {};
        entity_.type = group.value;
        if (group.value == "ENDSEC") section_.clear();
        continue;
      }
      if (group.code == 2 && entity_.type == "SECTION") {
        section_ = group.value;
        has_section = true;
      }
      take(group);
    }
    finish();
    if (!has_section) throw std::runtime_error(name + ": is no DXF: it has no SECTION");
    if (!(scale_ > 0.0)) scale_ = 1.0;
    for (auto& [a, b] : plan_.lines) {
      a *= scale_;
      b *= scale_;
    }
    plan_.not_understood = inWords(rest_);
  }
  PlanFile plan() { return std::move(plan_); }

 private:
  void take(const DxfGroup& group) {
    if (section_ == "HEADER") {
      if (group.code == 9) variable_ = group.value;
      if (group.code == 70 && variable_ == "$INSUNITS" && !(scale_ > 0.0)) {
        const auto units = static_cast<std::size_t>(std::max(0.0, groups_.number(group)));
        scale_ = units < std::size(kMetresOfUnits) ? kMetresOfUnits[units] : 1.0;
      }
      return;
    }
    if (group.code == 2 && entity_.type == "LAYER") {
      entity_.layer = group.value;
      layers_.insert(entity_.layer);
    }
    if (group.code == 62 && entity_.type == "LAYER" && groups_.number(group) < 0.0) {
      hidden_.insert(entity_.layer);
    }
    if (group.code == 8) entity_.layer = group.value;
    if (group.code == 70) entity_.flags = static_cast<int>(groups_.number(group));
    if (section_ != "ENTITIES") return;
    if (group.code == 10 || group.code == 11) {
      entity_.points.emplace_back(groups_.number(group), 0.0);
    } else if ((group.code == 20 || group.code == 21) && !entity_.points.empty()) {
      entity_.points.back().y() = groups_.number(group);
    } else if (group.code == 40) {
      entity_.radius = groups_.number(group);
    } else if (group.code == 50) {
      entity_.from_deg = groups_.number(group);
    } else if (group.code == 51) {
      entity_.to_deg = groups_.number(group);
    } else if (group.code == 42 && groups_.number(group) != 0.0) {
      ++rest_["bent parts of polylines, taken for straight"];
    }
  }

  bool isWall(const std::string& layer) const {
    // Our own drawing tells all lines on a layer that is off; those of chains on another once more.
    if (layers_.count("LINES") > 0 && layers_.count("POLYLINES") > 0) return layer == "LINES";
    if (hidden_.count(layer) > 0) return false;
    for (const std::string_view no_wall : kLayersOfNoWalls) {
      if (layer.compare(0, no_wall.size(), no_wall) == 0) return false;
    }
    return true;
  }

  /// What was told of a thing is complete.
  void finish() {
    if (entity_.type == "LAYER" && (entity_.flags & 1) != 0) hidden_.insert(entity_.layer);
    if (section_ != "ENTITIES" || entity_.type.empty() || entity_.type == "SECTION") return;
    if (entity_.type == "POLYLINE") {
      chain_.clear();
      chain_layer_ = entity_.layer;
      chain_closes_ = (entity_.flags & 1) != 0;
    } else if (entity_.type == "VERTEX") {
      if (!entity_.points.empty()) chain_.push_back(entity_.points.front());
    } else if (entity_.type == "SEQEND") {
      if (isWall(chain_layer_)) addChain(chain_, chain_closes_, plan_.lines);
      chain_.clear();
    } else if (isWall(entity_.layer)) {
      finishWall();
    }
  }

  void finishWall() {
    const auto& points = entity_.points;
    if (entity_.type == "LINE" && points.size() >= 2) {
      plan_.lines.emplace_back(points[0], points[1]);
    } else if (entity_.type == "LWPOLYLINE") {
      addChain(points, (entity_.flags & 1) != 0, plan_.lines);
    } else if ((entity_.type == "ARC" || entity_.type == "CIRCLE") && !points.empty()) {
      double to = entity_.to_deg;
      while (to <= entity_.from_deg) to += 360.0;
      addArc(points.front(), entity_.radius, kRadiansPerDegree * entity_.from_deg,
             kRadiansPerDegree * to, plan_.lines);
    } else {
      ++rest_[entity_.type];
    }
  }

  GroupReader groups_;
  double scale_;
  PlanFile plan_;
  Counts rest_;
  std::string section_, variable_;
  Entity entity_;
  std::set<std::string> layers_, hidden_;
  std::vector<Eigen::Vector2d> chain_;  ///< of a POLYLINE
  std::string chain_layer_;
  bool chain_closes_ = false;
};

}  // namespace

PlanFile readDxfPlan(const std::string& text, const std::string& name, double scale) {
  return DxfPlan(text, name, scale).plan();
}

}  // namespace cca
