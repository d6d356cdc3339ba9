// SPDX-License-Identifier: BSD-3-Clause
#include "live_run.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

namespace cca {
namespace {

constexpr std::size_t kMostWaiting = 100;    // five seconds of moments
constexpr double kStep = 0.05, kTurn = 0.1;  // m, rad; nearer moments are not kept
constexpr std::chrono::seconds kPatience(1), kPackedFor(2);

bool hasMoved(const std::optional<Pose2>& last, const Pose2& now) {
  return !last || (now.position() - last->position()).norm() >= kStep ||
         std::abs(wrapAngle(now.theta - last->theta)) >= kTurn;
}

Replay emptyReplay(const LivePageSettings& settings) {
  Replay replay(settings.title, settings.robot_radius);
  replay.setWorld(settings.world);
  return replay;
}

}  // namespace

LiveRun::LiveRun(const LivePageSettings& settings)
    : settings_(settings),
      empty_(emptyReplay(settings)),
      replay_(empty_),
      thread_([this] { work(); }) {}

LiveRun::~LiveRun() {
  close();
  {
    const std::lock_guard<std::mutex> lock(handed_mutex_);
    ends_ = true;
  }
  handed_.notify_all();
  thread_.join();
}

void LiveRun::hand(Glimpse glimpse) {
  {
    const std::lock_guard<std::mutex> lock(handed_mutex_);
    if (waiting_.size() >= kMostWaiting && !glimpse.begins_anew) return;
    if (glimpse.begins_anew) waiting_.clear();
    waiting_.push_back(std::move(glimpse));
  }
  handed_.notify_all();
}

void LiveRun::work() {
  std::unique_lock<std::mutex> lock(handed_mutex_);
  for (;;) {
    handed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
    if (ends_) return;
    const Glimpse glimpse = std::move(waiting_.front());
    waiting_.pop_front();
    is_busy_ = true;
    lock.unlock();
    take(glimpse);
    lock.lock();
    is_busy_ = false;
    handed_.notify_all();
  }
}

void LiveRun::take(const Glimpse& glimpse) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (glimpse.begins_anew) {
      replay_ = empty_;
      last_kept_.reset();
      ++run_;
    } else if (isFinite(glimpse.moment.T_map_robot) && std::isfinite(glimpse.moment.time)) {
      const bool is_kept =
          hasMoved(last_kept_, glimpse.moment.T_map_robot) || glimpse.moment.reason != tip_.reason;
      if (is_kept) {
        replay_.add(glimpse.moment, glimpse.scan, glimpse.lines ? &*glimpse.lines : nullptr);
        last_kept_ = glimpse.moment.T_map_robot;
      } else if (glimpse.lines) {
        replay_.redraw(*glimpse.lines);
      }
      tip_ = glimpse.moment;
      shown_at_ = glimpse.shown_at;
    }
    ++version_;
  }
  changed_.notify_all();
}

void LiveRun::setPaused(bool is_paused) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_paused_ == is_paused) return;
    is_paused_ = is_paused;
    ++version_;
  }
  changed_.notify_all();
}

void LiveRun::finish(const std::vector<MapLine>& lines, const std::string& reason) {
  {
    std::unique_lock<std::mutex> lock(handed_mutex_);
    handed_.wait(lock, [this] { return waiting_.empty() && !is_busy_; });
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    replay_.finish(lines);
    end_ = reason;
    ++version_;
  }
  changed_.notify_all();
}

void LiveRun::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_closed_ = true;
  }
  changed_.notify_all();
}

std::string LiveRun::next(Viewed& viewed) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, kPatience, [&] { return is_closed_ || version_ != viewed.version; });
  if (version_ != viewed.version) return event(viewed);
  return is_closed_ ? "" : ": still here\n\n";
}

void LiveRun::pack() {
  const auto now = std::chrono::steady_clock::now();
  const bool is_good = packed_has_.run == run_ && packed_has_.mark.isBefore(replay_.mark()) &&
                       now - packed_at_ < kPackedFor;
  if (is_good) return;
  packed_ = replay_.packed(settings_.origin);
  packed_has_ = {version_, run_, replay_.mark()};
  packed_at_ = now;
}

std::string LiveRun::event(Viewed& viewed) {
  nlohmann::json told;
  if (viewed.run != run_ || !viewed.mark.isBefore(replay_.mark())) {
    if (!replay_.empty()) {
      pack();
      told["whole"] = packed_;
      viewed.mark = packed_has_.mark;
    } else {
      told["empty"] = true;
      viewed.mark = {};
    }
  }
  const Pose2& T = tip_.T_map_robot;
  if (isFinite(T)) {
    told["robot"] = {{"time", tip_.time}, {"distance", tip_.distance}, {"x", T.x},
                     {"y", T.y},          {"theta", T.theta},          {"reason", tip_.reason}};
  }
  told["shown_at"] = shown_at_;
  told["paused"] = is_paused_;
  told["has_robot"] = settings_.has_robot;
  told["end"] = end_;
  std::string text = told.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  const Replay::Mark mark = replay_.mark();
  if (viewed.mark.generation != 0) text.insert(1, "\"more\":" + replay_.since(viewed.mark) + ",");
  viewed = {version_, run_, mark};
  if (replay_.empty()) viewed.mark = {};
  return "data: " + text + "\n\n";
}

}  // namespace cca
