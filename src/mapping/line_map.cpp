// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/line_map.hpp"

#include <algorithm>
#include <cmath>

#include "cca_mrpt/mapping/line_extraction.hpp"

namespace cca {
namespace {

constexpr double kIndexMargin = 0.3;  // m, walls are named this far around
constexpr double kSigmas = 3.0;       // gates
constexpr double kLineCost = 27.6;    // nat, four coordinates of 20 m at 2 cm
constexpr double kLargestGap = 1.0;   // m
constexpr int kBridgedBins = 5;

double square(double x) {
  return x * x;
}

LineSegment toMap(const Pose2& T_map_sensor, const LineSegment& line) {
  LineSegment r = line;
  Eigen::Matrix2d R;
  const Eigen::Vector2d h = T_map_sensor.heading();
  R << h.x(), -h.y(), h.y(), h.x();
  r.start = T_map_sensor * line.start;
  r.end = T_map_sensor * line.end;
  r.moments.mean = T_map_sensor * line.moments.mean;
  r.moments.scatter = R * line.moments.scatter * R.transpose();
  return r;
}

}  // namespace

bool LineMap::insert(const Scan& scan) {
  const Pose2& T = scan.T_map_sensor;
  if (!std::isfinite(T.x) || !std::isfinite(T.y) || !std::isfinite(T.theta)) return false;
  batch_.push_back(scan);
  if (static_cast<int>(batch_.size()) >= parameters_.scans_per_batch) finishBatch();
  return true;
}

void LineMap::finishBatch() {
  mergeBatch();
  batch_.clear();
}

void LineMap::mergeBatch() {
  new_lines_.clear();
  touched_.clear();
  ++stamp_;
  for (std::size_t s = 0; s < batch_.size(); ++s) {
    const Pose2& T = batch_[s].T_map_sensor;
    for (const LineSegment& line : extractLines(batch_[s], parameters_)) {
      NewLine n{toMap(T, line), T.position(), s, -1};
      const Eigen::Vector2d u = n.segment.direction(), v = n.viewpoint - n.segment.start;
      if (u.x() * v.y() - u.y() * v.x() < 0.0) std::swap(n.segment.start, n.segment.end);
      if (n.segment.length() > 0.0) new_lines_.push_back(n);
    }
  }
  for (NewLine& line : new_lines_) place(line);
  for (std::size_t s = 0; s < batch_.size(); ++s) depositScan(batch_[s], s);
  for (const Scan& scan : batch_) castRays(scan);
  for (std::size_t i = 0; i < touched_.size(); ++i) maintain(touched_[i]);
}

void LineMap::neighbours(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                         std::vector<Slot>& found) {
  found.clear();
  const int steps = 1 + static_cast<int>((to - from).norm() / WallIndex::kCellSize * 2.0);
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d p = from + (to - from) * (static_cast<double>(i) / steps);
    for (const Slot slot : index_.at(WallIndex::cellOf(p))) {
      if (std::find(found.begin(), found.end(), slot) == found.end()) found.push_back(slot);
    }
  }
}

double LineMap::likeness(const NewLine& line, const Wall& wall) const {
  const Eigen::Vector2d u = line.segment.direction(), w = wall.fittedDirection();
  double cosine = u.dot(w);
  if (wall.two_sided) cosine = std::abs(cosine);
  if (cosine < 0.8) return 0.0;
  const double angle = std::asin(std::clamp(w.x() * u.y() - w.y() * u.x(), -1.0, 1.0));
  const Eigen::Vector2d a = wall.toWall(line.segment.start), b = wall.toWall(line.segment.end);
  const double offset = 0.5 * (wall.offLine(a) + wall.offLine(b));
  const double half = 0.5 * line.segment.length();
  const double var_lateral =
      square(pose_sigma_) + line.segment.covariance(0, 0) + square(range_sigma_);
  const double var_angle = line.segment.covariance(1, 1) + square(0.02) +
                           square(range_sigma_ / std::max(half, range_sigma_));
  const double first = wall.profile.first() * SupportProfile::kBinLength;
  const double last = wall.profile.last() * SupportProfile::kBinLength;
  const double gap = std::max({first - std::max(a.x(), b.x()), std::min(a.x(), b.x()) - last, 0.0});
  if (gap > kLargestGap) return 0.0;
  const double x = std::max(square(offset) / var_lateral, square(angle) / var_angle);
  if (x > square(kSigmas)) return 0.0;
  return std::exp(-0.5 * x) * (1.0 - 0.5 * gap / kLargestGap);
}

