// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cca_mrpt/mapping/parameters.hpp"
#include "evidence/labelled_scan.hpp"

namespace cca::evidence {

/// The factorial experiment on the three input parameters: every combination of their levels, in
/// every scene (world x range noise x seed).
struct TuningDesign {
  std::vector<double> similarity_cut{0.2, 0.35, 0.5, 0.65, 0.8};
  std::vector<double> vertex_price{4.0, 8.0, 12.0, 20.0, 32.0};
  std::vector<double> straightness{0.01, 0.02, 0.035, 0.05, 0.08};
  std::vector<std::string> worlds;  ///< .yaml
  std::vector<double> noises{0.01, 0.03};
  int seeds = 2;
  int scans = 15;            ///< single scans of each scene
  int poses = 120;           ///< longest tour of a scene, for the map
  double pose_noise = 0.01;  ///< m, per axis: the map is built with poses that err
  double heading_noise_deg = 0.1;

  std::size_t scenes() const { return worlds.size() * noises.size() * seeds; }
  std::size_t combinations() const {
    return similarity_cut.size() * vertex_price.size() * straightness.size();
  }
  std::size_t jobs() const { return scenes() * combinations(); }
  /// One line that tells a design from another.
  std::string signature() const;
};

/// One run of the experiment, numbered scene by scene.
struct TuningJob {
  std::size_t index = 0, scene = 0;
  CcaParameters parameters;
  std::string world;
  double noise = 0.0;
  int seed = 0;
};
TuningJob tuningJob(const TuningDesign& design, std::size_t index);

/// What a job gives: F1 of single scans (mean) and F1 of the map's length, both in [0, 1].
struct TuningRow {
  std::size_t job = 0;
  double scan_f1 = 0.0, map_f1 = 0.0;
};

/// What the jobs of one scene share.
struct Scene {
  std::vector<LabelledScan> scans;  ///< single ones, at random places
  std::vector<Scan> tour;           ///< with erring poses
  std::vector<Segment2> walls;      ///< true, map frame: those that the tour has seen
};
Scene makeScene(const TuningDesign& design, const TuningJob& job);

TuningRow runJob(const TuningJob& job, const Scene& scene);

}  // namespace cca::evidence
