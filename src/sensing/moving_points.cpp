// SPDX-License-Identifier: BSD-3-Clause
#include "sensing/moving_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sensing/beam.hpp"

namespace cca {
namespace {

constexpr double kAge = 0.45;  // s, of the scan to compare with: a walker has gone its own depth
constexpr double kLongAge = 1.35;  // s, of another: somebody of 0.2 m/s has come by kClearly
constexpr double kClearly = 0.12;  // m, beyond the noise: a walker of 0.3 m/s goes farther in kAge
constexpr int kBeamsAround = 2;    // of the other scan, to each side
constexpr int kLeastBeams = 3;     // of a mover: noise makes up two at times, hardly three
constexpr double kJoined = 0.2;    // m, between neighbouring returns of a mover
constexpr double kBody = 0.8;      // m, how far a mover reaches from its suspicious part
constexpr double kNearby = 0.75;   // m, around a place where a mover was
constexpr double kStill = 0.05;    // m, beyond the noise: a walker of 0.15 m/s goes farther in kAge
constexpr double kStampError = 0.01;  // s, between a scan's beams and its pose
constexpr double kPlaceError = 0.01;  // m, of a scan's pose as seen from another's
constexpr double kHeeded = 2.0;       // m; what is farther cannot come before the robot stands
constexpr double kStandsLong = 5.0;   // s; who walks about pauses for two, or leans for some more
constexpr double kCell = 0.05;  // m, of what stands: with its neighbours, the noise of two scans

Cell cellOf(const Eigen::Vector2d& p_map) { return cellAt(p_map / kCell); }

// rad/s, of the robot, from one scan to another. A sweep that is undone by wheels that err, and
// stamps that are not those of the poses, leave bearings wrong by some hundredths of that.
double turningRate(const Scan& from, double from_time, const Scan& to, double to_time) {
  const double turn = wrapAngle(to.T_map_sensor.theta - from.T_map_sensor.theta);
  return to_time > from_time ? std::abs(turn) / (to_time - from_time) : 0.0;
}

// The same about one of the past scans.
template <class Pasts, class Past>
double turningRate(const Pasts& past, const Past& at) {
  for (std::size_t i = 1; i < past.size(); ++i) {
    if (&past[i] != &at && !(i == 1 && &past[0] == &at)) continue;
    return turningRate(past[i - 1].scan, past[i - 1].time, past[i].scan, past[i].time);
  }
  return 0.0;
}

// The shortest free distance that the scan saw around the direction of a point; 0 where unknown.
// @param slack  rad, by which that direction may be wrong.
double seenAround(const Scan& scan, const Eigen::Vector2d& p_sensor, double slack) {
  const int beam = beamTowards(scan, p_sensor), n = static_cast<int>(scan.size());
  const double more = std::ceil(slack / std::abs(scan.angle_increment));
  const int around = kBeamsAround + static_cast<int>(std::min(more, static_cast<double>(n)));
  if (beam < around || beam >= n - around) return 0.0;
  double least = INFINITY;
  for (int i = beam - around; i <= beam + around; ++i) {
    least = std::min(least, scan.freeRange(static_cast<std::size_t>(i)));
  }
  return least;
}

// Map frame, by beam; the origin where there is no return.
std::vector<Eigen::Vector2d> pointsOf(const Scan& scan) {
  std::vector<Eigen::Vector2d> points(scan.size(), Eigen::Vector2d::Zero());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (isReturn(scan.ranges[i])) points[i] = returnOf(scan, i);
  }
  return points;
}

// First and last beam of each run of returns of `scan` that lie where `other` saw free space.
std::vector<std::pair<std::size_t, std::size_t>> runsInFreeSpace(
    const Scan& scan, const std::vector<Eigen::Vector2d>& points, const Scan& other, double clearly,
    double slack) {
  const auto toOther = transformBy(other.T_map_sensor.inverse());
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  std::size_t length = 0;
  for (std::size_t i = 0; i <= scan.size(); ++i) {
    bool in_free_space = false;
    if (i < scan.size() && isReturn(scan.ranges[i]) && scan.ranges[i] <= MovingPoints::kFarthest) {
      const Eigen::Vector2d p = toOther(points[i]);
      const double range = p.norm();
      in_free_space = range < seenAround(other, p, slack + kPlaceError / range) - clearly;
    }
    const bool goes_on =
        in_free_space && length > 0 && (points[i] - points[i - 1]).norm() < kJoined;
    if (!goes_on) {
      if (length >= kLeastBeams) runs.emplace_back(i - length, i - 1);
      length = 0;
    }
    if (in_free_space) ++length;
  }
  return runs;
}

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b) {
  const Eigen::Vector2d d = b - a;
  const double length_sq = d.squaredNorm();
  const double t = length_sq > 0.0 ? std::clamp(d.dot(p - a) / length_sq, 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

// Whether a scan, whose returns lie at `points`, saw a surface within `gate` of a point.
bool sawSurfaceAt(const Scan& scan, const std::vector<Eigen::Vector2d>& points,
                  const Eigen::Vector2d& p_map, double gate) {
  const int n = static_cast<int>(scan.size());
  if (n == 0) return false;
  const int beam = beamTowards(scan, scan.T_map_sensor.inverse() * p_map);
  const auto wrapped = [n](int i) { return static_cast<std::size_t>((i % n + n) % n); };
  for (int i = beam - kBeamsAround; i <= beam + kBeamsAround; ++i) {
    const std::size_t a = wrapped(i), b = wrapped(i + 1);
    if (!isReturn(scan.ranges[a])) continue;
    const bool joined = isReturn(scan.ranges[b]) && (points[a] - points[b]).norm() < kJoined;
    if (distanceToSegment(p_map, points[a], joined ? points[b] : points[a]) < gate) return true;
  }
  return false;
}

}  // namespace

std::vector<bool> MovingPoints::update(const Scan& scan, double range_sigma, double time) {
  std::vector<bool> moving(scan.size(), false);
  const std::vector<Eigen::Vector2d> points = pointsOf(scan);
  while (past_.size() > 1 && past_[1].time <= time - kLongAge) past_.pop_front();
  places_.erase(std::remove_if(places_.begin(), places_.end(),
                               [&](const Place& place) { return time - place.time > kMemory; }),
                places_.end());
  if (!past_.empty() && past_.front().time < time) {
    const double clearly = kClearly + 4.0 * range_sigma;
    const Past &long_ago = past_.front(), &lately = scanBefore(time - kAge);
    const double rate = turningRate(past_.back().scan, past_.back().time, scan, time);
    const auto slack = [&](const Past& earlier) {
      return kStampError * (rate + turningRate(past_, earlier));
    };
    for (const Past* earlier : {&long_ago, &lately}) {
      for (const auto& [first, last] :
           runsInFreeSpace(scan, points, earlier->scan, clearly, slack(*earlier))) {
        markBody(points, first, last, moving);
        places_.push_back({points[(first + last) / 2], time});
      }
    }
    for (const auto& [first, last] :
         runsInFreeSpace(lately.scan, lately.points, scan, clearly, slack(lately))) {
      places_.push_back({lately.points[(first + last) / 2], time});
    }
  }
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (moving[i] || !isReturn(scan.ranges[i])) continue;
    moving[i] = mayMove(points[i], time);
  }
  if (!places_.empty() && places_.back().time == time) {
    // Who moves is suspicious in one scan after the other; what noise and lost beams show is not.
    if (places_.front().time < time) last_seen_ = time;
  }
  findUnsettled(scan, points, moving, range_sigma, time);
  noteWhatStands(scan, points, moving, kClearly + 4.0 * range_sigma, time);
  past_.push_back({scan, points, time});
  return moving;
}

