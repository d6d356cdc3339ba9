// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/mapping/ablation.hpp"

namespace cca {

/// The three input parameters of the Consecutive Clustering Algorithm; all else is tuned from the
/// data (sensor noise, membership widths, gates, pose error).
struct CcaParameters {
  int points_per_cluster = 8;
  double similarity_cut = 0.5;
  int scans_per_batch = 1;
  Ablation without;  ///< for studies of what the parts are worth; no parameter
};

/// Calls field(name, value, lowest, highest, unit, meaning) for each parameter: the one description
/// that the .ini, the command line, --dump-config and the ROS parameters are made from.
template <class Field>
void describe(CcaParameters& p, Field&& field) {
  field("points_per_cluster", p.points_per_cluster, 2, 50, "points",
        "mean size of a K-means point cluster (K = points / points_per_cluster)");
  field("similarity_cut", p.similarity_cut, 0.01, 1.0, "",
        "two segments are alike where their similarity reaches this alpha-cut");
  field("scans_per_batch", p.scans_per_batch, 1, 100, "scans",
        "scans that are clustered together before they are merged into the map");
}

}  // namespace cca
