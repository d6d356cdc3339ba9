// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/aside_goals.hpp"

#include <algorithm>
#include <cstdlib>

namespace cca {
namespace {

constexpr std::size_t kRetryAfter = 4000;  // cells newly seen: 10 m^2
constexpr int kSameTarget = 3;             // cells

bool isSameTarget(Cell a, Cell b) {
  return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) <= kSameTarget;
}

}  // namespace

void AsideGoals::add(Cell target, std::size_t revealed) { aside_.push_back({target, revealed}); }

bool AsideGoals::noteLostWay(Cell target) {
  const bool again = std::any_of(lost_ways_.begin(), lost_ways_.end(),
                                 [&](Cell lost) { return isSameTarget(lost, target); });
  if (!again) lost_ways_.push_back(target);
  return again;
}

bool AsideGoals::contains(Cell target, std::size_t revealed) const {
  return std::any_of(aside_.begin(), aside_.end(), [&](const Aside& a) {
    return isSameTarget(a.target, target) && revealed < a.revealed_then + kRetryAfter;
  });
}

void AsideGoals::move(const CellMove& moved, std::size_t revealed) {
  for (Aside& a : aside_) a = {moved(a.target), std::min(a.revealed_then, revealed)};
  for (Cell& lost : lost_ways_) lost = moved(lost);
}

}  // namespace cca
