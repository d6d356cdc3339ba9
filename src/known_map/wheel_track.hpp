// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "cca_mrpt/geometry/pose2.hpp"
#include "known_map/global_localisation.hpp"

namespace cca {

/// A way by the wheels, and by the matches at both its ends, m.
struct JudgedWay {
  double by_wheels, matched;
  double variance;  ///< m^2, of the matched one
};

/// Where the sensor got to by its motion alone since the beginning, whoever carried the robot; and
/// what places that were found since say of that.
class WheelTrack {
 public:
  void add(const Pose2& T_before_after);
  const Pose2& T_wheels_sensor() const { return T_wheels_sensor_; }

  /// The sensor is known to be there.
  void trust(const Pose2& T_map_sensor);
  /// Where nobody carried it, since it was trusted last; nothing: it never was.
  std::optional<Expectation> expectation() const;

  /// The sensor has been matched to the map there.
  /// @param covariance  of the match, m^2, map axes.
  /// @return  the way since the last judged match, once it is long enough.
  std::optional<JudgedWay> judge(const Pose2& T_map_sensor, const Eigen::Matrix2d& covariance);
  /// Nobody knows how the sensor got to its place: the next way begins here.
  void breakOff() { anchor_.reset(); }

 private:
  struct Trusted {
    Pose2 T_map_wheels;
    double way, turn;
  };
  struct Anchor {
    Pose2 T_map_sensor, T_wheels_sensor;
    Eigen::Matrix2d covariance;
  };

  Pose2 T_wheels_sensor_;
  double way_ = 0.0, turn_ = 0.0;  ///< m, rad, in all
  std::optional<Trusted> trusted_;
  std::optional<Anchor> anchor_;  ///< where the way that is judged next began
};

}  // namespace cca
