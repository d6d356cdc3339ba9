// SPDX-License-Identifier: BSD-3-Clause
#include "slam/correlative_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

#include "cca_mrpt/geometry/cell.hpp"
#include "slam/surface_matching.hpp"

namespace cca {
namespace {

/// Cells that are looked up between two looks at whether to give up: a few more than needed cost
/// less than to ask after each.
constexpr std::size_t kAtOnce = 8;

}  // namespace

PoseSearch::PoseSearch(std::vector<SurfacePoint> query, LikelihoodPyramid pyramid,
                       const SearchWindow& window, double least_score)
    : query_(std::move(query)), pyramid_(std::move(pyramid)), window_(window) {
  double farthest = pyramid_.cell();
  for (const SurfacePoint& p : query_) {
    farthest = std::max(farthest, p.position.norm());
    facings_.push_back(bearingOf(p.normal));
  }
  const double turn_step = pyramid_.cell() / farthest;
  half_turns_ = static_cast<int>(std::ceil(window.half_turn / turn_step));
  steps_ = static_cast<int>(std::ceil(window.half_width / pyramid_.cell()));
  begin(least_score);
}

void PoseSearch::begin(double least_score) {
  best_bound_ = least_score;
  next_turn_ = query_.empty() ? turns() : 0;
  open_.clear();
}

void PoseSearch::seekRival(double distance, double turn, double least_score) {
  excluded_ = Excluded{found_->T_map_query, distance, turn};
  found_.reset();
  begin(least_score);
}

void PoseSearch::keepSeveral(std::size_t count, double distance, double turn) {
  wanted_ = Several{count, distance, turn};
}

/// Takes a place among the best, for those near it that score less, and for the least of them where
/// they are too many.
void PoseSearch::keep(const Candidate& candidate) {
  const SearchResult found{poseOf(candidate), candidate.bound};
  const auto isNear = [&](const SearchResult& other) {
    const Eigen::Vector3d off = difference(found.T_map_query, other.T_map_query);
    return off.head<2>().norm() < wanted_->distance && std::abs(off.z()) < wanted_->turn;
  };
  const auto beside = std::find_if(several_.begin(), several_.end(), [&](const auto& other) {
    return other.score >= found.score && isNear(other);
  });
  if (beside != several_.end()) return;
  several_.erase(std::remove_if(several_.begin(), several_.end(), isNear), several_.end());
  const auto at = std::find_if(several_.begin(), several_.end(),
                               [&](const auto& other) { return other.score < found.score; });
  several_.insert(at, found);
  if (several_.size() > wanted_->count) several_.pop_back();
  if (several_.size() == wanted_->count) best_bound_ = several_.back().score;
}

bool PoseSearch::advance(int cells) {
  looked_up_ = 0;
  while (looked_up_ < cells) {
    if (next_turn_ < turns()) {
      openTurn(next_turn_++);
      if (next_turn_ == turns()) sortFrom(0);
      continue;
    }
    if (open_.empty()) return true;
    const Candidate next = open_.back();
    open_.pop_back();
    if (next.bound <= best_bound_) continue;
    if (next.level > 0) {
      expand(next);
      continue;
    }
    if (wanted_) {
      keep(next);
      continue;
    }
    best_bound_ = next.bound;
    found_ = SearchResult{poseOf(next), scoreOf(next, 0.0)};
    if (excluded_) open_.clear();  // one rival is enough
  }
  return false;
}

void PoseSearch::run() {
  while (!advance(std::numeric_limits<int>::max())) continue;
}

/// The query as it is turned for the k-th time, from the window's one end to the other.
PoseSearch::TurnedQuery PoseSearch::turnedQuery(int k) const {
  TurnedQuery turned;
  const double by = half_turns_ > 0 ? (k - half_turns_) * window_.half_turn / half_turns_ : 0.0;
  turned.angle = wrapAngle(window_.centre.theta + by);
  turned.penalty = window_.prior_information.z() * by * by;
  const double c = std::cos(turned.angle), s = std::sin(turned.angle);
  const Eigen::Vector2d low =
      window_.centre.position() - Eigen::Vector2d::Constant(steps_ * pyramid_.cell());
  turned.cells.reserve(query_.size());
  turned.offsets.reserve(query_.size());
  for (std::size_t i = 0; i < query_.size(); ++i) {
    const Eigen::Vector2d& p = query_[i].position;
    const Eigen::Vector2d at =
        pyramid_.toCells(low + Eigen::Vector2d(c * p.x() - s * p.y(), s * p.x() + c * p.y()));
    turned.cells.emplace_back(wholeBelow(at.x()), wholeBelow(at.y()),
                              pyramid_.layerOf(facings_[i] + turned.angle));
    const Eigen::Vector3i& cell = turned.cells.back();
    turned.offsets.push_back(pyramid_.offset(cell.x(), cell.y(), cell.z()));
    turned.low_x = i > 0 ? std::min(turned.low_x, cell.x()) : cell.x();
    turned.low_y = i > 0 ? std::min(turned.low_y, cell.y()) : cell.y();
    turned.high_x = i > 0 ? std::max(turned.high_x, cell.x()) : cell.x();
    turned.high_y = i > 0 ? std::max(turned.high_y, cell.y()) : cell.y();
  }
  return turned;
}

void PoseSearch::openTurn(int turn) {
  if (static_cast<int>(turned_.size()) == turn) {
    turned_.push_back(turnedQuery(turn));
    looked_up_ += static_cast<int>(query_.size());
  }
  const int top = pyramid_.levels() - 1;
  for (int y = 0; y <= 2 * steps_; y += 1 << top) {
    for (int x = 0; x <= 2 * steps_; x += 1 << top) openIfGood({0.0, top, turn, x, y});
  }
}

void PoseSearch::expand(const Candidate& candidate) {
  const std::size_t first = open_.size();
  const int half = 1 << (candidate.level - 1);
  for (const int dy : {0, half}) {
    for (const int dx : {0, half}) {
      const int x = candidate.x + dx, y = candidate.y + dy;
      if (x > 2 * steps_ || y > 2 * steps_) continue;
      openIfGood({0.0, candidate.level - 1, candidate.turn, x, y});
    }
  }
  sortFrom(first);
}

void PoseSearch::openIfGood(Candidate candidate) {
  const double penalty = penaltyOf(candidate);
  if (1.0 - penalty <= best_bound_ || isExcluded(candidate)) return;
  candidate.bound = scoreOf(candidate, best_bound_ + penalty) - penalty;
  if (candidate.bound > best_bound_) open_.push_back(candidate);
}

void PoseSearch::sortFrom(std::size_t first) {
  std::sort(open_.begin() + static_cast<std::ptrdiff_t>(first), open_.end(),
            [](const Candidate& a, const Candidate& b) {
              if (a.bound != b.bound) return a.bound < b.bound;
              return std::tie(a.turn, a.y, a.x) > std::tie(b.turn, b.y, b.x);
            });
}

Pose2 PoseSearch::poseOf(const Candidate& c) const {
  const double cell = pyramid_.cell();
  return {window_.centre.x + (c.x - steps_) * cell, window_.centre.y + (c.y - steps_) * cell,
          turned_[static_cast<std::size_t>(c.turn)].angle};
}

/// @param least  what cannot score more is given up, and its score is less.
double PoseSearch::scoreOf(const Candidate& c, double least) {
  const double most =
      255.0 * static_cast<double>(turned_[static_cast<std::size_t>(c.turn)].cells.size());
  // What may be missed of the most that there could be.
  const int may_miss = static_cast<int>((1.0 - least) * most) + 1;
  const int missed = missedBy(c, may_miss);
  return missed > may_miss ? 0.0 : (most - missed) / most;
}

/// What a candidate misses of the most that there could be, given up beyond `most`.
int PoseSearch::missedBy(const Candidate& c, int most) {
  const TurnedQuery& turned = turned_[static_cast<std::size_t>(c.turn)];
  const std::size_t count = turned.cells.size();
  int missed = 0;
  std::size_t k = 0;
  if (pyramid_.covers(turned.low_x + c.x, turned.low_y + c.y, turned.high_x + c.x,
                      turned.high_y + c.y)) {
    const std::uint8_t* level = pyramid_.level(c.level) + pyramid_.offset(c.x, c.y, 0);
    while (k < count && missed <= most) {
      const std::size_t end = std::min(count, k + kAtOnce);
      for (; k < end; ++k) missed += 255 - level[turned.offsets[k]];
    }
  } else {
    for (; k < count && missed <= most; ++k) {
      const Eigen::Vector3i& at = turned.cells[k];
      missed += 255 - pyramid_.at(c.level, at.z(), at.x() + c.x, at.y() + c.y);
    }
  }
  looked_up_ += static_cast<int>(k);
  return missed;
}

/// The least penalty of the shifts that a candidate stands for.
double PoseSearch::penaltyOf(const Candidate& c) const {
  const double cell = pyramid_.cell();
  const auto least = [&](int from) {
    const int low = from - steps_, high = std::min(from + (1 << c.level) - 1, 2 * steps_) - steps_;
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

/// Whether all the shifts that a candidate stands for lie beside what was found.
bool PoseSearch::isExcluded(const Candidate& c) const {
  if (!excluded_) return false;
  const Eigen::Vector3d off = difference(poseOf(c), excluded_->T_map_query);
  const double size = ((1 << c.level) - 1) * pyramid_.cell();
  const auto farthest = [&](double from) {
    return std::max(std::abs(from), std::abs(from + size));
  };
  return std::hypot(farthest(off.x()), farthest(off.y())) < excluded_->distance &&
         std::abs(off.z()) < excluded_->turn;
}

std::optional<SearchResult> searchPose(std::vector<SurfacePoint> query, LikelihoodPyramid pyramid,
                                       const SearchWindow& window, double least_score) {
  PoseSearch search(std::move(query), std::move(pyramid), window, least_score);
  search.run();
  return search.found();
}

}  // namespace cca