void LineMap::place(NewLine& line) {
  neighbours(line.segment.start, line.segment.end, found_);
  double best = 0.0;
  for (const Slot slot : found_) {
    const double alike = likeness(line, walls_[static_cast<std::size_t>(slot)]);
    if (alike > best) {
      best = alike;
      line.wall = slot;
    }
  }
  if (line.wall >= 0) {
    const Wall& wall = walls_[static_cast<std::size_t>(line.wall)];
    const Eigen::Vector2d m = wall.toWall(line.segment.moments.mean);
    learnPoseError(wall.offLine(m), line.segment.covariance(0, 0));
    touch(line.wall);
    return;
  }
  const double tilt = std::sqrt(line.segment.covariance(1, 1));
  if (tilt > 0.2) return;
  line.wall = newWall();
  Wall& wall = walls_[static_cast<std::size_t>(line.wall)];
  wall.origin = 0.5 * (line.segment.start + line.segment.end);
  wall.direction = line.segment.direction();
  touch(line.wall);
}

LineMap::Slot LineMap::wallAt(const Eigen::Vector2d& p_map,
                              const Eigen::Vector2d& viewpoint) const {
  const double gate = kSigmas * std::sqrt(square(pose_sigma_) + square(range_sigma_));
  double nearest = gate;
  Slot best = -1;
  for (const Slot slot : index_.at(WallIndex::cellOf(p_map))) {
    const Wall& wall = walls_[static_cast<std::size_t>(slot)];
    const Eigen::Vector2d td = wall.toWall(p_map);
    const double off = std::abs(wall.offLine(td));
    if (off >= nearest) continue;
    const int i = SupportProfile::binOf(td.x());
    if (!wall.profile.contains(i) || wall.profile.bin(i).hits <= 0.0) continue;
    if (!wall.two_sided && wall.toWall(viewpoint).y() < 0.0) continue;
    nearest = off;
    best = slot;
  }
  return best;
}

void LineMap::depositScan(const Scan& scan, std::size_t scan_index) {
  const Pose2& T = scan.T_map_sensor;
  const Eigen::Vector2d viewpoint = T.position();
  const double gate = kSigmas * range_sigma_ + 0.01;
  std::size_t next = 0;
  std::vector<const NewLine*> mine;
  for (const NewLine& line : new_lines_) {
    if (line.scan == scan_index) mine.push_back(&line);
  }
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (!isReturn(scan.ranges[beam])) continue;
    const double bearing = T.theta + scan.bearing(beam);
    const Eigen::Vector2d p =
        viewpoint + scan.ranges[beam] * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
    // Segments come in the order of their bearings: the current one and the next are enough.
    Slot slot = -1;
    for (std::size_t k = next; k < std::min(next + 2, mine.size()); ++k) {
      const LineSegment& s = mine[k]->segment;
      const Eigen::Vector2d u = s.direction(), v = p - s.start;
      const double t = u.dot(v), d = std::abs(u.x() * v.y() - u.y() * v.x());
      if (t < -1e-6 || t > s.length() + 1e-6 || d > gate) continue;
      slot = mine[k]->wall;
      next = k;
      break;
    }
    if (slot < 0) {
      slot = wallAt(p, viewpoint);
      if (slot < 0) continue;
      touch(slot);
    }
    Wall& wall = walls_[static_cast<std::size_t>(slot)];
    const Eigen::Vector2d td = wall.toWall(p);
    wall.profile.hit(td.x(), td.y());
    wall.hits += 1.0;
  }
}

void LineMap::castRays(const Scan& scan) {
  const Pose2& T = scan.T_map_sensor;
  const Eigen::Vector2d o = T.position();
  const double clear = std::max(0.1, kSigmas * pose_sigma_);
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const double range = scan.ranges[beam];
    double reach = 0.0;
    if (isReturn(range)) reach = std::min(range, 30.0);
    if (isNoReturn(range)) reach = std::min(scan.free_range_without_return, 30.0);
    if (!(reach > 2.0 * clear)) continue;
    const double bearing = T.theta + scan.bearing(beam);
    const Eigen::Vector2d u(std::cos(bearing), std::sin(bearing));
    const std::uint64_t ray = ++stamp_;
    // Cell by cell [Amanatides & Woo 1987].
    WallIndex::Cell cell = WallIndex::cellOf(o);
    const Eigen::Vector2i step(u.x() < 0 ? -1 : 1, u.y() < 0 ? -1 : 1);
    const double h = WallIndex::kCellSize, never = 1e18;
    const double dx = u.x() != 0.0 ? h / std::abs(u.x()) : never;
    const double dy = u.y() != 0.0 ? h / std::abs(u.y()) : never;
    double tx = u.x() != 0.0 ? ((cell.x() + (step.x() > 0)) * h - o.x()) / u.x() : never;
    double ty = u.y() != 0.0 ? ((cell.y() + (step.y() > 0)) * h - o.y()) / u.y() : never;
    for (double t = 0.0; t < reach;) {
      for (const Slot slot : index_.at(cell)) {
        Wall& wall = walls_[static_cast<std::size_t>(slot)];
        if (wall.ray_stamp == ray) continue;
        wall.ray_stamp = ray;
        const Eigen::Vector2d v = wall.toWall(o);
        const Eigen::Vector2d ru(wall.direction.dot(u), wall.normal().dot(u));
        const double closing = wall.fit.slope * ru.x() - ru.y();
        if (closing == 0.0) continue;
        const double at = wall.offLine(v) / closing;
        if (at <= 0.05 || at >= reach - 2.0 * clear) continue;
        if ((reach - at) * std::abs(closing) < clear) continue;
        const double t_cross = v.x() + at * ru.x();
        if (!wall.profile.contains(SupportProfile::binOf(t_cross))) continue;
        wall.profile.pass(t_cross);
        touch(slot);
      }
      if (tx < ty) {
        t = tx;
        tx += dx;
        cell.x() += step.x();
      } else {
        t = ty;
        ty += dy;
        cell.y() += step.y();
      }
    }
  }
}

