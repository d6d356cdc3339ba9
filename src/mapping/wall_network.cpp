// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/wall_network.hpp"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "cca_mrpt/sensing/range_noise.hpp"
#include "geometry/cross.hpp"

namespace cca {
namespace {

using SparseFactor = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>;

constexpr double kPatch = 2.0;  // m, about: walls of 20 m as one unknown are too stiff
/// Fewer returns are no sighting of a patch.
constexpr double kFewestReturns = 0.5;
/// Where nothing else does, this holds poses and walls: to a hundred metres and as many radians.
constexpr double kVague = 1e-4;

/// Deviations at which a sighting counts by half (Cauchy's weight): where errors are normal, 95 %
/// as efficient as least squares [Holland & Welsch 1977].
constexpr double kHalfBelieved = 2.385;

/// Of the adjustment's own deviations, that a map lies off it sideways: where sweeps are undone and
/// noise grows with range, the adjustment itself goes astray by ten of them, the map by one or two.
constexpr double kMostAstray = 3.0;

/// m^2, rad^2, of a wall that nothing ties to the others: no pose errs by more, or it is lost.
const Eigen::Vector2d kLeastKnown(0.09, 0.01);

/// A wall in patches of equal length.
struct Patches {
  explicit Patches(const Wall& wall) : first(extentOf(wall).first) {
    const double whole = extentOf(wall).length();
    number = std::max(1, static_cast<int>(std::lround(whole / kPatch)));
    length = whole / number;
  }
  double begin(int k) const { return first + k * length; }
  double middle(int k) const { return first + (k + 0.5) * length; }
  int at(double t) const {
    return std::clamp(static_cast<int>((t - first) / length), 0, number - 1);
  }
  double first, length;  ///< m along the wall
  int number;
};

/// A sighting of a patch: seen = by_patch (offset, angle) + by_pose (x, y, angle), of its unknowns.
struct Equation {
  int patch;
  Eigen::Vector2d seen;  ///< offset [m] and direction [rad] against the map's line
  Eigen::Matrix2d information, by_patch;
  Eigen::Matrix<double, 2, 3> by_pose;
};

/// The elements of the inverse where the factor L is not zero, in its order of elimination
/// [Takahashi et al. 1973].
Eigen::SparseMatrix<double> selectedInverse(const Eigen::SparseMatrix<double>& L) {
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): written through its iterators
  Eigen::SparseMatrix<double> inverse = L;
  std::vector<double> column(static_cast<std::size_t>(L.rows()), 0.0);
  using Iterator = Eigen::SparseMatrix<double>::InnerIterator;
  for (Eigen::Index j = L.cols() - 1; j >= 0; --j) {
    const double pivot = L.coeff(j, j);
    std::vector<Eigen::Index> rows;
    std::vector<double> factors;
    for (Iterator at(L, j); at; ++at) {
      if (at.row() == j) continue;
      rows.push_back(at.row());
      factors.push_back(at.value() / pivot);
    }
    std::vector<double> sums(rows.size(), 0.0);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      // inverse(row, rows[k]) for all rows of this column at once: L's pattern holds them.
      for (Iterator at(inverse, rows[k]); at; ++at) column[at.row()] = at.value();
      for (std::size_t i = k; i < rows.size(); ++i) {
        sums[i] -= factors[k] * column[rows[i]];
        if (i != k) sums[k] -= factors[i] * column[rows[i]];
      }
      for (Iterator at(inverse, rows[k]); at; ++at) column[at.row()] = 0.0;
    }
    double own = 1.0 / (pivot * pivot);
    for (std::size_t i = 0; i < rows.size(); ++i) own -= factors[i] * sums[i];
    for (Iterator at(inverse, j); at; ++at) {
      if (at.row() == j) {
        at.valueRef() = own;
      } else {
        const auto found = std::lower_bound(rows.begin(), rows.end(), at.row());
        at.valueRef() = sums[static_cast<std::size_t>(found - rows.begin())];
      }
    }
  }
  return inverse;
}

}  // namespace

/// The unknowns of the walls, and their normal equations with all poses eliminated.
class WallNetwork::Adjustment {
 public:
  Adjustment(const Walls& walls, const MapNoise& noise) : walls_(walls), noise_(noise) {}

  void add(const Station& station, bool is_held);
  bool isEmpty() const { return patches_.empty(); }
  /// False where the equations cannot be solved.
  bool solve();
  /// Covariance of two patches' unknowns; zero where nothing ties them.
  Eigen::Matrix2d covariance(int a, int b) const;
  /// How far off the map the adjusted patch lies: offset [m], direction [rad].
  Eigen::Vector2d correction(int patch) const { return corrections_.segment<2>(2 * patch); }
  /// The number of each wall's patches that are sighted.
  const std::map<std::pair<Walls::Slot, int>, int>& patches() const { return patches_; }

