// SPDX-License-Identifier: BSD-3-Clause
#include "io/replay/replay.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cca {
namespace {

constexpr std::size_t kMostShown = 181;  // of a scan: what can be told apart on a screen
constexpr std::int64_t kVisible = 20;    // mm, that a line's end moves before it is drawn anew
constexpr std::size_t kLinesAMoment = 40;

/// The nearest integer. A page's numbers are exact up to 2^53: what is beyond, as broken logs have
/// it, is out of view anyway.
std::int64_t whole(double value) {
  constexpr double kLargest = 4e15;
  return std::isnan(value) ? 0 : std::llround(std::clamp(value, -kLargest, kLargest));
}

std::int64_t thousandths(double value) { return whole(1e3 * value); }

}  // namespace

bool Replay::Laser::operator==(const Laser& other) const {
  return T_robot_sensor == other.T_robot_sensor && first == other.first && step == other.step &&
         beams == other.beams;
}

bool Replay::Decision::saysTheSame(const Decision& other) const {
  return goal == other.goal && reason == other.reason && way == other.way;
}

Replay::Placed Replay::placed(const Pose2& pose) {
  return {thousandths(pose.x), thousandths(pose.y), thousandths(pose.theta)};
}

Replay::Shown Replay::shown(const MapLine& line) {
  const auto& [start, end, moments, covariance] = line.segment;
  const auto sigma = [](double variance) { return whole(1e5 * std::sqrt(std::abs(variance))); };
  return {
      {thousandths(start.x()), thousandths(start.y()), thousandths(end.x()), thousandths(end.y())},
      std::max<std::int64_t>(whole(line.support), 1),
      sigma(covariance(0, 0)),
      sigma(covariance(1, 1))};
}

// Of a large map the lines are looked at the more seldom, or they would cost more than mapping.
bool Replay::linesAreDue() const {
  return offered_ % stride_ == 0 &&
         frames_.size() % std::max<std::size_t>(1, lines_.size() / kLinesAMoment) == 0;
}

void Replay::add(const ReplayMoment& moment, const Scan& scan, const LineMap& map) {
  std::vector<MapLine> lines;
  const bool is_due = linesAreDue();
  if (is_due) lines = map.lines();
  add(moment, scan, is_due ? &lines : nullptr);
}

void Replay::add(const ReplayMoment& moment, const Scan& scan, const std::vector<MapLine>* lines) {
  if (!isFinite(moment.T_map_robot) || !std::isfinite(moment.time) || offered_++ % stride_ != 0)
    return;
  has_truth_ = has_truth_ && moment.truth && isFinite(*moment.truth);
  decide(moment);
  drawFrontier(moment.frontier);
  if (lines) drawLines(*lines, kVisible);
  const std::int64_t last = frames_.empty() ? 0 : frames_.back().time;
  Frame frame{std::max(last, thousandths(moment.time)),
              thousandths(moment.distance),
              placed(moment.T_map_robot),
              placed(moment.truth.value_or(Pose2())),
              0,
              {}};
  addScan(moment, scan, frame);
  frames_.push_back(std::move(frame));
  if (frames_.size() > kMostMoments) dropEverySecond();
}

void Replay::addScan(const ReplayMoment& moment, const Scan& scan, Frame& frame) {
  const std::size_t every = (scan.size() + kMostShown - 1) / kMostShown;
  for (std::size_t beam = 0; every > 0 && beam < scan.size(); beam += every) {
    const double range = scan.ranges[beam];
    frame.ranges.push_back(
        isReturn(range) ? static_cast<int>(std::lround(100.0 * std::min(range, 1e4))) : 0);
  }
  const Laser laser{placed(moment.T_map_robot.inverse() * scan.T_map_sensor), scan.angle_min,
                    scan.angle_increment * static_cast<double>(every), frame.ranges.size()};
  const auto found = std::find(lasers_.rbegin(), lasers_.rend(), laser);
  frame.laser = static_cast<std::size_t>(lasers_.rend() - found) - 1;
  if (found != lasers_.rend()) return;
  frame.laser = lasers_.size();
  lasers_.push_back(laser);
}

