// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/k_means.hpp"

#include <algorithm>

namespace cca {
namespace {

/// One sweep over all boundaries.
bool moveBoundaries(const ScanPoints& points, const RunFitter& fitter, double worth, Runs* runs) {
  bool moved = false;
  for (std::size_t k = 0; k + 1 < runs->size(); ++k) {
    FittedRun &a = (*runs)[k], &b = (*runs)[k + 1];
    if (a.settled_with == b.last || (!a.is_line && !b.is_line)) continue;
    a.settled_with = b.last;
    if (!areNeighbours(points, a, b)) continue;
    const int low = std::max(a.first, a.last - kBoundaryReach);
    const int high = std::min(b.last, a.last + kBoundaryReach);
    const int middle = twoMeans(fitter, a.first, low, high, b.last, a.price + b.price - worth);
    if (middle < 0) continue;
    moved = true;
    const int last = b.last;
    a = fitter.fit(a.first, middle);
    b = fitter.fit(middle, last);
    if (k > 0) (*runs)[k - 1].settled_with = -1;
  }
  dropEmpty(runs);
  return moved;
}

}  // namespace

int twoMeans(const RunFitter& fitter, int first, int low, int high, int last, double price) {
  int best = -1;
  double least = price;
  for (int middle = low; middle <= high; ++middle) {
    const double least_after = fitter.leastPrice(middle, last);
    if (fitter.leastPrice(first, middle) + least_after >= least) continue;
    const double before = fitter.price(first, middle);
    if (before + least_after >= least) continue;
    const double parted = before + fitter.price(middle, last);
    if (parted < least) {
      least = parted;
      best = middle;
    }
  }
  return best;
}

bool kMeans(const ScanPoints& points, const RunFitter& fitter, Runs* runs, double worth) {
  bool changed = false;
  while (moveBoundaries(points, fitter, worth, runs)) changed = true;
  return changed;
}

}  // namespace cca
