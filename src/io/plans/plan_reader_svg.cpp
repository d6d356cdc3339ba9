// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <set>
#include <stdexcept>

#include "io/plans/plan_formats.hpp"
#include "plan_reader_formats.hpp"

namespace cca {
namespace {

/// Of our own line maps: no walls. Of our own floor plans: the only ones.
const std::set<std::string> kNoWallIds{"trajectory", "scale", "north", "arcs"};
const std::set<std::string> kPlanWallIds{kWallLayer, kFurnitureLayer};
const std::set<std::string> kGroups{"svg", "g", "a", "switch"};
/// What draws nothing where it stands.
const std::set<std::string> kHidden{"defs", "symbol", "clipPath", "mask", "pattern", "marker"};
const std::set<std::string> kSilent{"title", "desc", "style", "metadata", "tspan"};

/// Reads numbers, and letters between them, from an attribute.
class SvgNumbers {
 public:
  explicit SvgNumbers(std::string text) : text_(std::move(text)), at_(text_.c_str()) {}
  SvgNumbers(const SvgNumbers&) = delete;
  SvgNumbers& operator=(const SvgNumbers&) = delete;

  /// The letter that comes next, if one does.
  char letter() {
    skip();
    return std::isalpha(static_cast<unsigned char>(*at_)) ? *at_++ : '\0';
  }
  bool number(double& value) {
    skip();
    char* end = nullptr;
    value = std::strtod(at_, &end);
    if (end == at_ || !std::isfinite(value)) return false;
    at_ = end;
    return true;
  }
  bool atEnd() {
    skip();
    return *at_ == '\0';
  }

 private:
  void skip() {
    while (*at_ != '\0' && (std::isspace(static_cast<unsigned char>(*at_)) || *at_ == ',')) ++at_;
  }
  std::string text_;
  const char* at_;
};

class SvgPlan {
 public:
  SvgPlan(const std::string& text, const std::string& name, double scale)
      : text_(text), name_(name), scale_(scale > 0.0 ? scale : 1.0) {
    plan_.kind = "SVG";
    levels_.push_back({Eigen::Affine2d::Identity(), false, ""});
    bool is_svg = false;
    while (nextTag()) {
      is_svg = is_svg || tag_ == "svg";
      if (!is_svg) continue;
      if (closes_) {
        if (levels_.size() > 1 && levels_.back().tag == tag_) levels_.pop_back();
        continue;
      }
      take();
    }
    if (!is_svg) throw std::runtime_error(name_ + ": is no SVG: it has no <svg>");
    plan_.not_understood = inWords(rest_);
  }
  PlanFile plan() { return std::move(plan_); }

 private:
  struct Level {
    Eigen::Affine2d transform;
    bool is_hidden;
    std::string tag;
  };

  [[noreturn]] void fail(const std::string& complaint) const {
    throw std::runtime_error(name_ + ": <" + tag_ + ">: " + complaint);
  }

  /// Reads one tag with its attributes; false at the end.
  bool nextTag() {
    for (;;) {
      const std::size_t begin = text_.find('<', at_);
      if (begin == std::string::npos) return false;
      const bool is_comment = text_.compare(begin, 4, "<!--") == 0;
      const std::string ending = is_comment ? "-->" : ">";
      // A '>' may stand in a value.
      std::size_t end = begin + 1;
      for (char quote = '\0'; end < text_.size(); ++end) {
        const char c = text_[end];
        if (is_comment) {
          if (text_.compare(end, 3, ending) == 0) break;
        } else if (quote != '\0') {
          if (c == quote) quote = '\0';
        } else if (c == '"' || c == '\'') {
          quote = c;
        } else if (c == '>') {
          break;
        }
      }
      if (end >= text_.size()) throw std::runtime_error(name_ + ": ends within a tag");
      at_ = end + ending.size();
      if (is_comment || text_[begin + 1] == '?' || text_[begin + 1] == '!') continue;
      parseTag(text_.substr(begin + 1, end - begin - 1));
      return true;
    }
  }