void LineMap::touch(Slot slot) {
  Wall& wall = walls_[static_cast<std::size_t>(slot)];
  if (wall.stamp != 0) return;
  wall.stamp = 1;
  touched_.push_back(slot);
}

void LineMap::maintain(Slot slot) {
  Wall* wall = &walls_[static_cast<std::size_t>(slot)];
  wall->stamp = 0;
  if (!wall->alive) return;
  wall->profile.prune();
  if (wall->profile.empty()) return removeWall(slot);
  wall->fit = wall->profile.fit();
  reanchor(*wall, 0.02);
  if (wall->hits > 1.2 * wall->hits_at_check) {
    splitWhereBent(slot);
    mergeWithNeighbours(slot);
    wall = &walls_[static_cast<std::size_t>(slot)];
    if (!wall->alive) return;
    wall->hits_at_check = wall->hits;
  }
  recut(*wall);
  reindex(slot);
}

bool LineMap::splitWhereBent(Slot slot) {
  Wall* wall = &walls_[static_cast<std::size_t>(slot)];
  const SupportProfile::Cut cut = wall->profile.bestCut();
  const double noise = square(pose_sigma_) + square(range_sigma_);
  if (cut.gain / (2.0 * noise) < kLineCost) return false;
  const Slot tail_slot = newWall();
  wall = &walls_[static_cast<std::size_t>(slot)];
  Wall& tail = walls_[static_cast<std::size_t>(tail_slot)];
  tail.origin = wall->origin;
  tail.direction = wall->direction;
  tail.two_sided = wall->two_sided;
  tail.profile = wall->profile.cutFrom(cut.at);
  const double share = static_cast<double>(tail.profile.last() - cut.at) /
                       (tail.profile.last() - wall->profile.first());
  tail.hits = share * wall->hits;
  wall->hits -= tail.hits;
  tail.hits_at_check = 0.0;
  wall->profile.prune();
  wall->fit = wall->profile.fit();
  reanchor(*wall, 0.02);
  touch(tail_slot);
  return true;
}

bool LineMap::oneWall(const Wall& wall, const Wall& other) const {
  const Eigen::Vector2d u = wall.fittedDirection(), w = other.fittedDirection();
  if (u.dot(w) < 0.9) return false;
  const BinSums a = wall.profile.sums(), b = sumsInFrameOf(wall, other);
  if (a.w <= 0.0 || b.w <= 0.0) return false;
  const double t_a = a.t / a.w;
  const Eigen::Vector2d ends[2] = {
      wall.toWall(other.toMap(other.profile.first() * SupportProfile::kBinLength, 0.0)),
      wall.toWall(other.toMap(other.profile.last() * SupportProfile::kBinLength, 0.0))};
  const double lo = std::min(ends[0].x(), ends[1].x()), hi = std::max(ends[0].x(), ends[1].x());
  const double first = wall.profile.first() * SupportProfile::kBinLength;
  const double last = wall.profile.last() * SupportProfile::kBinLength;
  const double overlap = std::min(hi, last) - std::max(lo, first);
  if (-overlap > kLargestGap) return false;
  (void)t_a;
  const double noise = square(pose_sigma_) + square(range_sigma_);
  const Eigen::Vector2d mid(b.t / b.w, b.d / b.w);
  const double shorter = std::min(hi - lo, last - first);
  if (overlap > 0.5 * shorter) {
    const double offset = std::abs(wall.offLine(mid));
    return offset < kSigmas * std::sqrt(2.0 * noise) && u.dot(w) > 0.98;
  }
  BinSums joint = a;
  joint.add(b);
  const double loss = joint.residual() - a.residual() - b.residual();
  return loss / (2.0 * noise) < 0.7 * kLineCost &&
         std::abs(wall.offLine(mid)) < kSigmas * std::sqrt(noise) * 2.0;
}

