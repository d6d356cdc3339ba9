// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/mapping/ablation.hpp"

namespace cca {

/// The three input parameters of the Consecutive Clustering Algorithm; all else is tuned from the
/// data (sensor noise, membership widths, gates, pose error). None of them sets a number of
/// clusters, a length of lines, a distance within a cluster or a least number of points.
struct CcaParameters {
  double similarity_cut = 0.5;
  /// nats: two coordinates of a wall of 20 m, each to 5 cm, are told in 2 ln 400 = 12 of them.
  double vertex_price = 12.0;
  /// m: plaster, skirting boards and what leans on a wall.
  double straightness = 0.035;
  Ablation without;  ///< for studies of what the parts are worth; no parameter
};

/// Calls field(name, value, lowest, highest, unit, meaning) for each parameter: the one description
/// that the .ini, the command line, --dump-config and the ROS parameters are made from.
template <class Field>
void describe(CcaParameters& p, Field&& field) {
  field("similarity_cut", p.similarity_cut, 0.01, 1.0, "",
        "two segments are alike where their similarity reaches this alpha-cut");
  field("vertex_price", p.vertex_price, 1.0, 100.0, "nats",
        "what a further vertex of a poly-line must explain: less tells finer detail");
  field("straightness", p.straightness, 0.0, 0.5, "m",
        "a wall is straight to this standard deviation: finer detail is no line's concern");
}

}  // namespace cca
