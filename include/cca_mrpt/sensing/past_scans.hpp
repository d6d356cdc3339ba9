// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "cca_mrpt/sensing/analysed_scan.hpp"

namespace cca {

/// The scans that matter of a way so far, one every few steps, so that maps can be made anew where
/// their poses are corrected.
class PastScans {
 public:
  struct Kept {
    std::size_t step;         ///< its number among all scans
    AnalysedScan seen;        ///< at T_map_sensor as believed now
    Pose2 T_map_robot;        ///< as believed now
    Pose2 T_was_robot{};      ///< as believed before the last correction
    bool was_placed = false;  ///< whether that was known
    std::size_t sensor = 0;   ///< which laser
  };

  /// Takes the next scan, and keeps it where the robot has moved 10 cm or 5 degrees since the last
  /// one that was kept.
  /// @param is_placed  whether the pose is known: otherwise it is kept until a correction tells it.
  /// @return  whether it was kept.
  bool add(const AnalysedScan& seen, const Pose2& T_map_robot, bool is_placed = true);

  /// Takes a scan of another laser (1, 2, ...) from about the time of the scan with the number
  /// `step`, with which it goes where that is corrected; kept by the same rule.
  /// @param step  not below that of any scan taken before. @param T_map_robot  at that step.
  /// @return  whether it was kept.
  bool addBeside(std::size_t step, const AnalysedScan& seen, const Pose2& T_map_robot,
                 std::size_t sensor);

  /// @param T_map_robot  of all scans taken so far, in their order, as believed now.
  /// @param is_placed    of each of them, whether that is known.
  void correct(const std::vector<Pose2>& T_map_robot, const std::vector<bool>& is_placed);

  /// Those whose place is known, in their order.
  const std::vector<Kept>& kept() const { return kept_; }
  std::size_t size() const { return steps_; }  ///< scans taken

  /// By how much the last correction moved a place: T_map_was of the scan taken nearest to it whose
  /// place was known, of equally near ones the latest. @param p_was  m, map frame before the
  /// correction. Cost: O(scans kept).
  Pose2 correctionAt(const Eigen::Vector2d& p_was) const;
  /// The same for the robot.
  Pose2 correctionHere() const;

 private:
  std::size_t steps_ = 0;
  std::vector<Kept> kept_, unplaced_;
};

}  // namespace cca
