// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/simulation/coverage.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "simulation/beam.hpp"

namespace cca {

namespace {

constexpr int kBeams = 361;       // first and last coincide
constexpr double kSpacing = 0.2;  // m, of the lattice of places
constexpr int kStartReach = 20;   // cells around the start in which its free cell is looked for
constexpr double kGolden = 0.6180339887;

using Cells = std::vector<unsigned char>;

template <class Visit>
void lookAround(const World& world, const Pose2& T_map_sensor, double max_range, Visit&& visit) {
  for (int beam = 0; beam < kBeams; ++beam) {
    const double bearing = T_map_sensor.theta - M_PI + 2.0 * M_PI * beam / (kBeams - 1);
    walkBeam(world, T_map_sensor.position(), bearing, max_range, visit);
  }
}

/// Cells in which a disc stands free wherever in the cell its centre is.
Cells standable(const World& world, double radius, const std::atomic<bool>& given_up) {
  const double reach = radius / world.resolution();
  const int n = static_cast<int>(std::ceil(reach)) + 1;
  std::vector<std::pair<int, int>> disc;
  for (int dy = -n; dy <= n; ++dy) {
    for (int dx = -n; dx <= n; ++dx) {
      const double gap = std::hypot(std::max(std::abs(dx) - 1, 0), std::max(std::abs(dy) - 1, 0));
      if (gap < reach - 1e-9) disc.emplace_back(dx, dy);
    }
  }
  Cells free(world.obstacles().size(), 1);
  for (int iy = 0; iy < world.height() && !given_up; ++iy) {
    for (int ix = 0; ix < world.width(); ++ix) {
      if (!world.isObstacle(ix, iy)) continue;
      const bool buried = world.isObstacle(ix - 1, iy) && world.isObstacle(ix + 1, iy) &&
                          world.isObstacle(ix, iy - 1) && world.isObstacle(ix, iy + 1);
      free[iy * world.width() + ix] = 0;
      if (buried) continue;  // its neighbours grow farther
      for (const auto& [dx, dy] : disc) {
        const int x = ix + dx, y = iy + dy;
        if (x >= 0 && y >= 0 && x < world.width() && y < world.height()) {
          free[y * world.width() + x] = 0;
        }
      }
    }
  }
  return free;
}

/// The set cell nearest to a point, or -1.
int nearestCell(const Cells& set, const World& world, const Eigen::Vector2d& p) {
  const int x0 = static_cast<int>(p.x()), y0 = static_cast<int>(p.y());
  int best = -1;
  double best_sq = 0.0;
  for (int iy = std::max(0, y0 - kStartReach); iy <= std::min(world.height() - 1, y0 + kStartReach);
       ++iy) {
    for (int ix = std::max(0, x0 - kStartReach);
         ix <= std::min(world.width() - 1, x0 + kStartReach); ++ix) {
      const double gap_sq = (Eigen::Vector2d(ix + 0.5, iy + 0.5) - p).squaredNorm();
      if (!set[iy * world.width() + ix] || (best >= 0 && gap_sq >= best_sq)) continue;
      best = iy * world.width() + ix;
      best_sq = gap_sq;
    }
  }
  return best;
}

/// The 4-connected part of a set that holds a cell. The set holds no outermost cell.
Cells component(const Cells& set, int width, int first, const std::atomic<bool>& given_up) {
  Cells reached(set.size(), 0);
  std::vector<int> open;
  const auto take = [&](int cell) {
    if (!set[cell] || reached[cell]) return;
    reached[cell] = 1;
    open.push_back(cell);
  };
  if (first >= 0) take(first);
  while (!open.empty() && !given_up) {
    const int cell = open.back();
    open.pop_back();
    for (int next : {cell - 1, cell + 1, cell - width, cell + width}) take(next);
  }
  return reached;
}

}  // namespace

std::vector<unsigned char> visibleCells(const World& world, const Eigen::Vector2d& start,
                                        double radius, double max_range,
                                        const std::atomic<bool>& given_up) {
  const Cells free = standable(world, radius, given_up);
  const Cells reach =
      component(free, world.width(), nearestCell(free, world, world.toCells(start)), given_up);
  Cells visible(free.size(), 0);
  const int step = std::max(1, static_cast<int>(std::lround(kSpacing / world.resolution())));
  int places = 0;
  for (int iy = 0; iy < world.height(); iy += step) {
    for (int ix = 0; ix < world.width(); ix += step) {
      if (!reach[iy * world.width() + ix] || given_up) continue;
      const Eigen::Vector2d p =
          world.origin() + world.resolution() * Eigen::Vector2d(ix + 0.5, iy + 0.5);
      const double turn = std::fmod(kGolden * places++, 1.0) * 2.0 * M_PI / (kBeams - 1);
      lookAround(world, {p.x(), p.y(), turn}, max_range,
                 [&visible](int cell) { visible[cell] = 1; });
    }
  }
  return visible;
}

double shareReached(const World& world, const Eigen::Vector2d& start, double radius) {
  const Cells free = standable(world, radius, false);
  const int first = nearestCell(free, world, world.toCells(start));
  const Cells reached = component(free, world.width(), first, false);
  const auto all = std::count(free.begin(), free.end(), 1);
  const auto some = std::count(reached.begin(), reached.end(), 1);
  return all > 0 ? static_cast<double>(some) / static_cast<double>(all) : 0.0;
}

Coverage::Coverage(const World& world, const Eigen::Vector2d& start, double radius,
                   double max_range)
    : world_(world),
      max_range_(max_range),
      pending_(std::async(std::launch::async,
                          [this, start, radius] {
                            return visibleCells(world_, start, radius, max_range_, given_up_);
                          })),
      seen_(world.obstacles().size(), 0) {}

Coverage::~Coverage() { given_up_ = true; }  // and the future waits for its thread

void Coverage::giveUp() {
  if (sofar()) return;
  given_up_ = true;
  pending_ = {};  // waits for the thread, which looks at the word every few milliseconds
}

void Coverage::look(const Pose2& T_map_sensor) {
  lookAround(world_, T_map_sensor, max_range_, [this](int cell) {
    if (seen_[cell]) return;
    seen_[cell] = 1;
    seen_order_.push_back(cell);
  });
  seen_at_look_.push_back(seen_order_.size());
}

void Coverage::learnVisible() {
  if (!pending_.valid()) return;
  visible_ = pending_.get();
  visible_count_ = static_cast<std::size_t>(std::count(visible_.begin(), visible_.end(), 1));
}

std::vector<double> Coverage::curve() {
  learnVisible();
  if (given_up_) return {};
  std::vector<double> shares;
  std::size_t seen = 0, next = 0;
  for (std::size_t up_to : seen_at_look_) {
    for (; next < up_to; ++next) seen += visible_[seen_order_[next]];
    shares.push_back(visible_count_ ? static_cast<double>(seen) / visible_count_ : 0.0);
  }
  return shares;
}

std::optional<double> Coverage::sofar() {
  if (given_up_) return {};
  if (pending_.valid()) {
    if (pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
    learnVisible();
  }
  for (; counted_ < seen_order_.size(); ++counted_)
    seen_visible_ += visible_[seen_order_[counted_]];
  return visible_count_ ? static_cast<double>(seen_visible_) / visible_count_ : 0.0;
}

}  // namespace cca
