// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/line_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "cca_mrpt/mapping/line_extraction.hpp"
#include "geometry/cross.hpp"
#include "mapping/hindsight.hpp"
#include "mapping/laser_evidence.hpp"
#include "mapping/line_covariance.hpp"
#include "mapping/loose_returns.hpp"
#include "mapping/map_arcs.hpp"
#include "mapping/map_clusters.hpp"
#include "mapping/map_corners.hpp"
#include "mapping/map_noise.hpp"
#include "mapping/wall_network.hpp"
#include "mapping/wall_upkeep.hpp"
#include "mapping/walls.hpp"

namespace cca {
namespace {

constexpr double kTellingLength = 1.0;  // m; shorter lines say little about the pose
constexpr double kFarthestPose = 1e7;   // m; beyond, a double no longer tells bins apart
constexpr double kSameRow = 0.5;        // m, between the middles of a dotted wall then and now

/// The line in the map frame, its sensor on the left, the pose error in its covariance.
NewLine inMap(const LineSegment& line, const Pose2& T_map_sensor, const MapNoise& noise) {
  NewLine n;
  n.viewpoint = T_map_sensor.position();
  const double spread = fitLine(line.moments).spread_sum_sq;
  n.own_offset_variance = noise.rangeVariance() / line.moments.weight;
  n.own_angle_variance = spread > 0.0 ? std::min(1.0, noise.rangeVariance() / spread) : 1.0;
  n.segment = line;
  n.segment.start = T_map_sensor * line.start;
  n.segment.end = T_map_sensor * line.end;
  Eigen::Matrix2d R;
  const Eigen::Vector2d heading = T_map_sensor.heading();
  R << heading.x(), -heading.y(), heading.y(), heading.x();
  n.segment.moments.mean = T_map_sensor * line.moments.mean;
  n.segment.moments.scatter = R * line.moments.scatter * R.transpose();
  n.segment.covariance << n.own_offset_variance + noise.offsetVariance(), 0.0, 0.0,
      n.own_angle_variance + noise.angleVariance();
  const Eigen::Vector2d u = n.segment.direction(), v = n.viewpoint - n.segment.start;
  if (cross(u, v) < 0.0) std::swap(n.segment.start, n.segment.end);
  return n;
}

}  // namespace

/// All that a map knows.
class LineMap::State {
 public:
  State(const CcaParameters& parameters, Poses poses) : parameters_(parameters), poses_(poses) {}

  bool insert(const Scan& scan, const std::vector<LineSegment>& lines);
  void lookBack(const std::vector<PastScans::Kept>& scans);
  std::vector<MapLine> lines() const;
  std::vector<PolyLine> polyLines() const;

  const CcaParameters& parameters() const { return parameters_; }
  const MapNoise& noise() const { return noise_; }
  const Walls& walls() const { return walls_; }

 private:
  std::vector<MapLine> pieces() const;
  std::vector<NewLine> newLines(const std::vector<LineSegment>& lines, const Pose2& T_map_sensor);
  void learn(const std::vector<NewLine>& lines);

