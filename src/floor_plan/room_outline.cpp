// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan/room_outline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "geometry/cross.hpp"

namespace cca {
namespace {

constexpr int kNone = -1;  // no edge: these are counted from 0
constexpr double kSeenFrom =
    0.3;  // cosine; a side of a cell on a slanted line looks aside by 45 degrees
constexpr double kParallel = 0.2;  // sine of the angle below which two lines do not meet

struct Edge {
  Eigen::Vector2d start, direction;  // start to end, unit
  double length = 0.0;
  bool is_opening = false;
};

std::vector<Edge> edgesOf(const std::vector<MapLine>& lines, const std::vector<Passage>& openings) {
  std::vector<Edge> edges;
  for (const MapLine& line : lines)
    edges.push_back({line.segment.start, line.segment.direction(), line.segment.length(), false});
  for (const Passage& opening : openings) {
    if (opening.width() <= 0.0) continue;
    edges.push_back({opening.a, (opening.b - opening.a).normalized(), opening.width(), true});
  }
  return edges;
}

/// A piece of the chain that stands for one edge, or for none.
struct Run {
  int edge = kNone;
  std::size_t first = 0, last = 0;  // sides of the chain, both included; last may pass the end
};

/// Which edges are near each cell of the border: all of them are asked for each side otherwise.
class EdgeIndex {
 public:
  EdgeIndex(const std::vector<Edge>& edges, double reach) : bucket_(std::max(reach, 0.5)) {
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Edge& e = edges[k];
      const int pieces = 1 + static_cast<int>(e.length / (0.5 * bucket_));
      for (int i = 0; i <= pieces; ++i) add(e.start + e.length * i / pieces * e.direction, k);
    }
  }
  const std::vector<std::size_t>& near(const Eigen::Vector2d& p) const {
    const auto found = edges_.find(key(cellAt(p / bucket_)));
    return found == edges_.end() ? none_ : found->second;
  }

 private:
  static long key(Cell c) { return static_cast<long>(c.x) * 4194304L + c.y; }
  void add(const Eigen::Vector2d& p, std::size_t edge) {
    const Cell c = cellAt(p / bucket_);
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        auto& list = edges_[key(c + Cell{x, y})];
        if (list.empty() || list.back() != edge) list.push_back(edge);
      }
    }
  }
  double bucket_;
  std::unordered_map<long, std::vector<std::size_t>> edges_;
  std::vector<std::size_t> none_;
};

/// The edge that a side of a cell stands for: from p, with the room in direction `inwards`.
int nearestEdge(const std::vector<Edge>& edges, const EdgeIndex& index, const Eigen::Vector2d& p,
                const Eigen::Vector2d& inwards, double snap) {
  int best = kNone;
  double least = snap;
  for (const std::size_t k : index.near(p)) {
    const Edge& e = edges[k];
    const Eigen::Vector2d off = p - e.start;
    const double along = off.dot(e.direction);
    const double beyond = std::max({0.0, -along, along - e.length});
    if (beyond > snap) continue;
    const Eigen::Vector2d normal(-e.direction.y(), e.direction.x());
    const double facing = normal.dot(inwards);
    if (e.is_opening ? std::abs(facing) < kSeenFrom : facing < kSeenFrom) continue;
    const double distance = std::hypot(beyond, cross(e.direction, off));
    if (distance >= least) continue;
    least = distance;
    best = static_cast<int>(k);
  }
  return best;
}

std::vector<Run> runsOf(const std::vector<int>& edge_of) {
  std::vector<Run> runs;
  for (std::size_t k = 0; k < edge_of.size(); ++k) {
    if (runs.empty() || runs.back().edge != edge_of[k]) runs.push_back({edge_of[k], k, k});
    runs.back().last = k;
  }
  if (runs.size() > 1 && runs.front().edge == runs.back().edge) {
    runs.back().last = runs.front().last + edge_of.size();
    runs.erase(runs.begin());
  }
  return runs;
}

/// Douglas-Peucker between two corners of a chain, the first and last of which stay.
void straighten(const Polygon& chain, std::size_t first, std::size_t last, double tolerance,
                std::vector<std::size_t>& kept) {
  const auto at = [&](std::size_t k) -> const Eigen::Vector2d& { return chain[k % chain.size()]; };
  const Eigen::Vector2d way = at(last) - at(first);
  const double length = way.norm();
  double farthest = tolerance;
  std::size_t split = first;
  for (std::size_t k = first + 1; k < last; ++k) {
    const Eigen::Vector2d off = at(k) - at(first);
    const double distance = length > 0.0 ? std::abs(cross(way, off)) / length : off.norm();
    if (distance <= farthest) continue;
    farthest = distance;
    split = k;
  }
  if (split == first) return;
  straighten(chain, first, split, tolerance, kept);
  kept.push_back(split);
  straighten(chain, split, last, tolerance, kept);
}

/// Draws runs one after the other.
class OutlineDrawing {
 public:
  OutlineDrawing(const Raster<int>& labels, const Polygon& chain, const std::vector<Edge>& edges,
                 const OutlineTuning& tuning)
      : labels_(labels), chain_(chain), edges_(edges), tuning_(tuning) {}

