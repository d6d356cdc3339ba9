// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan/room_regions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "floor_plan/components.hpp"
#include "geometry/median.hpp"

namespace cca {
namespace {

// Excess, just above 1: a niche joins after all that is too wide.
constexpr double kNiche = 1.001;

constexpr double kNearest = 0.35,
                 kFarthest = 1.0;  // m from a passage: past the wall, before the next
constexpr double kThrough = 0.25;  // m to both sides of a passage, that a way leads through
constexpr double kWidest = 8.0;    // m to each side; wider is wide

/// Cells from wall to wall, with one more at each end.
std::vector<Cell> cutCells(const Mask& space, const Passage& passage) {
  const Eigen::Vector2d beyond = 1.5 * space.resolution * (passage.b - passage.a).normalized();
  return cellsAlong(space, passage.a - beyond, passage.b + beyond);
}

/// Space with all passages closed, and without what is too narrow to pass.
Mask cutSpace(const Mask& space, const Raster<float>& clearance,
              const std::vector<Passage>& passages, double least_clearance) {
  Mask parted = space;
  for (std::size_t k = 0; k < parted.values.size(); ++k) {
    if (clearance.values[k] < least_clearance) parted.values[k] = 0;
  }
  for (const Passage& passage : passages) {
    for (const Cell c : cutCells(space, passage)) parted[c] = 0;
  }
  return parted;
}

/// Gives each cell of the space that has no label that of its next neighbour, step by step.
void growLabels(const Mask& space, Raster<int>& labels) {
  std::vector<std::size_t> front, next;
  for (std::size_t k = 0; k < space.values.size(); ++k) {
    if (labels.values[k] >= 0) front.push_back(k);
  }
  while (!front.empty()) {
    next.clear();
    for (const std::size_t k : front) {
      const Cell c = labels.cell(k);
      for (int side = 0; side < 4; ++side) {
        const Cell beside = c + kNeighbours[static_cast<std::size_t>(side)];
        if (!space.at(beside, 0) || labels[beside] >= 0) continue;
        labels[beside] = labels.values[k];
        next.push_back(labels.index(beside));
      }
    }
    front.swap(next);
  }
}

/// The labels on both sides of a passage: those most often seen some cells off its line.
std::array<int, 2> sidesOf(const Raster<int>& labels, const Passage& passage) {
  const Eigen::Vector2d way = passage.b - passage.a;
  const Eigen::Vector2d across =
      labels.resolution * Eigen::Vector2d(-way.y(), way.x()).normalized();
  std::array<int, 2> sides{-1, -1};
  for (int side = 0; side < 2; ++side) {
    std::map<int, int> seen;
    for (double t = 0.1; t < 0.95; t += 0.1) {
      for (const double off : {1.5, 2.5}) {
        const Eigen::Vector2d p = passage.a + t * way + (side ? off : -off) * across;
        const int label = labels.at(labels.cellOf(p), -1);
        if (label >= 0) ++seen[label];
      }
    }
    int most = 0;
    for (const auto& [label, times] : seen) {
      if (times <= most) continue;
      most = times;
      sides[static_cast<std::size_t>(side)] = label;
    }
  }
  return sides;
}

/// m, how wide the space is beside a passage: the median over sections parallel to it.
/// @param is_open  bool(Eigen::Vector2d): whether a point belongs to the space.
/// @param may_be   bool(Eigen::Vector2d): whether it may do, for all that was seen.
template <class IsOpen, class MayBe>
double widthBeside(const Passage& passage, double resolution, bool left, IsOpen&& is_open,
                   MayBe&& may_be) {
  const Eigen::Vector2d way = (passage.b - passage.a).normalized();
  const Eigen::Vector2d across = (left ? 1.0 : -1.0) * Eigen::Vector2d(-way.y(), way.x());
  const double step = 0.5 * resolution;
  std::vector<double> widths;
  for (double off = kNearest; off <= kFarthest; off += resolution) {
    const Eigen::Vector2d p = passage.middle() + off * across;
    if (!is_open(p)) break;
    double width = 0.0;
    for (const double sign : {-1.0, 1.0}) {
      double s = 0.0;
      while (s < kWidest && may_be(p + sign * s * way)) s += step;
      width += s;
    }
    widths.push_back(width);
  }
  return widths.empty() ? resolution : median(std::move(widths));
}

/// m, how deep the space is before a passage: the way straight ahead to the next wall.
template <class IsOpen>
double depthBeside(const Passage& passage, double resolution, bool left, IsOpen&& is_open) {
  const Eigen::Vector2d way = (passage.b - passage.a).normalized();
  const Eigen::Vector2d across = (left ? 1.0 : -1.0) * Eigen::Vector2d(-way.y(), way.x());
  double depth = 2.0 * resolution;
  while (is_open(passage.middle() + depth * across)) depth += resolution;
  return depth;
}

/// Whether a passage is a gap in a wall: as much wall as gap in its line, or more.
bool isInWall(const Passage& passage, const RoomTuning& tuning) {
  return passage.evidence >= PassageEvidence::kCollinear && passage.support >= tuning.in_wall;
}

/// Whether a passage is a gap in something, and no mere narrowing of the space.
bool isGap(const Passage& passage, const RoomTuning& tuning) {
  return passage.evidence != PassageEvidence::kNarrowing || passage.support >= tuning.in_wall;
}

/// Whether the wall that ends at a passage leads elsewhere than across it.
bool isBesideWall(const Passage& passage, const RoomTuning& tuning) {
  return passage.evidence == PassageEvidence::kAbutting && passage.support < tuning.least_support;
}

/// Relative width up to which a passage may be a door.
double widestDoor(const Passage& passage, const RoomTuning& tuning) {
  switch (passage.evidence) {
    case PassageEvidence::kNarrowing:
      return isGap(passage, tuning) ? tuning.widest_abutting : tuning.widest_narrowing;
    case PassageEvidence::kAtCorner:
      return tuning.widest_narrowing;
    case PassageEvidence::kAbutting:
      return isBesideWall(passage, tuning) ? tuning.widest_narrowing : tuning.widest_abutting;
    case PassageEvidence::kCollinear:
    case PassageEvidence::kBetweenEnds:
      break;
  }
  return tuning.widest_collinear;
}

/// Relative width, on the other side, up to which a passage may be a corridor's mouth.
double widestMouth(const Passage& passage, const RoomTuning& tuning) {
  if (isBesideWall(passage, tuning)) return 0.0;
  return passage.evidence == PassageEvidence::kBetweenEnds ? tuning.widest_front
                                                           : tuning.widest_mouth;
}

/// Whether one can go through a passage: from one side to the other, somewhere along it. A line
/// that lies on the flank of a thin wall, or short of its end, makes a gap that leads along the
/// wall.
bool leadsThrough(const Mask& space, const Passage& passage) {
  const Eigen::Vector2d way = passage.b - passage.a;
  const Eigen::Vector2d across = Eigen::Vector2d(-way.y(), way.x()).normalized();
  for (const double share : {0.5, 0.25, 0.75}) {
    const Eigen::Vector2d p = passage.a + share * way;
    bool is_open = true;
    for (double off = -kThrough; off <= kThrough && is_open; off += 0.5 * space.resolution)
      is_open = space.at(space.cellOf(p + off * across), 0) != 0;
    if (is_open) return true;
  }
  return false;
}

/// The passages that are narrower than the space on one side at least; of mere narrowings, on both.
std::vector<Passage> plausible(const Mask& space, const Mask& hidden,
                               const std::vector<Passage>& passages, const RoomTuning& tuning) {
  const auto isOpen = [&](const Eigen::Vector2d& p) { return space.at(space.cellOf(p), 0) != 0; };
  std::vector<Passage> kept;
  for (const Passage& passage : passages) {
    if (!leadsThrough(space, passage)) continue;
    const auto mayBeOpen = [&](const Eigen::Vector2d& p) {
      return isOpen(p) || (isInWall(passage, tuning) && hidden.at(hidden.cellOf(p), 0) != 0);
    };
    const double q0 =
        passage.width() / widthBeside(passage, space.resolution, false, isOpen, mayBeOpen);
    const double q1 =
        passage.width() / widthBeside(passage, space.resolution, true, isOpen, mayBeOpen);
    const bool is_door = std::max(q0, q1) <= widestDoor(passage, tuning);
    const bool is_mouth = passage.evidence != PassageEvidence::kNarrowing &&
                          std::min(q0, q1) <= widestMouth(passage, tuning);
    if (is_door || is_mouth) kept.push_back(passage);
  }
  return kept;
}

/// Regions that join until no passage is too wide.
class RegionGraph {
 public:
  RegionGraph(const Raster<int>& labels, int count, const Raster<float>& clearance,
              const Mask& hidden, const std::vector<Passage>& passages, const RoomTuning& tuning)
      : tuning_(tuning),
        labels_(labels),
        hidden_(hidden),
        joined_(static_cast<std::size_t>(count)),
        peak_(static_cast<std::size_t>(count), 0.0),
        area_(peak_) {
    std::iota(joined_.begin(), joined_.end(), 0);
    const double cell_area = labels.resolution * labels.resolution;
    for (std::size_t k = 0; k < labels.values.size(); ++k) {
      if (labels.values[k] < 0) continue;
      const auto region = static_cast<std::size_t>(labels.values[k]);
      peak_[region] = std::max(peak_[region], static_cast<double>(clearance.values[k]));
      area_[region] += cell_area;
    }
    for (const Passage& passage : passages) {
      const auto rooms = sidesOf(labels, passage);
      if (rooms[0] >= 0 && rooms[1] >= 0 && rooms[0] != rooms[1]) {
        borders_.push_back({passage, rooms});
        beside_.push_back({0.0, 0.0});
        depth_.push_back({0.0, 0.0});
      }
    }
  }

