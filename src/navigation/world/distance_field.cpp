// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "navigation/world/frontier.hpp"
#include "navigation/world/grid_paths.hpp"

namespace cca {
namespace {

// Bits of a block: 4 y + x.
constexpr unsigned kLeft = 0x1111, kRight = 0x8888, kBottom = 0x000F, kTop = 0xF000, kAll = 0xFFFF;

/// The 4-connected part of `cells` that holds `seed`.
unsigned connectedPart(unsigned cells, unsigned seed) {
  if (cells == kAll) return kAll;
  unsigned part = seed & cells;
  for (;;) {
    const unsigned wider =
        (part | (part << 1 & ~kLeft) | (part >> 1 & ~kRight) | part << 4 | part >> 4) & cells;
    if (wider == part) return part;
    part = wider;
  }
}

/// Of a block, the cells beside the neighbour d, and by how many bits to the right they lie in the
/// cells of that one which they touch.
struct Side {
  unsigned cells;
  int shift;
};
/// In the order of kNeighbours, of blocks of 4 x 4 bits.
constexpr Side kSides[8] = {{kRight, 3},  {kTop, 12},  {kLeft, -3},   {kBottom, -12},
                            {0x8000, 15}, {0x1000, 9}, {0x0001, -15}, {0x0008, -9}};

/// The cells of neighbour d that touch `cells`.
unsigned across(unsigned cells, std::size_t d) {
  const unsigned beside = cells & kSides[d].cells;
  return kSides[d].shift > 0 ? beside >> kSides[d].shift : beside << -kSides[d].shift;
}

/// The two side neighbours between which a diagonal one lies.
std::array<std::size_t, 2> sidesOf(std::size_t diagonal) {
  return {kNeighbours[diagonal].x > 0 ? 0u : 2u, kNeighbours[diagonal].y > 0 ? 1u : 3u};
}

/// Where a shortest path that came by neighbour d goes on in the open, a bit for each neighbour:
/// straight on, and after a diagonal also along its two sides. All else is reached past the block.
unsigned onwardFrom(std::size_t d) {
  if (d < 4) return 1u << d;
  const auto sides = sidesOf(d);
  return 1u << d | 1u << sides[0] | 1u << sides[1];
}

/// Whether a way leads from a cell out of a square around a place. @param seen  takes its cells.
bool leadsAway(const PassableSpace& space, Cell from, Cell centre, int reach, CellSet& seen) {
  std::vector<Cell> open{from};
  seen.insert(from);
  while (!open.empty()) {
    const Cell c = open.back();
    open.pop_back();
    if (squareDistance(c, centre) >= reach) return true;
    for (std::size_t d = 0; d < 4; ++d) {
      const Cell next = c + kNeighbours[d];
      if (!space.isTraversable(next) || seen.contains(next)) continue;
      seen.insert(next);
      open.push_back(next);
    }
  }
  return false;
}

/// Whether no obstacle is known between two cells.
bool isFreeBetween(const PassableSpace& space, Cell from, Cell to) {
  const Eigen::Vector2d line = middleOf(to) - middleOf(from);
  bool is_free = true;
  if (from == to) return true;
  walkBeam(middleOf(from), line.normalized(), line.norm(), [&](Cell c, double) {
    is_free = !space.isObstacle(c);
    return is_free;
  });
  return is_free;
}

/// The nearest traversable cell that a way leads away from: noise may leave single cells open
/// around a robot that stands too near to something.
bool findStart(const PassableSpace& space, Cell robot, int reach, Cell& start) {
  if (!nearestTraversable(space, robot, reach, start)) return false;
  CellSet seen;
  if (leadsAway(space, start, robot, reach, seen)) return true;
  std::vector<Cell> others;
  for (int y = robot.y - reach; y <= robot.y + reach; ++y) {
    for (int x = robot.x - reach; x <= robot.x + reach; ++x) {
      if (space.isTraversable({x, y})) others.push_back({x, y});
    }
  }
  std::stable_sort(others.begin(), others.end(), [&](Cell a, Cell b) {
    return distanceBetween(a, robot) < distanceBetween(b, robot);
  });
  const auto other = std::find_if(others.begin(), others.end(), [&](Cell c) {
    return !seen.contains(c) && isFreeBetween(space, robot, c) &&
           leadsAway(space, c, robot, reach, seen);
  });
  if (other == others.end()) return false;
  start = *other;
  return true;
}

}  // namespace

void DistanceField::search(const PassableSpace& space, double resolution, Cell start,
                           std::optional<Cell> until) {
  ++search_;
  unit_ = resolution * FreeSpace::kBlock / kStraight;
  for (auto& bucket : queue_) bucket.clear();
  waiting_ = 0;
  started_ = findStart(space, start, kBesideWalls, start_);
  if (!started_) return;
  const Cell first = FreeSpace::blockOf(start_);
  relax(nodes_[first], {first, space.traversableCells(first), FreeSpace::bitOf(start_)}, 0);
  for (std::uint32_t cost = 0; waiting_ > 0 && !(until && isReached(*until)); ++cost) {
    auto& bucket = queue_[cost % queue_.size()];
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      const Entry entry = bucket[i];
      Part& part = nodes_[entry.block].parts[static_cast<std::size_t>(entry.part)];
      if (part.settled || part.cost != entry.cost) continue;
      part.settled = true;
      expand(space, part, entry);
    }
    waiting_ -= bucket.size();
    bucket.clear();
  }
}

