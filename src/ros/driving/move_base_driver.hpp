// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <actionlib/client/simple_action_client.h>
#include <move_base_msgs/MoveBaseAction.h>

#include <functional>
#include <optional>
#include <string>

#include "cca_mrpt/geometry/pose2.hpp"
#include "cca_mrpt/navigation/explorer.hpp"

namespace cca {

/// Leaves the driving to move_base: the explorer's goals go there through actionlib. It has one
/// goal at a time, and waits for nothing: what becomes of it is told by callbacks.
class MoveBaseDriver {
 public:
  /// @param outcome  told of a goal that move_base has reached, or aborted or rejected.
  /// @param barred   told why no further goal is of use: somebody else has sent move_base
  /// elsewhere,
  ///                 or it takes none.
  MoveBaseDriver(std::string map_frame, std::function<void(DriveOutcome)> outcome,
                 std::function<void(const std::string& why)> barred);

  /// Whether a move_base listens.
  bool isThere() const { return client_.isServerConnected(); }

  /// Sends a goal where it is another one than the last.
  void driveTo(const Pose2& T_map_goal);

  /// Cancels the goal, if there is one.
  void stop();

  /// The next goal is sent in any case: the last one's move_base is gone.
  void forget();

 private:
  void onDone(const actionlib::SimpleClientGoalState& state);

  std::string map_frame_;
  std::function<void(DriveOutcome)> outcome_;
  std::function<void(const std::string&)> barred_;
  std::optional<Pose2> T_map_goal_;  ///< under way
  int rejected_ = 0;                 ///< one after another
  actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction> client_;
};

}  // namespace cca
