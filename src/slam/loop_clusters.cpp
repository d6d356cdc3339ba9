// SPDX-License-Identifier: BSD-3-Clause
#include "slam/loop_clusters.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "slam/loop_closer.hpp"

namespace cca {
namespace {

constexpr std::size_t kMostWithout = 10, kMostWith = 8;  // bound the work of a round

}  // namespace

void numberClusters(const PoseGraph& graph, std::vector<LoopOfCluster>& loops) {
  std::vector<std::size_t> first(loops.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  const auto rootOf = [&](std::size_t k) {
    while (first[k] != k) k = first[k];
    return k;
  };
  for (std::size_t a = 0; a < loops.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (loops[a].is_believed != loops[b].is_believed) continue;
      if (!saySamePlace(graph, loops[a].verdict, loops[b].verdict)) continue;
      const std::size_t root_a = rootOf(a), root_b = rootOf(b);
      first[std::max(root_a, root_b)] = std::min(root_a, root_b);
    }
  }
  for (std::size_t k = 0; k < loops.size(); ++k) loops[k].cluster = static_cast<int>(rootOf(k));
}

std::vector<LoopChange> changesOf(const std::vector<LoopOfCluster>& loops) {
  std::vector<LoopChange> without, with;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    if (loops[k].cluster != static_cast<int>(k)) continue;
    double size = 0.0, widest = 0.0;
    for (const LoopOfCluster& loop : loops) {
      if (loop.cluster != loops[k].cluster) continue;
      size += 1.0;
      widest = std::max(widest, loop.verdict.window);
    }
    const int number = loops[k].cluster;
    if (loops[k].is_believed) {
      without.push_back({true, number, widest});
    } else if (size > 1.0) {
      with.push_back({false, number, size});
    }
  }
  const auto earlier = [](const LoopChange& a, const LoopChange& b) {
    return a.first != b.first ? a.first > b.first : a.cluster < b.cluster;
  };
  std::sort(without.begin(), without.end(), earlier);
  std::sort(with.begin(), with.end(), earlier);
  if (without.size() > kMostWithout) without.resize(kMostWithout);
  if (with.size() > kMostWith) with.resize(kMostWith);
  without.insert(without.end(), with.begin(), with.end());
  return without;
}

}  // namespace cca
