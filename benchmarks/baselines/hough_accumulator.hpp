// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "cca_mrpt/geometry/line_segment.hpp"

namespace cca::baselines {

/// The resolution of a Hough accumulator. [Nguyen et al. 2007] take 0.9 deg and 1 cm.
struct HoughResolution {
  double angle_deg = 0.9;
  double distance = 0.01;  ///< m
};

template <class Field>
void describe(HoughResolution& p, Field&& field) {
  field("angle_step_deg", p.angle_deg, 0.25, 5.0, "deg", "angle of an accumulator cell");
  field("distance_step", p.distance, 0.005, 0.2, "m", "distance of an accumulator cell");
}

/// Votes of points for lines x cos(alpha) + y sin(alpha) = r, alpha in [0, pi), r in [-R, R].
class HoughAccumulator {
 public:
  /// @param reach  m, largest norm of a point that will vote.
  HoughAccumulator(const HoughResolution& resolution, double reach);

  /// Adds (or, with weight -1, takes back) the votes of a point. Cost: one cell per angle.
  void vote(const Eigen::Vector2d& point, int weight);

  struct Peak {
    FittedLine line;
    int votes = 0;
  };
  /// The cell with most votes, the first of equals. Cost: all cells.
  Peak strongest() const;

 private:
  double distance_step_, reach_;
  Eigen::ArrayXd cosines_, sines_;
  Eigen::Array<short, Eigen::Dynamic, Eigen::Dynamic> votes_;  ///< distances x angles
};

}  // namespace cca::baselines
