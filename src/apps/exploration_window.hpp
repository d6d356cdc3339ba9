// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/gui/CDisplayWindow3D.h>

#include <chrono>

#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/navigation/explorer.hpp"
#include "cca_mrpt/simulation/simulation.hpp"

namespace cca::apps {

/// The run as it goes, in MRPT's 3-D window: map, way, robot, scan, movers and goal.
class ExplorationWindow {
 public:
  /// @throws std::runtime_error where there is no display.
  explicit ExplorationWindow(const World& world);

  /// Whether the last picture is old enough, and the window still open.
  bool isDue() const;
  void show(const MapProducts& products, const Simulation& simulation,
            const Observation& observation, const Action& action);

 private:
  mrpt::gui::CDisplayWindow3D::Ptr window_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace cca::apps
