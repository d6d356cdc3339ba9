// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/wall_upkeep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mapping/description_length.hpp"
#include "mapping/map_similarity.hpp"
#include "mapping/rank_order_clustering.hpp"

namespace cca {
namespace {

using Slot = Walls::Slot;

/// Returns after which a wall is compared with its neighbours again, however many it has.
constexpr double kMostBeforeCheck = 100.0;
constexpr double kSideBySide = 0.97;  // cosine of 14 degrees: more is a corner

/// Where two walls that are not one run side by side all the same, the longer one takes what lies
/// beside its hits. Of one wall that has two parts only for its length, it takes all between its
/// ends.
void shareOverlap(Slot a, Slot b, Walls& walls, const MapNoise& noise, const AlphaCut& cut) {
  const double cosine = walls[a].fittedDirection().dot(walls[b].fittedDirection());
  if (cosine < kSideBySide) return;
  const bool a_lesser = extentOf(walls[a]).length() < extentOf(walls[b]).length();
  const Slot lesser = a_lesser ? a : b, greater = a_lesser ? b : a;
  const bool are_parts =
      wouldOutgrow(walls[a], walls[b]) &&
      cut.similarity(membershipsOfAnyLength(walls[a], walls[b], noise)) >= cut.value;
  const SupportProfile& taker = walls[greater].profile;
  const auto yields = [&](int bin, double off) {
    if (are_parts) return taker.contains(bin);
    const Memberships place{1.0, 1.0, 1.0, 1.0, overlapOfPlace(off, noise)};
    return taker.spans(bin) && cut.similarity(place) >= cut.value;
  };
  if (!yieldBins(walls[lesser], walls[greater], yields)) return;
  walls.touch(lesser);
  walls.touch(greater);
}

/// Walls of the map are clustered as lines of a scan are: those near a wall that are alike, it and
/// each other, make a group. @return  that of `slot`, without it.
std::vector<Slot> groupOf(Slot slot, const std::vector<Slot>& near, const Walls& walls,
                          const MapNoise& noise, const AlphaCut& cut) {
  if (cut.without(Part::kWallsToWalls)) return {};
  const auto similarity = [&](Slot a, Slot b) {
    return cut.similarity(mapMemberships(walls[a], walls[b], noise));
  };
  std::vector<Slot> members{slot};
  for (const Slot other : near) {
    if (other == slot || walls[other].profile.empty()) continue;
    if (similarity(slot, other) >= cut.value) members.push_back(other);
  }
  SimilarityMatrix sim(static_cast<int>(members.size()));
  for (std::size_t i = 0; i < members.size(); ++i) {
    for (std::size_t j = i + 1; j < members.size(); ++j) {
      sim.set(static_cast<int>(i), static_cast<int>(j), similarity(members[i], members[j]));
    }
  }
  const std::vector<int> group_of = rankOrderGroups(sim, cut);
  std::vector<Slot> group;
  for (std::size_t i = 1; i < members.size(); ++i) {
    if (group_of[i] == group_of[0]) group.push_back(members[i]);
  }
  return group;
}

/// Exchanges all but what says where the walls stand in the index and in the list of the touched.
void exchange(Wall& wall, Wall& other) {
  std::swap(wall, other);
  std::swap(wall.cells, other.cells);
  std::swap(wall.visit, other.visit);
  std::swap(wall.touched, other.touched);
  wall.indexed = other.indexed = {};  // bins of another frame
}

/// What was seen in a single look is no face: for the sake of a few returns of a door post two
/// faces that are well apart must not become one wall.
constexpr double kVisitsOfFace = 2.0;

void merge(Slot slot, Slot other_slot, Walls& walls) {
  Wall &wall = walls[slot], &other = walls[other_slot];
  const bool opposed = wall.fittedDirection().dot(other.fittedDirection()) < 0.0;
  const Wall& greater = wall.hits < other.hits ? other : wall;
  const Wall& lesser = wall.hits < other.hits ? wall : other;
  const bool two_sided =
      greater.two_sided || ((lesser.two_sided || opposed) && lesser.visits >= kVisitsOfFace);
  // The front is that of the greater: a post seen from behind does not turn a wall round.
  if (opposed && wall.hits < other.hits) exchange(wall, other);
  wall.two_sided = two_sided;
  absorb(wall, other);
  wall.hits += other.hits;
  wall.visits = std::max(wall.visits, other.visits);
  wall.pieces.insert(wall.pieces.end(), other.pieces.begin(), other.pieces.end());
  walls.remove(other_slot);
}

/// Merges the wall with its group, and again, until it is alone.
void mergeWithNeighbours(Slot slot, Walls& walls, const MapNoise& noise, const AlphaCut& cut) {
  std::vector<Slot> near, group;
  do {
    const Extent extent = extentOf(walls[slot]);
    walls.near(walls[slot].onLine(extent.first - 0.5), walls[slot].onLine(extent.last + 0.5), near);
    group = groupOf(slot, near, walls, noise, cut);
    for (const Slot other : group) merge(slot, other, walls);
    if (!group.empty()) refit(walls[slot]);
  } while (!group.empty());
  if (cut.without(Part::kYielding)) return;
  for (const Slot other : near) {
    if (other == slot || walls[other].profile.empty()) continue;
    shareOverlap(slot, other, walls, noise, cut);
    if (walls[slot].profile.sums().w <= 0.0) return;
  }
}

/// Cuts the wall at its strongest bend, where that saves the price of a vertex [nats]; the part
/// behind the bend becomes a wall of its own.
/// @return whether it was bent.
bool splitWhereBent(Slot slot, Walls& walls, const MapNoise& noise, double vertex_price) {
  const double least_gain = 2.0 * noise.lateralSigma() * noise.lateralSigma() * vertex_price;
  const double residual = walls[slot].profile.sums().residual();
  // No cut gains more than all, nor more than the best one did and what came on top since.
  if (residual < std::max(least_gain, walls[slot].uncut_residual)) return false;
  const SupportProfile::Cut cut = walls[slot].profile.bestCut();
  const double lacking = least_gain - cut.gain;
  walls[slot].uncut_residual = lacking > 0.0 ? residual + lacking : 0.0;
  if (lacking > 0.0) return false;
  const Slot tail_slot = walls.create();
  Wall &wall = walls[slot], &tail = walls[tail_slot];
  tail.origin = wall.origin;
  tail.direction = wall.direction;
  tail.two_sided = wall.two_sided;
  tail.visits = wall.visits;
  const double length = wall.profile.last() - wall.profile.first();
  tail.profile = wall.profile.cutFrom(cut.at);
  const double share = (tail.profile.last() - tail.profile.first()) / length;
  tail.hits = share * wall.hits;
  wall.hits -= tail.hits;
  // Ids stay with the half that they lie on.
  for (const MapLine& piece : wall.pieces) {
    const Eigen::Vector2d middle = 0.5 * (piece.segment.start + piece.segment.end);
    if (wall.toWall(middle).x() >= cut.at * SupportProfile::kBinLength)
      tail.pieces.push_back(piece);
  }
  for (const MapLine& piece : tail.pieces) {
    wall.pieces.erase(std::find_if(wall.pieces.begin(), wall.pieces.end(),
                                   [&](const MapLine& p) { return p.id == piece.id; }));
  }
  wall.profile.prune();
  refit(wall);
  walls.touch(tail_slot);
  return true;
}

bool changedMuch(const Wall& wall) {
  const int length = wall.profile.last() - wall.profile.first();
  const double new_hits = std::clamp(0.2 * wall.hits_at_check, 5.0, kMostBeforeCheck);
  return wall.hits > wall.hits_at_check + new_hits || length > wall.length_at_check + 2;
}

}  // namespace

void seeToTouched(Walls& walls, const MapNoise& noise, const CcaParameters& parameters,
                  std::uint64_t& next_id) {
  const AlphaCut cut(parameters);
  // What is cut off from a wall may be shared out so that the wall is bent again, and so on for
  // ever: there are no more cuts than walls that the scan has touched.
  std::size_t cuts_left = cut.without(Part::kBends) ? 0 : walls.touched().size();
  // More are touched meanwhile.
  for (std::size_t i = 0; i < walls.touched().size(); ++i) {
    const Slot slot = walls.touched()[i];
    walls[slot].touched = false;
    if (!walls[slot].alive) continue;
    if (!walls.prune(slot)) {
      walls.remove(slot);
      continue;
    }
    refit(walls[slot]);
    const bool changed = changedMuch(walls[slot]);
    if (cuts_left > 0 && splitWhereBent(slot, walls, noise, parameters.vertex_price)) --cuts_left;
    if (changed) {
      mergeWithNeighbours(slot, walls, noise, cut);
      if (!walls.prune(slot)) {
        walls.remove(slot);
        continue;
      }
      Wall& wall = walls[slot];
      refit(wall);
      wall.hits_at_check = wall.hits;
      wall.length_at_check = wall.profile.last() - wall.profile.first();
    }
    recut(walls[slot], noise, linePrice(parameters.vertex_price), next_id);
    walls.place(slot);
  }
  walls.touched().clear();
  walls.recycle();
}

}  // namespace cca
