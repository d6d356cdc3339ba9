// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
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

/// The simulated laser.
struct LaserParameters {
  double range = 8.0;
  double field_of_view_deg = 360.0;
  int beams = 361;
  double range_noise = 0.01;
  double angle_noise_deg = 0.0;
  double dropout = 0.0;
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
  field("dropout", p.dropout, 0.0, 1.0, "", "share of beams that give an invalid reading");
  field("caster", p.caster, kCasterNames,
        "how beams are traced: exact cell edges, or MRPT's simulator (sees 80 % of the range)");
}

/// Distance along one beam to the edge of the first obstacle cell, see walkBeam().
/// @param bearing    rad, map frame.
/// @param max_range  m.
/// @return           m; +inf where nothing is met up to max_range; 0 inside an obstacle.
double castBeam(const World& world, const Eigen::Vector2d& p_map, double bearing, double max_range);

/// One sweep at T_map_sensor over the world and the bodies in it.
///
/// Noise is added to returns only; what then exceeds the range is no return, what falls to zero or
/// below is invalid (NaN), as is a beam that drops out. A beam without return is free up to the
/// range. Draws its random numbers beam by beam, so equal streams give equal scans.
/// With caster "mrpt" the bodies are not seen: MRPT's simulator knows its grid alone.
Scan sweep(const World& world, const std::vector<Body>& bodies, const Pose2& T_map_sensor,
           const LaserParameters& parameters, Random& random);

}  // namespace cca
