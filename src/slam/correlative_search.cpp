// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/correlative_search.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_set>

namespace cca {
namespace {

/// The likelihood beside a return, as far as it matters (three deviations).
class Kernel {
 public:
  constexpr static int kHalf = 3;
  Kernel() {
    for (int y = -kHalf; y <= kHalf; ++y) {
      for (int x = -kHalf; x <= kHalf; ++x) {
        const double d = std::hypot(x, y) / LikelihoodPyramid::kSigma;
        values_[y + kHalf][x + kHalf] =
            static_cast<std::uint8_t>(std::lround(255.0 * std::exp(-0.5 * d * d)));
      }
    }
  }
  std::uint8_t at(int x, int y) const { return values_[y + kHalf][x + kHalf]; }

 private:
  std::uint8_t values_[2 * kHalf + 1][2 * kHalf + 1];
};

struct Candidate {
  double bound = 0.0;
  int turn = 0, x = 0, y = 0;  // steps from the window's corner
};

/// One turn of the query: its points in cells, at the window's lowest shift.
struct TurnedQuery {
  double angle = 0.0;
  double penalty = 0.0;
  std::vector<Eigen::Vector2i> cells;
};

class BranchAndBound {
 public:
  BranchAndBound(const std::vector<Eigen::Vector2d>& query, const LikelihoodPyramid& pyramid,
                 const SearchWindow& window)
      : pyramid_(pyramid), window_(window), count_(static_cast<double>(query.size())) {
    double farthest = pyramid.cell();
    for (const Eigen::Vector2d& p : query) farthest = std::max(farthest, p.norm());
    const double turn_step = pyramid.cell() / farthest;
    const int turns = static_cast<int>(std::ceil(window.half_turn / turn_step));
    steps_ = static_cast<int>(std::ceil(window.half_width / pyramid.cell()));
    const Eigen::Vector2d low =
        window.centre.position() - Eigen::Vector2d::Constant(steps_ * pyramid.cell());
    for (int k = -turns; k <= turns; ++k) {
      TurnedQuery turned;
      const double by = turns > 0 ? k * window.half_turn / turns : 0.0;
      turned.angle = wrapAngle(window.centre.theta + by);
      turned.penalty = window.prior_information.z() * by * by;
      const double c = std::cos(turned.angle), s = std::sin(turned.angle);
      turned.cells.reserve(query.size());
      for (const Eigen::Vector2d& p : query) {
        const Eigen::Vector2d at =
            pyramid.toCells(low + Eigen::Vector2d(c * p.x() - s * p.y(), s * p.x() + c * p.y()));
        turned.cells.emplace_back(static_cast<int>(std::floor(at.x())),
                                  static_cast<int>(std::floor(at.y())));
      }
      turned_.push_back(std::move(turned));
    }
  }

  std::optional<SearchResult> search(double least_score) {
    best_bound_ = least_score;
    const int top = pyramid_.levels() - 1;
    std::vector<Candidate> roots;
    for (int turn = 0; turn < static_cast<int>(turned_.size()); ++turn) {
      for (int y = 0; y <= 2 * steps_; y += 1 << top) {
        for (int x = 0; x <= 2 * steps_; x += 1 << top) {
          addIfGood(top, {0.0, turn, x, y}, roots);
        }
      }
    }
    visit(top, roots);
    if (!found_) return std::nullopt;
    SearchResult result;
    result.T_map_query = poseOf(best_);
    result.score = scoreOf(0, best_);
    return result;
  }

 private:
  Pose2 poseOf(const Candidate& c) const {
    const double cell = pyramid_.cell();
    return {window_.centre.x + (c.x - steps_) * cell, window_.centre.y + (c.y - steps_) * cell,
            turned_[static_cast<std::size_t>(c.turn)].angle};
  }

  /// @param least  what cannot score more is given up, and its score is less.
  double scoreOf(int level, const Candidate& c, double least = 0.0) const {
    // What may be missed of the most that there could be.
    int missed = static_cast<int>((1.0 - least) * 255.0 * count_) + 1;
    int sum = 0;
    for (const Eigen::Vector2i& at : turned_[static_cast<std::size_t>(c.turn)].cells) {
      const int value = pyramid_.at(level, at.x() + c.x, at.y() + c.y);
      sum += value;
      missed -= 255 - value;
      if (missed < 0) return 0.0;
    }
    return sum / (255.0 * count_);
  }

  /// The least penalty of the shifts that a candidate stands for.
  double penaltyOf(int level, const Candidate& c) const {
    const double cell = pyramid_.cell();
    const auto least = [&](int from) {
      const int low = from - steps_, high = std::min(from + (1 << level) - 1, 2 * steps_) - steps_;
      return cell * (low > 0 ? low : high < 0 ? -high : 0);
    };
    const double dx = least(c.x), dy = least(c.y);
    const Eigen::Vector3d& information = window_.prior_information;
    const double off_sq = information.x() * dx * dx + information.y() * dy * dy +
                          turned_[static_cast<std::size_t>(c.turn)].penalty;
    return off_sq > 0.0
               ? window_.prior_weight * 0.5 * kPriorFreedom * std::log1p(off_sq / kPriorFreedom)
               : 0.0;
  }