// Beside a mover, and no wall or furniture that it passes by.
bool MovingPoints::mayMove(const Eigen::Vector2d& p_map, double time) const {
  const bool is_beside = std::any_of(places_.begin(), places_.end(), [&](const Place& place) {
    return (place.p_map - p_map).squaredNorm() < kNearby * kNearby;
  });
  return is_beside && !hasStood(p_map, time);
}

Scan MovingPoints::withoutMovers(Scan scan) const {
  if (places_.empty() || !areAround(past_.back().time)) return scan;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (isReturn(scan.ranges[i]) && mayMove(returnOf(scan, i), past_.back().time))
      scan.ranges[i] = std::numeric_limits<double>::quiet_NaN();
  }
  return scan;
}

double MovingPoints::distanceTo(const Eigen::Vector2d& p_map) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Place& place : places_) nearest = std::min(nearest, (place.p_map - p_map).norm());
  return nearest;
}

// The latest scan of at least that age; else the oldest.
const MovingPoints::Past& MovingPoints::scanBefore(double time) const {
  std::size_t i = 0;
  while (i + 1 < past_.size() && past_[i + 1].time <= time) ++i;
  return past_[i];
}

void MovingPoints::findUnsettled(const Scan& scan, const std::vector<Eigen::Vector2d>& points,
                                 const std::vector<bool>& moving, double range_sigma, double time) {
  unsettled_.clear();
  if (!areAround(time)) return;
  const bool old_enough = !past_.empty() && past_.front().time <= time - kAge;
  const Past* earlier = old_enough ? &scanBefore(time - kAge) : nullptr;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (moving[i] || !isReturn(scan.ranges[i]) || scan.ranges[i] > kHeeded) continue;
    const bool settled = old_enough && sawSurfaceAt(earlier->scan, earlier->points, points[i],
                                                    kStill + 2.0 * range_sigma);
    if (!settled && !hasStood(points[i], time)) unsettled_.push_back(points[i]);
  }
}