  void parseTag(std::string inside) {
    closes_ = inside.front() == '/';
    if (closes_) inside.erase(0, 1);
    is_alone_ = !inside.empty() && inside.back() == '/';
    if (is_alone_) inside.pop_back();
    const std::size_t end = std::min(inside.find_first_of(" \t\r\n"), inside.size());
    tag_ = inside.substr(0, end);
    const std::size_t colon = tag_.find(':');
    if (colon != std::string::npos) tag_.erase(0, colon + 1);
    attributes_.clear();
    for (std::size_t at = end; at < inside.size();) {
      const std::size_t equals = inside.find('=', at);
      if (equals == std::string::npos) break;
      const std::size_t open = inside.find_first_of("\"'", equals);
      if (open == std::string::npos) break;
      const std::size_t close = inside.find(inside[open], open + 1);
      if (close == std::string::npos) break;
      const std::size_t from = inside.find_first_not_of(" \t\r\n", at);
      const std::size_t to = inside.find_first_of(" \t\r\n=", from);
      attributes_[inside.substr(from, to - from)] = inside.substr(open + 1, close - open - 1);
      at = close + 1;
    }
  }

  double number(const char* key) const {
    const auto found = attributes_.find(key);
    if (found == attributes_.end()) return 0.0;
    double value = 0.0;
    if (!SvgNumbers(found->second).number(value)) {
      fail(std::string(key) + "=\"" + found->second.substr(0, 40) + "\" is no finite number");
    }
    return value;
  }

  Eigen::Affine2d transform(const char* key) const {
    Eigen::Affine2d all = Eigen::Affine2d::Identity();
    const auto found = attributes_.find(key);
    if (found == attributes_.end()) return all;
    const std::string& text = found->second;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t open = text.find('(', at);
      if (open == std::string::npos) break;
      const std::size_t close = text.find(')', open);
      if (close == std::string::npos) fail(std::string(key) + "=\"" + text + "\" lacks a )");
      std::string kind = text.substr(at, open - at);
      kind.erase(0, std::min(kind.find_first_not_of(" ,\t\r\n"), kind.size()));
      std::vector<double> v;
      SvgNumbers numbers(text.substr(open + 1, close - open - 1));
      for (double value = 0.0; numbers.number(value);) v.push_back(value);
      all = all * oneTransform(kind, v);
      at = close + 1;
    }
    return all;
  }

  Eigen::Affine2d oneTransform(const std::string& kind, const std::vector<double>& v) const {
    Eigen::Affine2d t = Eigen::Affine2d::Identity();
    if (kind == "translate" && !v.empty()) {
      t.translate(Eigen::Vector2d(v[0], v.size() > 1 ? v[1] : 0.0));
    } else if (kind == "scale" && !v.empty()) {
      t.scale(Eigen::Vector2d(v[0], v.size() > 1 ? v[1] : v[0]));
    } else if (kind == "rotate" && !v.empty()) {
      const Eigen::Vector2d about =
          v.size() > 2 ? Eigen::Vector2d(v[1], v[2]) : Eigen::Vector2d(0, 0);
      t.translate(about).rotate(v[0] * M_PI / 180.0).translate(-about);
    } else if (kind == "matrix" && v.size() == 6) {
      t.matrix() << v[0], v[2], v[4], v[1], v[3], v[5], 0.0, 0.0, 1.0;
    } else {
      fail("transform " + kind +
           "(...) is not understood: allowed are translate, scale, rotate "
           "and matrix");
    }
    return t;
  }

