// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <deque>
#include <memory>
#include <vector>

#include "cca_mrpt/io/log_reader.hpp"

namespace cca {

/// Where the frame lies in which a run is worked out that begins at a place: at the nearest
/// multiple of a kilometre, so that what lies within 500 m of (0, 0) stays as it is, to the bit.
/// MRPT keeps its grids in single precision, which has no centimetres left far from its origin
/// (UTM).
/// @return  m, map frame; (0, 0) where the place is not finite.
Eigen::Vector2d localOrigin(const Eigen::Vector2d& p_map);

/// The same pose, seen from a frame that lies at p_origin and is not turned.
inline Pose2 seenFrom(const Eigen::Vector2d& p_origin, const Pose2& pose) {
  return {pose.x - p_origin.x(), pose.y - p_origin.y(), pose.theta};
}

/// Each coordinate's median, so that no single pose that is far off decides; (0, 0) of none.
Eigen::Vector2d medianPlace(const std::vector<Eigen::Vector2d>& places);

/// A log in the local frame of its first scans: their sensor poses, corrected poses and true poses.
/// Odometry stays as it is, in the frame of the wheels.
class LocalLog : public LogReader {
 public:
  /// Reads up to a hundred scans ahead.
  explicit LocalLog(std::unique_ptr<LogReader> log);

  /// m, map frame: where the local frame lies.
  const Eigen::Vector2d& origin() const { return origin_; }
  /// m, local frame: about where the log begins.
  const Eigen::Vector2d& start() const { return start_; }

  /// Lets the local frame lie elsewhere [m, map frame], e.g. where another log has it. To be called
  /// before next().
  void moveTo(const Eigen::Vector2d& origin);

  /// Whether a SLAM system had corrected the pose of the first scan. To be asked before next().
  bool beginsCorrected() const { return !ahead_.empty() && ahead_.front().corrected; }

  std::optional<LogRecord> next() override;
  std::string warnings() const override { return log_->warnings(); }
  double progress() const override { return log_->progress(); }

 private:
  std::unique_ptr<LogReader> log_;
  std::deque<LogRecord> ahead_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero(), start_ = Eigen::Vector2d::Zero();
};

}  // namespace cca