// What this scan sees free, by the rule for movers, stands no longer. Near the robot alone: what
// comes near has been far.
void MovingPoints::noteWhatStands(const Scan& scan, const std::vector<Eigen::Vector2d>& points,
                                  const std::vector<bool>& moving, double clearly, double time) {
  if (!start_) start_ = time;
  const auto now = static_cast<float>(time - *start_);
  const Cell here = cellOf(scan.T_map_sensor.position());
  if (!isStorable(here)) return;
  const auto toSensor = transformBy(scan.T_map_sensor.inverse());
  constexpr int kReach = static_cast<int>(kHeeded / kCell);  // cells
  for (int y = here.y - kReach; y <= here.y + kReach; ++y) {
    for (int x = here.x - kReach; x <= here.x + kReach; ++x) {
      const Cell c{x, y};
      if (standing_since_.at(c) == kNobody) continue;
      const Eigen::Vector2d p = toSensor(kCell * middleOf(c));
      if (p.norm() < seenAround(scan, p, 0.0) - clearly) standing_since_[c] = kNobody;
    }
  }
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (moving[i] || !isReturn(scan.ranges[i]) || scan.ranges[i] > kFarthest) continue;
    const Cell c = cellOf(points[i]);
    if (isStorable(c) && standing_since_.at(c) == kNobody) standing_since_[c] = now;
  }
}

bool MovingPoints::hasStood(const Eigen::Vector2d& p_map, double time) const {
  if (!start_) return false;
  const Cell c = cellOf(p_map);
  if (!isStorable(c)) return false;
  const auto has = [&](Cell at) { return standing_since_.at(at) <= time - *start_ - kStandsLong; };
  return has(c) ||
         std::any_of(kNeighbours.begin(), kNeighbours.end(), [&](Cell to) { return has(c + to); });
}

// All that is joined to the suspicious run, as far as a body reaches.
void MovingPoints::markBody(const std::vector<Eigen::Vector2d>& points, std::size_t first,
                            std::size_t last, std::vector<bool>& moving) {
  const Eigen::Vector2d middle = points[(first + last) / 2];
  const auto joined = [&](std::size_t i, std::size_t j) {
    return (points[i] - points[j]).norm() < kJoined && (points[j] - middle).norm() < kBody;
  };
  while (first > 0 && joined(first, first - 1)) --first;
  while (last + 1 < points.size() && joined(last, last + 1)) ++last;
  for (std::size_t i = first; i <= last; ++i) moving[i] = true;
}

}  // namespace cca
