// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/point_runs.hpp"

/// What the extractors share that find one line at a time in all points, whatever their order.
namespace cca::baselines {

/// The parameters of an extractor that gathers the points near a candidate line.
struct InlierParameters {
  double distance = 0.05;  ///< m
  double max_gap = 0.3;    ///< m
  SegmentLimits limits;
};

template <class Field>
void describe(InlierParameters& p, Field&& field) {
  field("distance", p.distance, 0.005, 0.5, "m", "points nearer to a line belong to it");
  field("max_gap", p.max_gap, 0.05, 2.0, "m", "largest gap along a segment");
  field("min_points", p.limits.min_points, 2, 15, "points", "fewest points of a segment");
  field("min_length", p.limits.min_length, 0.05, 1.0, "m", "shortest segment");
}

/// Points with what is left of them to be explained.
struct Pool {
  Points points;
  std::vector<bool> taken;
  explicit Pool(Points all) : points(std::move(all)), taken(points.size(), false) {}
  std::vector<std::size_t> left() const;
};

/// Takes the points near a line out of the pool: gathers those within the distance, refits and
/// gathers again, and cuts them where the gap along the line is too large. Points of pieces that
/// are too short for a segment stay in the pool.
/// @return  the points of each segment; none where no piece is long enough: the pool is unchanged.
std::vector<Points> takePieces(Pool& pool, const FittedLine& candidate, const InlierParameters& p);

/// The segments of pieces, ordered by the bearing of their centroids.
std::vector<LineSegment> segmentsOf(const std::vector<Points>& pieces);

/// Orders segments by the bearing of their centroids, so that results do not depend on luck.
void sortByBearing(std::vector<LineSegment>& segments);

}  // namespace cca::baselines
