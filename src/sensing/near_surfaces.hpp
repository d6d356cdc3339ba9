// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <deque>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// Where the surfaces around the robot are, as the last scans say together: the nearest of many
/// returns lies two or three deviations before its surface, and passages would be narrower.
///
/// To the left and to the right of each beam a line is fitted through a patch of the returns of the
/// last scans, five and as many as it takes in noise. The surface is where both lines end, in the
/// beam: a corner stays sharp. Where the two disagree, the nearer one counts: that is an edge in
/// front of something else.
class NearSurfaces {
 public:
  /// Takes the next scan. What only one return shows, nearer than the noise of a surface explains,
  /// stays where it is; what the scan does not show is not there, whatever earlier ones did.
  /// @param raw          at T_map_sensor.
  /// @param smooth       the same, see smoothScan().
  /// @param moving       by beam: such returns are left as they are in `smooth`, not remembered.
  /// @param range_sigma  m, of the raw ranges; up to kUsualSigma nothing is done.
  /// @return  `smooth`, its returns within kNear replaced by the places of their surfaces, and
  ///          brought nearer where these are known less well than the least clearance allows for.
  /// Cost: O(returns within kNear of kMostScans scans * beams of a patch).
  Scan update(const Scan& raw, const Scan& smooth, const std::vector<bool>& moving,
              double range_sigma);

  /// m: with so much the nearest of many returns is near enough to the surface, and shows at once
  /// what comes nearer.
  static constexpr double kUsualSigma = 0.015;
  static constexpr double kNear = 1.5;  ///< m, from the sensor: a robot that drives stops within
  static constexpr std::size_t kMostScans = 20;  ///< two seconds, in which poses hardly drift

 private:
  struct Point {
    Eigen::Vector2d p_sensor;  ///< m, in the frame of the last scan
    int beam;                  ///< of that scan, next to it
  };
  void sortByBeam(const Scan& scan);

  std::deque<std::vector<Eigen::Vector2d>> scans_;  ///< m, map frame
  std::vector<Point> points_;                       ///< of all scans
  std::vector<Eigen::Vector2d> by_beam_;            ///< m, sensor frame, in the order of the beams
  std::vector<std::size_t> first_;                  ///< of each beam, in by_beam_
};

}  // namespace cca
