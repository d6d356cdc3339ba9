// SPDX-License-Identifier: BSD-3-Clause
// How well arcs are found in single scans: round pillars in rooms, and the gallery's curved walls.
// Prints the tables of docs/line_extraction.md: arc_benchmark [SCANS]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "cca_mrpt/mapping/line_extraction.hpp"
#include "cca_mrpt/simulation/world_generator.hpp"
#include "geometry/cross.hpp"
#include "simulation/random.hpp"

namespace cca {
namespace {

constexpr double kNear = 0.1;                    // m, as for lines (test of run.py's score)
constexpr double kAligned = 5.0 * M_PI / 180.0;  // rad, likewise
constexpr int kFewestRays = 5;                   // that a true feature has to receive, likewise
constexpr int kWellSeen = 8;                     // rays
constexpr double kResolution = 0.05, kClearance = 0.3, kLongest = 30.0;  // m
constexpr int kBeams = 361;

/// A curve as places and directions along it.
struct Curve {
  std::vector<Eigen::Vector2d> places, directions;

  void add(const Eigen::Vector2d& place, const Eigen::Vector2d& direction) {
    places.push_back(place);
    directions.push_back(direction);
  }
};

constexpr int kSamples = 40;

Curve curveOf(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  Curve curve;
  for (int i = 0; i < kSamples; ++i) {
    curve.add(from + (to - from) * ((i + 0.5) / kSamples), (to - from).normalized());
  }
  return curve;
}

Curve curveOf(const Arc& arc) {
  Curve curve;
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector2d place = arc.at((i + 0.5) / kSamples), out = place - arc.centre;
    curve.add(place, Eigen::Vector2d(-out.y(), out.x()).normalized());
  }
  return curve;
}

/// Share of a curve beside another, within both tolerances.
double shareBeside(const Curve& curve, const Curve& other) {
  int beside = 0;
  for (std::size_t i = 0; i < curve.places.size(); ++i) {
    bool found = false;
    for (std::size_t k = 0; k < other.places.size() && !found; ++k) {
      const Eigen::Vector2d apart = other.places[k] - curve.places[i];
      const double off = std::abs(cross(other.directions[k], apart));
      const double along = std::abs(other.directions[k].dot(apart));
      const double spacing = (other.places[1] - other.places[0]).norm();
      found = off < kNear && along <= spacing &&
              std::abs(cross(curve.directions[i], other.directions[k])) < std::sin(kAligned);
    }
    beside += found ? 1 : 0;
  }
  return static_cast<double>(beside) / static_cast<double>(curve.places.size());
}

/// A world of faces, each the chord of an arc of the plan or none (-1).
struct Faces {
  Building plan;
  World world;
  std::vector<WallFace> faces;
  std::vector<int> arc_of;

  explicit Faces(const Building& of)
      : plan(of), world(rasterise(of, kResolution)), faces(wallFaces(of, kResolution)) {
    constexpr double kOnCircle = 0.01;  // m
    for (const WallFace& face : faces) {
      int found = -1;
      for (std::size_t k = 0; k < plan.arcs.size(); ++k) {
        const Arc& arc = plan.arcs[k];
        const auto on = [&](const Eigen::Vector2d& p) {
          return std::abs((p - arc.centre).norm() - arc.radius) < kOnCircle;
        };
        const Eigen::Vector2d middle = 0.5 * (face.first + face.second);
        if (on(face.first) && on(middle) && on(face.second)) found = static_cast<int>(k);
      }
      arc_of.push_back(found);
    }
  }

