// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "live/run_observer.hpp"

namespace cca {

/// What somebody who looks at a run wants its robot to do.
struct RunCommand {
  enum class Kind { kStart, kPause, kStop, kHome, kGo };
  Kind kind;
  Eigen::Vector2d place_map = Eigen::Vector2d::Zero();  ///< m, map frame; of kGo
};

struct LivePageSettings {
  static constexpr int kPort = 8048;  ///< where none is named
  /// A number of this machine's. On another one than 127.0.0.1 who asks has to know a random token,
  /// which url() tells.
  std::string address = "127.0.0.1";
  int port = 0;                                      ///< 0: any that is free
  std::string title;                                 ///< for people
  double robot_radius = 0.2;                         ///< m
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, map frame: where the run's frame lies
  std::string world;  ///< what there is in truth: replayWorld(); empty: nobody knows
  bool has_robot =
      false;  ///< else there is nobody to be sent home or anywhere: kStart, kPause only
};

/// The page of replay.html, of a run that goes on, for some browsers at a time.
///
/// A page has the whole run when it connects, and its changes from then on, as fast as it reads
/// them. Pages of other origins can neither read nor command, see docs/live.md. The run waits for
/// nobody: what it shows is copied, and written by the threads of the server.
class LivePage : public RunObserver {
 public:
  /// To be opened in a browser.
  virtual const std::string& url() const = 0;
  /// The map begins anew, and all that was shown is void.
  virtual void restart() = 0;
  /// The oldest command that was not taken yet, of 16 at most; in the run's frame.
  virtual std::optional<RunCommand> nextCommand() = 0;
  /// Tells the viewers whether the run stands still.
  virtual void setPaused(bool is_paused) = 0;
  /// The map as the run leaves it, and how it ended: one sentence.
  virtual void finish(const std::vector<MapLine>& lines, const std::string& reason) = 0;
};

/// Opens one. @throws std::runtime_error where the port is in use, the address is none of this
/// machine's, or the program was built without an HTTP library, with what to do then.
std::unique_ptr<LivePage> openLivePage(const LivePageSettings& settings);

}  // namespace cca
