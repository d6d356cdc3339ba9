// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "cca_mrpt/geometry/line_segment.hpp"
#include "cca_mrpt/mapping/map_line.hpp"
#include "cca_mrpt/mapping/parameters.hpp"
#include "cca_mrpt/sensing/past_scans.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

class MapNoise;
class Walls;

/// The incremental line map (the paper's steps 6-7).
class LineMap {
 public:
  /// Where the poses of the scans come from, for what is known of the lines.
  enum class Poses {
    kGiven,  ///< from elsewhere: each errs for itself, by what the lines show
    kOwn,    ///< from the scans themselves: they err together, see WallNetwork
  };
  explicit LineMap(const CcaParameters& parameters = {}, Poses poses = Poses::kGiven);
  ~LineMap();
  LineMap(const LineMap& other);
  LineMap& operator=(const LineMap& other);
  LineMap(LineMap&&) noexcept;
  LineMap& operator=(LineMap&&) noexcept;

  /// Takes a scan at its T_map_sensor. Cost does not depend on the size of the map.
  /// @return  false where the pose is not finite or further than 10 000 km from the map's origin:
  ///          the scan is then left out.
  bool insert(const Scan& scan);
  /// The same with lines (sensor frame, in any order) that were extracted elsewhere.
  bool insert(const Scan& scan, const std::vector<LineSegment>& lines);

  /// A last look at the whole map: the evidence of its scans assigned anew (reassignEvidence()),
  /// dotted walls among what is left over, and what all lines owe to the poses, where these are the
  /// map's own. lines() holds all this from now on.
  /// @param scans  those of the map, or as many of them as were kept; none: no evidence moves.
  /// Cost: about that of an insertion for each scan; see LooseReturns::dottedWalls() and
  /// WallNetwork::settle().
  void lookBack(const std::vector<PastScans::Kept>& scans = {});

  /// The lines as they stand, by rising id; ends that meet share their corner. Dotted walls last.
  /// Cost: O(n log n) for n lines, of which none is fitted anew.
  std::vector<MapLine> lines() const;
  /// The same lines but the dotted ones, chained along their corners.
  std::vector<PolyLine> polyLines() const;
  /// Round pillars and curved walls among the same lines; see arcsOfWalls().
  std::vector<MapArc> arcs() const;

  /// What the map has learned about the noise and the pose error of its scans.
  const MapNoise& noise() const;
  const Walls& walls() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace cca