  void joinAll() {
    for (std::size_t k = 0; k < borders_.size(); ++k) measure(k);
    while (joinWorst()) {
    }
  }

  int root(int region) const {
    while (joined_[at(region)] != region) region = joined_[at(region)];
    return region;
  }
  /// Whether each region is large enough for a room.
  std::vector<char> areRooms() const {
    std::vector<char> is_closed(joined_.size(), 1);
    for (const RoomBorder& border : borders_) {
      const int a = root(border.rooms[0]), b = root(border.rooms[1]);
      if (a != b) is_closed[at(a)] = is_closed[at(b)] = 0;
    }
    const auto largest = std::max_element(area_.begin(), area_.end());
    if (largest != area_.end()) is_closed[static_cast<std::size_t>(largest - area_.begin())] = 0;
    std::vector<char> are_rooms;
    for (std::size_t k = 0; k < joined_.size(); ++k) {
      const std::size_t region = at(root(static_cast<int>(k)));
      are_rooms.push_back(area_[region] >=
                          (is_closed[region] ? tuning_.smallest_closed : tuning_.smallest_room));
    }
    return are_rooms;
  }
  const std::vector<RoomBorder>& borders() const { return borders_; }

 private:
  static std::size_t at(int region) { return static_cast<std::size_t>(region); }

