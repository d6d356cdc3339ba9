// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <algorithm>

#include "ros/nodes/node_main.hpp"

namespace cca {

/// Paces a simulation by the wall's clock, and serves callbacks meanwhile.
class Pace {
 public:
  /// @param speed  simulated seconds a second of the wall, positive.
  explicit Pace(double speed) : speed_(speed), begin_(ros::WallTime::now()) {}

  /// Waits until `simulated` seconds since the start are due.
  /// @return  false where the node shall end.
  bool wait(double simulated) {
    double ahead = 0.0;
    do {
      ahead = simulated - due();
      if (!keepRunning(std::clamp(ahead / speed_, 0.0, 0.1))) return false;
    } while (ahead > 0.0 && simulated > due());
    return true;
  }

  /// Gives up what a machine too slow, or suspended, could not do in time.
  /// @return  s, by how much the simulation is late beyond what it may catch up with.
  double forgive(double simulated) {
    const double late = due() - simulated - kCatchUp * speed_;
    if (late <= 0.0) return 0.0;
    begin_ += ros::WallDuration(late / speed_);
    return late;
  }

 private:
  static constexpr double kCatchUp = 0.5;  // s of the wall

  double due() const { return speed_ * (ros::WallTime::now() - begin_).toSec(); }

  double speed_;
  ros::WallTime begin_;
};

}  // namespace cca
