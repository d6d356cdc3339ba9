// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "cca_mrpt/mapping/wall.hpp"

namespace cca {

/// The stretch of a wall's frame that the bins of a wall cover.
struct Extent {
  double first = 0.0, last = 0.0;  ///< m
  double length() const { return last - first; }
};

inline Extent extentOf(const Wall& wall) {
  return {wall.profile.first() * SupportProfile::kBinLength,
          wall.profile.last() * SupportProfile::kBinLength};
}

/// The same in another wall's frame.
inline Extent extentOf(const Wall& other, const Wall& frame) {
  const Extent e = extentOf(other);
  const double a = frame.toWall(other.toMap({e.first, 0.0})).x();
  const double b = frame.toWall(other.toMap({e.last, 0.0})).x();
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace cca
