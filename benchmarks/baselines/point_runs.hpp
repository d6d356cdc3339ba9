// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "cca_mrpt/geometry/line_segment.hpp"
#include "cca_mrpt/sensing/scan.hpp"

/// What the extractors share that use the order of the beams: runs of neighbouring returns.
namespace cca::baselines {

using Points = std::vector<Eigen::Vector2d>;

/// Neighbouring points [first, last) of a list.
struct Run {
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t size() const { return last - first; }
};

/// Where one surface ends and the next begins.
struct BreakPoints {
  double max_gap = 0.2;       ///< m, distance of neighbours beyond what the beam spacing explains
  double grazing_deg = 20.0;  ///< deg, incidence down to which the spacing is explained
};

/// What is too short to be reported.
struct SegmentLimits {
  int min_points = 7;
  double min_length = 0.5;  ///< m
};

/// The parameters that nearly every extractor has in common.
struct CommonParameters {
  BreakPoints break_points;
  SegmentLimits limits;
};

/// See cca::describe(CcaParameters&, ...).
template <class Field>
void describe(CommonParameters& p, Field&& field) {
  field("max_gap", p.break_points.max_gap, 0.03, 1.0, "m",
        "largest gap inside a line, beyond what the beam spacing explains");
  field("grazing_deg", p.break_points.grazing_deg, 3.0, 90.0, "deg",
        "incidence down to which the beam spacing is explained");
  field("min_points", p.limits.min_points, 2, 15, "points", "fewest points of a segment");
  field("min_length", p.limits.min_length, 0.05, 1.0, "m", "shortest segment");
}

/// The returns of a scan, sensor frame, by beam.
Points returnedPoints(const Scan& scan);

/// Cuts between neighbours that are farther apart than
/// max_gap + r sin(dphi) / sin(grazing - dphi), the adaptive break point [Borges & Aldon 2004].
/// @param beam_spacing  rad, between neighbouring beams.
std::vector<Run> contiguousRuns(const Points& points, double beam_spacing, const BreakPoints& rule);

PointMoments momentsOf(const Points& points, Run run);
double distanceFrom(const FittedLine& line, const Eigen::Vector2d& point);

/// The point of the run's inside that is farthest from the chord between the run's ends.
/// @param run  of three points or more.
std::size_t farthestFromChord(const Points& points, Run run);

/// Total-least-squares segment; its ends are the projections of the extreme points; its covariance
/// comes from the residuals (zero for two points).
/// @param run  of two points or more.
LineSegment segmentThrough(const Points& points, Run run);
LineSegment segmentThrough(const Points& points);

bool isLongEnough(const LineSegment& segment, std::size_t points, const SegmentLimits& limits);

/// Joins neighbouring runs, first to last, while the joint line keeps all points within tolerance
/// and the runs' facing ends lie no farther apart than a break point allows.
std::vector<Run> mergeCollinear(const Points& points, const std::vector<Run>& runs,
                                double tolerance, double beam_spacing, const BreakPoints& rule);

/// The segments of all runs that are long enough.
std::vector<LineSegment> segmentsOf(const Points& points, const std::vector<Run>& runs,
                                    const SegmentLimits& limits);

}  // namespace cca::baselines
