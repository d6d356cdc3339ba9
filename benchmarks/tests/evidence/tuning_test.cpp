// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "evidence/tour.hpp"
#include "evidence/tuning_rows.hpp"

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

TEST(TuningRows, AreOneTableWhateverTheShardsAndTheirOrder) {
  const TuningDesign d = smallDesign();
  const std::string first = freshPath("rows-first.csv"), second = freshPath("rows-second.csv");
  {
    TuningRows a(first, d), b(second, d);
    a.append(tuningJob(d, 14), {14, 0.5, 0.25});
    a.append(tuningJob(d, 0), {0, 1.0 / 3.0, 1.0});
    b.append(tuningJob(d, 13), {13, 0.75, 0.0});
  }
  const std::string table = tuningTable(d, readTuningRows({first, second}, d));
  EXPECT_EQ(table, tuningTable(d, readTuningRows({second, first}, d)));
  EXPECT_EQ(table,
            d.signature() +
                "\n# combinations=12 scenes=8 shipped similarity_cut=0.5 vertex_price=12 "
                "straightness=0.035\n"
                "job,similarity_cut,vertex_price,straightness,world,noise,seed,scan_f1,map_f1\n"
                "0,0.25,8,0.01,a,0.01,1,0.333333333,1\n"
                "13,0.25,8,0.04,a,0.01,2,0.75,0\n"
                "14,0.25,16,0.01,a,0.01,2,0.5,0.25\n");
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
