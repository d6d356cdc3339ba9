// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/freed_places.hpp"

#include <cmath>

namespace cca {
namespace {

constexpr double kCell = 0.3;  // m, a chair's leg and its next place

}  // namespace

std::int64_t FreedPlaces::cellOf(const Eigen::Vector2d& p_map) {
  const auto x = static_cast<std::int64_t>(std::floor(p_map.x() / kCell));
  const auto y = static_cast<std::int64_t>(std::floor(p_map.y() / kCell));
  return x * (std::int64_t{1} << 32) + y;
}

}  // namespace cca