  Polygon draw(const std::vector<Run>& runs) {
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const Run &run = runs[k], &next = runs[(k + 1) % runs.size()];
      if (run.edge == kNone) {
        drawCells(run);
      } else if (next.edge != kNone) {
        drawCorner(run, next);
      } else {
        add(foot(run.edge, run.last + 1));
      }
      if (run.edge == kNone && next.edge != kNone) add(foot(next.edge, next.first));
    }
    return drawn_;
  }

 private:
  Eigen::Vector2d at(std::size_t k) const { return labels_.inMetres(chain_[k % chain_.size()]); }
  void add(const Eigen::Vector2d& p) {
    if (drawn_.empty() || (p - drawn_.back()).norm() > 1e-6) drawn_.push_back(p);
  }
  /// A corner of the chain, moved onto an edge.
  Eigen::Vector2d foot(int edge, std::size_t k) const {
    const Edge& e = edges_[static_cast<std::size_t>(edge)];
    return e.start + (at(k) - e.start).dot(e.direction) * e.direction;
  }
  void drawCells(const Run& run) {
    std::vector<std::size_t> kept{run.first};
    straighten(chain_, run.first, run.last + 1, tuning_.tolerance / labels_.resolution, kept);
    kept.push_back(run.last + 1);
    for (const std::size_t k : kept) add(at(k));
  }
  void drawCorner(const Run& run, const Run& next) {
    const Edge& a = edges_[static_cast<std::size_t>(run.edge)];
    const Edge& b = edges_[static_cast<std::size_t>(next.edge)];
    const double sine = cross(a.direction, b.direction);
    const Eigen::Vector2d end = at(run.last + 1), begin = at(next.first);
    if (std::abs(sine) > kParallel) {
      const Eigen::Vector2d meet =
          a.start + cross(b.start - a.start, b.direction) / sine * a.direction;
      if (std::min((meet - end).norm(), (meet - begin).norm()) < tuning_.bridge) {
        add(meet);
        return;
      }
    }
    add(foot(run.edge, run.last + 1));
    add(foot(next.edge, next.first));
  }

  const Raster<int>& labels_;
  const Polygon& chain_;
  const std::vector<Edge>& edges_;
  const OutlineTuning& tuning_;
  Polygon drawn_;
};

/// One line on both sides of what was left out is one run.
std::vector<Run> joinedRuns(const std::vector<Run>& runs) {
  std::vector<Run> joined;
  for (const Run& run : runs) {
    if (!joined.empty() && run.edge != kNone && joined.back().edge == run.edge) {
      joined.back().last = run.last;
    } else {
      joined.push_back(run);
    }
  }
  if (joined.size() > 1 && joined.front().edge == joined.back().edge &&
      joined.front().edge != kNone) {
    joined.front().first = joined.back().first;
    joined.pop_back();
  }
  return joined;
}

/// Runs without short gaps between runs of edges.
std::vector<Run> cleaned(const std::vector<int>& edge_of, const Polygon& chain, double resolution,
                         const OutlineTuning& tuning) {
  const auto length = [&](const Run& run) {
    return resolution * static_cast<double>(run.last - run.first + 1);
  };
  const std::vector<Run> runs = runsOf(edge_of);
  if (runs.size() < 3) return runs;
  std::vector<Run> kept;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Run& run = runs[k];
    const Run &before = runs[(k + runs.size() - 1) % runs.size()],
              &after = runs[(k + 1) % runs.size()];
    const double chord =
        resolution *
        (chain[(run.last + 1) % chain.size()] - chain[run.first % chain.size()]).norm();
    const bool is_notch = before.edge != kNone && before.edge == after.edge && chord < tuning.notch;
    if (run.edge != kNone || (length(run) >= tuning.bridge && !is_notch)) kept.push_back(run);
  }
  return joinedRuns(kept);
}

}  // namespace

Polygon straightened(const Raster<int>& labels, const Polygon& chain, double tolerance) {
  if (chain.empty()) return {};
  std::size_t far = 0;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    if ((chain[k] - chain[0]).squaredNorm() > (chain[far] - chain[0]).squaredNorm()) far = k;
  }
  std::vector<std::size_t> kept{0};
  straighten(chain, 0, far, tolerance / labels.resolution, kept);
  kept.push_back(far);
  straighten(chain, far, chain.size(), tolerance / labels.resolution, kept);
  Polygon polygon;
  for (const std::size_t k : kept) polygon.push_back(labels.inMetres(chain[k]));
  return polygon;
}

Polygon outlineAlongLines(const Raster<int>& labels, const Polygon& chain,
                          const std::vector<MapLine>& lines, const std::vector<Passage>& openings,
                          const OutlineTuning& tuning) {
  const std::vector<Edge> edges = edgesOf(lines, openings);
  const EdgeIndex index(edges, tuning.snap);
  std::vector<int> edge_of;
  for (std::size_t k = 0; k < chain.size(); ++k) {
    const Eigen::Vector2d side = chain[(k + 1) % chain.size()] - chain[k];
    const Eigen::Vector2d middle = labels.inMetres(chain[k] + 0.5 * side);
    edge_of.push_back(nearestEdge(edges, index, middle, {-side.y(), side.x()}, tuning.snap));
  }
  const std::vector<Run> runs = cleaned(edge_of, chain, labels.resolution, tuning);
  if (runs.size() < 3) return straightened(labels, chain, tuning.tolerance);
  return OutlineDrawing(labels, chain, edges, tuning).draw(runs);
}

}  // namespace cca
