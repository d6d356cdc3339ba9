// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "cca_mrpt/mapping/line_map.hpp"
#include "cca_mrpt/sensing/scan.hpp"
#include "cca_mrpt/simulation/body.hpp"
#include "io/replay/replay.hpp"

namespace cca {

struct MapProducts;

/// What there is to see of a run at one moment; valid during RunObserver::show() only.
struct RunView {
  const ReplayMoment& moment;
  const Scan& scan;  ///< at its T_map_sensor
  const LineMap& map;
  std::vector<Body> bodies;               ///< what moves about in a simulated world
  std::function<MapProducts()> products;  ///< of the map as it stands. Cost: that of the map
};

/// Who watches a run as it goes: a window, a page in browsers.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  /// Whether it wants to see more by now. Asked after each scan. Cost: none worth naming.
  virtual bool isDue() const = 0;
  /// Called where the map stands still.
  virtual void show(const RunView& view) = 0;
};

}  // namespace cca
