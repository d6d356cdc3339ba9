// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "baselines/hough_accumulator.hpp"
#include "baselines/point_runs.hpp"

namespace cca::baselines {

struct ConvolutionClusteringParameters {
  int half_width = 3;       ///< points
  double threshold = 0.15;  ///< m
  HoughResolution resolution{1.0, 0.05};
  double distance = 0.06;  ///< m
  int max_misses = 2;      ///< points
  SegmentLimits limits;
  static ConvolutionClusteringParameters tuned();
};

template <class Field>
void describe(ConvolutionClusteringParameters& p, Field&& field) {
  field("half_width", p.half_width, 1, 10, "points", "half the width of the convolution mask");
  field("threshold", p.threshold, 0.03, 1.0, "m", "response that ends a cluster");
  describe(p.resolution, field);
  field("distance", p.distance, 0.005, 0.5, "m", "points nearer to a tracked line belong to it");
  field("max_misses", p.max_misses, 0, 10, "points", "points off the line in a row that end it");
  field("min_points", p.limits.min_points, 2, 15, "points", "fewest points of a segment");
  field("min_length", p.limits.min_length, 0.05, 1.0, "m", "shortest segment");
}

/// Distance-based Convolution Clustering, then Hough and line tracking [Fernandez et al. 2010].
///
/// The sequence of distances between neighbouring points is convolved with a high-pass mask (one in
/// the middle, minus the mean of the neighbours); responses above the threshold end a cluster. In
/// each cluster the strongest Hough line is tracked along the beams, both ways, refitted as it
/// grows; the points before and after it are treated in the same way.
/// The paper's text was not at hand: the mask and all values here are ours, after its abstract and
/// after what others report of it.
/// @return  segments in the sensor frame, by bearing. Cost: O(cells) per line.
std::vector<LineSegment> convolutionClustering(const Scan& scan,
                                               const ConvolutionClusteringParameters& p = {});

}  // namespace cca::baselines
