// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "cca_mrpt/evidence/tour.hpp"
#include "cca_mrpt/evidence/tuning_analysis.hpp"
#include "cca_mrpt/evidence/tuning_rows.hpp"

namespace cca::evidence {
namespace {

TuningDesign smallDesign() {
  TuningDesign d;
  d.similarity_cut = {0.25, 0.5, 0.75};
  d.vertex_price = {8.0, 16.0};
  d.straightness = {0.01, 0.04};
  d.worlds = {"maps/a.yaml", "maps/b.yaml"};
  d.noises = {0.01, 0.03};
  d.seeds = 2;
  return d;
}

std::string freshPath(const char* name) {
  const std::string path = testing::TempDir() + name;
  std::filesystem::remove(path);
  return path;
}

TEST(TuningDesign, NumbersEachCombinationOfEachSceneOnce) {
  const TuningDesign d = smallDesign();
  ASSERT_EQ(d.jobs(), 12u * 8u);
  std::set<std::string> seen;
  for (std::size_t k = 0; k < d.jobs(); ++k) {
    const TuningJob j = tuningJob(d, k);
    EXPECT_EQ(j.scene, k / 12);
    seen.insert(j.world + "/" + std::to_string(j.noise) + "/" + std::to_string(j.seed) + "/" +
                std::to_string(j.parameters.similarity_cut) + "/" +
                std::to_string(j.parameters.vertex_price) + "/" +
                std::to_string(j.parameters.straightness));
  }
  EXPECT_EQ(seen.size(), d.jobs());
}

TEST(TuningRows, GoesOnWhereItWasKilledInTheMiddleOfARow) {
  const TuningDesign d = smallDesign();
  const std::string path = freshPath("rows-killed.csv");
  {
    TuningRows rows(path, d);
    for (std::size_t k = 0; k < 3; ++k) rows.append(tuningJob(d, k), {k, 0.5, 0.25});
  }
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 3);
  {
    TuningRows rows(path, d);
    EXPECT_EQ(rows.size(), 2u);
    EXPECT_TRUE(rows.has(1));
    EXPECT_FALSE(rows.has(2));
    rows.append(tuningJob(d, 2), {2, 0.75, 0.125});
  }
  const auto rows = readTuningRows({path}, d);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_DOUBLE_EQ(rows[2].scan_f1, 0.75);
  EXPECT_DOUBLE_EQ(rows[2].map_f1, 0.125);
}

TEST(TuningRows, RefusesTheResultsOfAnotherDesign) {
  TuningDesign d = smallDesign();
  const std::string path = freshPath("rows-other.csv");
  { TuningRows rows(path, d); }
  d.seeds = 3;
  EXPECT_THROW(TuningRows(path, d), std::runtime_error);
  EXPECT_THROW(readTuningRows({path}, d), std::runtime_error);
}

/// Rows whose objective is known: a parabola in the cut, the best at 0.5, a bonus for a price
/// of 16, nothing for the straightness, and a scene's own level.
std::vector<TuningRow> knownRows(const TuningDesign& d) {
  std::vector<TuningRow> rows;
  for (std::size_t k = 0; k < d.jobs(); ++k) {
    const TuningJob j = tuningJob(d, k);
    const double cut = j.parameters.similarity_cut - 0.5;
    const double ripple = 1e-3 * std::sin(12.9898 * static_cast<double>(k));
    const double value = 0.8 - cut * cut + (j.parameters.vertex_price == 16.0 ? 0.02 : 0.0) +
                         0.01 * static_cast<double>(j.scene) + ripple;
    rows.push_back({k, value, value});
  }
  return rows;
}

TEST(TuningAnalysis, FindsTheEffectsThatAreThereAndNoOthers) {
  const TuningDesign d = smallDesign();
  const AnalysisOfVariance a = analyseTuning(d, knownRows(d), Objective::kMap);
  ASSERT_EQ(a.effects.size(), 7u);
  EXPECT_LT(a.effects[0].p_value, 1e-6) << a.effects[0].name;
  EXPECT_LT(a.effects[1].p_value, 1e-6) << a.effects[1].name;
  for (int k = 2; k < 6; ++k) EXPECT_GT(a.effects[k].p_value, 0.01) << a.effects[k].name;
  EXPECT_LT(a.effects[6].p_value, 1e-6) << a.effects[6].name;
}

TEST(TuningAnalysis, RecommendsTheKnownBestAndTellsHowFarTheShippedIs) {
  const TuningDesign d = smallDesign();
  CcaParameters shipped;
  shipped.similarity_cut = 0.75;
  shipped.vertex_price = 8.0;
  shipped.straightness = 0.01;
  const Recommendation r = recommend(d, knownRows(d), Objective::kBoth, shipped);
  EXPECT_DOUBLE_EQ(r.best.vertex_price, 16.0);
  EXPECT_DOUBLE_EQ(r.best.similarity_cut, 0.5);
  EXPECT_DOUBLE_EQ(r.similarity_cut.low, 0.5);
  EXPECT_DOUBLE_EQ(r.similarity_cut.high, 0.5);
  EXPECT_TRUE(r.shipped_in_design);
  EXPECT_NEAR(r.shortfall.value, 0.0625 + 0.02, 2e-3);
  EXPECT_GT(r.shortfall.low, 0.0);
}

TEST(TuningAnalysis, LeavesOutScenesThatAreNotComplete) {
  const TuningDesign d = smallDesign();
  auto rows = knownRows(d);
  rows.resize(12 * 3 + 5);
  EXPECT_EQ(analyseTuning(d, rows, Objective::kScan).effects.back().degrees, 2);
  rows.resize(12 + 5);
  EXPECT_THROW(analyseTuning(d, rows, Objective::kScan), std::runtime_error);
}

TEST(Tour, VisitsBothRoomsThroughTheDoor) {
  // Two rooms of 5 x 5 m, 10 cm cells, a door of 1 m in the wall between them.
  std::vector<unsigned char> cells(100 * 50, 0);
  for (int iy = 0; iy < 50; ++iy) {
    if (iy < 20 || iy > 30) cells[iy * 100 + 50] = 1;
  }
  const World world("two", 100, 50, cells, 0.1, {0.0, 0.0});
  const auto poses = tour(world, 1000);
  bool left = false, right = false;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    EXPECT_GE(world.clearance(poses[k].position(), 0.35), 0.35);
    left |= poses[k].x < 3.0;
    right |= poses[k].x > 7.0;
    if (k > 0) {
      EXPECT_LE((poses[k].position() - poses[k - 1].position()).norm(), 0.71);
    }
  }
  EXPECT_TRUE(left && right);
}

}  // namespace
}  // namespace cca::evidence
