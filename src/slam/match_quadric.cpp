// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "slam/seen_points.hpp"
#include "slam/surface_matching.hpp"

namespace cca {
namespace {

/// Surfaces face the same way within 25 degrees.
constexpr float kSameFacing = 0.9F;
/// What lies k beams beside a point is farther from it than k - .5 arcs, less what the sine of that
/// angle is short of it: this share of its square remains up to a radian.
constexpr float kOfArc = 0.7F;

/// Looks for partners among the returns of one reference.
class PartnerSearch {
 public:
  PartnerSearch(const ScanSurface& reference, double reach)
      : returns_(reference.returns()),
        most_beside_(std::min(ScanSurface::kBeside, reference.beams() - 1)),
        reach_sq_(static_cast<float>(reach * reach)),
        arc_sq_(kOfArc * static_cast<float>(reference.spacing * reference.spacing)) {}

  /// The nearest return to one of the query, in the frame of the reference, facing as it does;
  /// nullptr: none. Beams are asked from the one that looks there outwards, until none can be
  /// nearer.
  const PackedReturn* partnerOf(const PackedReturn& seen, int beam) const {
    const PackedReturn* towards = returns_ + beam;
    Nearest nearest{nullptr, reach_sq_};
    ask(seen, towards, nearest);
    const float arc_sq = arc_sq_ * (seen.x * seen.x + seen.y * seen.y);
    for (int k = 1; k <= most_beside_; ++k) {
      const float before = static_cast<float>(k) - 0.5F;
      if (before * before * arc_sq >= nearest.apart_sq) break;
      ask(seen, towards - k, nearest);
      ask(seen, towards + k, nearest);
    }
    return nearest.single;
  }

 private:
  struct Nearest {
    const PackedReturn* single;
    float apart_sq;
  };
  static void ask(const PackedReturn& seen, const PackedReturn* single, Nearest& nearest) {
    const float dx = single->x - seen.x, dy = single->y - seen.y;
    const float apart_sq = dx * dx + dy * dy;
    if (apart_sq >= nearest.apart_sq) return;
    if (single->normal_x * seen.normal_x + single->normal_y * seen.normal_y < kSameFacing) return;
    nearest = {single, apart_sq};
  }

