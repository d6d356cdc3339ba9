// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "cca_mrpt/simulation/building.hpp"
#include "simulation/random.hpp"

namespace cca {

using Box = Eigen::AlignedBox2d;

/// m, free between pieces of furniture, and in front of doors: a robot of 0.25 m radius passes.
constexpr double kPassage = 0.9;

/// A rectangular room between the inner faces of its walls, and what must stay free in it.
struct Room {
  Box floor;               ///< m
  std::vector<Box> doors;  ///< m, the openings themselves
};

/// Sets up to `count` pieces against the walls (desks, shelves, cupboards) and free-standing ones
/// (tables, round tables, pillars), wherever kPassage stays free around them.
void furnish(Building& plan, const Room& room, int count, Random& random);

/// Sets `count` pieces (cupboards against the walls, chairs and tables on legs, boxes) anywhere but
/// in `kept_free`: they may overlap and shut ways.
void clutter(Building& plan, const Box& floor, const Box& kept_free, int count, Random& random);

/// The value on the 5 cm raster that the worlds are made for.
double onRaster(double value);

}  // namespace cca
