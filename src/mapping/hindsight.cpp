// SPDX-License-Identifier: BSD-3-Clause
#include "hindsight.hpp"

#include <cmath>

#include "cca_mrpt/mapping/laser_evidence.hpp"
#include "cca_mrpt/sensing/range_noise.hpp"

namespace cca {
namespace {

/// The returns of a scan, each to the wall that it is a hit of as the walls stand.
void depositOnStanding(const Scan& scan, const std::vector<Eigen::Vector2d>& beams, double gate,
                       const Walls& standing, Walls& walls) {
  const Eigen::Vector2d viewpoint = scan.T_map_sensor.position();
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (!isUsableReturn(scan.ranges[beam])) continue;
    const Eigen::Vector2d p = viewpoint + scan.ranges[beam] * beams[beam];
    const Walls::Slot slot = standing.hitBy(p, viewpoint, gate);
    if (slot < 0) continue;
    Wall& wall = walls[slot];
    const Eigen::Vector2d td = wall.toWall(p);
    wall.profile.hit(td.x(), td.y());
    wall.hits += 1.0;
  }
}

}  // namespace

void reassignEvidence(const std::vector<PastScans::Kept>& scans, const MapNoise& noise,
                      bool uses_rays, Walls& walls) {
  const Walls standing = walls;
  const auto slots = static_cast<Walls::Slot>(walls.all().size());
  for (Walls::Slot slot = 0; slot < slots; ++slot) {
    if (!walls[slot].alive) continue;
    walls[slot].profile.forget();
    walls[slot].hits = walls[slot].hits_at_check = 0.0;
    walls[slot].length_at_check = 0;
    walls.touch(slot);
  }
  const double gate = kGates * noise.lateralSigma();
  for (const PastScans::Kept& kept : scans) {
    const Scan& scan = kept.seen.scan;
    const std::vector<Eigen::Vector2d> beams = beamDirections(scan);
    depositOnStanding(scan, beams, gate, standing, walls);
    if (uses_rays) passRays(scan, beams, noise, walls);
  }
}

}  // namespace cca