  const PackedReturn* returns_;
  int most_beside_;
  float reach_sq_, arc_sq_;
};

/// The returns that found a partner in one reference, in its frame: distance e along the partner's
/// normal n, and how e changes as the query turns about its sensor.
struct Pairs {
  explicit Pairs(std::size_t count)
      : of(count), e(count), normal_x(count), normal_y(count), turn(count) {}
  void shorten(std::size_t count) {
    of.resize(count);
    for (std::vector<float>* column : {&e, &normal_x, &normal_y, &turn}) column->resize(count);
  }
  std::vector<std::int32_t> of;  ///< number of the return
  std::vector<float> e, normal_x, normal_y, turn;
};

Pairs pairsWith(const ScanSurface& reference, const PackedPoints& query,
                const Pose2& T_reference_query, double reach) {
  const std::size_t count = query.size();
  Pairs pairs(count);
  const PackedMotion motion(T_reference_query);
  const SeenPoints seen(query, motion, reference);
  const PartnerSearch search(reference, reach);
  std::size_t found = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const float nx = query.normal_x[k], ny = query.normal_y[k];
    if (seen.beam[k] < 0 || (nx == 0.0F && ny == 0.0F)) continue;
    const float x = seen.x[k], y = seen.y[k];
    const PackedReturn* partner = search.partnerOf(
        {x, y, motion.c * nx - motion.s * ny, motion.s * nx + motion.c * ny}, seen.beam[k]);
    if (!partner) continue;
    const float to_x = partner->normal_x, to_y = partner->normal_y;
    pairs.of[found] = static_cast<std::int32_t>(k);
    pairs.e[found] = to_x * (x - partner->x) + to_y * (y - partner->y);
    pairs.normal_x[found] = to_x;
    pairs.normal_y[found] = to_y;
    pairs.turn[found] = to_y * (x - motion.x) - to_x * (y - motion.y);
    ++found;
  }
  pairs.shorten(found);
  return pairs;
}

/// Four distances at a time.
using Four = Eigen::Array4f;
Four fourOf(const std::vector<float>& column, std::size_t first) {
  return Eigen::Map<const Four>(column.data() + first);
}

/// Adds the distances to one reference, each weighed by the kernel and by `shares`, to a quadric in
/// the axes of the map; without the information that all returns share.
void addPairs(Pairs& pairs, std::vector<float>& shares, double weight_of_sigma, double theta,
              MatchQuadric& quadric) {
  const std::size_t whole = (pairs.e.size() + 3) / 4 * 4;  // the last ones have no weight
  for (std::vector<float>* column :
       {&pairs.e, &pairs.normal_x, &pairs.normal_y, &pairs.turn, &shares})
    column->resize(whole, 0.0F);
  const float per_square = static_cast<float>(weight_of_sigma);
  Four xx = Four::Zero(), xy = xx, xt = xx, yy = xx, yt = xx, tt = xx;
  Four gx = xx, gy = xx, gt = xx, weights = xx, squares = xx;
  for (std::size_t k = 0; k < whole; k += 4) {
    const Four e = fourOf(pairs.e, k), nx = fourOf(pairs.normal_x, k);
    const Four ny = fourOf(pairs.normal_y, k), turn = fourOf(pairs.turn, k);
    const Four weight = fourOf(shares, k) / (1.0F + per_square * e * e);
    const Four wx = weight * nx, wy = weight * ny, wt = weight * turn, we = weight * e;
    xx += wx * nx;
    xy += wx * ny;
    xt += wx * turn;
    yy += wy * ny;
    yt += wy * turn;
    tt += wt * turn;
    gx += wx * e;
    gy += wy * e;
    gt += wt * e;
    weights += weight;
    squares += we * e;
  }
  Eigen::Matrix3d H;
  H << xx.sum(), xy.sum(), xt.sum(), xy.sum(), yy.sum(), yt.sum(), xt.sum(), yt.sum(), tt.sum();
  Eigen::Matrix3d to_map = Eigen::Matrix3d::Identity();
  to_map.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(theta).toRotationMatrix();
  quadric.H += to_map * H * to_map.transpose();
  quadric.g += to_map * Eigen::Vector3d(gx.sum(), gy.sum(), gt.sum());
  quadric.sum_weights += weights.sum();
  quadric.sum_sq += squares.sum();
}

PackedPoints everyOf(const PackedPoints& points, int stride) {
  const auto step = static_cast<std::size_t>(stride);
  PackedPoints some;
  some.resize((points.size() + step - 1) / step);
  for (std::size_t k = 0; k < some.size(); ++k) some.set(k, points.at(k * step));
  return some;
}

/// The pairs of all references, and of each return how many there are.
struct PairsOfAll {
  PairsOfAll(const PackedPoints& points, const Pose2& T_map_query,
             const std::vector<PlacedSurface>& references, double reach)
      : partners(points.size(), 0) {
    of_reference.reserve(references.size());
    for (const PlacedSurface& placed : references) {
      of_reference.push_back(
          pairsWith(*placed.surface, points, placed.T_map_sensor.inverse() * T_map_query, reach));
      for (const std::int32_t k : of_reference.back().of) ++partners[static_cast<std::size_t>(k)];
    }
  }
  int paired() const {
    return static_cast<int>(partners.size() - std::count(partners.begin(), partners.end(), 0));
  }
  std::vector<Pairs> of_reference;
  std::vector<int> partners;
};

/// @param weight_of  of return k.
template <class WeightOf>
MatchQuadric sumPairs(PairsOfAll& pairs, const std::vector<PlacedSurface>& references,
                      const MatchScale& scale, const WeightOf& weight_of) {
  MatchQuadric quadric;
  const double weight_of_sigma = 1.0 / (scale.sigma * scale.sigma);
  std::vector<float> shares;
  for (std::size_t r = 0; r < references.size(); ++r) {
    // Each return counts once, however many references saw its place.
    shares.clear();
    for (const std::int32_t of : pairs.of_reference[r].of) {
      const auto k = static_cast<std::size_t>(of);
      shares.push_back(weight_of(k) / static_cast<float>(pairs.partners[k]));
    }
    addPairs(pairs.of_reference[r], shares, weight_of_sigma, references[r].T_map_sensor.theta,
             quadric);
  }
  const double information = kIndependent * weight_of_sigma * scale.stride;
  quadric.paired = pairs.paired() * scale.stride;
  quadric.H *= information;
  quadric.g *= information;
  quadric.sum_weights *= scale.stride;
  quadric.sum_sq *= scale.stride;
  return quadric;
}

}  // namespace

MatchQuadric matchQuadric(const ScanSurface& query, const Pose2& T_map_query,
                          const std::vector<PlacedSurface>& references, const MatchScale& scale) {
  PackedPoints some;
  if (scale.stride > 1) some = everyOf(query.packed, scale.stride);
  const PackedPoints& points = scale.stride > 1 ? some : query.packed;
  PairsOfAll pairs(points, T_map_query, references, scale.reach);
  return sumPairs(pairs, references, scale, [](std::size_t) { return 1.0F; });
}

SweepQuadric sweepQuadric(const PackedPoints& query, const SweepShares& shares,
                          const Pose2& T_map_query, const std::vector<PlacedSurface>& references,
                          const MatchScale& scale) {
  PairsOfAll pairs(query, T_map_query, references, scale.reach);
  const std::vector<float> whole(query.size(), 1.0F);
  const std::array<const std::vector<float>*, 3> parts{&whole, &shares.before, &shares.after};
  SweepQuadric quadric;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = i; j < 3; ++j) {
      const std::vector<float>&a = *parts[static_cast<std::size_t>(i)],
            &b = *parts[static_cast<std::size_t>(j)];
      const MatchQuadric mixed =
          sumPairs(pairs, references, scale, [&](std::size_t k) { return a[k] * b[k]; });
      quadric.H.block<3, 3>(3 * i, 3 * j) = quadric.H.block<3, 3>(3 * j, 3 * i) = mixed.H;
      if (i == 0) quadric.g.segment<3>(3 * j) = mixed.g;
    }
  }
  quadric.paired = pairs.paired() * scale.stride;
  return quadric;
}

}  // namespace cca
