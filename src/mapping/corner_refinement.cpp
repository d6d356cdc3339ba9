// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/corner_refinement.hpp"

#include <algorithm>

#include "geometry/cross.hpp"
#include "mapping/k_means.hpp"

namespace cca {
namespace {

/// Longest line sought among loose points, and longest run that is shared out.
constexpr int kLongestLoose = 8;
/// nats, what it may cost that two lines meet at their boundary: half the 99 % quantile of
/// chi-square with the one degree of freedom that this takes.
constexpr double kMeetingPrice = 3.32;

bool shareOut(const ScanPoints& points, const RunFitter& fitter, Runs* runs) {
  bool shared = false;
  for (std::size_t k = 1; k + 1 < runs->size(); ++k) {
    FittedRun &a = (*runs)[k - 1], &b = (*runs)[k], &c = (*runs)[k + 1];
    if (a.size() == 0 || b.size() > 2 * kLongestLoose) continue;
    if (b.kept_from == a.first && b.kept_to == c.last) continue;
    b.kept_from = a.first;
    b.kept_to = c.last;
    if (!areNeighbours(points, a, b) || !areNeighbours(points, b, c)) continue;
    const int middle =
        twoMeans(fitter, a.first, b.first, b.last, c.last, a.price + b.price + c.price - kNoGain);
    if (middle < 0) continue;
    shared = true;
    b = fitter.fit(a.first, middle);
    c = fitter.fit(middle, c.last);
    a.last = a.first;
  }
  dropEmpty(runs);
  return shared;
}

bool splitLines(const RunFitter& fitter, Runs* runs) {
  const std::size_t before = runs->size();
  for (std::size_t k = 0; k < runs->size(); ++k) {
    FittedRun& run = (*runs)[k];
    const int first = run.first, last = run.last;
    const bool may_gain =
        !run.is_searched && (!run.is_line || 0.5 * run.chi_square > fitter.linePrice());
    const int middle =
        may_gain ? twoMeans(fitter, first, first + 1, last - 1, last, run.price - kNoGain) : -1;
    if (run.is_line) run.is_searched = true;
    if (middle < 0) continue;
    run = fitter.fit(first, middle);
    runs->insert(runs->begin() + static_cast<std::ptrdiff_t>(++k), fitter.fit(middle, last));
  }
  return runs->size() > before;
}

/// Appends the points first <= i < last as their best line and what is left on either side.
void appendLinesAmong(const ScanPoints& points, const RunFitter& fitter, int first, int last,
                      Runs* runs) {
  int best_first = first, best_last = first;
  double most = kNoGain;
  for (int i = first; i + kFewestPoints <= last; ++i) {
    for (int j = i + 2; j <= std::min(last, i + kLongestLoose); ++j) {
      if (points.breaksBetween(i, j - 1) > 0) break;
      if (j < i + kFewestPoints) continue;
      const double gain = kPointPrice * (j - i) - fitter.price(i, j);
      if (gain <= most) continue;
      most = gain;
      best_first = i;
      best_last = j;
    }
  }
  if (best_last == best_first) {
    if (last <= first) return;
    FittedRun loose = fitter.fit(first, last);
    loose.is_line = false;
    loose.price = kPointPrice * loose.size();
    loose.is_searched = true;
    runs->push_back(loose);
    return;
  }
  appendLinesAmong(points, fitter, first, best_first, runs);
  runs->push_back(fitter.fit(best_first, best_last));
  appendLinesAmong(points, fitter, best_last, last, runs);
}

bool tellLoosePoints(const ScanPoints& points, const RunFitter& fitter, Runs* runs) {
  Runs told;
  told.reserve(runs->size() + 1);
  bool found = false;
  for (std::size_t k = 0; k < runs->size();) {
    if ((*runs)[k].is_line) {
      told.push_back((*runs)[k++]);
      continue;
    }
    std::size_t end = k + 1;
    while (end < runs->size() && !(*runs)[end].is_line &&
           points.silentBetween((*runs)[end - 1].last - 1, (*runs)[end].first) == 0) {
      ++end;
    }
    if (end == k + 1 && (*runs)[k].is_searched) {
      told.push_back((*runs)[k++]);
      continue;
    }
    const std::size_t before = told.size();
    appendLinesAmong(points, fitter, (*runs)[k].first, (*runs)[end - 1].last, &told);
    for (std::size_t i = before; i < told.size(); ++i) found = found || told[i].is_line;
    k = end;
  }
  runs->swap(told);
  return found;
}

/// Whether the lines of a and b intersect between the last beam of a and the first of b.
bool meetAtBoundary(const ScanPoints& points, const FittedRun& a, const FittedRun& b) {
  const Eigen::Vector2d &before = points.positions[a.last - 1], &after = points.positions[b.first];
  const auto corner = intersection(a.line, b.line);
  return corner && corner->dot(before) > 0.0 && cross(before, *corner) >= 0.0 &&
         cross(*corner, after) >= 0.0;
}

/// The edge that tells the points about the boundary of two lines most briefly, and meets both.
bool findEdgeBetween(const ScanPoints& points, const RunFitter& fitter, double loose_price,
                     FittedRun* a, FittedRun* edge, FittedRun* b) {
  const int first = a->first, low = a->last, high = b->first, last = b->last;
  if (high - low > kLongestLoose || points.breaksBetween(low - 1, high) > 0) return false;
  const int from = std::max(first + kFewestPoints, low - kBoundaryReach);
  const int to = std::min(last - kFewestPoints, high + kBoundaryReach);
  if (from > low || to < high) return false;
  double least = 0.5 * (a->chi_square + b->chi_square) + loose_price - fitter.vertexPrice();
  const auto leastOf = [&](int i, int j) { return i < j ? fitter.leastHalfChiSquare(i, j) : 0.0; };
  // Fewer points have smaller residuals: where none at all would not pay, nothing does.
  const double least_after = leastOf(to, last);
  if (leastOf(first, from) + least_after >= least) return false;
  bool found = false;
  for (int i = from; i <= low && leastOf(first, i) + least_after < least; ++i) {
    const FittedRun left = fitter.fit(first, i);
    if (!left.is_line) continue;
    for (int j = std::max(high, i + 2); j <= std::min(to, i + kLongestLoose); ++j) {
      if (0.5 * left.chi_square + leastOf(i, j) + leastOf(j, last) >= least) continue;
      const FittedRun middle = fitter.fit(i, j), right = fitter.fit(j, last);
      const double told = 0.5 * (left.chi_square + middle.chi_square + right.chi_square);
      if (told >= least || !right.is_line || !fitter.hasDirection(middle)) continue;
      if (!meetAtBoundary(points, left, middle) || !meetAtBoundary(points, middle, right)) continue;
      least = told;
      *a = left;
      *edge = middle;
      *b = right;
      found = true;
    }
  }
  edge->is_line = true;
  return found;
}

}  // namespace

bool refineCorners(const ScanPoints& points, const RunFitter& fitter, Runs* runs,
                   const Ablation& without) {
  bool changed = !without(Part::kKMeans) && kMeans(points, fitter, runs);
  if (splitLines(fitter, runs)) changed = true;
  if (tellLoosePoints(points, fitter, runs)) changed = true;
  if (shareOut(points, fitter, runs)) changed = true;
  return changed;
}

void meetAtCorners(const ScanPoints& points, const RunFitter& fitter, Runs* runs) {
  for (std::size_t k = 0; k + 1 < runs->size(); ++k) {
    FittedRun &a = (*runs)[k], &b = (*runs)[k + 1];
    if (!a.is_line || !b.is_line || !areNeighbours(points, a, b)) continue;
    if (meetAtBoundary(points, a, b)) continue;
    const int first = a.first, last = b.last, from = std::max(first, a.last - kBoundaryReach);
    const int to = std::min(last, a.last + kBoundaryReach);
    double least = a.price + b.price + kMeetingPrice;
    for (int middle = from; middle <= to; ++middle) {
      const double least_right = fitter.leastPrice(middle, last);
      if (fitter.leastPrice(first, middle) + least_right >= least) continue;
      const FittedRun left = fitter.fit(first, middle);
      if (!left.is_line || left.price + least_right >= least) continue;
      const FittedRun right = fitter.fit(middle, last);
      if (!right.is_line || left.price + right.price >= least) continue;
      if (!meetAtBoundary(points, left, right)) continue;
      least = left.price + right.price;
      a = left;
      b = right;
    }
  }
}

void tellEdgesBetween(const ScanPoints& points, const RunFitter& fitter, Runs* runs) {
  for (std::size_t k = 0; k < runs->size(); ++k) {
    if (!(*runs)[k].is_line) continue;
    double loose_price = 0.0;
    std::size_t next = k + 1;
    while (next < runs->size() && !(*runs)[next].is_line) loose_price += (*runs)[next++].price;
    if (next == runs->size()) return;
    FittedRun edge;
    if (!findEdgeBetween(points, fitter, loose_price, &(*runs)[k], &edge, &(*runs)[next])) continue;
    const auto between = runs->begin() + static_cast<std::ptrdiff_t>(++k);
    runs->insert(runs->erase(between, runs->begin() + static_cast<std::ptrdiff_t>(next)), edge);
  }
}

}  // namespace cca
