// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/options/moved.hpp"
#include "cca_mrpt/io/scan_raster.hpp"
#include "cca_mrpt/session/mapping_session.hpp"
#include "io/replay/replay.hpp"
#include "live/live_page.hpp"

namespace cca::python {

/// What is kept of the scans of a map beside it: occupancy, and what a page shows of a map that is
/// made at the end.
class ScanRecorder : public MapRecorder {
 public:
  /// @param title  of the replay, for people.
  explicit ScanRecorder(std::string title) : title_(std::move(title)), replay_(title_) {}

  void restart() override {
    raster_ = ScanRaster(p_begin_);
    replay_ = Replay(title_);
    last_moment_.reset();
    distance_ = 0.0;
    if (page_) page_->restart();
  }
  void record(const MappedScan& mapped, const LineMap& map) override {
    goOn();
    raster_.insert(mapped.scan);
    if (!is_replayed_ || mapped.is_of_earlier_drive) return;
    ReplayMoment moment;
    moment.time = told_[mapped.number].time;
    moment.distance = distance_;
    moment.T_map_robot = mapped.T_map_robot;
    moment.truth = told_[mapped.number].reference;
    if (page_ && page_->isDue()) page_->show({moment, mapped.scan, map, {}, {}});
    const std::optional<Pose2> last = last_moment_;
    if (!apps::keepIfMoved(last_moment_, mapped.T_map_robot)) return;
    const double step = last ? (mapped.T_map_robot.position() - last->position()).norm() : 0.0;
    if (step < apps::kLongestStep) distance_ += step;
    moment.distance = distance_;
    replay_.add(moment, mapped.scan, map);
  }
  /// Of any thread: nobody wants the map any more.
  void stop() { is_stopped_ = true; }
  /// @throws std::runtime_error after stop().
  void goOn() const {
    if (is_stopped_) throw std::runtime_error("stopped");
  }
  std::optional<OccupancyRaster> raster() const { return raster_.raster(); }

  /// Before the first scan. @param p_begin  m: about where they begin.
  void beginAt(const Eigen::Vector2d& p_begin) {
    p_begin_ = p_begin;
    raster_ = ScanRaster(p_begin_);
  }
  /// Of the next scan. @param reference  the pose that the run can be judged by.
  void add(double seconds, const std::optional<Pose2>& reference) {
    told_.push_back({seconds, reference});
  }
  /// From now on, what is recorded can be looked at: of maps that are made once.
  void keepReplay() { is_replayed_ = true; }
  void showOn(LivePage* page) { page_ = page; }
  /// Replay::packed(); empty where there is none. @param lines  as the run leaves them.
  std::string replay(const std::vector<MapLine>& lines, const Eigen::Vector2d& origin) const {
    Replay replay = replay_;
    replay.finish(lines);
    return replay.empty() ? "" : replay.packed(origin);
  }

 private:
  std::optional<Eigen::Vector2d> p_begin_;
  ScanRaster raster_;
  /// What a log tells of a scan beside what is mapped.
  struct Telling {
    double time;  ///< s
    std::optional<Pose2> reference;
  };
  std::vector<Telling> told_;  ///< of each scan
  std::string title_;
  Replay replay_;
  bool is_replayed_ = false;
  std::atomic<bool> is_stopped_{false};
  std::optional<Pose2> last_moment_;
  double distance_ = 0.0;  ///< m, up to the last moment
  LivePage* page_ = nullptr;
};

}  // namespace cca::python