  bool isExcluded(const Candidate& c) const {
    if (!window_.excluded) return false;
    const Eigen::Vector3d off = difference(poseOf(c), *window_.excluded);
    return off.head<2>().norm() < window_.excluded_distance &&
           std::abs(off.z()) < window_.excluded_turn;
  }

  void addIfGood(int level, Candidate c, std::vector<Candidate>& candidates) const {
    const double penalty = penaltyOf(level, c);
    if (1.0 - penalty <= best_bound_) return;
    c.bound = scoreOf(level, c, best_bound_ + penalty) - penalty;
    if (c.bound > best_bound_) candidates.push_back(c);
  }

  void visit(int level, std::vector<Candidate>& candidates) {
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
      if (a.bound != b.bound) return a.bound > b.bound;
      return std::tie(a.turn, a.y, a.x) < std::tie(b.turn, b.y, b.x);
    });
    for (const Candidate& c : candidates) {
      if (c.bound <= best_bound_) return;
      if (level == 0) {
        if (isExcluded(c)) continue;
        best_bound_ = c.bound;
        best_ = c;
        found_ = true;
        return;
      }
      std::vector<Candidate> parts;
      const int half = 1 << (level - 1);
      for (const int dy : {0, half}) {
        for (const int dx : {0, half}) {
          const Candidate part{0.0, c.turn, c.x + dx, c.y + dy};
          if (part.x > 2 * steps_ || part.y > 2 * steps_) continue;
          addIfGood(level - 1, part, parts);
        }
      }
      visit(level - 1, parts);
    }
  }

  const LikelihoodPyramid& pyramid_;
  const SearchWindow& window_;
  double count_;
  int steps_ = 0;
  std::vector<TurnedQuery> turned_;
  double best_bound_ = 0.0;
  Candidate best_;
  bool found_ = false;
};

}  // namespace

LikelihoodPyramid::LikelihoodPyramid(const std::vector<Eigen::Vector2d>& points,
                                     const Eigen::Vector2d& centre, double reach, int levels,
                                     double cell)
    : cell_(cell) {
  static const Kernel kernel;
  Eigen::Vector2d low = centre, high = centre;
  const auto isNear = [&](const Eigen::Vector2d& p) {
    return (p - centre).cwiseAbs().maxCoeff() <= reach;
  };
  for (const Eigen::Vector2d& p : points) {
    if (!isNear(p)) continue;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double border = Kernel::kHalf * cell_;
  low_ = low - Eigen::Vector2d::Constant(border);
  width_ = static_cast<int>((high.x() - low_.x() + border) / cell_) + 2 + kMargin;
  height_ = static_cast<int>((high.y() - low_.y() + border) / cell_) + 2 + kMargin;
  const std::size_t width = static_cast<std::size_t>(width_);
  cells_.emplace_back(width * static_cast<std::size_t>(height_), std::uint8_t{0});
  std::vector<std::uint8_t>& finest = cells_.front();
  for (const Eigen::Vector2d& p : points) {
    if (!isNear(p)) continue;
    const Eigen::Vector2d at = toCells(p);
    const int cx = static_cast<int>(at.x()) + kMargin, cy = static_cast<int>(at.y()) + kMargin;
    if (finest[static_cast<std::size_t>(cy) * width + static_cast<std::size_t>(cx)] == 255)
      continue;
    for (int y = -Kernel::kHalf; y <= Kernel::kHalf; ++y) {
      std::uint8_t* row = &finest[static_cast<std::size_t>(cy + y) * width];
      for (int x = -Kernel::kHalf; x <= Kernel::kHalf; ++x) {
        std::uint8_t& value = row[cx + x];
        value = std::max(value, kernel.at(x, y));
      }
    }
  }
  for (int level = 1; level <= levels; ++level) {
    const std::vector<std::uint8_t>& finer = cells_.back();
    std::vector<std::uint8_t> coarser(finer.size());
    const int half = 1 << (level - 1);
    for (int y = 0; y < height_; ++y) {
      const std::uint8_t* here = &finer[static_cast<std::size_t>(y) * width];
      const std::uint8_t* there =
          y + half < height_ ? here + static_cast<std::size_t>(half) * width : here;
      std::uint8_t* out = &coarser[static_cast<std::size_t>(y) * width];
      for (int x = 0; x < width_ - half; ++x) {
        out[x] = std::max(std::max(here[x], here[x + half]), std::max(there[x], there[x + half]));
      }
      for (int x = std::max(0, width_ - half); x < width_; ++x)
        out[x] = std::max(here[x], there[x]);
    }
    cells_.push_back(std::move(coarser));
  }
}

std::optional<SearchResult> searchPose(const std::vector<Eigen::Vector2d>& query,
                                       const LikelihoodPyramid& pyramid, const SearchWindow& window,
                                       double least_score) {
  if (query.empty()) return std::nullopt;
  return BranchAndBound(query, pyramid, window).search(least_score);
}

std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& points, double spacing) {
  std::unordered_set<std::int64_t> taken;
  std::vector<Eigen::Vector2d> kept;
  for (const Eigen::Vector2d& p : points) {
    const auto x = static_cast<std::int64_t>(std::floor(p.x() / spacing));
    const auto y = static_cast<std::int64_t>(std::floor(p.y() / spacing));
    if (taken.insert(x * (std::int64_t{1} << 32) + y).second) kept.push_back(p);
  }
  return kept;
}

}  // namespace cca
