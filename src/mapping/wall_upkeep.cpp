// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/wall_upkeep.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

using Slot = Walls::Slot;

/// nat, what a bend must save: one vertex, two coordinates of the longest wall at a bin's length,
/// 2 ln(20 m / 5 cm).
constexpr double kBendCost = 12.0;
/// Share of it below which two walls are joined; less than 1, or cuts and joins would alternate.
constexpr double kJoinShare = 0.6;
constexpr double kLargestGap = 1.0;  // m, between two stretches of one wall
/// Returns after which a wall is compared with its neighbours again, however many it has.
constexpr double kMostBeforeCheck = 100.0;
/// Gates of a lateral distance, in three deviations of a return, and the least that they fall to
/// [m]: two walls with one front (each has its own pose error: sqrt 2), two fronts (the line
/// between them lies within two deviations of either), a stretch side by side.
constexpr double kSameFront = 1.42;
constexpr double kSameFrontLeast = 0.10;
constexpr double kTwoFronts = 1.33;
constexpr double kTwoFrontsLeast = 0.06;
constexpr double kStretch = 0.7;
constexpr double kStretchLeast = 0.07;
constexpr double kSideBySide = 0.97;  // cosine
constexpr double kReach = 0.2;  // m, how far a wall's hits lie off its extent in another frame

struct Extent {
  double first, last;  // m, along a wall
  double length() const { return last - first; }
};

Extent extentOf(const Wall& wall) {
  return {wall.profile.first() * SupportProfile::kBinLength,
          wall.profile.last() * SupportProfile::kBinLength};
}

Extent extentOf(const Wall& other, const Wall& frame) {
  const Extent e = extentOf(other);
  const double a = frame.toWall(other.toMap(e.first, 0.0)).x();
  const double b = frame.toWall(other.toMap(e.last, 0.0)).x();
  return {std::min(a, b), std::max(a, b)};
}

/// Whether the two hold hits beside each other. In the bin where one ends and the other goes on,
/// both may.
bool standSideBySide(const Wall& wall, const Wall& other) {
  int common = 0;
  for (int i = other.profile.first(); i < other.profile.last(); ++i) {
    const SupportBin& bin = other.profile.bin(i);
    if (bin.hits <= 0.0) continue;
    if (wall.hitNear(other.toMap(bin.t / bin.hits, bin.d / bin.hits)) && ++common > 1) return true;
  }
  return false;
}

bool oneWall(const Wall& wall, const Wall& other, const MapNoise& noise) {
  const double cosine = wall.fittedDirection().dot(other.fittedDirection());
  if (std::abs(cosine) < 0.9) return false;
  const Extent mine = extentOf(wall), theirs = extentOf(other, wall);
  const double overlap = std::min(mine.last, theirs.last) - std::max(mine.first, theirs.first);
  const double whole = mine.length() + theirs.length() - overlap;
  if (-overlap > kLargestGap || (whole > kLongestWall && overlap < theirs.length())) return false;
  const BinSums &a = wall.profile.sums(), b = sumsInFrameOf(wall, other);
  if (a.w <= 0.0 || b.w <= 0.0) return false;
  const bool same_side = cosine > 0.0 || wall.two_sided || other.two_sided;
  const double sigma = noise.lateralSigma();
  BinSums joint = a;
  joint.add(b);
  const double loss = std::max(0.0, joint.residual() - a.residual() - b.residual());
  const bool beside = overlap > 0.5 * std::min(mine.length(), theirs.length());
  if (beside && standSideBySide(wall, other)) {
    // Of two faces with one front only one can be seen; of two with opposite fronts both can, where
    // they lie far enough apart to be told apart. Parallels h apart lose h^2 w_a w_b / (w_a + w_b).
    const double gate = same_side ? std::max(kSameFrontLeast, 3.0 * sigma * kSameFront)
                                  : std::max(kTwoFrontsLeast, 3.0 * sigma * kTwoFronts);
    return loss * joint.w < gate * gate * a.w * b.w;
  }
  // A stretch in another's gap, such as the niche of a door, has a bend at either end.
  const double bends = beside ? 2.0 : 1.0;
  return same_side && loss < 2.0 * sigma * sigma * kJoinShare * bends * kBendCost;
}