  /// The width of both regions beside a passage.
  void measure(std::size_t k) {
    for (const bool left : {false, true}) {
      const int region = root(borders_[k].rooms[left]);
      const auto isIn = [&](const Eigen::Vector2d& p) {
        const int label = labels_.at(labels_.cellOf(p), -1);
        return label >= 0 && root(label) == region;
      };
      const auto mayBeIn = [&](const Eigen::Vector2d& p) {
        return isIn(p) ||
               (isInWall(borders_[k].passage, tuning_) && hidden_.at(hidden_.cellOf(p), 0) != 0);
      };
      beside_[k][left] = widthBeside(borders_[k].passage, labels_.resolution, left, isIn, mayBeIn);
      depth_[k][left] = depthBeside(borders_[k].passage, labels_.resolution, left, isIn);
    }
  }

  /// Above 1: too wide to part rooms.
  double excess(std::size_t k) const {
    const RoomBorder& border = borders_[k];
    const int a = root(border.rooms[0]), b = root(border.rooms[1]);
    const double width = border.passage.width();
    // A shallow room with its door in the long side is as wide as a square of its area.
    const auto besideOf = [&](std::size_t side, bool is_door) {  // m
      const std::size_t region = at(side ? b : a);
      const double extent = is_door && isGap(border.passage, tuning_)
                                ? std::max(2.0 * peak_[region], std::sqrt(area_[region]))
                                : 2.0 * peak_[region];
      return std::max(1e-9, std::min(extent, beside_[k][side]));
    };
    const bool is_left_narrower = besideOf(1, true) < besideOf(0, true);
    const double narrower = besideOf(is_left_narrower, true);
    const bool is_in_corridor =
        depth_[k][is_left_narrower] > tuning_.shortest_corridor * narrower &&
        2.0 * peak_[at(is_left_narrower ? b : a)] < tuning_.corridor_width * width;
    const double widest = std::min(widestDoor(border.passage, tuning_),
                                   is_in_corridor ? tuning_.widest_in_corridor : 1.0);
    const double as_door =
        std::max(width / narrower / widest, (width + tuning_.least_step) / narrower);
    if (border.passage.evidence == PassageEvidence::kNarrowing) return as_door;
    // A corridor's mouth.
    const double q0 = width / besideOf(0, false), q1 = width / besideOf(1, false);
    const int arm = q0 > q1 ? a : b;
    const double arm_area = area_[at(arm)];
    const double other = width / depth_[k][q0 > q1 ? 1 : 0];
    const bool is_front = border.passage.evidence == PassageEvidence::kBetweenEnds;
    double as_mouth = std::max(std::min(q0, q1) / widestMouth(border.passage, tuning_),
                               is_front ? 0.0 : other / tuning_.shallowest_mouth);
    // A niche joins last: it may be a piece of a corridor still.
    if (arm_area < tuning_.shortest_corridor * width * width) as_mouth = std::max(as_mouth, kNiche);
    return std::min(as_door, as_mouth);
  }

