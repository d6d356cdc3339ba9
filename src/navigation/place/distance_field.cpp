// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "cca_mrpt/navigation/place/grid_paths.hpp"

namespace cca {
namespace {

constexpr double kStartReach = 0.5;  // m, from a robot that stands too near to something

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

/// The cells of the neighbouring block that touch `part` across the side towards neighbour d.
unsigned acrossSide(unsigned part, int d) {
  switch (d) {
    case 0:
      return (part & kRight) >> 3;
    case 1:
      return (part & kTop) >> 12;
    case 2:
      return (part & kLeft) << 3;
    default:
      return (part & kBottom) << 12;
  }
}

/// Diagonal neighbours d = 4..7: this block's corner cell, the one across, and the corner cells of
/// the two blocks beside, horizontal then vertical, which must be open too (no cutting of corners).
struct Corner {
  unsigned here, there, beside_x, beside_y;
};
constexpr Corner kCorners[4] = {{0x8000, 0x0001, 0x1000, 0x0008},
                                {0x1000, 0x0008, 0x8000, 0x0001},
                                {0x0001, 0x8000, 0x0008, 0x1000},
                                {0x0008, 0x1000, 0x0001, 0x8000}};

/// Where a shortest path that came by neighbour d goes on in the open, a bit for each neighbour:
/// straight on, and after a diagonal also along its two sides. All else is reached past the block.
constexpr unsigned kOnward[8] = {1u << 0,
                                 1u << 1,
                                 1u << 2,
                                 1u << 3,
                                 1u << 4 | 1u << 0 | 1u << 1,
                                 1u << 5 | 1u << 2 | 1u << 1,
                                 1u << 6 | 1u << 2 | 1u << 3,
                                 1u << 7 | 1u << 0 | 1u << 3};

}  // namespace

void DistanceField::search(const FreeSpace& space, double resolution, Cell start, double horizon,
                           std::optional<Cell> until) {
  begin(space, resolution, start, horizon);
  grow(space, until);
}

void DistanceField::begin(const FreeSpace& space, double resolution, Cell start, double horizon) {
  ++search_;
  unit_ = resolution * FreeSpace::kBlock / kStraight;
  horizon_ = horizon;
  for (auto& bucket : queue_) bucket.clear();
  waiting_ = 0;
  settled_up_to_ = 0;
  started_ = nearestTraversable(space, start, static_cast<int>(kStartReach / resolution), start_);
  if (!started_) return;
  const Cell first = FreeSpace::blockOf(start_);
  relax(nodes_[first], {first, space.traversableCells(first), FreeSpace::bitOf(start_)}, 0);
}

double DistanceField::reach(const FreeSpace& space, Cell c) {
  if (!started_ || leastDistanceTo(FreeSpace::blockOf(c)) > horizon_) return kUnreached;
  grow(space, c);
  return distanceTo(c);
}

void DistanceField::grow(const FreeSpace& space, std::optional<Cell> until) {
  while (waiting_ > 0 && settled_up_to_ * unit_ <= horizon_ && !(until && isReached(*until))) {
    auto& bucket = queue_[settled_up_to_ % queue_.size()];
    for (std::size_t i = 0; i < bucket.size(); ++i) {
      const Entry entry = bucket[i];
      Node& node = nodes_[entry.block];
      Part& part = node.parts[static_cast<std::size_t>(entry.part)];
      if (part.settled || part.cost != entry.cost) continue;
      part.settled = true;
      expand(space, node, entry);
    }
    waiting_ -= bucket.size();
    bucket.clear();
    ++settled_up_to_;
  }
}

void DistanceField::expand(const FreeSpace& space, Node& node, const Entry& entry) {
  const Cell b = entry.block;
  const Part& here = node.parts[static_cast<std::size_t>(entry.part)];
  const unsigned part = here.cells;
  const auto from_part = static_cast<std::int8_t>(entry.part);
  const std::array<std::uint16_t, 8> around = space.traversableAround(b);
  const bool is_open = part == kAll && std::all_of(around.begin(), around.end(),
                                                   [](unsigned cells) { return cells == kAll; });
  // The space may have grown between two blocks of a path: both have to have been open.
  const unsigned onward =
      is_open && here.from_open ? kOnward[static_cast<std::size_t>(here.from)] : 0xFF;
  for (int d = 0; d < 4; ++d) {
    const unsigned cells = around[static_cast<std::size_t>(d)];
    unsigned open = onward >> d & 1 ? cells & acrossSide(part, d) : 0;
    if (!open) continue;
    const Cell step = kNeighbours[static_cast<std::size_t>(d)], next = b + step;
    if (!isStorable(next)) continue;
    Node& beside = nodes_.beside(node, b, step);
    while (open) {
      const Passage to{next,      cells,  open & (~open + 1), static_cast<std::int8_t>(d),
                       from_part, is_open};
      open &= ~relax(beside, to, entry.cost + kStraight);
    }
  }
  for (int d = 4; d < 8; ++d) {
    const Corner& corner = kCorners[d - 4];
    if (!(onward >> d & 1) || !(part & corner.here)) continue;
    const unsigned cells = around[static_cast<std::size_t>(d)];
    const Cell step = kNeighbours[static_cast<std::size_t>(d)], next = b + step;
    if (!(cells & corner.there) || !(around[step.x > 0 ? 0 : 2] & corner.beside_x) ||
        !(around[step.y > 0 ? 1 : 3] & corner.beside_y) || !isStorable(next)) {
      continue;
    }
    relax(nodes_.beside(node, b, step),
          {next, cells, corner.there, static_cast<std::int8_t>(d), from_part, is_open},
          entry.cost + kDiagonal);
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

DistanceField::Reached DistanceField::reached(Cell c) const {
  const Part* part = partOf(c);
  return part ? Reached{part->cost * unit_, part->cells} : Reached{};
}

double DistanceField::leastDistanceTo(Cell block) const {
  const Cell first = FreeSpace::blockOf(start_);
  const int dx = std::abs(block.x - first.x), dy = std::abs(block.y - first.y);
  return (kStraight * std::abs(dx - dy) + kDiagonal * std::min(dx, dy)) * unit_;
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
