// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cca_mrpt/mapping/wall_index.hpp"

namespace cca {

/// The cells of the wall index that the rays of one scan cross, and some beside them: row by row,
/// from the first to the last that lies in the polygon of the rays' ends.
///
/// Cost: O(rays + rows), however many cells a ray crosses.
class SweptCells {
 public:
  /// @param farthest  m, no ray is longer.
  SweptCells(const Eigen::Vector2d& origin, double farthest);
  /// The next ray ends here. Two that follow one another sweep what lies between them, unless
  /// breakOff() is called in between.
  void sweepTo(const Eigen::Vector2d& end);
  /// The next ray is no neighbour of the last.
  void breakOff();

  /// Calls visit(cell) for each cell, each once.
  template <class Visit>
  void forEach(Visit&& visit) const {
    for (std::size_t row = 0; row < spans_.size(); ++row) {
      const Span& span = spans_[row];
      if (span.first > span.last) continue;
      const int y = first_row_ + static_cast<int>(row);
      const int last = WallIndex::cellOf({span.last, 0.0}).x();
      for (int x = WallIndex::cellOf({span.first, 0.0}).x(); x <= last; ++x) visit({x, y});
    }
  }

 private:
  struct Span {
    double first, last;  // m, x
  };
  void sweepTo(const Eigen::Vector2d& end, int row);
  void widen(int row, double x);
  /// Widens the rows by where the way from the last end to this one enters and leaves them.
  void crossRows(const Eigen::Vector2d& end, int end_row);

  Eigen::Vector2d origin_, end_;
  int first_row_, origin_row_, end_row_;
  std::vector<Span> spans_;
};

}  // namespace cca