  struct Hit {
    double range = std::numeric_limits<double>::infinity();
    int face = -1;
  };
  Hit cast(const Eigen::Vector2d& origin, double bearing) const {
    const Eigen::Vector2d u(std::cos(bearing), std::sin(bearing));
    Hit nearest;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const Eigen::Vector2d d = faces[k].second - faces[k].first, w = faces[k].first - origin;
      const double det = cross(u, d);
      if (det == 0.0) continue;
      const double range = cross(w, d) / det, share = cross(w, u) / det;
      if (range <= 0.0 || share < 0.0 || share > 1.0 || range >= nearest.range) continue;
      nearest = {range, static_cast<int>(k)};
    }
    return nearest;
  }
  /// What a hit belongs to: an arc, or a straight face.
  int featureOf(const Hit& hit) const {
    if (hit.face < 0) return std::numeric_limits<int>::min();
    const int arc = arc_of[static_cast<std::size_t>(hit.face)];
    return arc >= 0 ? arc : -1 - hit.face;
  }
};

/// What neighbouring rays have seen of one face or arc.
struct TrueFeature {
  int arc = -1;
  int rays = 0;
  Curve curve;
};

struct Look {
  Scan scan;
  std::vector<TrueFeature> truth;  ///< sensor frame
  std::vector<Arc> pillars;        ///< sensor frame, those that receive rays enough
  std::vector<Arc> hardly_seen;    ///< the others
};

Look lookFrom(const Faces& faces, const Pose2& pose, double sigma, Random& random) {
  Look look;
  look.scan.angle_min = -M_PI;
  look.scan.angle_increment = 2.0 * M_PI / kBeams;
  look.scan.free_range_without_return = kLongest;
  std::vector<int> feature;
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < kBeams; ++i) {
    const double bearing = look.scan.angle_min + i * look.scan.angle_increment;
    const Faces::Hit hit = faces.cast(pose.position(), pose.theta + bearing);
    look.scan.ranges.push_back(hit.range + sigma * random.normal());
    feature.push_back(faces.featureOf(hit));
    places.push_back(hit.range * Eigen::Vector2d(std::cos(bearing), std::sin(bearing)));
  }
  const int cut = static_cast<int>(
      std::adjacent_find(feature.begin(), feature.end(), std::not_equal_to<int>()) -
      feature.begin());
  const auto at = [&](int i) { return static_cast<std::size_t>((cut + 1 + i) % kBeams); };
  const Pose2 T_sensor_map = pose.inverse();
  for (int i = 0; i < kBeams;) {
    int end = i + 1;
    while (end < kBeams && feature[at(end)] == feature[at(i)]) ++end;
    TrueFeature piece;
    piece.rays = end - i;
    piece.arc = feature[at(i)];
    if (piece.arc >= 0) {
      Arc arc = faces.plan.arcs[static_cast<std::size_t>(piece.arc)];
      arc.centre = T_sensor_map * arc.centre;
      const Eigen::Vector2d a = places[at(i)] - arc.centre, b = places[at(end - 1)] - arc.centre;
      const bool turned = cross(a, b) < 0.0;
      const Eigen::Vector2d& start = turned ? b : a;
      const bool whole = arc.sweep > 6.0;
      arc.start_angle = std::atan2(start.y(), start.x());
      arc.sweep = std::atan2(std::abs(cross(a, b)), a.dot(b));
      piece.curve = curveOf(arc);
      arc.support = piece.rays;
      const bool enough = piece.rays >= kFewestRays;
      if (whole) (enough ? look.pillars : look.hardly_seen).push_back(arc);
      if (enough) look.truth.push_back(piece);
    } else if (piece.rays >= kFewestRays) {
      piece.curve = curveOf(places[at(i)], places[at(end - 1)]);
      look.truth.push_back(piece);
    }
    i = end;
  }
  return look;
}

/// A free place, facing at random, from where all rays end in the building.
Pose2 placeIn(const Faces& faces, Random& random) {
  while (true) {
    const Pose2 pose{random.uniform(0.0, faces.plan.width), random.uniform(0.0, faces.plan.height),
                     random.uniform(-M_PI, M_PI)};
    if (faces.world.clearance(pose.position(), 1.0) < kClearance) continue;
    bool closed = true;
    for (int i = 0; i < 90 && closed; ++i) {
      closed = faces.cast(pose.position(), 2.0 * M_PI * i / 90).range < kLongest;
    }
    if (closed) return pose;
  }
}

