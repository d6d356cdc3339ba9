// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <utility>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"
#include "cca_mrpt/simulation/body.hpp"
#include "cca_mrpt/simulation/random.hpp"
#include "cca_mrpt/simulation/world.hpp"

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

/// The simulated laser: by default one that sees all in one instant and loses no beam.
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

/// Distance along one beam to the edge of the first obstacle cell, see walkBeam().
/// @param bearing    rad, map frame.
/// @param max_range  m.
/// @return           m; +inf where nothing is met up to max_range; 0 inside an obstacle.
double castBeam(const World& world, const Eigen::Vector2d& p_map, double bearing, double max_range);

/// Where the laser is, and what moves about, at a time.
struct LaserPlace {
  Pose2 T_map_sensor;
  const std::vector<Body>& bodies;
};

/// One sweep over the world and the bodies in it, each beam from where the laser is at its time; by
/// MRPT's caster all from the place of time 0. sweep_duration is that of a driver that does not
/// know the sense of its laser: without sign.
/// @param at  the place at a time [s] before or after the middle of the sweep.
Scan sweep(const World& world, const std::function<LaserPlace(double)>& at,
           const LaserParameters& parameters, Random& random);

/// One sweep at T_map_sensor over the world and the bodies in it.
///
/// Noise is added to returns only; what then exceeds the range is no return, what falls to zero or
/// below is invalid (NaN). Lost beams and those without return read what parameters.missing says. A
/// beam without return is free up to the range. Draws its random numbers beam by beam, so equal
/// streams give equal scans. With caster "mrpt" the bodies are not seen: MRPT's simulator knows its
/// grid alone.
Scan sweep(const World& world, const std::vector<Body>& bodies, const Pose2& T_map_sensor,
           const LaserParameters& parameters, Random& random);

}  // namespace cca
