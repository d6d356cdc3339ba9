// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/swept_cells.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace cca {
namespace {

int rowOf(double y) { return WallIndex::cellOf({0.0, y}).y(); }

}  // namespace

SweptCells::SweptCells(const Eigen::Vector2d& origin, double farthest)
    : origin_(origin), end_(origin), first_row_(rowOf(origin.y() - farthest) - 1) {
  const int rows = rowOf(origin.y() + farthest) + 2 - first_row_;
  const double inf = std::numeric_limits<double>::infinity();
  spans_.assign(static_cast<std::size_t>(rows), {inf, -inf});
}

void SweptCells::sweepTo(const Eigen::Vector2d& end) {
  edge(end_, end);
  end_ = end;
}

void SweptCells::breakOff() { sweepTo(origin_); }

void SweptCells::edge(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const auto widen = [](Span& span, double x) {
    span.first = std::min(span.first, x);
    span.last = std::max(span.last, x);
  };
  const bool upwards = from.y() <= to.y();
  const Eigen::Vector2d &low = upwards ? from : to, &high = upwards ? to : from;
  int row = rowOf(low.y());
  const int last = rowOf(high.y());
  widen(at(row), low.x());
  widen(at(last), high.x());
  if (row == last) return;
  const double x_per_y = (high.x() - low.x()) / (high.y() - low.y());
  for (; row < last; ++row) {
    const double border = low.x() + ((row + 1) * WallIndex::kCellSize - low.y()) * x_per_y;
    widen(at(row), border);
    widen(at(row + 1), border);
  }
}

}  // namespace cca
