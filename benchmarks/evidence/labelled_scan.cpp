// SPDX-License-Identifier: BSD-3-Clause
#include "evidence/labelled_scan.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/simulation/world.hpp"
#include "geometry/cross.hpp"
#include "io/lines/segments_csv.hpp"

namespace cca::evidence {
namespace {

constexpr std::uint64_t kPlaces = 0x9e3779b97f4a7c15u;  // tells the streams of one seed apart
constexpr int kMostTrials = 200000;
constexpr double kFewestReturns = 0.25;  // of the beams; less: the place lies outside the building

/// Range along a ray to an edge and the place on it, 0 at its start, 1 at its end.
struct Hit {
  double range = std::numeric_limits<double>::infinity();
  double along = 0.0;
};

Hit meet(const Eigen::Vector2d& u, const Segment2& edge) {
  const Eigen::Vector2d d = edge.end - edge.start;
  const double across = cross(u, d);
  if (across == 0.0) return {};
  const double range = cross(edge.start, d) / across;
  const double along = cross(edge.start, u) / across;
  if (range <= 0.0 || along < 0.0 || along > 1.0) return {};
  return {range, along};
}

/// The stretch of an edge that rays have met.
struct Seen {
  double low = 1.0, high = 0.0;
  int rays = 0, first_beam = 0, last_beam = 0;

  void add(const Seen& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
    rays += other.rays;
    last_beam = other.last_beam;
  }
};

/// The stretches of one edge, by beam.
class Stretches {
 public:
  void meet(double along, int beam, HiddenWalls rule) {
    const bool goes_on =
        !seen_.empty() && (rule == HiddenWalls::kWhole || seen_.back().last_beam + 1 == beam);
    if (!goes_on) seen_.push_back({1.0, 0.0, 0, beam, beam});
    seen_.back().add({along, along, 1, beam, beam});
  }
  /// Joins what the seam between the last beam and the first has cut.
  const std::vector<Seen>& close(int beams) {
    if (seen_.size() > 1 && seen_.front().first_beam == 0 && seen_.back().last_beam == beams - 1) {
      seen_.front().add(seen_.back());
      seen_.pop_back();
    }
    return seen_;
  }

 private:
  std::vector<Seen> seen_;
};

std::vector<Segment2> inFrame(const Pose2& T_map_sensor, const std::vector<Segment2>& edges_map) {
  const Pose2 T_sensor_map = T_map_sensor.inverse();
  std::vector<Segment2> edges;
  for (const Segment2& e : edges_map)
    edges.push_back({T_sensor_map * e.start, T_sensor_map * e.end});
  return edges;
}

double noisyReading(double range, const LaserParameters& laser, Random& random) {
  const double noise = laser.range_noise * random.normal();
  if (random.uniform() < laser.dropout) return std::numeric_limits<double>::quiet_NaN();
  if (range > laser.range) return std::numeric_limits<double>::infinity();
  const double reading = range + noise;
  return reading > 0.0 ? reading : std::numeric_limits<double>::quiet_NaN();
}

std::uint64_t noiseSeed(const Sampling& s) {
  return s.seed * 1000003u + static_cast<std::uint64_t>(std::llround(1e6 * s.laser.range_noise));
}

std::vector<Segment2> randomPolygon(Random& random) {
  const int corners = random.integer(3, 36);
  std::vector<double> bearings;
  while (true) {
    bearings.clear();
    for (int i = 0; i < corners; ++i) bearings.push_back(random.uniform(-M_PI, M_PI));
    std::sort(bearings.begin(), bearings.end());
    double widest = bearings.front() + 2.0 * M_PI - bearings.back();
    for (int i = 1; i < corners; ++i) widest = std::max(widest, bearings[i] - bearings[i - 1]);
    if (widest < 0.9 * M_PI) break;  // else the sensor would stand outside, or nearly
  }
  std::vector<Eigen::Vector2d> vertices;
  for (const double bearing : bearings) {
    const double range = random.uniform(2.0, 10.0);
    vertices.emplace_back(range * std::cos(bearing), range * std::sin(bearing));
  }
  std::vector<Segment2> edges;
  for (int i = 0; i < corners; ++i) edges.push_back({vertices[i], vertices[(i + 1) % corners]});
  return edges;
}

}  // namespace

LabelledScan sweepOverEdges(const std::vector<Segment2>& edges_map, const Pose2& T_map_sensor,
                            const LaserParameters& laser, Random& random,
                            HiddenWalls hidden_walls) {
  const std::vector<Segment2> edges = inFrame(T_map_sensor, edges_map);
  LabelledScan labelled;
  labelled.has_truth = true;
  Scan& scan = labelled.scan;
  const double view = laser.field_of_view_deg * M_PI / 180.0;
  scan.angle_min = -0.5 * view;
  scan.angle_increment = laser.beams > 1 ? view / (laser.beams - 1) : 0.0;
  scan.free_range_without_return = laser.range;
  scan.T_map_sensor = T_map_sensor;
  std::vector<Stretches> seen(edges.size());
  for (int beam = 0; beam < laser.beams; ++beam) {
    const double bearing = scan.bearing(static_cast<std::size_t>(beam)) +
                           laser.angle_noise_deg * M_PI / 180.0 * random.normal();
    const Eigen::Vector2d u(std::cos(bearing), std::sin(bearing));
    Hit nearest;
    std::size_t owner = 0;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Hit hit = meet(u, edges[k]);
      if (hit.range < nearest.range) nearest = hit, owner = k;
    }
    scan.ranges.push_back(noisyReading(nearest.range, laser, random));
    if (!isReturn(scan.ranges.back())) continue;
    seen[owner].meet(nearest.along, beam, hidden_walls);
  }
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Eigen::Vector2d d = edges[k].end - edges[k].start;
    for (const Seen& stretch : seen[k].close(laser.beams)) {
      if (stretch.rays < 2) continue;
      labelled.edges.push_back(
          {edges[k].start + stretch.low * d, edges[k].start + stretch.high * d});
      labelled.rays.push_back(stretch.rays);
    }
  }
  return labelled;
}