  CcaParameters parameters_;
  Walls walls_;
  MapNoise noise_;
  Poses poses_;
  WallNetwork network_;  ///< of own poses
  LooseReturns loose_;
  std::vector<MapLine> dotted_;
  std::uint64_t next_id_ = 1;
};

bool LineMap::State::insert(const Scan& scan, const std::vector<LineSegment>& lines) {
  const Pose2& T = scan.T_map_sensor;
  const bool in_reach = std::abs(T.x) < kFarthestPose && std::abs(T.y) < kFarthestPose;
  if (!in_reach || !std::isfinite(T.theta)) return false;
  std::vector<NewLine> new_lines = newLines(lines, T);
  clusterIntoMap(new_lines, AlphaCut(parameters_), noise_, walls_);
  learn(new_lines);
  if (poses_ == Poses::kOwn) network_.add(T, new_lines);
  const std::vector<Eigen::Vector2d> beams = beamDirections(scan);
  std::vector<Eigen::Vector2d> loose;
  const bool is_wanted = loose_.wants(scan);
  depositReturns(scan, beams, new_lines, noise_, walls_, is_wanted ? &loose : nullptr);
  if (is_wanted) loose_.add(scan, loose);
  if (!parameters_.without(Part::kRays)) passRays(scan, beams, noise_, walls_);
  seeToTouched(walls_, noise_, parameters_, next_id_);
  return true;
}

void LineMap::State::lookBack(const std::vector<PastScans::Kept>& scans) {
  if (!scans.empty() && !parameters_.without(Part::kHindsight)) {
    reassignEvidence(scans, noise_, !parameters_.without(Part::kRays), walls_);
    seeToTouched(walls_, noise_, parameters_, next_id_);
  }
  if (poses_ == Poses::kOwn) network_.settle(noise_, walls_);
  const std::vector<MapLine> before = std::exchange(dotted_, {});
  for (MapLine line : loose_.dottedWalls(pieces(), noise_)) {
    const Eigen::Vector2d middle = 0.5 * (line.segment.start + line.segment.end);
    const auto same = std::find_if(before.begin(), before.end(), [&](const MapLine& old) {
      return (0.5 * (old.segment.start + old.segment.end) - middle).norm() < kSameRow;
    });
    line.id = same == before.end() ? next_id_++ : same->id;
    dotted_.push_back(line);
  }
}

std::vector<NewLine> LineMap::State::newLines(const std::vector<LineSegment>& lines,
                                              const Pose2& T_map_sensor) {
  std::vector<NewLine> found;
  for (const LineSegment& line : lines) {
    const double length = line.length(), distance = line.moments.mean.norm();
    const bool sane = length > 0.0 && length < kLongestRange && distance < kLongestRange;
    if (!sane || !(line.moments.weight > 0.0)) continue;
    const FittedLine fitted = fitLine(line.moments);
    const double freedom = line.moments.weight - 2.0;
    if (freedom > 2.0) noise_.learnRange(fitted.residual_sum_sq / freedom, distance);
    found.push_back(inMap(line, T_map_sensor, noise_));
  }
  return found;
}

void LineMap::State::learn(const std::vector<NewLine>& lines) {
  for (const NewLine& line : lines) {
    if (line.wall < 0) continue;
    Wall& wall = walls_[line.wall];
    walls_.touch(line.wall);
    // What all scans share does not average out for ever.
    wall.visits = std::min(wall.visits + 1.0, SupportBin::kMostHits);
    const double length = line.segment.length();
    if (length < kTellingLength || wall.two_sided || parameters_.without(Part::kPoseNoise)) {
      continue;
    }
    const Eigen::Vector2d m = wall.toWall(line.segment.moments.mean);
    const int half = static_cast<int>(0.5 * length / SupportProfile::kBinLength);
    const int middle = SupportProfile::binOf(m.x());
    if (!wall.profile.contains(middle - half) || !wall.profile.contains(middle + half)) continue;
    // Against the stretch of wall that it covers, so that no bend is taken for a pose error.
    const PointSums seen = wall.profile.tally({middle - half, middle + half + 1}).fitted;
    if (seen.w < 0.5 * half) continue;
    noise_.learnOffset(m.y() - seen.y / seen.w - wall.fit.slope * (m.x() - seen.x / seen.w),
                       line.own_offset_variance);
    const Eigen::Vector2d u = line.segment.direction(), w = wall.fittedDirection();
    noise_.learnAngle(cross(w, u), line.own_angle_variance);
  }
}

std::vector<MapLine> LineMap::State::pieces() const {
  std::vector<MapLine> all;
  std::vector<const Wall*> wall_of;
  for (const Wall& wall : walls_.all()) {
    all.insert(all.end(), wall.pieces.begin(), wall.pieces.end());
    wall_of.insert(wall_of.end(), wall.pieces.size(), &wall);
  }
  // A few returns that were seen from afar make an end.
  cutOvershoots(all, kNormalGate * std::sqrt(noise_.rangeVariance(kLongestRange)));
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].segment.covariance = covarianceOf(*wall_of[k], all[k].segment, noise_);
  }
  std::sort(all.begin(), all.end(), [](const MapLine& a, const MapLine& b) { return a.id < b.id; });
  return all;
}

std::vector<MapLine> LineMap::State::lines() const {
  std::vector<MapLine> all = pieces();
  joinCorners(all, SupportProfile::kResolved);
  all.insert(all.end(), dotted_.begin(), dotted_.end());
  return all;
}

std::vector<PolyLine> LineMap::State::polyLines() const {
  std::vector<MapLine> all = pieces();
  const std::vector<Corner> corners = joinCorners(all, SupportProfile::kResolved);
  return chainLines(all, corners);
}

LineMap::LineMap(const CcaParameters& parameters, Poses poses)
    : state_(std::make_unique<State>(parameters, poses)) {}
LineMap::~LineMap() = default;
LineMap::LineMap(const LineMap& other) : state_(std::make_unique<State>(*other.state_)) {}
LineMap& LineMap::operator=(const LineMap& other) { return *this = LineMap(other); }
LineMap::LineMap(LineMap&&) noexcept = default;
LineMap& LineMap::operator=(LineMap&&) noexcept = default;

bool LineMap::insert(const Scan& scan) {
  return insert(scan, extractLines(scan, state_->parameters()));
}

bool LineMap::insert(const Scan& scan, const std::vector<LineSegment>& lines) {
  return state_->insert(scan, lines);
}

void LineMap::lookBack(const std::vector<PastScans::Kept>& scans) { state_->lookBack(scans); }

std::vector<MapLine> LineMap::lines() const { return state_->lines(); }

std::vector<PolyLine> LineMap::polyLines() const { return state_->polyLines(); }

std::vector<MapArc> LineMap::arcs() const {
  return arcsOfWalls(walls().all(), noise(), state_->parameters());
}

const MapNoise& LineMap::noise() const { return state_->noise(); }

const Walls& LineMap::walls() const { return state_->walls(); }

}  // namespace cca
