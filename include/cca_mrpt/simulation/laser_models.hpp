// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cca_mrpt/simulation/parameters.hpp"

namespace cca {

/// A laser that one can buy, as its data sheet has it. Beams are lost as they are in rooms: data
/// sheets do not tell that.
struct LaserModel {
  std::string name;
  LaserParameters laser;
  double rate;  ///< Hz
};

/// The default first: a laser all round at 10 Hz, as many small robots have it. "ideal" sees all in
/// one instant and loses no beam; it is LaserParameters{}.
const std::vector<LaserModel>& laserModels();

/// "ld19, ideal, rplidar_a1, ..."
std::string laserModelNames();

/// @throws std::runtime_error that lists the names.
const LaserModel& laserModel(const std::string& name);

}  // namespace cca
