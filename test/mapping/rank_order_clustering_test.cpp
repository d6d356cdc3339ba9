// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/rank_order_clustering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace cca {
namespace {

/// King's algorithm as it is written: a dense matrix, words of zeros and ones, blocks by linkage.
std::vector<int> naiveGroups(const std::vector<std::vector<int>>& ones) {
  const int n = static_cast<int>(ones.size());
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  for (int sweep = 0; sweep < kMostRankOrderSweeps; ++sweep) {
    std::vector<std::pair<std::vector<int>, int>> words;
    for (const int i : order) {
      std::vector<int> word;
      for (const int j : order) word.push_back(ones[i][j]);
      words.emplace_back(word, i);
    }
    std::stable_sort(words.begin(), words.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<int> next;
    for (const auto& w : words) next.push_back(w.second);
    if (next == order) break;
    order = next;
  }
  std::vector<int> group(n, -1);
  std::vector<int> block;
  int open = -1;
  for (const int k : order) {
    const bool joins =
        open >= 0 && std::all_of(block.begin(), block.end(), [&](int m) { return ones[m][k]; });
    if (!joins) {
      ++open;
      block.clear();
    }
    block.push_back(k);
    group[k] = open;
  }
  return group;
}

TEST(RankOrderClustering, FindsTheBlocksOfAShuffledBlockMatrix) {
  const std::vector<int> truth = {2, 0, 1, 0, 2, 2, 1, 0, 3};
  SimilarityMatrix s(9);
  for (int i = 0; i < 9; ++i) {
    for (int j = i + 1; j < 9; ++j) s.set(i, j, truth[i] == truth[j] ? 0.9 : 0.2);
  }
  const std::vector<int> group = rankOrderGroups(s, 0.5);
  for (int i = 0; i < 9; ++i) {
    for (int j = 0; j < 9; ++j) EXPECT_EQ(group[i] == group[j], truth[i] == truth[j]);
  }
}

TEST(RankOrderClustering, EqualsKingsSortsOnDenseWords) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 1 + trial % 70;
    const double density = 0.05 + 0.5 * uniform(random);
    SimilarityMatrix s(n);
    std::vector<std::vector<int>> ones(n, std::vector<int>(n, 0));
    for (int i = 0; i < n; ++i) {
      ones[i][i] = 1;
      for (int j = i + 1; j < n; ++j) {
        const double value = uniform(random) < density ? 0.8 : 0.3;
        s.set(i, j, value);
        ones[i][j] = ones[j][i] = value >= 0.5;
      }
    }
    EXPECT_EQ(rankOrderGroups(s, 0.5), naiveGroups(ones)) << "n = " << n;
  }
}

TEST(RankOrderClustering, NeverPutsUnlikeSegmentsIntoOneGroup) {
  const int n = 100;  // a curved wall: only neighbours are alike
  SimilarityMatrix s(n);
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < std::min(n, i + 4); ++j) s.set(i, j, 0.9);
  }
  const std::vector<int> group = rankOrderGroups(s, 0.5);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (group[i] == group[j]) {
        EXPECT_LT(std::abs(i - j), 4);
      }
    }
  }
}

TEST(RankOrderClustering, TakesAHigherCutForFewerLikenesses) {
  SimilarityMatrix s(3);
  s.set(0, 1, 0.9);
  s.set(1, 2, 0.6);
  s.set(0, 2, 0.6);
  const std::vector<int> low = rankOrderGroups(s, 0.5), high = rankOrderGroups(s, 0.8);
  EXPECT_TRUE(low[0] == low[1] && low[1] == low[2]);
  EXPECT_TRUE(high[0] == high[1] && high[1] != high[2]);
}

TEST(RankOrderClustering, OfNothingIsNothing) {
  EXPECT_TRUE(rankOrderGroups(SimilarityMatrix(0), 0.5).empty());
  EXPECT_EQ(rankOrderGroups(SimilarityMatrix(1), 0.5), std::vector<int>{0});
}

}  // namespace
}  // namespace cca
