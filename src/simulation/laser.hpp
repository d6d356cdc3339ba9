// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "cca_mrpt/sensing/scan.hpp"
#include "cca_mrpt/simulation/body.hpp"
#include "cca_mrpt/simulation/parameters.hpp"
#include "cca_mrpt/simulation/world.hpp"
#include "simulation/random.hpp"

namespace cca {

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
