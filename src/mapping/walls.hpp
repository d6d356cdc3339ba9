// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "mapping/wall.hpp"
#include "mapping/wall_index.hpp"

namespace cca {

/// The walls of a map in slots that are reused, with the index that finds them.
class Walls {
 public:
  using Slot = WallIndex::Slot;

  Wall& operator[](Slot slot) { return walls_[static_cast<std::size_t>(slot)]; }
  const Wall& operator[](Slot slot) const { return walls_[static_cast<std::size_t>(slot)]; }
  const std::vector<Wall>& all() const { return walls_; }

  /// A new, empty wall; invalidates references.
  Slot create();
  void remove(Slot slot);
  /// Gives the slots of removed walls free, when nobody holds their numbers any more.
  void recycle();
  /// Tells the index where the wall lies now.
  void place(Slot slot);

  const std::vector<Slot>& at(const WallIndex::Cell& cell) const { return index_.at(cell); }
  /// Walls near a stretch, each once, in the order of the stretch.
  void near(const Eigen::Vector2d& from, const Eigen::Vector2d& to, std::vector<Slot>& found) const;
  /// The wall that a return at `p` most likely came from: the nearest within `gate` [m] of its
  /// fitted line that was hit near there before and shows its face to the viewer; -1 where there is
  /// none.
  Slot hitBy(const Eigen::Vector2d& p, const Eigen::Vector2d& viewpoint, double gate) const;
  /// The same by a mixture of walls, each of which scatters its returns evenly along itself and
  /// normally across: of those within kGates of what a return from so far away may be off, the one
  /// of the greatest density.
  Slot likelyHitBy(const Eigen::Vector2d& p, const Eigen::Vector2d& viewpoint,
                   const MapNoise& noise) const;

  /// Enters a return at `p` as a hit of a wall. Where something was refuted before, four rays speak
  /// against what is new: more than eight returns are needed to believe it, two elsewhere. What
  /// lies beside another wall that stands is not new: the two may be merged, scan after scan, and
  /// the rays would add up.
  void hit(Slot slot, const Eigen::Vector2d& p);
  /// Forgets the bins of a wall that rays have refuted, and remembers where they were.
  /// @return false where nothing is left of the wall.
  bool prune(Slot slot);

  /// Walls that changed since they were last seen to, in order of their first change.
  void touch(Slot slot);
  std::vector<Slot>& touched() { return touched_; }
  /// A number that no wall has been visited under.
  std::uint64_t nextVisit() { return ++visit_; }

 private:
  template <class Visit>  // (slot, distance from its line): walls that hitBy() may name
  void visitHitBy(const Eigen::Vector2d& p, const Eigen::Vector2d& viewpoint, double gate,
                  const Visit& visit) const;
  bool standsBeside(Slot slot, const Eigen::Vector2d& p) const;

  std::vector<Wall> walls_;
  std::vector<Slot> free_, dead_, touched_;
  WallIndex index_;
  /// Where rays have refuted a line, in cells of 30 cm: the memory is bounded by the area, and no
  /// ray is traced for it. Deviation: the paper has no memory of what went. Without it the map
  /// showed each time what stood there last, though ten times as many rays had gone through.
  std::set<std::pair<long, long>> freed_;
  std::uint64_t visit_ = 0;
};

}  // namespace cca