void DistanceField::expand(const PassableSpace& space, const Part& here, const Entry& entry) {
  const Cell b = entry.block;
  const unsigned part = here.cells;
  const auto from_part = static_cast<std::int8_t>(entry.part);
  std::array<unsigned, 8> around;
  for (std::size_t d = 0; d < 8; ++d) around[d] = space.traversableCells(b + kNeighbours[d]);
  const bool is_open = part == kAll && std::all_of(around.begin(), around.end(),
                                                   [](unsigned cells) { return cells == kAll; });
  const unsigned onward =
      is_open && here.from_open ? onwardFrom(static_cast<std::size_t>(here.from)) : 0xFF;
  for (std::size_t d = 0; d < 8; ++d) {
    unsigned open = onward >> d & 1 ? around[d] & across(part, d) : 0;
    const Cell next = b + kNeighbours[d];
    if (!open || !isStorable(next)) continue;
    if (d >= 4) {  // no cutting of corners
      const auto sides = sidesOf(d);
      const auto isShut = [&](std::size_t s) { return !(around[s] & across(kSides[d].cells, s)); };
      if (isShut(sides[0]) || isShut(sides[1])) continue;
    }
    Node& beside = nodes_[next];
    while (open) {
      const Passage to{next,      around[d], open & (~open + 1), static_cast<std::int8_t>(d),
                       from_part, is_open};
      open &= ~relax(beside, to, entry.cost + (d < 4 ? kStraight : kDiagonal));
    }
  }
}

/// @return the cells of the part that is entered.
unsigned DistanceField::relax(Node& node, const Passage& to, std::uint32_t cost) {
  if (node.search != search_) node = {search_, {}};
  for (std::size_t k = 0; k < kParts; ++k) {
    Part& part = node.parts[k];
    if (part.cells && !(part.cells & to.entry)) continue;
    if (part.cells && cost >= part.cost) return part.cells;
    const unsigned cells = part.cells ? part.cells : connectedPart(to.open, to.entry);
    part = {cost, static_cast<std::uint16_t>(cells), false, to.from, to.from_part, to.from_open};
    queue_[cost % queue_.size()].push_back({to.block, static_cast<int>(k), cost});
    ++waiting_;
    return cells;
  }
  return connectedPart(to.open, to.entry);
}

const DistanceField::Part* DistanceField::partOf(Cell c) const {
  const Node& node = nodes_.at(FreeSpace::blockOf(c));
  if (node.search != search_ || search_ == 0) return nullptr;
  for (const Part& part : node.parts) {
    if (part.settled && (part.cells & FreeSpace::bitOf(c))) return &part;
  }
  return nullptr;
}

double DistanceField::distanceTo(Cell c) const {
  const Part* part = partOf(c);
  return part ? part->cost * unit_ : kUnreached;
}

std::vector<Cell> DistanceField::blocksTo(Cell c) const {
  std::vector<Cell> blocks;
  Cell block = FreeSpace::blockOf(c);
  for (const Part* part = partOf(c); part;) {
    blocks.push_back(block);
    if (part->from < 0) break;
    const Cell step = kNeighbours[static_cast<std::size_t>(part->from)];
    block = {block.x - step.x, block.y - step.y};
    part = &nodes_.at(block).parts[static_cast<std::size_t>(part->from_part)];
  }
  std::reverse(blocks.begin(), blocks.end());
  return blocks;
}

}  // namespace cca
