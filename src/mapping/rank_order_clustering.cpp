// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/rank_order_clustering.hpp"

#include <algorithm>
#include <numeric>

namespace cca {
namespace {

/// The ones of the cut matrix, row after row.
struct Ones {
  std::vector<int> begin;   // of each row in columns; one more than rows
  std::vector<int> column;  // includes the diagonal
};

Ones cutMatrix(const SimilarityMatrix& s, double cut) {
  Ones ones;
  ones.begin.assign(s.size() + 1, 0);
  for (int i = 0; i < s.size(); ++i) ones.begin[i + 1] = 1;
  for (const auto& e : s.entries()) {
    if (e.value < cut) continue;
    ++ones.begin[e.row + 1];
    ++ones.begin[e.column + 1];
  }
  std::partial_sum(ones.begin.begin(), ones.begin.end(), ones.begin.begin());
  ones.column.resize(ones.begin.back());
  std::vector<int> next(ones.begin.begin(), ones.begin.end() - 1);
  for (int i = 0; i < s.size(); ++i) ones.column[next[i]++] = i;
  for (const auto& e : s.entries()) {
    if (e.value < cut) continue;
    ones.column[next[e.row]++] = e.column;
    ones.column[next[e.column]++] = e.row;
  }
  return ones;
}

/// Where nothing but ones stands there is nothing to sort.
bool allAlike(const SimilarityMatrix& s, double cut) {
  const auto alike = std::count_if(s.entries().begin(), s.entries().end(),
                                   [&](const auto& e) { return e.value >= cut; });
  return 2 * alike == static_cast<std::ptrdiff_t>(s.size()) * (s.size() - 1);
}

/// One of King's sorts, largest word first; true where something moved.
///
/// A word is kept as the rising places of its ones: the larger of two binary words is the one with
/// the smaller place where they first differ, and the longer where one begins the other.
bool sortOnce(const Ones& ones, std::vector<int>* order, std::vector<int>* place,
              std::vector<int>* words) {
  const int n = static_cast<int>(order->size());
  for (int i = 0; i < n; ++i) {
    for (int k = ones.begin[i]; k < ones.begin[i + 1]; ++k) (*words)[k] = (*place)[ones.column[k]];
    std::sort(words->begin() + ones.begin[i], words->begin() + ones.begin[i + 1]);
  }
  const auto larger = [&](int a, int b) {
    const int* wa = words->data() + ones.begin[a];
    const int* wb = words->data() + ones.begin[b];
    const int na = ones.begin[a + 1] - ones.begin[a], nb = ones.begin[b + 1] - ones.begin[b];
    for (int k = 0; k < std::min(na, nb); ++k) {
      if (wa[k] != wb[k]) return wa[k] < wb[k];
    }
    return na != nb ? na > nb : (*place)[a] < (*place)[b];
  };
  if (std::is_sorted(order->begin(), order->end(), larger)) return false;
  std::sort(order->begin(), order->end(), larger);
  for (int i = 0; i < n; ++i) (*place)[(*order)[i]] = i;
  return true;
}

}  // namespace

std::vector<int> rankOrderGroups(const SimilarityMatrix& similarity, const AlphaCut& cut) {
  if (allAlike(similarity, cut.value)) return std::vector<int>(similarity.size());
  const Ones ones = cutMatrix(similarity, cut.value);
  std::vector<int> order(static_cast<std::size_t>(similarity.size()));
  std::iota(order.begin(), order.end(), 0);
  std::vector<int> place = order, words(ones.column.size());
  const int sweeps = cut.without(Part::kRankOrder) ? 0 : kMostRankOrderSweeps;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    if (!sortOnce(ones, &order, &place, &words)) break;
  }
  std::vector<int> group_of(order.size(), -1);
  int open = -1, members = 0;
  for (const int next : order) {
    int alike = 0;
    for (int k = ones.begin[next]; k < ones.begin[next + 1]; ++k) {
      alike += group_of[ones.column[k]] == open ? 1 : 0;
    }
    const int enough = cut.without(Part::kCompleteLinkage) ? std::min(members, 1) : members;
    if (open < 0 || alike < enough) {
      ++open;
      members = 0;
    }
    group_of[next] = open;
    ++members;
  }
  return group_of;
}

}  // namespace cca