void Replay::decide(const ReplayMoment& moment) {
  Decision decision{frames_.size(), {}, moment.reason, {}};
  if (moment.goal) decision.goal = {thousandths(moment.goal->x()), thousandths(moment.goal->y())};
  for (const Eigen::Vector2d& p : moment.way) {
    decision.way.push_back(thousandths(p.x()));
    decision.way.push_back(thousandths(p.y()));
  }
  if (!decisions_.empty() && decisions_.back().saysTheSame(decision)) return;
  decisions_.push_back(std::move(decision));
}

void Replay::drawFrontier(const std::vector<Eigen::Vector2d>& cells) {
  std::set<Block> blocks;
  for (const Eigen::Vector2d& p : cells) {
    blocks.emplace(static_cast<int>(std::floor(p.x() / kFrontierBlock)),
                   static_cast<int>(std::floor(p.y() / kFrontierBlock)));
  }
  std::vector<Block> changed;
  std::set_symmetric_difference(frontier_.begin(), frontier_.end(), blocks.begin(), blocks.end(),
                                std::back_inserter(changed));
  for (const Block& block : changed) toggles_.push_back({frames_.size(), block});
  frontier_ = std::move(blocks);
}

void Replay::drawLines(const std::vector<MapLine>& lines, std::int64_t smallest_change) {
  std::map<std::uint64_t, Shown> now;
  for (const MapLine& line : lines) {
    const Shown drawn = shown(line);
    const auto before = lines_.find(line.id);
    std::int64_t moved = before == lines_.end() ? smallest_change : 0;
    for (std::size_t k = 0; k < 4 && before != lines_.end(); ++k) {
      moved = std::max(moved, std::abs(drawn.ends[k] - before->second.ends[k]));
    }
    const bool is_drawn = moved >= smallest_change;
    if (is_drawn) changes_.push_back({frames_.size(), line.id, drawn});
    now.emplace(line.id, is_drawn ? drawn : before->second);
  }
  for (const auto& [id, line] : lines_) {
    if (now.count(id) == 0) changes_.push_back({frames_.size(), id, Shown{line.ends, 0, 0, 0}});
  }
  lines_ = std::move(now);
}

void Replay::redraw(const std::vector<MapLine>& lines) {
  if (!frames_.empty()) drawLines(lines, kVisible);
}

void Replay::finish(const std::vector<MapLine>& lines) {
  if (!frames_.empty()) drawLines(lines, 0);
}

// What happened at a moment that is dropped is shown at the next one.
void Replay::dropEverySecond() {
  for (std::size_t k = 1; 2 * k < frames_.size(); ++k) frames_[k] = std::move(frames_[2 * k]);
  frames_.resize((frames_.size() + 1) / 2);
  for (Decision& decision : decisions_) decision.frame = (decision.frame + 1) / 2;
  for (Toggle& toggle : toggles_) toggle.frame = (toggle.frame + 1) / 2;
  for (LineChange& change : changes_) change.frame = (change.frame + 1) / 2;
  stride_ *= 2;
  ++generation_;
}

bool Replay::hasTimes() const {
  return !frames_.empty() && frames_.back().time > frames_.front().time;
}

bool Replay::Mark::isBefore(const Mark& later) const {
  return generation == later.generation && has_truth == later.has_truth &&
         has_times == later.has_times && frames <= later.frames && decisions <= later.decisions &&
         toggles <= later.toggles && changes <= later.changes;
}

Replay::Mark Replay::mark() const {
  return {generation_,     frames_.size(), decisions_.size(), toggles_.size(),
          changes_.size(), has_truth_,     hasTimes()};
}

void Replay::setCoverage(const std::vector<double>& distance, const std::vector<double>& share) {
  for (std::size_t i = 0; i < std::min(distance.size(), share.size()); ++i) {
    coverage_distance_.push_back(thousandths(distance[i]));
    coverage_share_.push_back(std::llround(1e4 * share[i]));
  }
}

}  // namespace cca
