// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "cca_mrpt/geometry/tiled_grid.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// Tells which returns come from something that moves: they lie where an earlier scan saw free
/// space, or beside a place that an earlier scan saw taken and this one sees free.
///
/// The scan of about half a second ago is looked up in the direction of each return, and the other
/// way round; so is, one way, that of 1.4 s ago, for who comes slowly. A return is suspicious where
/// all beams around that direction saw clearly farther.
/// Three suspicious neighbours are a mover, with all that is joined to them; a mover that pauses
/// stays one for kMemory. Beyond kFarthest beams are too sparse to tell a thin pole from somebody.
class MovingPoints {
 public:
  /// @param scan  smoothed. @param range_sigma  m, before. @param time  s, never falling.
  /// @return      by beam.
  std::vector<bool> update(const Scan& scan, double range_sigma, double time);

  /// Whether movers have been seen within the last minute, in more than one scan: there may be more
  /// around the corner.
  bool areAround(double time) const { return time - last_seen_ < 60.0; }

  /// Returns of the last scan, m, map frame, that may belong to a mover though none was found in
  /// them: they are near, movers are around, the scan of half a second ago saw nothing at their
  /// place, and nothing is known to have stood there for longer. Somebody slow, or somebody who has
  /// just come from behind something.
  const std::vector<Eigen::Vector2d>& unsettled() const { return unsettled_; }

  /// A scan, taken right after the last one, without its returns from where somebody moves, or has
  /// within the last kMemory: those beams tell nothing. A map that has them keeps where people were
  /// when the laser last saw them. Where nobody is around it stays as it is.
  /// Cost: O(beams * places).
  Scan withoutMovers(Scan scan) const;

  /// m, from p_map [m, map frame] to the nearest place where a mover was within the last kMemory;
  /// infinite where there was none. Cost: O(places).
  double distanceTo(const Eigen::Vector2d& p_map) const;

  static constexpr double kFarthest = 6.0;  ///< m; a leg has one beam of a cheap laser there
  /// s; longer than people pause, who are gone again after two
  static constexpr double kMemory = 3.0;

 private:
  struct Past {
    Scan scan;
    std::vector<Eigen::Vector2d> points;  ///< m, map frame, by beam
    double time;
  };
  struct Place {
    Eigen::Vector2d p_map;
    double time;
  };
  /// s, since when: nothing stands.
  static constexpr float kNobody = std::numeric_limits<float>::infinity();

  static void markBody(const std::vector<Eigen::Vector2d>& points, std::size_t first,
                       std::size_t last, std::vector<bool>& moving);

  const Past& scanBefore(double time) const;
  void noteWhatStands(const Scan& scan, const std::vector<Eigen::Vector2d>& points,
                      const std::vector<bool>& moving, double clearly, double time);
  bool mayMove(const Eigen::Vector2d& p_map, double time) const;
  bool hasStood(const Eigen::Vector2d& p_map, double time) const;
  void findUnsettled(const Scan& scan, const std::vector<Eigen::Vector2d>& points,
                     const std::vector<bool>& moving, double range_sigma, double time);

  std::deque<Past> past_;
  std::vector<Eigen::Vector2d> unsettled_;
  std::vector<Place> places_;  ///< where movers were
  double last_seen_ = -1e9;
  /// s, of the drive, since when something that does not move has been seen in a cell, and not that
  /// it is free; kNobody where nothing has.
  TiledGrid<float> standing_since_{kNobody};
  std::optional<double> start_;  ///< s, of the drive
};

}  // namespace cca
