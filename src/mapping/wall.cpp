// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/wall.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/cross.hpp"

namespace cca {
namespace {

/// What lies in the frame of one wall, in that of another.
struct FrameChange {
  Eigen::Vector2d shift;
  double cosine, sine;

  FrameChange(const Wall& to, const Wall& from)
      : shift(to.toWall(from.origin)),
        cosine(to.direction.dot(from.direction)),
        sine(cross(to.direction, from.direction)) {}

  PointSums operator()(const PointSums& s) const { return s.moved(shift, cosine, sine); }
  SupportBin operator()(const SupportBin& b) const {
    const double d_mean = b.hits() > 0.0 ? b.mean().y() : 0.0;
    const double a = shift.x() + cosine * b.first - sine * d_mean;
    const double c = shift.x() + cosine * b.last - sine * d_mean;
    return {(*this)(b.returns), b.passed, std::min(a, c), std::max(a, c)};
  }
};

constexpr double kDrift = 0.1;     // m, of the line from its frame; the index reaches 0.3 m
constexpr double kSameDoor = 0.2;  // m, between the lines of a doorway before and after a join

/// Weight of the wall's line, in bins, where one of its pieces is fitted.
constexpr double kTrustInWall = 3.0;

/// The line of a piece between t_first and t_last: that of its own bins, held to the wall's line by
/// a few bins' worth. A wall is straight to its noise from end to end; a piece of it is nearer to
/// its own returns, and ends where it ends at no further price.
LateralFit fitOfPiece(const Wall& wall, PointSums sums, double t_first, double t_last) {
  for (const double t : {t_first, t_last}) sums.addPoint(t, wall.fit.at(t), 0.5 * kTrustInWall);
  return sums.fit();
}

LineSegment segmentOf(const Wall& wall, const Stretch& stretch) {
  LineSegment s;
  if (stretch.tally.returns.w <= 0.0) return s;
  const PointMoments moments = stretch.tally.returns.moments();
  const double t_first = wall.profile.bin(stretch.range.first).first;
  const double t_last = wall.profile.bin(stretch.range.last - 1).last;
  const LateralFit fit = fitOfPiece(wall, stretch.tally.fitted, t_first, t_last);
  s.start = wall.toMap({t_first, fit.at(t_first)});
  s.end = wall.toMap({t_last, fit.at(t_last)});
  Eigen::Matrix2d axes;
  axes << wall.direction, wall.normal();
  s.moments = {moments.weight, wall.toMap(moments.mean), axes * moments.scatter * axes.transpose()};
  return s;
}

bool isDirected(const PointSums& bins, const MapNoise& noise) {
  const double spread = bins.xx - bins.x * bins.x / bins.w;
  return noise.lateralSigma() < kDirectionKnown * std::sqrt(std::max(0.0, spread));
}

/// The id of the old piece that the segment covers most, if no new piece has it yet; otherwise 0.
std::uint64_t takeId(const std::vector<MapLine>& old, const LineSegment& segment,
                     const std::vector<MapLine>& taken) {
  const Eigen::Vector2d u = segment.direction();
  const double length = segment.length();
  double most = 0.0;
  std::uint64_t id = 0;
  for (const MapLine& line : old) {
    const double a = u.dot(line.segment.start - segment.start);
    const double b = u.dot(line.segment.end - segment.start);
    const double common = std::min(length, std::max(a, b)) - std::max(0.0, std::min(a, b));
    const bool used =
        std::any_of(taken.begin(), taken.end(), [&](const MapLine& t) { return t.id == line.id; });
    if (used || common <= most) continue;
    most = common;
    id = line.id;
  }
  return id;
}

}  // namespace

Eigen::Vector2d Wall::fittedDirection() const {
  return (direction + fit.slope * normal()).normalized();
}

void absorb(Wall& wall, const Wall& other) {
  wall.uncut_residual = 0.0;
  const FrameChange change(wall, other);
  for (int i = other.profile.first(); i < other.profile.last(); ++i) {
    const SupportBin& bin = other.profile.bin(i);
    if (bin.hits() > 0.0) wall.profile.add(change(bin));
  }
  // A doorway has rays but no hits: it stands where it stood. Rays through a line that was off are
  // not held against what the wall itself has there.
  for (int i = other.profile.first(); i < other.profile.last(); ++i) {
    const SupportBin& bin = other.profile.bin(i);
    if (bin.hits() > 0.0 || bin.passed <= 0.0) continue;
    const Eigen::Vector2d td = wall.toWall(other.onLine((i + 0.5) * SupportProfile::kBinLength));
    const int here = SupportProfile::binOf(td.x());
    const bool stands = wall.profile.contains(here) && wall.profile.bin(here).hits() > 0.0;
    if (!stands && std::abs(wall.offLine(td)) < kSameDoor) wall.profile.pass(td.x(), bin.passed);
  }
}

bool yieldBins(Wall& lesser, Wall& greater, const std::function<bool(int, double)>& yields) {
  const FrameChange change(greater, lesser);
  bool moved = false;
  for (int i = lesser.profile.first(); i < lesser.profile.last(); ++i) {
    const SupportBin& bin = lesser.profile.bin(i);
    if (bin.hits() <= 0.0) continue;
    const Eigen::Vector2d td = greater.toWall(lesser.toMap(bin.mean()));
    if (!yields(SupportProfile::binOf(td.x()), greater.offLine(td))) continue;
    greater.profile.add(change(lesser.profile.take(i)));
    moved = true;
  }
  if (moved) lesser.uncut_residual = greater.uncut_residual = 0.0;
  return moved;
}

PointSums sumsInFrameOf(const Wall& wall, const Wall& other) {
  return FrameChange(wall, other)(other.profile.sums());
}

void refit(Wall& wall) {
  wall.fit = wall.profile.fit();
  if (wall.profile.empty()) return;
  const double t_first = wall.profile.first() * SupportProfile::kBinLength;
  const double t_last = wall.profile.last() * SupportProfile::kBinLength;
  const double drift = std::max(std::abs(wall.fit.at(t_first)), std::abs(wall.fit.at(t_last)));
  if (drift < kDrift) return;
  // The origin stays at t = 0, so that the bins keep their numbers.
  Wall moved;
  moved.direction = wall.fittedDirection();
  moved.origin = wall.onLine(0.0);
  absorb(moved, wall);
  wall.origin = moved.origin;
  wall.direction = moved.direction;
  wall.profile = std::move(moved.profile);
  wall.fit = wall.profile.fit();
}

void recut(Wall& wall, const MapNoise& noise, double line_price, std::uint64_t& next_id) {
  std::vector<MapLine> pieces;
  for (const Stretch& stretch : wall.profile.stretches()) {
    MapLine line;
    line.segment = segmentOf(wall, stretch);
    line.support = line.segment.moments.weight;
    if (line.support < line_price || !isDirected(stretch.tally.fitted, noise)) continue;
    line.id = takeId(wall.pieces, line.segment, pieces);
    pieces.push_back(line);
  }
  for (MapLine& line : pieces) {
    if (line.id == 0) line.id = next_id++;
  }
  wall.pieces = std::move(pieces);
}

}  // namespace cca
