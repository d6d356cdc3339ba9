// SPDX-License-Identifier: BSD-3-Clause
#include "evidence/tuning_design.hpp"

#include <cmath>
#include <sstream>

#include "cca_mrpt/mapping/line_extraction.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "evaluation/world_score.hpp"
#include "evidence/extraction_score.hpp"
#include "evidence/tour.hpp"
#include "io/lines/segments_csv.hpp"

namespace cca::evidence {
namespace {

template <class T>
void list(std::ostream& out, const char* name, const std::vector<T>& values) {
  out << ' ' << name << '=';
  for (std::size_t i = 0; i < values.size(); ++i) out << (i ? "|" : "") << values[i];
}

Pose2 erring(const Pose2& T, const TuningDesign& design, Random& random) {
  const double x = T.x + design.pose_noise * random.normal();
  const double y = T.y + design.pose_noise * random.normal();
  const double turn = design.heading_noise_deg * M_PI / 180.0 * random.normal();
  return {x, y, wrapAngle(T.theta + turn)};
}

/// Per wall, the stretch that the sweeps have seen: what a map of this tour can hold.
void widen(std::vector<std::pair<double, double>>& seen, const std::vector<Segment2>& walls,
           const LabelledScan& sweep, const Pose2& T_map_sensor) {
  for (const Segment2& edge : sweep.edges) {
    const Eigen::Vector2d a = T_map_sensor * edge.start, b = T_map_sensor * edge.end;
    for (std::size_t k = 0; k < walls.size(); ++k) {
      if (distance(a, walls[k]) > 1e-6 || distance(b, walls[k]) > 1e-6) continue;
      const double length = walls[k].length();
      const Eigen::Vector2d u = (walls[k].end - walls[k].start) / length;
      const double s = u.dot(a - walls[k].start), t = u.dot(b - walls[k].start);
      seen[k].first = std::min(seen[k].first, std::min(s, t));
      seen[k].second = std::max(seen[k].second, std::max(s, t));
    }
  }
}

}  // namespace

std::string TuningDesign::signature() const {
  std::ostringstream out;
  out << "# tune";
  list(out, "similarity_cut", similarity_cut);
  list(out, "vertex_price", vertex_price);
  list(out, "straightness", straightness);
  list(out, "worlds", worlds);
  list(out, "noises", noises);
  out << " seeds=" << seeds << " scans=" << scans << " poses=" << poses
      << " pose_noise=" << pose_noise << " heading_noise_deg=" << heading_noise_deg;
  return out.str();
}

TuningJob tuningJob(const TuningDesign& d, std::size_t index) {
  TuningJob job;
  job.index = index;
  job.scene = index / d.combinations();
  std::size_t rest = index % d.combinations();
  job.parameters.straightness = d.straightness[rest % d.straightness.size()];
  rest /= d.straightness.size();
  job.parameters.vertex_price = d.vertex_price[rest % d.vertex_price.size()];
  rest /= d.vertex_price.size();
  job.parameters.similarity_cut = d.similarity_cut[rest];
  rest = job.scene;
  job.seed = static_cast<int>(rest % d.seeds) + 1;
  rest /= d.seeds;
  job.noise = d.noises[rest % d.noises.size()];
  job.world = d.worlds[rest / d.noises.size()];
  return job;
}

Scene makeScene(const TuningDesign& design, const TuningJob& job) {
  Sampling sampling;
  sampling.scans = design.scans;
  sampling.laser.range_noise = job.noise;
  sampling.seed = static_cast<std::uint64_t>(job.seed);
  Scene scene;
  scene.scans = sampleWorld(job.world, sampling);
  const std::vector<Segment2> walls = loadSegments(truthPath(job.world));
  std::vector<std::pair<double, double>> seen(walls.size(), {INFINITY, -INFINITY});
  Random random(sampling.seed * 7919u + static_cast<std::uint64_t>(std::llround(1e6 * job.noise)));
  for (const Pose2& T_map_sensor : tour(loadWorld(job.world), design.poses)) {
    LabelledScan sweep = sweepOverEdges(walls, T_map_sensor, sampling.laser, random);
    widen(seen, walls, sweep, T_map_sensor);
    sweep.scan.T_map_sensor = erring(T_map_sensor, design, random);
    scene.tour.push_back(std::move(sweep.scan));
  }
  for (std::size_t k = 0; k < walls.size(); ++k) {
    if (seen[k].first >= seen[k].second) continue;
    const Eigen::Vector2d u = (walls[k].end - walls[k].start) / walls[k].length();
    scene.walls.push_back(
        {walls[k].start + seen[k].first * u, walls[k].start + seen[k].second * u});
  }
  return scene;
}

TuningRow runJob(const TuningJob& job, const Scene& scene) {
  TuningRow row;
  row.job = job.index;
  for (const LabelledScan& labelled : scene.scans) {
    const auto lines = extractLines(labelled.scan, job.parameters);
    row.scan_f1 += scoreExtraction(labelled, lines).f1.value_or(0.0);
  }
  if (!scene.scans.empty()) row.scan_f1 /= static_cast<double>(scene.scans.size());
  LineMap map(job.parameters);
  for (const Scan& scan : scene.tour) map.insert(scan);
  std::vector<Segment2> segments;
  for (const MapLine& line : map.lines())
    segments.push_back({line.segment.start, line.segment.end});
  if (!segments.empty() && !scene.walls.empty()) {
    const double f1 = scoreAgainstWorld(scene.walls, segments).at("world").at("f1");
    if (std::isfinite(f1)) row.map_f1 = f1;
  }
  return row;
}

}  // namespace cca::evidence
