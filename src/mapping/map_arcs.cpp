// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_arcs.hpp"

#include <algorithm>
#include <cmath>

#include "mapping/arcs_of_chain.hpp"
#include "sensing/gates.hpp"

namespace cca {
namespace {

constexpr double kNextEnd = 0.3;  // m, between chords; a shorter one is no line of the map

struct Piece {
  const Wall* wall;
  const MapLine* line;
  int next = -1, before = -1;  ///< the pieces that follow and precede it

  const LineSegment& segment() const { return line->segment; }
};

std::vector<Piece> piecesOf(const std::vector<Wall>& walls) {
  std::vector<Piece> pieces;
  for (const Wall& wall : walls) {
    for (const MapLine& line : wall.pieces) pieces.push_back({&wall, &line});
  }
  std::sort(pieces.begin(), pieces.end(),
            [](const Piece& a, const Piece& b) { return a.line->id < b.line->id; });
  return pieces;
}

/// Each piece is followed by the one that begins nearest to its end, if that has no nearer one
/// before it.
void chain(std::vector<Piece>* pieces) {
  const int n = static_cast<int>(pieces->size());
  const auto at = [&](int i) -> Piece& { return (*pieces)[static_cast<std::size_t>(i)]; };
  std::vector<int> by_start(pieces->size());
  for (int i = 0; i < n; ++i) by_start[static_cast<std::size_t>(i)] = i;
  const auto start = [&](int i) { return at(i).segment().start; };
  std::sort(by_start.begin(), by_start.end(), [&](int a, int b) {
    return start(a).x() != start(b).x() ? start(a).x() < start(b).x() : a < b;
  });
  std::vector<double> gap(pieces->size(), kNextEnd);  // to the piece before
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector2d end = at(i).segment().end, along = at(i).segment().direction();
    double nearest = kNextEnd;
    int next = -1;
    auto k = std::lower_bound(by_start.begin(), by_start.end(), end.x() - kNextEnd,
                              [&](int other, double x) { return start(other).x() < x; });
    for (; k != by_start.end() && start(*k).x() < end.x() + kNextEnd; ++k) {
      const double off = (start(*k) - end).norm();
      if (*k == i || off >= nearest || along.dot(at(*k).segment().direction()) <= 0.0) {
        continue;
      }
      nearest = off;
      next = *k;
    }
    if (next < 0 || nearest >= gap[static_cast<std::size_t>(next)]) continue;
    if (at(next).before >= 0) at(at(next).before).next = -1;
    gap[static_cast<std::size_t>(next)] = nearest;
    at(next).before = i;
    at(i).next = next;
  }
}

/// The mean points of the bins that a piece stands on.
void addPoints(const Piece& piece, const MapNoise& noise, std::vector<CurvePoint>* points) {
  const Wall& wall = *piece.wall;
  const auto bin = [&](const Eigen::Vector2d& p) {
    return SupportProfile::binOf(wall.toWall(p).x());
  };
  const int first = std::max(wall.profile.first(), bin(piece.segment().start));
  const int last = std::min(wall.profile.last(), bin(piece.segment().end) + 1);
  const double variance = noise.lateralSigma() * noise.lateralSigma();
  for (int i = first; i < last; ++i) {
    const SupportBin& b = wall.profile.bin(i);
    if (b.hits() > 0.0) points->push_back({wall.toMap(b.mean()), variance});
  }
}

}  // namespace

std::vector<MapArc> arcsOfWalls(const std::vector<Wall>& walls, const MapNoise& noise,
                                const CcaParameters& parameters) {
  std::vector<Piece> pieces = piecesOf(walls);
  chain(&pieces);
  std::vector<MapArc> arcs;
  std::vector<bool> used(pieces.size(), false);
  // Walls are bent by pose errors that many returns have in common.
  const double least_bulge = std::max(parameters.straightness, kNormalGate * noise.lateralSigma());
  const auto follow = [&](int begin) {
    std::vector<CurvePoint> points;
    std::vector<ChainLink> links;
    std::vector<std::uint64_t> ids;
    int i = begin;
    for (; i >= 0 && !used[static_cast<std::size_t>(i)];
         i = pieces[static_cast<std::size_t>(i)].next) {
      used[static_cast<std::size_t>(i)] = true;
      const int first = static_cast<int>(points.size());
      addPoints(pieces[static_cast<std::size_t>(i)], noise, &points);
      links.push_back({first, static_cast<int>(points.size()), true});
      ids.push_back(pieces[static_cast<std::size_t>(i)].line->id);
    }
    for (ArcOfLinks& found : arcsOfChain(points, links, least_bulge, parameters.vertex_price)) {
      const bool whole = i == begin && found.last - found.first == static_cast<int>(links.size());
      if (whole) found.arc.sweep = 2.0 * M_PI;
      arcs.push_back({found.arc, {ids.begin() + found.first, ids.begin() + found.last}});
    }
  };
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (pieces[k].before < 0) follow(static_cast<int>(k));
  }
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (!used[k]) follow(static_cast<int>(k));  // a ring
  }
  return arcs;
}

}  // namespace cca
