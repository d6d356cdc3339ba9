// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/world/exploration_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "cca_mrpt/sensing/range_noise.hpp"
#include "navigation/world/surface_points.hpp"
#include "sensing/beam.hpp"

namespace cca {
namespace {

constexpr int kPass = 8, kReturn = 2 * kPass;  // weight of a beam that passes, of a return
// Bounds of the evidence: 8 scans forget an obstacle.
constexpr int kSurest = 8 * kPass, kFreest = -4 * kPass;
// Cells. Noise of this deviation leaves nearly every return in its cell or beside it; of a beam of
// twice the deviation four are worth one. What lies so near before a return is not known to be
// free: noise and rounding must not open the wall.
constexpr double kSmallNoise = 0.3;
constexpr double kWithin = 2.0;       // deviations: where a beam may be
constexpr double kWidestGuess = 1.5;  // m, of a wall between two returns
// Rays between two beams: enough to 23 m where these are a degree apart. It bounds the cost.
constexpr std::size_t kMostBetween = 8;
constexpr double kLongestRangeCells = 4000;  // 200 m at 5 cm
// What was seen of a cell: its sides that returns came from, a bit each, and whether there were any
// so near to it along one surface that they tell of what is between.
constexpr unsigned kAllFaces = 0xF, kBetweenReturns = 0x10;
constexpr double kClose = 0.3;  // m: at 8 m returns are 14 cm apart, on walls seen aslant 30
// Cosine, 75 degrees: of a wall that is seen farther aslant there are too few returns for a line.
constexpr double kSquareEnough = 0.25;
// Cosine: a surface faces one side of its cell, or two at 45 degrees.
constexpr double kFacing = 0.38;

/// The sides of its cell that a surface faces, a bit each.
/// @param away  square to the surface, away from the sensor, of any length.
unsigned sidesFaced(const Eigen::Vector2d& away) {
  const double least = kFacing * away.norm();
  unsigned sides = 0;
  for (unsigned side = 0; side < 4; ++side) {
    const Cell step = kNeighbours[side];
    if (-(away.x() * step.x + away.y() * step.y) >= least) sides |= 1u << side;
  }
  return sides;
}

bool isUsable(const Scan& scan, double resolution) {
  const Pose2& T = scan.T_map_sensor;
  const double farthest = resolution * (kFarthestCell - kLongestRangeCells - 1.0);
  return std::isfinite(T.theta) && std::abs(T.x) < farthest && std::abs(T.y) < farthest &&
         std::isfinite(scan.angle_min) && std::isfinite(scan.angle_increment);
}

}  // namespace

void ExplorationGrid::insert(const Scan& scan) { insert(scan, rangeNoise(scan).range_sigma); }

void ExplorationGrid::insert(const Scan& raw_scan, double range_sigma) {
  changed_.clear();
  if (!isUsable(raw_scan, resolution_)) return;
  noise_.add(raw_scan, range_sigma);
  // Near the robot a cell has many beams, of which a single one that reads short would be enough.
  const bool is_noisy = noise_.rangeSigma() > kSmallNoise * resolution_;
  const Scan scan = is_noisy ? smoothScan(raw_scan, noise_.rangeSigma()) : raw_scan;
  ++scans_;
  const Eigen::Vector2d origin = scan.T_map_sensor.position() / resolution_;
  directions_.clear();
  for (std::size_t i = 0; i < scan.size(); ++i) directions_.push_back(directionOf(scan, i));
  findCertainRanges(scan);
  const auto points =
      surfacePoints(scan, directions_, resolution_, kBehindSurface, kLongestRangeCells);
  // Returns first: a cell that holds one is not cleared by a beam that passes beside the surface.
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!points[i].is_return) continue;
    const Cell cell = cellAt(points[i].inside);
    add(cell, kReturn / kPass * weightOf(noise_.variance(scan.ranges[i])));
    if (points[i].squareness >= kSquareEnough)
      noteFaces(cell, sidesFaced(points[i].inside - points[i].place));
  }
  markSurfaces(points);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const double range = certain_ranges_[i];
    const double free_range = isReturn(scan.ranges[i]) ? range - kSmallNoise * resolution_ : range;
    if (!(free_range > 0.0)) continue;
    passThrough(origin, directions_[i], std::min(free_range / resolution_, kLongestRangeCells),
                scan.ranges[i]);
  }
  presumeFree(scan);
}

/// Of a beam that may lie so far beside or before where it is thought to be. @param variance  m^2.
int ExplorationGrid::weightOf(double variance) const {
  const double small = kSmallNoise * resolution_;
  return std::max(1, static_cast<int>(kPass * std::min(1.0, small * small / variance) + 0.5));
}

// A beam may have gone anywhere within the bearing noise, past an edge beside it or farther along a
// wall that it grazes: what is certain is only what all of that is free. Between two beams the
// inverse range is taken for linear, as it is along a wall.
void ExplorationGrid::findCertainRanges(const Scan& scan) {
  const std::size_t n = scan.size();
  certain_ranges_.resize(n);
  for (std::size_t i = 0; i < n; ++i) certain_ranges_[i] = scan.freeRange(i);
  const double sigma = std::hypot(noise_.bearingSigma(), scan.bearing_sigma);
  const double within = kWithin * sigma / std::abs(scan.angle_increment);
  if (!(within > 0.0)) return;
  const double small = kSmallNoise * resolution_ / sigma;
  const auto whole = static_cast<std::size_t>(std::min(within, static_cast<double>(n)));
  for (std::size_t i = 0; i < n; ++i) {
    const double range = scan.freeRange(i);
    if (range <= small) continue;
    double& certain = certain_ranges_[i];
    for (const int side : {-1, 1}) {
      double before = 1.0 / range;
      for (std::size_t k = 1; k <= whole + 1; ++k) {
        const std::size_t j = side > 0 ? i + k : i - k;
        if (j >= n) break;
        const double beside = scan.freeRange(j);
        if (!(beside > 0.0)) continue;
        const double share = std::min(1.0, within - static_cast<double>(k - 1));
        const double inverse = before + share * (1.0 / beside - before);
        certain = std::min(certain, 1.0 / inverse);
        before = 1.0 / beside;
      }
    }
  }
}

