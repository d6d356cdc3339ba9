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

/// "ideal" first: the default, which sees all in one instant, loses no beam and comes at 10 Hz.
const std::vector<LaserModel>& laserModels();

/// "ideal, rplidar_a1, ..."
std::string laserModelNames();

/// @throws std::runtime_error that lists the names.
const LaserModel& laserModel(const std::string& name);

}  // namespace cca