/// Where two walls that are not one run side by side all the same, the longer one takes it all.
void shareOverlap(Slot a, Slot b, Walls& walls, const MapNoise& noise) {
  const double cosine = walls[a].fittedDirection().dot(walls[b].fittedDirection());
  if (cosine < kSideBySide) return;
  const bool a_lesser = extentOf(walls[a]).length() < extentOf(walls[b]).length();
  const Slot lesser = a_lesser ? a : b, greater = a_lesser ? b : a;
  const Extent mine = extentOf(walls[greater]), theirs = extentOf(walls[lesser], walls[greater]);
  if (mine.last < theirs.first - kReach || theirs.last < mine.first - kReach) return;
  const double gate = std::max(kStretchLeast, 3.0 * noise.lateralSigma() * kStretch);
  if (!yieldOverlap(walls[lesser], walls[greater], gate)) return;
  walls.touch(lesser);
  walls.touch(greater);
}

void mergeWithNeighbours(Slot slot, Walls& walls, const MapNoise& noise) {
  const Extent extent = extentOf(walls[slot]);
  std::vector<Slot> near;
  walls.near(walls[slot].onLine(extent.first - 0.5), walls[slot].onLine(extent.last + 0.5), near);
  for (const Slot other_slot : near) {
    Wall& wall = walls[slot];
    Wall& other = walls[other_slot];
    if (other_slot == slot || other.profile.empty()) continue;
    if (!oneWall(wall, other, noise)) {
      shareOverlap(slot, other_slot, walls, noise);
      if (walls[slot].profile.sums().w <= 0.0) return;
      continue;
    }
    const bool opposed = wall.fittedDirection().dot(other.fittedDirection()) < 0.0;
    wall.two_sided = wall.two_sided || other.two_sided || opposed;
    absorb(wall, other);
    wall.hits += other.hits;
    wall.visits = std::max(wall.visits, other.visits);
    wall.pieces.insert(wall.pieces.end(), other.pieces.begin(), other.pieces.end());
    refit(wall);
    walls.remove(other_slot);
  }
}

/// Cuts the wall at its strongest bend; the part behind the bend becomes a wall of its own.
/// @return whether it was bent.
bool splitWhereBent(Slot slot, Walls& walls, const MapNoise& noise) {
  const double least_gain = 2.0 * noise.lateralSigma() * noise.lateralSigma() * kBendCost;
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

void seeToTouched(Walls& walls, const MapNoise& noise, std::uint64_t& next_id) {
  std::vector<Slot>& touched = walls.touched();
  // What is cut off from a wall may be shared out so that the wall is bent again, and so on for
  // ever: there are no more cuts than walls that the scan has touched.
  std::size_t cuts_left = touched.size();
  for (std::size_t i = 0; i < touched.size(); ++i) {
    const Slot slot = touched[i];
    walls[slot].touched = false;
    if (!walls[slot].alive) continue;
    if (!walls.prune(slot)) {
      walls.remove(slot);
      continue;
    }
    refit(walls[slot]);
    const bool changed = changedMuch(walls[slot]);
    if (cuts_left > 0 && splitWhereBent(slot, walls, noise)) --cuts_left;
    if (changed) {
      mergeWithNeighbours(slot, walls, noise);
      if (!walls.prune(slot)) {
        walls.remove(slot);
        continue;
      }
      Wall& wall = walls[slot];
      refit(wall);
      wall.hits_at_check = wall.hits;
      wall.length_at_check = wall.profile.last() - wall.profile.first();
    }
    recut(walls[slot], noise, next_id);
    walls.place(slot);
  }
  touched.clear();
  walls.recycle();
}

}  // namespace cca