std::vector<LabelledScan> sampleWorld(const std::string& yaml_path, const Sampling& sampling) {
  const World world = loadWorld(yaml_path);
  const std::vector<Segment2> edges = loadSegments(truthPath(yaml_path));
  Random places(sampling.seed ^ kPlaces), noise(noiseSeed(sampling));
  const double width = world.width() * world.resolution();
  const double height = world.height() * world.resolution();
  std::vector<LabelledScan> scans;
  for (int trial = 0; static_cast<int>(scans.size()) < sampling.scans; ++trial) {
    if (trial == kMostTrials) {
      throw std::runtime_error(yaml_path + ": too few places are free enough for a scan");
    }
    const double x = places.uniform(0.0, width), y = places.uniform(0.0, height);
    const Eigen::Vector2d p = world.origin() + Eigen::Vector2d(x, y);
    const Pose2 T_map_sensor{p.x(), p.y(), places.uniform(-M_PI, M_PI)};
    if (world.clearance(p, sampling.clearance) < sampling.clearance) continue;
    LabelledScan labelled =
        sweepOverEdges(edges, T_map_sensor, sampling.laser, noise, sampling.hidden_walls);
    const auto returns =
        std::count_if(labelled.scan.ranges.begin(), labelled.scan.ranges.end(), isReturn);
    if (static_cast<double>(returns) < kFewestReturns * sampling.laser.beams) continue;
    labelled.source = world.name;
    scans.push_back(std::move(labelled));
  }
  return scans;
}

std::vector<LabelledScan> samplePolygons(const Sampling& sampling) {
  Random places(sampling.seed ^ kPlaces), noise(noiseSeed(sampling));
  LaserParameters laser = sampling.laser;
  laser.range = std::max(laser.range, 12.0);
  std::vector<LabelledScan> scans;
  for (int i = 0; i < sampling.scans; ++i) {
    scans.push_back(
        sweepOverEdges(randomPolygon(places), Pose2{}, laser, noise, sampling.hidden_walls));
    scans.back().source = "polygons";
  }
  return scans;
}

std::vector<LabelledScan> sampleLog(const std::string& path, int scans) {
  const auto reader = openUndistortedLog(path);
  std::vector<Scan> all;
  while (auto record = reader->next()) all.push_back(std::move(record->scan));
  const auto wanted = std::min<std::size_t>(all.size(), static_cast<std::size_t>(scans));
  std::vector<LabelledScan> sample;
  for (std::size_t k = 0; k < wanted; ++k) {
    LabelledScan labelled;
    labelled.source = std::filesystem::path(path).filename().string();
    labelled.scan = std::move(all[k * all.size() / wanted]);
    sample.push_back(std::move(labelled));
  }
  return sample;
}

}  // namespace cca::evidence
