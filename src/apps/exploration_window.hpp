// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/navigation/explorer.hpp"
#include "cca_mrpt/simulation/simulation.hpp"

namespace cca::apps {

/// The run as it goes, in MRPT's 3-D window: map, way, robot, scan, movers and goal.
class ExplorationWindow {
 public:
  virtual ~ExplorationWindow() = default;
  /// Whether the last picture is old enough, and the window still open.
  virtual bool isDue() const = 0;
  virtual void show(const MapProducts& products, const Simulation& simulation,
                    const Observation& observation, const Action& action) = 0;
};

/// Opens one; behind lateFunction(). @throws std::runtime_error where there is no display.
using OpenExplorationWindow = ExplorationWindow*(const World&);
constexpr const char* kWindowLibrary = "libcca_window.so";
constexpr const char* kOpenExplorationWindow = "openExplorationWindow";

}  // namespace cca::apps