 private:
  void addSighting(const Sighting& sighting, const Eigen::Vector2d& station,
                   std::vector<Equation>* equations);
  void addBlock(int i, int j, const Eigen::Matrix2d& block) {
    if (i < j) return;
    auto [at, is_new] =
        normal_.try_emplace(i * (std::int64_t{1} << 32) + j, Eigen::Matrix2d::Zero());
    at->second += block;
  }

  Eigen::Vector2d& rightSide(const Equation& e) {
    return right_side_[static_cast<std::size_t>(e.patch)];
  }

  const Walls& walls_;
  const MapNoise& noise_;
  std::map<std::pair<Walls::Slot, int>, int> patches_;
  std::unordered_map<std::int64_t, Eigen::Matrix2d> normal_;  ///< lower blocks
  std::vector<Eigen::Vector2d> right_side_;                   ///< of each patch
  Eigen::VectorXd corrections_;
  Eigen::SparseMatrix<double> inverse_;
  Eigen::VectorXi place_;  ///< of each unknown in the order of elimination
};

/// The returns of a sighting are spread evenly over the angle that it is seen under: far patches
/// have few. A line that lies off the map, merged or cut otherwise, tells less.
void WallNetwork::Adjustment::addSighting(const Sighting& s, const Eigen::Vector2d& station,
                                          std::vector<Equation>* equations) {
  Walls::Slot slot = -1;
  for (const double share : {0.5, 0.25, 0.75}) {  // a door may be in the middle
    const Eigen::Vector2d p = s.start + share * (s.end - s.start);
    if (slot < 0) slot = walls_.hitBy(p, station, kGates * noise_.lateralSigma());
  }
  if (slot < 0) return;
  const Wall& wall = walls_[slot];
  const Eigen::Vector2d u = wall.fittedDirection();
  const Eigen::Vector2d start = wall.toWall(s.start), end = wall.toWall(s.end);
  const auto [from, to] = std::minmax({start.x(), end.x()});
  const double slope = (end.y() - start.y()) / (end.x() - start.x());
  const auto angleOf = [&](double a, double b) {
    const Eigen::Vector2d v = wall.onLine(a) - station, w = wall.onLine(b) - station;
    return std::abs(std::atan2(cross(v, w), v.dot(w)));
  };
  const double whole = angleOf(from, to);
  const Patches patches(wall);
  for (int k = patches.at(from); k <= patches.at(to); ++k) {
    const double first = std::max(from, patches.begin(k));
    const double last = std::min(to, patches.begin(k + 1));
    const double length = last - first;
    if (!(length > 0.0)) continue;
    const double returns = s.returns * angleOf(first, last) / whole;
    if (returns < kFewestReturns) continue;
    const int next = static_cast<int>(patches_.size());
    const double t = 0.5 * (first + last), offset = noise_.rangeVariance() / returns;
    const double off = start.y() + slope * (t - start.x()) - wall.fit.at(t);
    Equation e{patches_.try_emplace({slot, k}, next).first->second,
               {off, std::atan(slope) - std::atan(wall.fit.slope)},
               Eigen::Matrix2d::Zero(),
               Eigen::Matrix2d::Identity(),
               {}};
    const Eigen::Array2d exact(1.0 / offset, length * length / (12.0 * offset));
    const Eigen::Array2d squares = exact * e.seen.array().square();
    e.information.diagonal() = exact / (1.0 + squares / (kHalfBelieved * kHalfBelieved));
    e.by_patch(0, 1) = t - patches.middle(k);
    e.by_pose << -u.y(), u.x(), u.dot(wall.onLine(t) - station), 0.0, 0.0, 1.0;
    equations->push_back(e);
  }
}

void WallNetwork::Adjustment::add(const Station& station, bool is_held) {
  std::vector<Equation> equations;
  for (const Sighting& s : station.sightings) addSighting(s, station.position, &equations);
  right_side_.resize(patches_.size(), Eigen::Vector2d::Zero());
  Eigen::Matrix3d own = kVague * Eigen::Matrix3d::Identity();
  Eigen::Vector3d seen = Eigen::Vector3d::Zero();
  std::vector<Eigen::Matrix<double, 2, 3>> mixed;
  for (const Equation& e : equations) {
    rightSide(e) += e.by_patch.transpose() * e.information * e.seen;
    seen += e.by_pose.transpose() * e.information * e.seen;
    addBlock(e.patch, e.patch, e.by_patch.transpose() * e.information * e.by_patch);
    mixed.emplace_back(e.by_patch.transpose() * e.information * e.by_pose);
    own += e.by_pose.transpose() * e.information * e.by_pose;
  }
  if (is_held) return;
  const Eigen::Matrix3d covariance = own.inverse();
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    const Eigen::Matrix<double, 2, 3> through = -mixed[i] * covariance;
    rightSide(equations[i]) += through * seen;
    for (std::size_t j = 0; j < mixed.size(); ++j) {
      addBlock(equations[i].patch, equations[j].patch, through * mixed[j].transpose());
    }
  }
}

