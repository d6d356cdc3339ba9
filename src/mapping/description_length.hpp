// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "cca_mrpt/geometry/line_segment.hpp"
#include "cca_mrpt/mapping/parameters.hpp"
#include "cca_mrpt/sensing/range_noise.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

// What it costs to tell a scan, in nats [Rissanen 1978]: the common coin of all decisions. Points
// on a line cost the line once, and each of them half its squared normalised residual; a point on
// no line has a price of its own. Two pieces of wall are one where one line tells their points in
// fewer nats than two lines do, a corner is where two do.

/// Price of a line, nats. Its four parameters are twice those of a vertex, but where it ends its
/// points tell in part: a third more than a vertex, 16 nats where that is 12. Noise alone lets them
/// raise the likelihood by more than e^16 in one of 500 000 trials (chi-square 32, four degrees of
/// freedom). A scan offers some 10^5 ways to part it: about one false line in five scans at the
/// very most, for the ways are far from independent.
inline double linePrice(double vertex_price) { return 4.0 * vertex_price / 3.0; }
/// Price of a point on no line: a residual of sqrt(2 * 9) = 4.2 deviations, one in 45 000 points.
inline constexpr double kPointPrice = 9.0;
/// nats, below any real gain: keeps rounding from moving a boundary to and fro.
inline constexpr double kNoGain = 1e-6;
/// Two points always fit a line: three are the fewest that can speak against it.
inline constexpr int kFewestPoints = 3;

/// Whether points spread over more than their noise: a line has a direction only where twice the
/// noise along it, and once the noise across, do not explain its extent. (The many returns of one
/// spot are a streak along the beam, and would else make a line of it.)
inline bool isDrawnOut(double points, double spread_sum_sq, const LineNoise& noise) {
  constexpr double kSigmas = 2.0;  // deviations: 95 % of what noise alone spreads
  return spread_sum_sq > noise.across && spread_sum_sq > points * kSigmas * kSigmas * noise.along;
}

/// Points, the line through them, and which of the two tells the scan more briefly.
struct FittedSegment {
  PointMoments moments;
  FittedLine line;
  double variance = 0.0;    ///< m^2, > 0, of one point's distance from the line
  double chi_square = 0.0;  ///< sum of the squared residuals over their variance
  double price = 0.0;       ///< nats, of the briefer telling
  bool is_line = false;     ///< the line is the briefer

  FittedSegment() = default;
  FittedSegment(const PointMoments& points, const FittedLine& fitted, const LineNoise& noise,
                double line_price)
      : moments(points),
        line(fitted),
        variance(noise.across),
        chi_square(fitted.residual_sum_sq / noise.across) {
    const double told = line_price + 0.5 * chi_square, alone = kPointPrice * points.weight;
    is_line = points.weight >= kFewestPoints && told < alone &&
              isDrawnOut(points.weight, fitted.spread_sum_sq, noise);
    price = is_line ? told : alone;
  }
};

/// A run of neighbouring points of a scan, first <= i < last.
struct FittedRun : FittedSegment {
  int first = 0;
  int last = 0;
  // What is known of the run as it stands, so that corner refinement asks nothing twice.
  bool is_searched = false;  ///< no split, and no line among loose points, shortens the telling
  int settled_with = -1;     ///< end of the next run, with which the boundary was found to be best
  int kept_from = -1;        ///< start of the run before and end of the one after,
  int kept_to = -1;          ///< to which this one was not shared out
  int compared_with = -1;    ///< end of the next run, to which this is the similarity:
  double similarity = 0.0;

  FittedRun() = default;
  FittedRun(const FittedSegment& segment, int from, int to)
      : FittedSegment(segment), first(from), last(to) {}
  int size() const { return last - first; }
};

/// Runs of one wall each, in scan order, covering all points of a scan.
using Runs = std::vector<FittedRun>;

inline void dropEmpty(Runs* runs) {
  const auto is_empty = [](const FittedRun& run) { return run.size() == 0; };
  runs->erase(std::remove_if(runs->begin(), runs->end(), is_empty), runs->end());
}

/// No beam without return and no step in depth lies between two runs that follow one another.
inline bool areNeighbours(const ScanPoints& points, const FittedRun& a, const FittedRun& b) {
  return points.breaksBetween(a.last - 1, b.first) == 0;
}

/// Fits any run of a scan in O(1).
class RunFitter {
 public:
  RunFitter(const std::vector<Eigen::Vector2d>& points, const PointNoise& noise,
            double vertex_price = CcaParameters().vertex_price)
      : prefix_(points),
        noise_(noise),
        vertex_price_(vertex_price),
        line_price_(cca::linePrice(vertex_price)) {
    double farthest_sq = 0.0;
    for (const Eigen::Vector2d& p : points) farthest_sq = std::max(farthest_sq, p.squaredNorm());
    most_variance_ = noise.mostAcross(farthest_sq);
  }

  FittedRun fit(int first, int last) const { return {fit(prefix_.run(first, last)), first, last}; }
  /// The price of a run alone: the same as fit(first, last).price, cheaper; 0 of an empty run.
  double price(int first, int last) const {
    const double alone = kPointPrice * std::max(0, last - first);
    if (last - first < kFewestPoints) return alone;
    const PointMoments moments = prefix_.run(first, last);
    const PrincipalAxis axis = principalAxis(moments);
    const LineNoise noise = noise_.onLine(moments.mean, axis);
    if (!isDrawnOut(moments.weight, axis.spread_sum_sq, noise)) return alone;
    return std::min(alone, line_price_ + 0.5 * axis.residual_sum_sq / noise.across);
  }
  /// A lower bound of price(), without roots: most partings are not worth more.
  double leastPrice(int first, int last) const {
    const double points = last - first, alone = kPointPrice * points;
    if (points < kFewestPoints) return alone;
    return std::min(alone, linePrice() + leastHalfChiSquare(first, last));
  }
  FittedSegment fit(const PointMoments& moments) const {
    const FittedLine line = fitLine(moments);
    return {moments, line, noise_.onLine(line.centroid, line.direction), line_price_};
  }
  /// Whether the points are spread over more than their noise, however many there are.
  bool hasDirection(const FittedSegment& s) const {
    return isDrawnOut(s.moments.weight, s.line.spread_sum_sq,
                      noise_.onLine(s.line.centroid, s.line.direction));
  }
  /// A lower bound of fit(first, last).chi_square / 2 of at least one point, without roots.
  double leastHalfChiSquare(int first, int last) const {
    return 0.5 * prefix_.leastResidual(first, last) / most_variance_;
  }
  double mostVariance() const { return most_variance_; }  ///< m^2, > 0, across any line
  const PrefixMoments& prefix() const { return prefix_; }
  double vertexPrice() const { return vertex_price_; }  ///< nats
  double linePrice() const { return line_price_; }      ///< nats

 private:
  PrefixMoments prefix_;
  PointNoise noise_;
  double vertex_price_, line_price_;
  double most_variance_;
};

}  // namespace cca