// Most cells are as surely free as can be already.
void ExplorationGrid::passThrough(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction,
                                  double length, double ends_at) {
  const double near_end = (ends_at - kWithin * noise_.rangeSigma()) / resolution_;
  const double across = noise_.bearingSigma() * resolution_;
  walkBeam(origin, direction, length, [&](Cell c, double entered) {
    if (evidence_.at(c) == kFreest) return true;
    const double far = across * entered;
    const double along = entered + 1.0 > near_end ? noise_.rangeSigma() : 0.0;
    add(c, -weightOf(far * far + along * along));
    return true;
  });
}

// Far from the sensor the beams are wider apart than the cells. What lies between two returns of
// one surface is most likely more of it, not a gap into the unknown. And a wall lies within its
// cells: beams that meet it farther along pass before it there, which says nothing against it.
void ExplorationGrid::markSurfaces(const std::vector<SurfacePoint>& points) {
  const double widest = kWidestGuess / resolution_;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].goes_on) continue;
    const Eigen::Vector2d step = points[(i + 1) % points.size()].inside - points[i].inside;
    const double gap = step.norm();
    if (gap == 0.0) continue;
    const bool is_seen = gap <= kClose / resolution_ && points[i].squareness >= kSquareEnough;
    walkBeam(points[i].inside, step / gap, gap, [&](Cell c, double) {
      counted_[c] = scans_;
      if (evidence_.at(c) < kWallPresumed && gap <= widest) write(c, kWallPresumed);
      if (is_seen) noteFaces(c, kBetweenReturns);
      return true;
    });
  }
}

// What lies between two neighbouring beams is most likely as free as they are.
void ExplorationGrid::presumeFree(const Scan& scan) {
  const Eigen::Vector2d origin = scan.T_map_sensor.position() / resolution_;
  const auto freeRange = [&](std::size_t i) { return scan.freeRange(i) / resolution_; };
  const double apart = std::abs(scan.angle_increment);
  for (std::size_t i = 0; i + 1 < scan.size(); ++i) {
    const double range =
        std::min({freeRange(i), freeRange(i + 1), kLongestRangeCells}) - kSmallNoise;
    if (!(range > 0.0)) continue;
    const auto between =
        static_cast<std::size_t>(std::min(range * apart, static_cast<double>(kMostBetween)));
    for (std::size_t k = 1; k <= between; ++k) {
      const double turn = scan.angle_increment * static_cast<double>(k) / (between + 1.0);
      const Eigen::Vector2d direction = Eigen::Rotation2Dd(turn) * directions_[i];
      const double gapless = std::min(1.0 / apart, range);
      walkBeam(origin + gapless * direction, direction, range - gapless, [&](Cell c, double) {
        if (evidence_.at(c) == kNever) write(c, kFreePresumed);
        return true;
      });
    }
  }
}

void ExplorationGrid::add(Cell cell, int weight) {
  std::uint32_t& counted = counted_[cell];
  if (counted == scans_) return;
  counted = scans_;
  Evidence& evidence = evidence_[cell];
  const int base = evidence <= kWallPresumed ? 0 : evidence;
  write(cell, evidence, static_cast<Evidence>(std::clamp(base + weight, kFreest, kSurest)));
}

void ExplorationGrid::noteFaces(Cell cell, unsigned sides) {
  std::uint8_t& faces = faces_[cell];
  if ((faces | sides) == faces) return;
  faces = static_cast<std::uint8_t>(faces | sides);
  if (changed_.empty() || changed_.back() != cell) changed_.push_back(cell);
}

bool ExplorationGrid::isFaceUnseen(Cell cell, std::size_t side) const {
  const CellState state = at(cell);
  if (state != CellState::kPresumedWall && state != CellState::kOccupied) return false;
  const unsigned faces = faces_.at(cell), opposite = (side + 2) % 4;
  if (state == CellState::kPresumedWall) return !(faces & kBetweenReturns);
  return !(faces >> side & 1u) && (faces >> opposite & 1u);
}

void ExplorationGrid::set(Cell cell, CellState state) {
  if (!isStorable(cell)) return;
  noteFaces(cell, kAllFaces | kBetweenReturns);
  constexpr Evidence kValue[] = {kNever, kFreePresumed, kWallPresumed, kFreest, kSurest};
  write(cell, kValue[static_cast<int>(state)]);
}

void ExplorationGrid::write(Cell cell, Evidence& evidence, Evidence value) {
  revealed_ += evidence <= kWallPresumed && value > kWallPresumed;
  if (stateOf(evidence) != stateOf(value)) {
    changed_.push_back(cell);
    if (evidence == kNever) {
      const bool first = highest_.x < lowest_.x;
      lowest_ = first ? cell : Cell{std::min(lowest_.x, cell.x), std::min(lowest_.y, cell.y)};
      highest_ = first ? cell : Cell{std::max(highest_.x, cell.x), std::max(highest_.y, cell.y)};
    }
  }
  evidence = value;
}

}  // namespace cca
