// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/scan_agreement.hpp"

#include <algorithm>
#include <cmath>

#include "mapping/walls.hpp"

namespace cca {
namespace {

constexpr std::size_t kMostBeams = 90;  // evenly over the scan: more say the same
constexpr double kOnWall = 0.15;        // m, across it; a ray has gone through from twice that on
constexpr double kFewestHits = 10.0;    // of a bin, for the wall to stand there
constexpr double kMemory = 0.998;       // of one scan: what is 500 scans old counts a third
/// Returns taken for confirmed beforehand, those of some twenty scans: one odd scan is no evidence.
constexpr double kBenefitOfDoubt = 1000.0;

bool stands(const Wall& wall, double t) {
  const int i = SupportProfile::binOf(t);
  return wall.profile.contains(i) && wall.profile.bin(i).hits() >= kFewestHits &&
         wall.profile.occupied(i);
}

bool isOn(const Wall& wall, const Eigen::Vector2d& p_map) {
  const Eigen::Vector2d td = wall.toWall(p_map);
  return std::abs(wall.offLine(td)) < kOnWall && stands(wall, td.x());
}

/// Whether the way from the sensor to a return leads through a place where the wall stands.
bool isCrossed(const Wall& wall, const Eigen::Vector2d& origin, const Eigen::Vector2d& hit) {
  const Eigen::Vector2d from = wall.toWall(origin), to = wall.toWall(hit);
  const double off_from = wall.offLine(from), off_to = wall.offLine(to);
  if ((off_from > 0.0) == (off_to > 0.0)) return false;
  if (std::abs(off_to) < 2.0 * kOnWall || std::abs(off_from) < kBlindCompared) return false;
  const double t = from.x() + (to.x() - from.x()) * off_from / (off_from - off_to);
  return stands(wall, t) && stands(wall, t - kRimOfWall) && stands(wall, t + kRimOfWall);
}

}  // namespace

ScanVerdict compareWithMap(const Scan& scan, const Walls& walls) {
  ScanVerdict verdict;
  const Eigen::Vector2d origin = scan.T_map_sensor.position();
  const std::size_t step = 1 + scan.size() / kMostBeams;
  std::vector<Walls::Slot> near;
  for (std::size_t beam = step / 2; beam < scan.size(); beam += step) {
    const double range = scan.ranges[beam];
    if (!isReturn(range) || range > kFarthestCompared) continue;
    const double angle = scan.T_map_sensor.theta + scan.bearing(beam);
    const Eigen::Vector2d hit = origin + range * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    if (!hit.allFinite()) continue;
    walls.near(origin, hit, near);
    const auto any = [&](auto&& test) {
      return std::any_of(near.begin(), near.end(), [&](Walls::Slot s) { return test(walls[s]); });
    };
    if (any([&](const Wall& wall) { return isOn(wall, hit); })) {
      ++verdict.confirmed;
    } else if (any([&](const Wall& wall) { return isCrossed(wall, origin, hit); })) {
      ++verdict.contradicted;
    }
  }
  return verdict;
}

void ScanAgreement::add(const ScanVerdict& verdict) {
  recent_.confirmed = kMemory * recent_.confirmed + verdict.confirmed;
  recent_.contradicted = kMemory * recent_.contradicted + verdict.contradicted;
  overall_.confirmed += verdict.confirmed;
  overall_.contradicted += verdict.contradicted;
}

double ScanAgreement::Sums::share() const {
  return 1.0 - contradicted / (confirmed + contradicted + kBenefitOfDoubt);
}

double ScanAgreement::recent() const { return recent_.share(); }
double ScanAgreement::overall() const { return overall_.share(); }

}  // namespace cca