  bool joinWorst() {
    double worst = 1.0, widest = 0.0;
    const RoomBorder* found = nullptr;
    for (std::size_t k = 0; k < borders_.size(); ++k) {
      const RoomBorder& border = borders_[k];
      if (root(border.rooms[0]) == root(border.rooms[1])) continue;
      const double e = excess(k), width = border.passage.width();
      if (e <= worst && !(e == worst && width > widest)) continue;
      worst = e;
      widest = width;
      found = &border;
    }
    if (!found) return false;
    const int a = root(found->rooms[0]), b = root(found->rooms[1]);
    joined_[at(b)] = a;
    peak_[at(a)] = std::max(peak_[at(a)], peak_[at(b)]);
    area_[at(a)] += area_[at(b)];
    for (std::size_t k = 0; k < borders_.size(); ++k) {
      if (root(borders_[k].rooms[0]) == a || root(borders_[k].rooms[1]) == a) measure(k);
    }
    return true;
  }

  RoomTuning tuning_;
  const Raster<int>& labels_;
  const Mask& hidden_;
  std::vector<int> joined_;
  std::vector<double> peak_, area_;
  std::vector<RoomBorder> borders_;
  std::vector<std::array<double, 2>> beside_, depth_;
};

}  // namespace

RoomRegions partitionIntoRooms(const Mask& space, const Raster<float>& clearance,
                               const Mask& hidden, const std::vector<Passage>& passages,
                               const RoomTuning& tuning) {
  const std::vector<Passage> cuts = plausible(space, hidden, passages, tuning);
  Components parts =
      connectedComponents(cutSpace(space, clearance, cuts, tuning.least_clearance), 4);
  growLabels(space, parts.labels);
  RegionGraph graph(parts.labels, static_cast<int>(parts.sizes.size()), clearance, hidden, cuts,
                    tuning);
  graph.joinAll();
  const std::vector<char> are_rooms = graph.areRooms();
  RoomRegions rooms;
  rooms.labels = parts.labels;
  std::map<int, int> number;
  for (int& label : rooms.labels.values) {
    if (label < 0) continue;
    label = are_rooms[static_cast<std::size_t>(label)]
                ? number.emplace(graph.root(label), static_cast<int>(number.size())).first->second
                : -1;
  }
  rooms.count = static_cast<int>(number.size());
  growLabels(space, rooms.labels);
  for (RoomBorder border : graph.borders()) {
    const auto a = number.find(graph.root(border.rooms[0]));
    const auto b = number.find(graph.root(border.rooms[1]));
    if (a == number.end() || b == number.end() || a == b) continue;
    border.rooms = {a->second, b->second};
    rooms.borders.push_back(border);
  }
  return rooms;
}

}  // namespace cca
