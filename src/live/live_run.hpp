// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "live/live_page.hpp"

namespace cca {

/// A run that goes on, as viewers are told of it. Who runs hands over copies and never waits; a
/// thread of its own adds them up; each viewer asks for what it lacks, so that one who is slow
/// gets more at once, and nothing is kept for anybody.
class LiveRun {
 public:
  explicit LiveRun(const LivePageSettings& settings);
  ~LiveRun();
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  /// One moment of the run, copied. Dropped where a hundred wait already, or its time or place is
  /// not finite.
  struct Glimpse {
    ReplayMoment moment;
    Scan scan;
    std::optional<std::vector<MapLine>> lines;
    bool begins_anew = false;
    double shown_at = 0.0;  ///< s since 1970
  };
  void hand(Glimpse glimpse);
  void setPaused(bool is_paused);
  void finish(const std::vector<MapLine>& lines, const std::string& reason);
  /// Nobody is to wait any more.
  void close();

  /// How much a viewer has.
  struct Viewed {
    std::size_t version = 0, run = 0;
    Replay::Mark mark;
  };
  /// What a viewer lacks, as one event of a stream; waits for it for a second, then says nothing
  /// (a comment). Empty: the run is closed, and all is told.
  std::string next(Viewed& viewed);

 private:
  void work();
  void take(const Glimpse& glimpse);
  std::string event(Viewed& viewed);
  void pack();

  LivePageSettings settings_;
  std::mutex handed_mutex_;
  std::condition_variable handed_;
  std::deque<Glimpse> waiting_;
  bool ends_ = false, is_busy_ = false;

  std::mutex mutex_;  ///< of all below
  std::condition_variable changed_;
  const Replay empty_;  ///< of the same world
  Replay replay_;
  ReplayMoment tip_;  ///< the last one, kept in the replay or not
  std::optional<Pose2> last_kept_;
  double shown_at_ = 0.0;
  std::size_t version_ = 1, run_ = 1;
  bool is_paused_ = false, is_closed_ = false;
  std::string end_;  ///< why; empty: goes on
  /// The whole, for who comes; kept for a moment, for many may come at once.
  std::string packed_;
  Viewed packed_has_;
  std::chrono::steady_clock::time_point packed_at_;
  std::thread thread_;  // last: it needs all the rest
};

}  // namespace cca