  void take() {
    const std::string id = attributes_["id"];
    bool is_hidden =
        levels_.back().is_hidden || kHidden.count(tag_) > 0 || kNoWallIds.count(id) > 0;
    Eigen::Affine2d here = levels_.back().transform * transform("transform");
    if (tag_ == "svg" && id == kPlanSvgId) {
      is_our_plan_ = is_hidden = true;
      if (attributes_[kPlanSvgPlace].find('(') == std::string::npos) {
        fail(std::string("of our plan lacks ") + kPlanSvgPlace + ", where it lies in the map");
      }
      here = here * transform(kPlanSvgPlace);
    }
    if (is_our_plan_ && kPlanWallIds.count(id) > 0) is_hidden = false;
    if (kGroups.count(tag_) > 0 || kHidden.count(tag_) > 0) {
      if (!is_alone_) levels_.push_back({here, is_hidden, tag_});
      return;
    }
    if (is_hidden || kSilent.count(tag_) > 0) return;
    here_ = here;
    if (tag_ == "line") {
      add({{number("x1"), number("y1")}, {number("x2"), number("y2")}}, false);
    } else if (tag_ == "polyline" || tag_ == "polygon") {
      takePoints(tag_ == "polygon");
    } else if (tag_ == "rect") {
      const double x = number("x"), y = number("y"), w = number("width"), h = number("height");
      add({{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, true);
    } else if (tag_ == "path") {
      takePath();
    } else {
      ++rest_["<" + tag_ + ">"];
    }
  }

  void add(std::vector<Eigen::Vector2d> chain, bool closed) {
    for (Eigen::Vector2d& p : chain) {
      const Eigen::Vector2d drawn = here_ * p;
      p = {scale_ * drawn.x(), -scale_ * drawn.y()};
    }
    addChain(chain, closed, plan_.lines);
  }

  void takePoints(bool closed) {
    std::vector<Eigen::Vector2d> chain;
    SvgNumbers numbers(attributes_["points"]);
    for (double x = 0.0, y = 0.0; numbers.number(x);) {
      if (!numbers.number(y)) fail("points holds an odd number of numbers");
      chain.emplace_back(x, y);
    }
    if (!numbers.atEnd()) fail("points holds what is no finite number");
    add(chain, closed);
  }

  /// M, L, H, V and Z, absolute and relative; what follows another letter is left out.
  void takePath() {
    SvgNumbers numbers(attributes_["d"]);
    std::vector<Eigen::Vector2d> chain;
    Eigen::Vector2d at(0, 0), start(0, 0);
    char command = '\0';
    while (!numbers.atEnd()) {
      const char next = numbers.letter();
      if (next != '\0') command = next;
      const char kind = static_cast<char>(std::toupper(static_cast<unsigned char>(command)));
      const Eigen::Vector2d base = kind == command ? Eigen::Vector2d(0, 0) : at;
      double x = 0.0, y = 0.0;
      if (kind == 'Z') {
        if (next == '\0') fail("d has a number after Z");
        add(chain, true);
        chain.assign(1, start);
        at = start;
        continue;
      }
      if (kind == 'M' || kind == 'L') {
        if (!numbers.number(x) || !numbers.number(y))
          fail("d lacks a number after " + std::string(1, command));
        at = base + Eigen::Vector2d(x, y);
      } else if (kind == 'H' || kind == 'V') {
        if (!numbers.number(x)) fail("d lacks a number after " + std::string(1, command));
        (kind == 'H' ? at.x() : at.y()) = (kind == 'H' ? base.x() : base.y()) + x;
      } else {
        ++rest_["paths with " + std::string(1, command) + ", read up to there"];
        break;
      }
      if (kind == 'M') {
        add(chain, false);
        chain.clear();
        start = at;
        command = command == 'M' ? 'L' : 'l';
      }
      chain.push_back(at);
    }
    add(chain, false);
  }

  const std::string& text_;
  const std::string& name_;
  double scale_;
  PlanFile plan_;
  Counts rest_;
  std::size_t at_ = 0;
  std::string tag_;
  bool closes_ = false, is_alone_ = false, is_our_plan_ = false;
  std::map<std::string, std::string> attributes_;
  std::vector<Level> levels_;
  Eigen::Affine2d here_ = Eigen::Affine2d::Identity();
};

}  // namespace

PlanFile readSvgPlan(const std::string& text, const std::string& name, double scale) {
  return SvgPlan(text, name, scale).plan();
}

}  // namespace cca
