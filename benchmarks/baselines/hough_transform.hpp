// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/hough_accumulator.hpp"
#include "baselines/inliers.hpp"

namespace cca::baselines {

struct HoughTransformParameters {
  HoughResolution resolution;
  InlierParameters inliers;
  static HoughTransformParameters tuned();
};

template <class Field>
void describe(HoughTransformParameters& p, Field&& field) {
  describe(p.resolution, field);
  describe(p.inliers, field);
}

/// Hough transform [Duda & Hart 1972; Pfister et al. 2003; Nguyen et al. 2007, Algorithm 6].
///
/// All points vote; the strongest cell's points are gathered, refitted by total least squares, cut
/// at gaps and taken out of the vote; until the strongest cell has too few votes or gives nothing.
/// @return  segments in the sensor frame, by bearing. Cost: O(cells) per line.
std::vector<LineSegment> houghTransform(const Scan& scan, const HoughTransformParameters& p = {});

/// The same, before lines are fitted: the points of each segment, strongest line first.
std::vector<Points> houghPieces(const Points& points, const HoughTransformParameters& p);

}  // namespace cca::baselines
