// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/line_merging.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/cross.hpp"
#include "mapping/rank_order_clustering.hpp"
#include "mapping/similarity.hpp"
#include "sensing/gates.hpp"

namespace cca {
namespace {

/// Each run is compared with this many that follow it. Rounds join longer walls.
constexpr int kNeighbours = 3;

/// What speaks for a gap between two neighbours: a beam between them that did not return, or a step
/// in depth beside anything but two lines, for points across a step are soon in line with the beam.
/// Either is evidence without end, so that nothing else need be asked.
double gapToNext(const ScanPoints& points, const FittedRun& a, const FittedRun& b) {
  const bool none = points.silentBetween(a.last - 1, b.first) == 0 &&
                    ((a.is_line && b.is_line) || areNeighbours(points, a, b));
  return none ? 0.0 : std::numeric_limits<double>::infinity();
}

/// Similarity of two neighbours: the gap is asked first, for nothing else need be where there is
/// one.
double similarityOf(const RunFitter& fitter, const AlphaCut& cut, const FittedRun& run,
                    const FittedRun& next, double gap) {
  if (gap > 0.0 && !cut.without(Part::kGap)) return 0.0;
  const FittedRun joint = fitter.fit(run.first, next.last);
  return cut.similarity(memberships(run, next, joint, gap, fitter.linePrice()));
}

/// Similarity of a run to the next one, remembered until either changes.
double similarityToNext(const ScanPoints& points, const RunFitter& fitter, const AlphaCut& cut,
                        const FittedRun& next, FittedRun* run) {
  if (run->compared_with == next.last) return run->similarity;
  run->compared_with = next.last;
  run->similarity = similarityOf(fitter, cut, *run, next, gapToNext(points, *run, next));
  return run->similarity;
}

/// The similarities among runs first <= i < last, of which each is alike the next.
SimilarityMatrix similarityOfRow(const ScanPoints& points, const RunFitter& fitter,
                                 const AlphaCut& cut, const Runs& runs, int first, int last) {
  SimilarityMatrix s(last - first);
  for (int i = first; i + 1 < last; ++i) {
    double similarity = runs[i].similarity;
    for (int j = i + 1; similarity >= cut.value; ++j) {
      s.set(i - first, j - first, similarity);
      const int next = j + 1;
      if (next >= last || next > i + kNeighbours) break;
      const double gap = gapToNext(points, runs[j], runs[next]);
      const FittedRun row = fitter.fit(runs[i].first, runs[j].last);
      similarity = similarityOf(fitter, cut, row, runs[next], gap);
    }
  }
  return s;
}

/// m. What hides more than this of a wall may hide a doorway as well: it is as likely two walls as
/// one. The length matters, not its share of what is seen (docs/tuning.md).
constexpr double kHiddenToEvenOdds = 0.5;

/// A line in pieces that something hides in part: its runs in scan order.
struct Interrupted {
  std::vector<int> runs;
  FittedSegment fit;
};

/// Rays on the way from run i on to run j that speak against a wall there: they pass it, they do
/// not return, or they end before it on what no other line explains.
double raysAgainst(const ScanPoints& points, const FittedSegment& joint, const Runs& runs, int i,
                   int j) {
  const bool over_seam = j < i;
  double against = over_seam ? points.silentAtSeam() +
                                   points.silentBetween(runs[i].last - 1, runs.back().last - 1) +
                                   points.silentBetween(0, runs[j].first)
                             : points.silentBetween(runs[i].last - 1, runs[j].first);
  const Eigen::Vector2d normal(-joint.line.direction.y(), joint.line.direction.x());
  const double distance = normal.dot(joint.line.centroid);
  const double gate = kNormalGate * std::sqrt(joint.variance);
  const int n = static_cast<int>(runs.size());
  for (int k = (i + 1) % n; k != j; k = (k + 1) % n) {
    for (int p = runs[k].first; p < runs[k].last; ++p) {
      const double off = normal.dot(points.positions[p]) - distance;
      const double behind = distance < 0.0 ? -off : off;
      if (behind > gate || (behind < -gate && !runs[k].is_line)) against += 1.0;
    }
  }
  return against;
}

/// One lies within the stretch of the other.
bool interlaced(const Interrupted& a, const Interrupted& b) {
  const auto within = [](int k, const Interrupted& l) {
    const int from = l.runs.front(), to = l.runs.back();
    return from <= to ? from < k && k < to : k > from || k < to;
  };
  return within(b.runs.front(), a) || within(a.runs.front(), b);
}

/// Evidence against one wall through both, in rays: those of the gap, and the hidden length.
/// Infinite where the field of view does not hold the gap.
double gapEvidence(const ScanPoints& points, const FittedSegment& joint, const Runs& runs,
                   const Interrupted& a, const Interrupted& b) {
  const auto first = [&](const Interrupted& l) {
    return points.positions[runs[l.runs.front()].first];
  };
  const auto last = [&](const Interrupted& l) {
    return points.positions[runs[l.runs.back()].last - 1];
  };
  const bool forward = cross(last(a), first(b)) >= 0.0;
  if (!forward && !points.closed) return std::numeric_limits<double>::infinity();
  const Interrupted &from = forward ? a : b, &to = forward ? b : a;
  const Eigen::Vector2d& u = joint.line.direction;
  const double hidden = std::abs(u.dot(first(to) - last(from)));
  return hidden / kHiddenToEvenOdds +
         raysAgainst(points, joint, runs, from.runs.back(), to.runs.front());
}

/// Scan order, begun after the turn away from the line: a wall may lie across the seam.
void orderAlong(const ScanPoints& points, const Runs& runs, std::vector<int>* parts) {
  std::sort(parts->begin(), parts->end());
  for (std::size_t k = 0; k + 1 < parts->size(); ++k) {
    const auto& end = points.positions[runs[(*parts)[k]].last - 1];
    const auto& start = points.positions[runs[(*parts)[k + 1]].first];
    if (cross(end, start) >= 0.0) continue;
    std::rotate(parts->begin(), parts->begin() + static_cast<std::ptrdiff_t>(k) + 1, parts->end());
    return;
  }
}

bool mergeInterrupted(const ScanPoints& points, const RunFitter& fitter, const AlphaCut& cut,
                      const Runs& runs, std::vector<Interrupted>* lines) {
  const int n = static_cast<int>(lines->size());
  SimilarityMatrix s(n);
  // Residuals that grow by more than this, m^2, no fit bears: most need no root to be told apart.
  const double most = 2.0 * fitter.linePrice() * (1.0 / cut.value - 1.0) * fitter.mostVariance();
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      const Interrupted &a = (*lines)[i], &b = (*lines)[j];
      PointMoments moments = a.fit.moments;
      moments.add(b.fit.moments);
      const double told = a.fit.line.residual_sum_sq + b.fit.line.residual_sum_sq;
      if (leastResidual(moments) > told + most && !cut.without(Part::kFit)) continue;
      if (interlaced(a, b)) continue;
      const FittedSegment joint = fitter.fit(moments);
      Memberships mu = memberships(a.fit, b.fit, joint, 0.0, fitter.linePrice());
      if (cut.similarity(mu) < cut.value) continue;
      mu.gap = bell(gapEvidence(points, joint, runs, a, b), kGapGate);
      if (cut.similarity(mu) >= cut.value) s.set(i, j, cut.similarity(mu));
    }
  }
  if (s.entries().empty()) return false;
  const std::vector<int> group_of = rankOrderGroups(s, cut);
  std::vector<Interrupted> merged(lines->size());
  for (int k = 0; k < n; ++k) {
    const Interrupted& part = (*lines)[k];
    Interrupted& line = merged[group_of[k]];
    line.runs.insert(line.runs.end(), part.runs.begin(), part.runs.end());
    line.fit.moments.add(part.fit.moments);
  }
  while (!merged.empty() && merged.back().runs.empty()) merged.pop_back();
  if (merged.size() == lines->size()) return false;
  for (Interrupted& line : merged) {
    orderAlong(points, runs, &line.runs);
    line.fit = fitter.fit(line.fit.moments);
  }
  std::sort(merged.begin(), merged.end(),
            [](const Interrupted& a, const Interrupted& b) { return a.runs < b.runs; });
  lines->swap(merged);
  return true;
}

}  // namespace

