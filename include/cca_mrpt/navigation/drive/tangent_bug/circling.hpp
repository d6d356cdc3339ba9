// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cca {

/// The proof that a boundary has been circled.
///
/// It is closed where the walk along it stands again where it stood before, a whole turn later. The
/// winding is what tells a loop from the way back along the other side of a corridor; the length
/// tells it from standing still. Once around any closed curve the heading turns by 2 pi, either
/// way.
class Circling {
 public:
  /// @param p_map    m, on the boundary. @param length  m, walked along it.
  /// @param heading  rad, of the walk, unwrapped.
  void add(const Eigen::Vector2d& p_map, double length, double heading);
  void reset() { *this = {}; }

  bool closed() const { return closed_; }

 private:
  struct Place {
    Eigen::Vector2d p_map;
    double length, heading;
  };
  std::vector<Place> places_;
  double again_since_ = -1.0;  ///< m, where the walk came upon its own traces; below 0: it did not
  bool closed_ = false;
};

}  // namespace cca
