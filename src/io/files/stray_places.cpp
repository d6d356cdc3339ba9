// SPDX-License-Identifier: BSD-3-Clause
#include "io/files/stray_places.hpp"

#include <algorithm>

namespace cca {
namespace {

constexpr double kWidestGap = 200.0;  // m
constexpr double kFarthest = 1e4;     // m
constexpr double kStrayShare = 0.05;

/// Places without a wide gap between them: [first, last) of an order along an axis.
struct Group {
  std::size_t first, last;
  double low, high, weight;
};

std::vector<Group> groupsAlong(Eigen::Index axis, const std::vector<WeightedPlace>& places,
                               const std::vector<std::size_t>& order) {
  std::vector<Group> groups;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto& [box, weight] = places[order[k]];
    if (groups.empty() || box.min()[axis] - groups.back().high > kWidestGap) {
      groups.push_back({k, k, box.min()[axis], box.max()[axis], 0.0});
    }
    Group& group = groups.back();
    group.last = k + 1;
    group.high = std::max(group.high, box.max()[axis]);
    group.weight += weight;
  }
  return groups;
}

void markStraysAlong(Eigen::Index axis, const std::vector<WeightedPlace>& places,
                     std::vector<bool>& stray) {
  std::vector<std::size_t> order;
  double all = 0.0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    if (stray[k]) continue;
    order.push_back(k);
    all += places[k].weight;
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return places[a].box.min()[axis] < places[b].box.min()[axis];
  });
  const std::vector<Group> groups = groupsAlong(axis, places, order);
  const auto heaviest =
      std::max_element(groups.begin(), groups.end(),
                       [](const Group& a, const Group& b) { return a.weight < b.weight; });
  for (const Group& group : groups) {
    const double gap = std::max(group.low - heaviest->high, heaviest->low - group.high);
    if (group.weight >= kStrayShare * all && gap <= kFarthest) continue;
    for (std::size_t k = group.first; k < group.last; ++k) stray[order[k]] = true;
  }
}

}  // namespace

std::vector<bool> findStrays(const std::vector<WeightedPlace>& places) {
  std::vector<bool> stray(places.size(), false);
  for (const Eigen::Index axis : {0, 1}) markStraysAlong(axis, places, stray);
  return stray;
}

std::vector<bool> findStrays(const std::vector<Pose2>& trajectory) {
  std::vector<WeightedPlace> places;
  for (const Pose2& pose : trajectory) {
    places.push_back({Eigen::AlignedBox2d(pose.position()), 1.0});
  }
  return findStrays(places);
}

double drivenLength(const std::vector<Pose2>& trajectory) {
  const std::vector<bool> stray = findStrays(trajectory);
  const Pose2* last = nullptr;
  double length = 0.0;
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    if (stray[k]) continue;
    if (last) length += (trajectory[k].position() - last->position()).norm();
    last = &trajectory[k];
  }
  return length;
}

}  // namespace cca
