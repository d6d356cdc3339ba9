// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/simulation/simulation.hpp"
#include "live/run_observer.hpp"

namespace cca::apps {

/// Opens a window of MRPT's that shows a run in three dimensions: map, robot, scan, movers and
/// goal; behind lateFunction(). @throws std::runtime_error where there is no display.
using OpenRunWindow = RunObserver*(const World&, double robot_radius);
constexpr const char* kWindowLibrary = "libcca_window.so";
constexpr const char* kOpenRunWindow = "openRunWindow";

}  // namespace cca::apps
