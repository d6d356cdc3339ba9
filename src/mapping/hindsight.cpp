// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/hindsight.hpp"

#include "cca_mrpt/sensing/range_noise.hpp"
#include "mapping/laser_evidence.hpp"

namespace cca {
namespace {

/// Visits the returns of a scan, each with the wall that it is a hit of as the walls stand.
template <class Visit>  // (return, m, map frame; slot)
void visitHits(const Scan& scan, const std::vector<Eigen::Vector2d>& beams, double gate,
               const Walls& standing, const Visit& visit) {
  const Eigen::Vector2d viewpoint = scan.T_map_sensor.position();
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    if (!isUsableReturn(scan.ranges[beam])) continue;
    const Eigen::Vector2d p = viewpoint + scan.ranges[beam] * beams[beam];
    const Walls::Slot slot = standing.hitBy(p, viewpoint, gate);
    if (slot >= 0) visit(p, slot);
  }
}

/// Removes walls most of whose returns more likely came from others, which scattered them: a few
/// returns from far away found lines askew, and those have what comes to lie on them.
void removeScattered(const std::vector<PastScans::Kept>& scans, const MapNoise& noise, double gate,
                     Walls& walls) {
  std::vector<int> surplus(walls.all().size(), 0);  // of returns of their own
  for (const PastScans::Kept& kept : scans) {
    const Scan& scan = kept.seen.scan;
    const Eigen::Vector2d viewpoint = scan.T_map_sensor.position();
    visitHits(scan, beamDirections(scan), gate, walls,
              [&](const Eigen::Vector2d& p, Walls::Slot slot) {
                surplus[static_cast<std::size_t>(slot)] +=
                    walls.likelyHitBy(p, viewpoint, noise) == slot ? 1 : -1;
              });
  }
  for (std::size_t i = 0; i < surplus.size(); ++i)
    if (surplus[i] < 0) walls.remove(static_cast<Walls::Slot>(i));
}

/// What only scans that were not kept have seen stays, where no ray of those kept went through.
void keepUnconfirmed(const Walls& standing, Walls& walls) {
  const auto slots = static_cast<Walls::Slot>(standing.all().size());
  for (Walls::Slot slot = 0; slot < slots; ++slot) {
    const Wall& before = standing[slot];
    if (!before.alive) continue;
    Wall& wall = walls[slot];
    for (int i = before.profile.first(); i < before.profile.last(); ++i) {
      SupportBin seen = before.profile.bin(i);
      const SupportBin& now = wall.profile.bin(i);
      if (seen.hits() <= 0.0 || now.hits() > 0.0 || now.passed > 0.0) continue;
      seen.passed = 0.0;
      wall.profile.add(seen);
      wall.hits += seen.hits();
    }
  }
}

}  // namespace

void reassignEvidence(const std::vector<PastScans::Kept>& scans, const MapNoise& noise,
                      bool uses_rays, Walls& walls) {
  const double gate = kGates * noise.lateralSigma();
  removeScattered(scans, noise, gate, walls);
  const Walls standing = walls;
  const auto slots = static_cast<Walls::Slot>(walls.all().size());
  for (Walls::Slot slot = 0; slot < slots; ++slot) {
    if (!walls[slot].alive) continue;
    walls[slot].profile.forget();
    walls[slot].hits = walls[slot].hits_at_check = 0.0;
    walls[slot].length_at_check = 0;
    walls.touch(slot);
  }
  for (const PastScans::Kept& kept : scans) {
    const Scan& scan = kept.seen.scan;
    const std::vector<Eigen::Vector2d> beams = beamDirections(scan);
    visitHits(scan, beams, gate, standing, [&](const Eigen::Vector2d& p, Walls::Slot slot) {
      Wall& wall = walls[slot];
      const Eigen::Vector2d td = wall.toWall(p);
      wall.profile.hit(td.x(), td.y());
      wall.hits += 1.0;
    });
    if (uses_rays) passRays(scan, beams, noise, walls);
  }
  keepUnconfirmed(standing, walls);
}

}  // namespace cca