/// Lines that are no chords of an arc, and arcs.
std::vector<Curve> curvesOf(const ScanFeatures& features) {
  std::vector<Curve> curves;
  for (const Arc& arc : features.arcs) curves.push_back(curveOf(arc));
  const std::size_t arcs = curves.size();
  for (const LineSegment& line : features.lines) {
    bool chord = false;
    for (std::size_t k = 0; k < arcs; ++k) {
      const Arc& arc = features.arcs[k];
      const auto on = [&](const Eigen::Vector2d& p) {
        const Eigen::Vector2d out = p - arc.centre;
        const double turn = std::atan2(out.y(), out.x()) - arc.start_angle;
        const double within = std::remainder(turn - 0.5 * arc.sweep, 2.0 * M_PI);
        return std::abs(out.norm() - arc.radius) < 2.0 * kNear &&
               std::abs(within) < 0.5 * arc.sweep + 0.1;
      };
      chord = chord || (on(line.start) && on(line.end));
    }
    if (!chord) curves.push_back(curveOf(line.start, line.end));
  }
  return curves;
}

struct Tally {
  int truth = 0, found = 0, matched = 0, true_arcs = 0, found_arcs = 0, matched_arcs = 0;
};

/// One-to-one, longest overlaps first.
void match(const std::vector<TrueFeature>& truth, const std::vector<Curve>& found, int found_arcs,
           Tally* tally) {
  struct Pair {
    double overlap;
    std::size_t t, f;
  };
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < truth.size(); ++t) {
    for (std::size_t f = 0; f < found.size(); ++f) {
      const double of_truth = shareBeside(truth[t].curve, found[f]);
      const double of_found = shareBeside(found[f], truth[t].curve);
      if (of_truth >= 0.5 && of_found >= 0.5) pairs.push_back({of_truth + of_found, t, f});
    }
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return a.overlap > b.overlap; });
  std::vector<bool> taken_t(truth.size()), taken_f(found.size());
  for (const Pair& p : pairs) {
    if (taken_t[p.t] || taken_f[p.f]) continue;
    taken_t[p.t] = taken_f[p.f] = true;
    ++tally->matched;
    tally->matched_arcs += truth[p.t].arc >= 0 ? 1 : 0;
  }
  tally->truth += static_cast<int>(truth.size());
  tally->found += static_cast<int>(found.size());
  tally->found_arcs += found_arcs;
  for (const TrueFeature& t : truth) tally->true_arcs += t.arc >= 0 ? 1 : 0;
}

/// 12 x 9 m: five pillars of 0.1 to 0.5 m, and turned boxes of 0.4 to 1 m, half a metre apart.
Building pillarRoom(int boxes, Random& random) {
  Building plan;
  plan.width = 12.0;
  plan.height = 9.0;
  plan.addOuterWalls(0.2);
  std::vector<std::pair<Eigen::Vector2d, double>> placed;
  while (placed.size() < 5U + static_cast<std::size_t>(boxes)) {
    const Eigen::Vector2d place(random.uniform(1.2, 10.8), random.uniform(1.2, 7.8));
    const double radius = random.uniform(0.1, 0.5);
    const bool free = std::all_of(placed.begin(), placed.end(), [&](const auto& other) {
      return (other.first - place).norm() > other.second + radius + 0.7;
    });
    if (!free) continue;
    placed.emplace_back(place, radius);
    const double angle = random.uniform(0.0, M_PI);
    if (placed.size() <= 5) {
      plan.addDisc(place, radius);
    } else {
      plan.addTurnedBox(place, {0.3 + radius, 0.4 + 0.8 * radius}, angle);
    }
  }
  for (double x = 0.5; x < 11.5; x += 0.1) {  // a start that is free
    plan.start = {x, 0.6, 0.0};
    if (rasterise(plan, kResolution).clearance(plan.start.position(), 1.0) > kClearance) break;
  }
  return plan;
}

