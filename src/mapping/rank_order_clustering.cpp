// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/rank_order_clustering.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace cca {
namespace {

using Word = std::vector<bool>;

/// Rows of the cut matrix as binary words, rows and columns both in the given order.
std::vector<Word> wordsInOrder(const SimilarityMatrix& s, double cut,
                               const std::vector<int>& order) {
  std::vector<Word> words(order.size(), Word(order.size()));
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = 0; j < order.size(); ++j) words[i][j] = s(order[i], order[j]) >= cut;
  }
  return words;
}

/// One of King's sorts, largest word first; true where something moved.
bool sortOnce(const SimilarityMatrix& s, double cut, std::vector<int>* order) {
  const std::vector<Word> words = wordsInOrder(s, cut, *order);
  std::vector<int> rank(order->size());
  std::iota(rank.begin(), rank.end(), 0);
  std::stable_sort(rank.begin(), rank.end(), [&](int a, int b) { return words[b] < words[a]; });
  if (std::is_sorted(rank.begin(), rank.end())) return false;
  std::vector<int> sorted(order->size());
  for (std::size_t i = 0; i < rank.size(); ++i) sorted[i] = (*order)[rank[i]];
  order->swap(sorted);
  return true;
}

}  // namespace

std::vector<std::vector<int>> rankOrderGroups(const SimilarityMatrix& similarity, double cut) {
  std::vector<int> order(similarity.size());
  std::iota(order.begin(), order.end(), 0);
  for (int sweep = 0; sweep < similarity.size() && sortOnce(similarity, cut, &order); ++sweep) {
  }
  std::vector<std::vector<int>> groups;
  for (const int next : order) {
    const bool joins =
        !groups.empty() && std::all_of(groups.back().begin(), groups.back().end(),
                                       [&](int member) { return similarity(member, next) >= cut; });
    if (!joins) groups.emplace_back();
    groups.back().push_back(next);
  }
  return groups;
}

}  // namespace cca
