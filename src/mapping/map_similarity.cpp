// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_similarity.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cross.hpp"
#include "sensing/gates.hpp"

namespace cca {
namespace {

constexpr double kGapOfWall = 1.0;  // m, as kGapOfLine, where both were seen many times
/// Gates of the distance of two faces side by side, in deviations of a return, and the least that
/// they fall to [m]. On one side: each has its own pose error. Opposite: the line between them lies
/// within two deviations of either.
constexpr double kOneFront = 3.0 * M_SQRT2, kOneFrontLeast = 0.10;
constexpr double kTwoFronts = 4.0, kTwoFrontsLeast = 0.06;  // two of either, on each side
/// The same of a place that one wall holds, and the line of another.
constexpr double kPlace = 2.4, kPlaceLeast = 0.08;
/// Deviations of a return from the common line, as the mean over all that one of the two holds.
constexpr double kFitGate = 3.3;
/// Cosine beyond which lines are compared: the frame of one shows the other as d(t).
constexpr double kComparable = 0.8;

/// How far two extents reach into each other; negative where there is a gap.
double overlapOf(const Extent& a, const Extent& b) {
  return std::min(a.last, b.last) - std::max(a.first, b.first);
}

bool outgrown(const Extent& wall, const Extent& other) {
  const double overlap = overlapOf(wall, other);
  const double whole = wall.length() + other.length() - overlap;
  return whole > kLongestWall && overlap + SupportProfile::kBinLength < other.length();
}

/// A line as the frame of a wall shows it, d = offset + slope (t - middle), and how well that is
/// known: at the middle of what it stands on the two are uncorrelated.
struct LateralLine {
  double middle, offset, slope;            // m, m, rad
  double offset_variance, slope_variance;  // m^2, rad^2

