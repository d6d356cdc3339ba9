// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace cca {

/// The frames that a robot speaks of [REP-105].
struct FrameNames {
  std::string map = "map", odom = "odom", base = "base_link", laser = "laser";
};

}  // namespace cca
