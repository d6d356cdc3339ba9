// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace cca {

/// How a simulated exploration is run.
struct RunParameters {
  int seed = 1;
  std::string pose = "slam";
  double control_period = 0.1;
  double longest_time = 14400.0;
};

/// See describe(CcaParameters&, ...).
template <class Field>
void describe(RunParameters& p, Field&& field) {
  field("seed", p.seed, 0, 2147483647, "", "of all that is random: same seed, same run");
  field("pose", p.pose, {"slam", "truth", "odometry", "icp"},
        "where the robot takes its pose from");
  field("control_period", p.control_period, 0.01, 1.0, "s", "between two scans and decisions");
  field("longest_time", p.longest_time, 1.0, 1e6, "s", "simulated time after which a run fails");
}

}  // namespace cca
