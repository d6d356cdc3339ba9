// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "cca_mrpt/motion/robot.hpp"

namespace cca {

/// How beams are traced.
enum class Caster {
  kExact,  ///< exact cell edges, see walkBeam()
  kMrpt,   ///< MRPT's simulator, which sees 80 % of the range and no bodies
};

/// As options and files name them.
inline constexpr std::pair<const char*, Caster> kCasterNames[] = {{"exact", Caster::kExact},
                                                                  {"mrpt", Caster::kMrpt}};

/// What a beam reads that got no answer, or was lost.
enum class MissingReading {
  kTold,      ///< +inf where nothing is in reach, NaN where the beam was lost: what no driver knows
  kInfinity,  ///< +inf for both
  kZero,      ///< 0 for both
  kRangeMax,  ///< the laser's range for both
};

/// As options and files name them.
inline constexpr std::pair<const char*, MissingReading> kMissingReadingNames[] = {
    {"told", MissingReading::kTold},
    {"inf", MissingReading::kInfinity},
    {"zero", MissingReading::kZero},
    {"range_max", MissingReading::kRangeMax}};

/// The simulated laser: one that sees all in one instant and loses no beam, unless told otherwise.
struct LaserParameters {
  double range = 8.0;
  double field_of_view_deg = 360.0;
  int beams = 361;
  double range_noise = 0.01;
  double angle_noise_deg = 0.0;
  double range_noise_share = 0.0;
  double dropout = 0.0;
  MissingReading missing = MissingReading::kTold;
  double sweep = 0.0;
  Caster caster = Caster::kExact;
};

/// See describe(CcaParameters&, ...).
template <class Field>
void describe(LaserParameters& p, Field&& field) {
  field("range", p.range, 0.1, 200.0, "m", "longest range that gives a return");
  field("field_of_view_deg", p.field_of_view_deg, 1.0, 360.0, "deg", "from first to last beam");
  field("beams", p.beams, 1, 100000, "", "number of beams");
  field("range_noise", p.range_noise, 0.0, 10.0, "m", "standard deviation of a range");
  field("angle_noise_deg", p.angle_noise_deg, 0.0, 10.0, "deg",
        "standard deviation of a beam's direction");
  field("range_noise_share", p.range_noise_share, 0.0, 1.0, "",
        "standard deviation that is added, as a share of the range");
  field("dropout", p.dropout, 0.0, 1.0, "", "share of beams that are lost");
  field("missing", p.missing, kMissingReadingNames,
        "what beams read that met nothing or were lost: told (+inf and NaN), inf, zero, range_max");
  field("sweep", p.sweep, -1.0, 1.0, "s",
        "from first to last beam, each cast from where the laser is by then; negative: clockwise, "
        "the last beam first, which the driver does not tell");
  field("caster", p.caster, kCasterNames,
        "how beams are traced: exact cell edges, or MRPT's simulator (sees 80 % of the range)");
}

/// How wheel odometry errs: variances grow with the way driven and the angle turned, whatever the
/// step [Thrun, Burgard & Fox 2005, ch. 5.4].
struct OdometryParameters {
  double distance_noise = 0.02;
  double turn_noise_deg = 2.0;
  double drift_noise_deg = 1.0;
};

/// See describe(CcaParameters&, ...).
template <class Field>
void describe(OdometryParameters& p, Field&& field) {
  field("distance_noise", p.distance_noise, 0.0, 1.0, "m", "error of distance after 1 m, sigma");
  field("turn_noise_deg", p.turn_noise_deg, 0.0, 90.0, "deg",
        "error of heading after a turn of 1 rad, sigma");
  field("drift_noise_deg", p.drift_noise_deg, 0.0, 90.0, "deg",
        "error of heading after 1 m of way, sigma");
}

struct SimulationParameters {
  RobotParameters robot;  ///< as it is, whatever the planner is told of it
  LaserParameters laser;
  OdometryParameters odometry;
  std::uint64_t seed = 1;
};

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