void LineMap::mergeWithNeighbours(Slot slot) {
  const Wall& me = walls_[static_cast<std::size_t>(slot)];
  const double b = SupportProfile::kBinLength;
  neighbours(me.toMap(me.profile.first() * b - 0.5, 0), me.toMap(me.profile.last() * b + 0.5, 0),
             found_);
  Slot keep = slot;
  for (const Slot other_slot : found_) {
    if (other_slot == keep) continue;
    Wall& wall = walls_[static_cast<std::size_t>(keep)];
    Wall& other = walls_[static_cast<std::size_t>(other_slot)];
    if (!other.alive || other.profile.empty() || !oneWall(wall, other)) continue;
    absorb(wall, other);
    wall.hits += other.hits;
    for (const MapLine& piece : other.pieces) wall.pieces.push_back(piece);
    wall.fit = wall.profile.fit();
    reanchor(wall, 0.02);
    removeWall(other_slot);
  }
}

void LineMap::recut(Wall& wall) {
  wall.profile.supportedRanges(kBridgedBins, wall.ranges);
  std::vector<MapLine> pieces;
  std::vector<BinRange> kept;
  for (const BinRange& range : wall.ranges) {
    MapLine line;
    SupportBin sum;
    for (int i = range.first; i < range.last; ++i) sum.add(wall.profile.bin(i));
    double hits = 0.0;
    for (int i = range.first; i < range.last; ++i) hits += wall.profile.bin(i).hits;
    const double t0 = wall.profile.bin(range.first).t_min;
    const double t1 = wall.profile.bin(range.last - 1).t_max;
    if (t1 - t0 < 0.2 || hits < 3.0) continue;
    line.segment.start = wall.toMap(t0, wall.fit.at(t0));
    line.segment.end = wall.toMap(t1, wall.fit.at(t1));
    line.support = hits;
    // The piece keeps the id of the old piece that it covers most.
    double most = 0.0;
    for (const MapLine& old : wall.pieces) {
      const double a = wall.toWall(old.segment.start).x(), c = wall.toWall(old.segment.end).x();
      const double common = std::min(t1, std::max(a, c)) - std::max(t0, std::min(a, c));
      bool taken = false;
      for (const MapLine& p : pieces) taken = taken || p.id == old.id;
      if (!taken && common > most) {
        most = common;
        line.id = old.id;
      }
    }
    if (line.id == 0) line.id = next_id_++;
    pieces.push_back(line);
    kept.push_back(range);
  }
  wall.pieces = pieces;
  wall.ranges = kept;
}

void LineMap::reindex(Slot slot) {
  Wall& wall = walls_[static_cast<std::size_t>(slot)];
  const double b = SupportProfile::kBinLength;
  index_.remove(slot, wall.cells);
  wall.cells.clear();
  index_.insert(slot, wall.toMap(wall.profile.first() * b, 0),
                wall.toMap(wall.profile.last() * b, 0), kIndexMargin, wall.cells);
}

LineMap::Slot LineMap::newWall() {
  Slot slot;
  if (free_slots_.empty()) {
    slot = static_cast<Slot>(walls_.size());
    walls_.emplace_back();
  } else {
    slot = free_slots_.back();
    free_slots_.pop_back();
    walls_[static_cast<std::size_t>(slot)] = Wall{};
  }
  walls_[static_cast<std::size_t>(slot)].alive = true;
  return slot;
}

void LineMap::removeWall(Slot slot) {
  Wall& wall = walls_[static_cast<std::size_t>(slot)];
  index_.remove(slot, wall.cells);
  wall.cells.clear();
  wall.pieces.clear();
  wall.profile = SupportProfile{};
  wall.alive = false;
  free_slots_.push_back(slot);
}

void LineMap::learnPoseError(double innovation, double expected_variance) {
  pose_samples_ = std::min(pose_samples_ + 1.0, 500.0);
  const double excess = std::min(square(innovation), 9.0 * square(pose_sigma_)) - expected_variance;
  const double gain = 1.0 / (20.0 + pose_samples_);
  const double variance = square(pose_sigma_) + gain * (1.05 * excess - square(pose_sigma_));
  pose_sigma_ = std::sqrt(std::max(variance, square(0.005)));
}

std::vector<MapLine> LineMap::lines() const {
  std::vector<MapLine> all;
  for (const Wall& wall : walls_) all.insert(all.end(), wall.pieces.begin(), wall.pieces.end());
  std::sort(all.begin(), all.end(), [](const MapLine& a, const MapLine& b) { return a.id < b.id; });
  return all;
}

std::vector<PolyLine> LineMap::polyLines() const {
  return {};
}

}  // namespace cca