/// The same circle among others; null where there is none.
const Arc* find(const std::vector<Arc>& arcs, const Arc& circle) {
  for (const Arc& arc : arcs) {
    const bool same = (arc.centre - circle.centre).norm() < kNear;
    if (same && std::abs(arc.radius - circle.radius) < kNear) return &arc;
  }
  return nullptr;
}

void judgePillars(double sigma, int boxes, int scans) {
  Random random(7);
  int seen = 0, found = 0, seen_well = 0, found_well = 0, wrong = 0;
  double centre_sq = 0.0, radius_sq = 0.0, normalised = 0.0;
  for (int k = 0; k < scans; ++k) {
    const Faces faces(pillarRoom(boxes, random));
    const Look look = lookFrom(faces, placeIn(faces, random), sigma, random);
    const ScanFeatures features = extractFeatures(look.scan);
    for (const Arc& pillar : look.pillars) {
      const bool well = pillar.support >= kWellSeen;
      ++seen;
      seen_well += well ? 1 : 0;
      const Arc* arc = find(features.arcs, pillar);
      if (arc == nullptr) continue;
      ++found;
      found_well += well ? 1 : 0;
      centre_sq += (arc->centre - pillar.centre).squaredNorm();
      radius_sq += std::pow(arc->radius - pillar.radius, 2);
      normalised += std::pow(arc->radius - pillar.radius, 2) / arc->covariance(2, 2);
    }
    for (const Arc& arc : features.arcs) {
      wrong += find(look.pillars, arc) == nullptr && find(look.hardly_seen, arc) == nullptr;
    }
  }
  std::printf("| %.0f mm, %d boxes | %d | %.3f | %.3f | %.1f | %.1f | %.1f | %.2f |\n", 1e3 * sigma,
              boxes, seen, 1.0 * found / seen, 1.0 * found_well / std::max(1, seen_well),
              100.0 * wrong / scans, 1e3 * std::sqrt(centre_sq / std::max(1, found)),
              1e3 * std::sqrt(radius_sq / std::max(1, found)),
              std::sqrt(normalised / std::max(1, found)));
}

void judgeGallery(double sigma, int scans) {
  Random random(7);
  const Faces faces(generateBuilding("gallery", 1));
  Tally t;
  for (int k = 0; k < scans; ++k) {
    const Look look = lookFrom(faces, placeIn(faces, random), sigma, random);
    const ScanFeatures features = extractFeatures(look.scan);
    match(look.truth, curvesOf(features), static_cast<int>(features.arcs.size()), &t);
  }
  const auto f1 = [](int matched, int found, int truth) {
    return 2.0 * matched / std::max(1, found + truth);
  };
  std::printf("| %.0f mm | %d | %.3f | %.3f | %.3f | %.3f |\n", 1e3 * sigma, t.truth,
              1.0 * t.matched / t.found, 1.0 * t.matched / t.truth, f1(t.matched, t.found, t.truth),
              1.0 * t.matched_arcs / t.true_arcs);
}

}  // namespace
}  // namespace cca

int main(int argc, char** argv) {
  const int scans = argc > 1 ? std::max(1, std::atoi(argv[1])) : 200;
  std::printf("| pillars | seen | found | of those with %d rays | false in 100 scans | ",
              cca::kWellSeen);
  std::printf("centre, mm | radius, mm | radius, sigmas |\n|---|---|---|---|---|---|---|---|\n");
  for (const int boxes : {0, 3}) {
    for (const double sigma : {0.01, 0.03}) cca::judgePillars(sigma, boxes, scans);
  }
  std::printf("\n| gallery | true features | precision | recall | F1 | curved ones found |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (const double sigma : {0.01, 0.03}) cca::judgeGallery(sigma, scans);
  return 0;
}