  double at(double t) const { return offset + slope * (t - middle); }
};

/// @param variance  m^2, of one bin.
LateralLine lateralLine(const PointSums& sums, double variance) {
  const LateralFit fit = sums.fit();
  const double middle = sums.x / sums.w, spread = sums.xx - sums.x * middle;
  return {middle, fit.at(middle), fit.slope, variance / sums.w,
          spread > variance ? variance / spread : 1.0};
}

LateralLine lateralLine(const LineSegment& line, const Wall& frame) {
  const Eigen::Vector2d a = frame.toWall(line.start), b = frame.toWall(line.end);
  const Eigen::Vector2d m = frame.toWall(line.moments.mean);
  const double slope = (b.y() - a.y()) / (b.x() - a.x());
  return {m.x(), a.y() + slope * (m.x() - a.x()), slope, line.covariance(0, 0),
          line.covariance(1, 1)};
}

/// Chi-squares of the angle between two lines, and of their offset where it does not depend on it.
struct Difference {
  double angle, offset;
};

Difference difference(const LateralLine& a, const LateralLine& b) {
  const double slopes = a.slope_variance + b.slope_variance;
  const double t = (a.middle * a.slope_variance + b.middle * b.slope_variance) / slopes;
  const double apart = b.middle - a.middle;
  const double offsets = a.offset_variance + b.offset_variance +
                         apart * apart * a.slope_variance * b.slope_variance / slopes;
  const double angle = b.slope - a.slope, offset = b.at(t) - a.at(t);
  return {angle * angle / slopes, offset * offset / offsets};
}

/// Mean squared distance [m^2] of what was added up from a line.
double meanSquareOff(const PointSums& s, const LateralFit& line) {
  const double o = line.offset, k = line.slope;
  return (s.yy - 2.0 * (o * s.y + k * s.xy) + 2.0 * o * k * s.x + k * k * s.xx) / s.w + o * o;
}

/// Whether the two hold hits beside each other. In the bin where one ends and the other goes on,
/// both may.
bool standSideBySide(const Wall& wall, const Wall& other) {
  int common = 0;
  for (int i = other.profile.first(); i < other.profile.last(); ++i) {
    const SupportBin& bin = other.profile.bin(i);
    if (bin.hits() <= 0.0) continue;
    if (wall.hitNear(other.toMap(bin.mean())) && ++common > 1) return true;
  }
  return false;
}

double square(double x) { return x * x; }

}  // namespace

Memberships mapMemberships(const NewLine& line, const Wall& wall, const MapNoise& noise) {
  const double cosine = line.segment.direction().dot(wall.fittedDirection());
  const PointSums& sums = wall.profile.sums();
  if (std::abs(cosine) < kComparable || sums.w <= 0.0) return {};
  const Eigen::Vector2d a = wall.toWall(line.segment.start), b = wall.toWall(line.segment.end);
  const Extent seen{std::min(a.x(), b.x()), std::max(a.x(), b.x())}, known = extentOf(wall);
  if (outgrown(known, seen)) return {};
  const double sigma = noise.lateralSigma();
  const LateralLine own = lateralLine(line.segment, wall);
  const Difference apart = difference(lateralLine(sums, sigma * sigma), own);
  const double off = own.offset - wall.fit.at(own.middle);
  Memberships mu;
  mu.orientation = bell(apart.angle, kChiSquareGate1);
  mu.offset = bell(apart.offset, kChiSquareGate1);
  mu.gap = bell(square(std::max(0.0, -overlapOf(known, seen))), square(kGapOfLine));
  mu.fit = bell(square(off), square(kFitGate * sigma));
  mu.overlap = cosine > 0.0 || wall.two_sided ? 1.0 : 0.0;
  return mu;
}

bool wouldOutgrow(const Wall& wall, const Wall& other) {
  return outgrown(extentOf(wall), extentOf(other, wall));
}

Memberships mapMemberships(const Wall& wall, const Wall& other, const MapNoise& noise) {
  return wouldOutgrow(wall, other) ? Memberships{} : membershipsOfAnyLength(wall, other, noise);
}

Memberships membershipsOfAnyLength(const Wall& wall, const Wall& other, const MapNoise& noise) {
  const double cosine = wall.fittedDirection().dot(other.fittedDirection());
  if (std::abs(cosine) < kComparable) return {};
  const Extent mine = extentOf(wall), theirs = extentOf(other, wall);
  const PointSums &a = wall.profile.sums(), b = sumsInFrameOf(wall, other);
  if (a.w <= 0.0 || b.w <= 0.0) return {};
  const double sigma = noise.lateralSigma(), variance = sigma * sigma;
  const Difference apart = difference(lateralLine(a, variance), lateralLine(b, variance));
  const bool one_front = cosine > 0.0 || wall.two_sided || other.two_sided;
  const double overlap = overlapOf(mine, theirs);
  const bool within = overlap > 0.5 * std::min(mine.length(), theirs.length());
  Memberships mu;
  mu.gap = bell(square(std::max(0.0, -overlap)), square(kGapOfWall));
  if (within && standSideBySide(wall, other)) {
    // The error that parts them is common to all of their bins: it is neither turn nor shift that
    // bins could tell. Parallels h apart let the residuals grow by h^2 w_a w_b / (w_a + w_b).
    const double apart_sq = variance * (apart.angle + apart.offset) * (a.w + b.w) / (a.w * b.w);
    mu.overlap = bell(apart_sq, square(one_front ? std::max(kOneFrontLeast, kOneFront * sigma)
                                                 : mostBetweenFaces(noise)));
    mu.orientation = mu.offset = mu.fit = 1.0;
    return mu;
  }
  // A stretch in another's gap, such as the niche of a door, has a bend at either end.
  const double gate = (within ? 2.0 : 1.0) * kChiSquareGate1;
  mu.orientation = bell(apart.angle, gate);
  mu.offset = bell(apart.offset, gate);
  PointSums joint = a;
  joint.add(b);
  const LateralFit line = joint.fit();
  const double off = std::max(meanSquareOff(a, line), meanSquareOff(b, line));
  mu.fit = bell(off, square(kFitGate * sigma));
  mu.overlap = one_front ? 1.0 : 0.0;
  return mu;
}

double mostBetweenFaces(const MapNoise& noise) {
  return std::max(kTwoFrontsLeast, kTwoFronts * noise.lateralSigma());
}

double overlapOfPlace(double off, const MapNoise& noise) {
  return bell(square(off), square(std::max(kPlaceLeast, kPlace * noise.lateralSigma())));
}

}  // namespace cca