bool mergeConsecutive(const ScanPoints& points, const RunFitter& fitter, const AlphaCut& cut,
                      Runs* runs) {
  const int n = static_cast<int>(runs->size());
  int kept = 0;
  const auto keep = [&](int first, int last) {
    if (last > first + 1) {
      (*runs)[kept] = fitter.fit((*runs)[first].first, (*runs)[last - 1].last);
    } else if (kept < first) {
      (*runs)[kept] = (*runs)[first];
    }
    ++kept;
  };
  // The matrix falls apart into rows of runs of which each is alike the next, and so does its
  // clustering.
  for (int first = 0, last = 1; first < n; first = last++) {
    while (last < n &&
           similarityToNext(points, fitter, cut, (*runs)[last], &(*runs)[last - 1]) >= cut.value) {
      ++last;
    }
    if (last <= first + 2) {
      keep(first, last);
      continue;
    }
    const auto row = similarityOfRow(points, fitter, cut, *runs, first, last);
    const std::vector<int> group_of = rankOrderGroups(row, cut);
    for (int i = first, j = first + 1; i < last; i = j++) {
      while (j < last && group_of[j - first] == group_of[i - first]) ++j;
      keep(i, j);
    }
  }
  runs->resize(kept);
  return kept < n;
}

std::vector<std::vector<int>> groupInterrupted(const ScanPoints& points, const RunFitter& fitter,
                                               const AlphaCut& cut, const Runs& runs) {
  std::vector<Interrupted> lines;
  lines.reserve(runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].is_line) lines.push_back({{static_cast<int>(k)}, runs[k]});
  }
  while (!cut.without(Part::kInterrupted) && mergeInterrupted(points, fitter, cut, runs, &lines)) {
  }
  std::vector<std::vector<int>> groups;
  groups.reserve(lines.size());
  for (Interrupted& line : lines) groups.push_back(std::move(line.runs));
  return groups;
}

}  // namespace cca
