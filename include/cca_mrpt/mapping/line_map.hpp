// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "cca_mrpt/mapping/line_segment.hpp"
#include "cca_mrpt/mapping/parameters.hpp"
#include "cca_mrpt/mapping/scan.hpp"
#include "cca_mrpt/mapping/wall.hpp"
#include "cca_mrpt/mapping/wall_index.hpp"

namespace cca {

/// Vertices of a chain of map lines that meet at their ends; closed where first equals last.
struct PolyLine {
  std::vector<Eigen::Vector2d> vertices;  ///< m, map frame
  std::vector<std::uint64_t> line_ids;    ///< the lines between neighbouring vertices
};

/// The incremental line map (the paper's steps 6-7).
class LineMap {
 public:
  explicit LineMap(const CcaParameters& parameters = {}) : parameters_(parameters) {}

  /// Takes a scan at its T_map_sensor. Cost does not depend on the size of the map.
  /// @return  false where the pose is not finite: the scan is then left out.
  bool insert(const Scan& scan);
  /// Merges scans that still wait for their batch to fill.
  void finishBatch();

  /// The lines as they stand, by rising id.
  std::vector<MapLine> lines() const;
  std::vector<PolyLine> polyLines() const;

  /// Standard deviation of a scan's lateral misplacement against the map, learned from it.
  double poseSigma() const { return pose_sigma_; }

 private:
  using Slot = WallIndex::Slot;
  /// A segment of a new scan, in the map frame.
  struct NewLine {
    LineSegment segment;
    Eigen::Vector2d viewpoint;
    std::size_t scan = 0;  ///< in the batch
    Slot wall = -1;        ///< where it went
  };

  void mergeBatch();
  void neighbours(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::vector<Slot>& found);
  double likeness(const NewLine& line, const Wall& wall) const;
  void place(NewLine& line);
  void depositScan(const Scan& scan, std::size_t scan_index);
  void castRays(const Scan& scan);
  Slot wallAt(const Eigen::Vector2d& p_map, const Eigen::Vector2d& viewpoint) const;
  void maintain(Slot slot);
  bool splitWhereBent(Slot slot);
  void mergeWithNeighbours(Slot slot);
  bool oneWall(const Wall& wall, const Wall& other) const;
  void recut(Wall& wall);
  void reindex(Slot slot);
  Slot newWall();
  void removeWall(Slot slot);
  void touch(Slot slot);
  void learnPoseError(double innovation, double expected_variance);

  CcaParameters parameters_;
  std::vector<Wall> walls_;
  std::vector<Slot> free_slots_;
  WallIndex index_;
  std::uint64_t next_id_ = 1;
  std::uint64_t stamp_ = 0;
  double pose_sigma_ = 0.04;
  double pose_samples_ = 0.0;
  double range_sigma_ = 0.015;

  std::vector<Scan> batch_;
  std::vector<NewLine> new_lines_;
  std::vector<Slot> touched_;
  std::vector<Slot> found_;
};

}  // namespace cca
