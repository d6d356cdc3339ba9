// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/swept_cells.hpp"

#include <algorithm>
#include <limits>

namespace cca {
namespace {

int rowOf(double y) { return WallIndex::cellOf({0.0, y}).y(); }

}  // namespace

SweptCells::SweptCells(const Eigen::Vector2d& origin, double farthest)
    : origin_(origin),
      end_(origin),
      first_row_(rowOf(origin.y() - farthest) - 1),
      origin_row_(rowOf(origin.y())),
      end_row_(origin_row_) {
  const int rows = rowOf(origin.y() + farthest) + 2 - first_row_;
  const double inf = std::numeric_limits<double>::infinity();
  spans_.assign(static_cast<std::size_t>(rows), {inf, -inf});
  widen(origin_row_, origin.x());
}

void SweptCells::sweepTo(const Eigen::Vector2d& end) { sweepTo(end, rowOf(end.y())); }

void SweptCells::breakOff() { sweepTo(origin_, origin_row_); }

void SweptCells::sweepTo(const Eigen::Vector2d& end, int row) {
  if (row != end_row_) crossRows(end, row);
  widen(row, end.x());
  end_ = end;
  end_row_ = row;
}

void SweptCells::widen(int row, double x) {
  Span& span = spans_[static_cast<std::size_t>(row - first_row_)];
  span.first = std::min(span.first, x);
  span.last = std::max(span.last, x);
}

void SweptCells::crossRows(const Eigen::Vector2d& end, int end_row) {
  const bool upwards = end_row_ < end_row;
  const Eigen::Vector2d &low = upwards ? end_ : end, &high = upwards ? end : end_;
  const double x_per_y = (high.x() - low.x()) / (high.y() - low.y());
  const int last = upwards ? end_row : end_row_;
  for (int row = upwards ? end_row_ : end_row; row < last; ++row) {
    const double border = low.x() + ((row + 1) * WallIndex::kCellSize - low.y()) * x_per_y;
    widen(row, border);
    widen(row + 1, border);
  }
}

}  // namespace cca
