// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/furniture.hpp"

#include <algorithm>
#include <cmath>

namespace cca {

namespace {

constexpr int kTries = 30;
constexpr double kLeg = 0.05;  // m

struct Piece {
  Box place;
  enum class Form { kBox, kDisc, kLegs, kTurned } form = Form::kBox;
  bool at_wall = false;
};

Box boxAt(const Eigen::Vector2d& lowest, const Eigen::Vector2d& size) {
  return Box(lowest, lowest + size);
}

/// A point of the raster in the rectangle from (0, 0) to `room`; x is drawn before y.
Eigen::Vector2d anywhere(const Eigen::Vector2d& room, Random& random) {
  const double x = onRaster(random.uniform(0.0, room.x()));
  const double y = onRaster(random.uniform(0.0, room.y()));
  return {x, y};
}

/// A desk, shelf or cupboard with its back to one of the four walls.
Piece wallPiece(const Box& floor, Random& random) {
  static const Eigen::Vector2d kSizes[] = {
      {1.6, 0.8}, {1.2, 0.6}, {0.9, 0.45}, {2.0, 0.4}, {0.6, 0.6}};
  const Eigen::Vector2d size = kSizes[random.integer(0, 4)];
  const int wall = random.integer(0, 3);
  const Eigen::Vector2d turned = wall < 2 ? size : Eigen::Vector2d(size.y(), size.x());
  const Eigen::Vector2d room = floor.sizes() - turned;
  Eigen::Vector2d offset = anywhere(room, random);
  const int axis = wall < 2 ? 1 : 0;
  offset[axis] = wall % 2 == 0 ? 0.0 : room[axis];
  Piece piece;
  piece.place = boxAt(floor.min() + offset, turned);
  piece.at_wall = true;
  return piece;
}

/// A table, round table, table on legs, or one that stands askew.
Piece freePiece(const Box& floor, Random& random) {
  Piece piece;
  piece.form = static_cast<Piece::Form>(random.integer(0, 3));
  Eigen::Vector2d size = Eigen::Vector2d(0.4, 0.4) + anywhere({1.4, 0.6}, random);
  if (piece.form == Piece::Form::kDisc) size.setConstant(onRaster(random.uniform(0.4, 1.2)));
  if (piece.form == Piece::Form::kTurned) size.setConstant(onRaster(random.uniform(0.8, 1.4)));
  if (piece.form == Piece::Form::kLegs) size = {0.5, 0.45};  // too narrow to drive between them
  if (random.integer(0, 1) == 1) std::swap(size.x(), size.y());
  const Eigen::Vector2d room = floor.sizes() - size;
  piece.place = boxAt(floor.min() + anywhere(room, random), size);
  return piece;
}

double gap(const Box& a, const Box& b) {
  return (a.min() - b.max()).cwiseMax(b.min() - a.max()).maxCoeff();
}

bool fits(const Piece& piece, const Room& room, const std::vector<Piece>& pieces) {
  constexpr double kRounding = 1e-9;
  const Eigen::Vector2d low = piece.place.min() - room.floor.min();
  const Eigen::Vector2d high = room.floor.max() - piece.place.max();
  for (double free : {low.x(), low.y(), high.x(), high.y()}) {
    const bool touches = piece.at_wall && std::abs(free) < kRounding;
    if (!touches && free < kPassage - kRounding) return false;
  }
  for (const Box& door : room.doors) {
    if (gap(piece.place, door) < kPassage - kRounding) return false;
  }
  return std::all_of(pieces.begin(), pieces.end(), [&piece](const Piece& other) {
    return gap(piece.place, other.place) >= kPassage - kRounding;
  });
}

void build(Building& plan, const Piece& piece, Random& random) {
  const Box& place = piece.place;
  switch (piece.form) {
    case Piece::Form::kBox:
      plan.addBox(place.min(), place.max());
      return;
    case Piece::Form::kDisc:
      plan.addDisc(place.center(), 0.5 * place.sizes().x(), 24);
      return;
    case Piece::Form::kTurned:  // the widest plate that stays in its place however it is turned
      plan.addTurnedBox(place.center(), Eigen::Vector2d(0.8, 0.55) * place.sizes().x(),
                        random.uniform(0.0, M_PI));
      return;
    case Piece::Form::kLegs:
      for (int leg = 0; leg < 4; ++leg) {
        const Eigen::Vector2d corner(leg % 2 ? place.max().x() - kLeg : place.min().x(),
                                     leg / 2 ? place.max().y() - kLeg : place.min().y());
        plan.addBox(corner, corner + Eigen::Vector2d(kLeg, kLeg));
      }
      return;
  }
}

}  // namespace

double onRaster(double value) { return std::round(value * 20.0) / 20.0; }

void furnish(Building& plan, const Room& room, int count, Random& random) {
  std::vector<Piece> pieces;
  for (int tries = 0; tries < kTries * count && static_cast<int>(pieces.size()) < count; ++tries) {
    const bool at_wall = random.uniform() < 0.65;
    const Piece piece = at_wall ? wallPiece(room.floor, random) : freePiece(room.floor, random);
    if (!fits(piece, room, pieces)) continue;
    build(plan, piece, random);
    pieces.push_back(piece);
  }
}

void clutter(Building& plan, const Box& floor, const Box& kept_free, int count, Random& random) {
  for (int i = 0; i < count; ++i) {
    const double kind = random.uniform();
    if (kind < 0.3) {
      const Box place = wallPiece(floor, random).place;
      if (!place.intersects(kept_free)) plan.addBox(place.min(), place.max());
      continue;
    }
    const bool is_chair = random.uniform() < 0.4, is_on_legs = kind < 0.75;
    const double length = is_chair ? random.uniform(0.35, 0.5) : random.uniform(0.8, 1.6);
    const double depth = is_chair ? length : random.uniform(0.4, 0.9);
    const Eigen::Vector2d half(0.5 * length, 0.5 * depth);
    const Eigen::Vector2d centre =
        floor.min() + half + anywhere(floor.sizes() - 2.0 * half, random);
    const double angle = random.integer(0, 1) * random.uniform(0.0, M_PI);
    if (kept_free.exteriorDistance(centre) < half.norm()) continue;
    if (is_on_legs) {
      for (const Eigen::Vector2d& corner : {half, Eigen::Vector2d(half.x(), -half.y())}) {
        const Eigen::Vector2d to_leg = Eigen::Rotation2Dd(angle) * corner;
        plan.addTurnedBox(centre + to_leg, {kLeg, kLeg}, angle);
        plan.addTurnedBox(centre - to_leg, {kLeg, kLeg}, angle);
      }
    } else {
      plan.addTurnedBox(centre, 2.0 * half, angle);
    }
  }
}

}  // namespace cca