bool WallNetwork::Adjustment::solve() {
  std::vector<Eigen::Triplet<double>> triplets;
  for (const auto& [key, block] : normal_) {
    const auto i = 2 * static_cast<int>(key >> 32), j = 2 * static_cast<int>(key & 0xffffffff);
    for (int r = 0; r < 2; ++r) {
      for (int c = 0; c < 2; ++c) {
        triplets.emplace_back(i + r, j + c, block(r, c) + (i == j && r == c ? kVague : 0.0));
      }
    }
  }
  const auto unknowns = static_cast<Eigen::Index>(2 * patches_.size());
  Eigen::SparseMatrix<double> normal(unknowns, unknowns);
  normal.setFromTriplets(triplets.begin(), triplets.end());
  const SparseFactor factor(normal);
  if (factor.info() != Eigen::Success) return false;
  corrections_ = factor.solve(Eigen::Map<const Eigen::VectorXd>(right_side_[0].data(), unknowns));
  inverse_ = selectedInverse(factor.matrixL());
  place_ = factor.permutationP().indices();
  return true;
}

Eigen::Matrix2d WallNetwork::Adjustment::covariance(int a, int b) const {
  Eigen::Matrix2d block;
  for (int r = 0; r < 2; ++r) {
    for (int c = 0; c < 2; ++c) {
      const auto [low, high] = std::minmax(place_[2 * a + r], place_[2 * b + c]);
      block(r, c) = inverse_.coeff(high, low);
    }
  }
  return block;
}

void WallNetwork::add(const Pose2& T_map_sensor, const std::vector<NewLine>& lines) {
  Station station{T_map_sensor.position(), {}};
  for (const NewLine& line : lines) {
    if (line.wall < 0) continue;
    station.sightings.push_back(
        {line.segment.start, line.segment.end, line.segment.moments.weight});
  }
  stations_.push_back(std::move(station));
}

void WallNetwork::settle(const MapNoise& noise, Walls& walls) const {
  Adjustment adjustment(walls, noise);
  for (const Station& station : stations_) adjustment.add(station, adjustment.isEmpty());
  if (adjustment.isEmpty() || !adjustment.solve()) return;
  const auto& patches = adjustment.patches();
  Eigen::Vector2d worst = Eigen::Vector2d::Zero();
  for (auto first = patches.begin(); first != patches.end();) {
    const Walls::Slot slot = first->first.first;
    Wall& wall = walls[slot];
    const Patches along(wall);
    auto last = first;
    double count = 0.0, sum = 0.0;
    for (; last != patches.end() && last->first.first == slot; ++last) {
      count += 1.0;
      sum += along.middle(last->first.second);
    }
    // The line through all patches, each of them a stretch of its own offset and direction.
    wall.known_at = sum / count;
    const double own = along.length * along.length / 12.0;  // m^2, spread of a patch
    const auto armOf = [&](const auto& at) {
      return along.middle(at->first.second) - wall.known_at;
    };
    double spread = 0.0;
    for (auto at = first; at != last; ++at) spread += armOf(at) * armOf(at) + own;
    const auto shareOf = [&](const auto& at) {
      Eigen::Matrix2d share;
      share << 1.0 / count, 0.0, armOf(at) / spread, own / spread;
      return share;
    };
    wall.pose_covariance.setZero();
    Eigen::Vector2d off = Eigen::Vector2d::Zero();
    for (auto a = first; a != last; ++a) {
      off += shareOf(a) * adjustment.correction(a->second);
      for (auto b = first; b != last; ++b) {
        wall.pose_covariance +=
            shareOf(a) * adjustment.covariance(a->second, b->second) * shareOf(b).transpose();
      }
    }
    const double astray = kMostAstray * kMostAstray * wall.pose_covariance(0, 0);
    off.x() /= std::sqrt(1.0 + off.x() * off.x() / astray);
    wall.pose_covariance += off * off.transpose();
    worst = worst.cwiseMax(wall.pose_covariance.diagonal()).cwiseMin(kLeastKnown);
    first = last;
  }
  // What no station is known to have sighted is known no better than anything else.
  for (Walls::Slot slot = 0; slot < static_cast<Walls::Slot>(walls.all().size()); ++slot) {
    Wall& wall = walls[slot];
    if (!wall.alive || !wall.pose_covariance.isZero()) continue;
    wall.pose_covariance = worst.asDiagonal();
    wall.known_at = 0.5 * (extentOf(wall).first + extentOf(wall).last);
  }
}

}  // namespace cca
