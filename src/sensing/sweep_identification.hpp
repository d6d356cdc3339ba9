// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "cca_mrpt/sensing/scan.hpp"
#include "sensing/undistortion.hpp"

namespace cca {

/// How the beams of a scan follow each other in time.
enum class SweepSense {
  kInstant,   ///< all at once
  kForward,   ///< in the order of the scan
  kBackward,  ///< the other way round: drivers of lasers that turn clockwise reverse the array
};

/// Finds out which way a laser sweeps: messages do not tell it reliably.
///
/// Under the right hypothesis, scans taken while the robot moves agree in shape with one taken
/// nearby at another speed or turning rate, or at another heading: a rigid motion joins them. Under
/// a wrong one they are bent. Each scan taken while moving is undistorted under the three
/// hypotheses and laid onto a reference scan likewise undistorted, at the heading that fits best;
/// odometry tells the rest. The mean differences of their ranges are the observations of a
/// sequential paired test.
class SweepIdentification {
 public:
  /// Takes the next scan. Cost: O(beams), some hundred thousand operations until it is settled.
  /// @param duration      s, of the whole sweep, > 0, whatever its sense; the same in all calls.
  /// @param sensor        in its own frame, when the scan was taken.
  /// @param T_odom_sensor by odometry; the heading may drift slowly.
  void add(const Scan& scan, double duration, const Twist& sensor, const Pose2& T_odom_sensor);

  /// Whether more scans change nothing any more.
  bool isSettled() const;

  /// The sense that agrees better than the others beyond chance; nothing while there is none.
  std::optional<SweepSense> sense() const;

 private:
  static constexpr std::size_t kHypotheses =
      3;  // of one instant, first beam first, last beam first
  using Costs = std::array<double, kHypotheses>;  ///< m, of one scan

  struct Reference {
    std::array<Scan, kHypotheses> scans;  ///< undistorted under each
    Costs turn{};                         ///< rad, by which odometry's heading is off since then
    double angular = 0.0;                 ///< rad/s
    Eigen::Vector2d linear{0.0, 0.0};     ///< m/s
    double turned = 0.0;                  ///< rad, since then, of both senses
    Pose2 T_odom_sensor;
  };
  bool isComparable(const Twist& sensor, const Pose2& T_odom_sensor) const;
  void begin(const Scan& scan, double duration, const Twist& sensor, const Pose2& T_odom_sensor);
  void count(const Costs& costs);

  std::optional<Reference> reference_;
  std::optional<Pose2> last_;
  int tests_ = 0;
  Costs sum_{};
  std::array<Costs, kHypotheses> sum_of_differences_{}, sum_of_squares_{};
};

}  // namespace cca
