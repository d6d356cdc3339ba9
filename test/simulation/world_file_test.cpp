// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "cca_mrpt/simulation/world.hpp"

namespace cca {
namespace {

/// An 8-bit PGM image, top row first.
void writePgm(const std::string& path, int width, int height, const std::string& pixels) {
  std::ofstream file(path, std::ios::binary);
  file << "P5\n" << width << " " << height << "\n255\n" << pixels;
}

std::string write(const std::string& yaml) {
  const std::string path = testing::TempDir() + "world_under_test.yaml";
  std::ofstream(path) << yaml;
  return path;
}

const std::string kRest =
    "resolution: 0.1\norigin: [-1.0, 2.0, 0.0]\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"
    "negate: 0\n";

/// 5 x 4 cells, all free (254) but one occupied and one unknown.
std::string smallWorld() {
  std::string pixels(5 * 4, '\xFE');
  pixels[1 * 5 + 2] = '\0';    // second row from the top
  pixels[2 * 5 + 1] = '\xCD';  // third row: 205, unknown
  writePgm(testing::TempDir() + "small.pgm", 5, 4, pixels);
  return "image: small.pgm\n";
}

std::string complaintAbout(const std::string& yaml) {
  try {
    loadWorld(write(yaml));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(WorldFile, TurnsTheImageUpsideUpAndTakesUnknownForObstacle) {
  const World world = loadWorld(write(smallWorld() + kRest));
  EXPECT_EQ(world.width(), 5);
  EXPECT_EQ(world.height(), 4);
  EXPECT_TRUE(world.isObstacle(2, 2));  // second row from the top
  EXPECT_TRUE(world.isObstacle(1, 1));  // unknown
  EXPECT_FALSE(world.isObstacle(2, 1));
  EXPECT_FALSE(world.isObstacle(3, 2));
  EXPECT_EQ(world.origin(), Eigen::Vector2d(-1.0, 2.0));
}

TEST(WorldFile, ClosesTheOutermostRowsAndAllBeyond) {
  const World world = loadWorld(write(smallWorld() + kRest));
  for (int x = -1; x <= 5; ++x) {
    for (int y : {-1, 0, 3, 4}) EXPECT_TRUE(world.isObstacle(x, y));
  }
  for (int y = -1; y <= 4; ++y) {
    for (int x : {-1, 0, 4, 5}) EXPECT_TRUE(world.isObstacle(x, y));
  }
}

TEST(WorldFile, NegateSwapsBlackAndWhite) {
  std::string yaml = smallWorld() + kRest;
  yaml.replace(yaml.find("negate: 0"), 9, "negate: 1");
  const World world = loadWorld(write(yaml));
  EXPECT_FALSE(world.isObstacle(2, 2));
  EXPECT_TRUE(world.isObstacle(2, 1));
}

TEST(WorldFile, ReadsTheStartInDegrees) {
  const World world = loadWorld(write(smallWorld() + kRest + "start: [-0.7, 2.15, 90]\n"));
  ASSERT_TRUE(world.start);
  EXPECT_NEAR(world.start->theta, M_PI / 2.0, 1e-12);
}

TEST(WorldFile, TellsOfKeysThatItDoesNotKnow) {
  const World world = loadWorld(write(smallWorld() + kRest + "strat: [1, 2, 3]\n"));
  EXPECT_EQ(world.unknown_keys, std::vector<std::string>{"strat"});
}

TEST(WorldFile, ErrorsNameFileKeyAndWhatIsAllowed) {
  const auto expect = [](const std::string& yaml, const std::string& part) {
    const std::string complaint = complaintAbout(yaml);
    EXPECT_NE(complaint.find(part), std::string::npos) << complaint;
    EXPECT_NE(complaint.find("world_under_test.yaml"), std::string::npos) << complaint;
  };
  const std::string image = smallWorld();
  expect(kRest, "image: is missing");
  expect("image: nowhere.png\n" + kRest, "does not exist");
  expect(image + "resolution: -1\n", "resolution: -1 is out of range, allowed is 0.001 to 10");
  expect(image + "resolution: wide\n", "resolution: 'wide' is not a number");
  expect(image + "resolution: .nan\n", "resolution: '.nan' is not a number");
  expect(image + "resolution: 0.1\norigin: [1, 2]\n", "origin: must be a list of 3 numbers");
  expect(image + "resolution: 0.1\norigin: [1, 2, 0.3]\n", "origin: a turned map");
  expect(image + "resolution: 0.1\norigin: [1, 2, 0]\nfree_thresh: 2\n", "free_thresh: 2 is out");
  expect(image + kRest + "start: here\n", "start: must be a list of 3 numbers");
  expect("just words\n", "holds no 'key: value' lines");
  expect("", "holds no 'key: value' lines");
  std::ofstream(testing::TempDir() + "broken.png") << "no image at all";
  expect("image: broken.png\n" + kRest, "is no readable image");
  std::ofstream(testing::TempDir() + "dim.pgm") << "P2\n# grey\n3 1\n# white\n100\n0 100 0\n";
  expect("image: dim.pgm\n" + kRest, "has 100 for white, allowed is 255");
  expect("image: ../\n" + kRest, "is no file");
  writePgm(testing::TempDir() + "black.pgm", 6, 6, std::string(36, '\0'));
  expect("image: black.pgm\n" + kRest, "has no free cell");
  writePgm(testing::TempDir() + "one.pgm", 1, 1, std::string(1, '\xFE'));
  expect("image: one.pgm\n" + kRest, "has no free cell");
}

TEST(WorldFile, RefusesAKeyThatIsGivenTwiceAndNamesItsLine) {
  const std::string image = smallWorld(), refused = "is given twice, first in line ";
  for (const auto& [yaml, complaint] : std::vector<std::pair<std::string, std::string>>{
           {image + kRest + "resolution: 0.2\n", "resolution: " + refused + "2"},
           {image + "# \xC3\xBC\nresolution: 0.1 # m\n\"resolution\": '0.1'\n",
            "resolution: " + refused + "3"},
           {image + "origin: [1, 2, 0]\n" + kRest, "origin: " + refused + "2"},
           {image + kRest + "start: ' #'\nstart: [0, 0, 0]\n", "start: " + refused + "7"},
           {"{image: a#b, image: small.pgm}\n", "image: " + refused + "1"},
           {"{image: ' # ', image: small.pgm}\n", "image: " + refused + "1"},
           {kRest + "more: {x: 1, y: 2, x: 3}\n", "x: " + refused + "6"},
           {kRest + "more:\n  - {x: 1}\n  - y: 1\n    y: 1\n", "y: " + refused + "8"}}) {
    EXPECT_NE(complaintAbout(yaml).find("world_under_test.yaml: " + complaint), std::string::npos)
        << complaintAbout(yaml);
  }
}

TEST(WorldFile, TakesEveryWayToWriteAPair) {
  const std::string rest =
      "origin:   # of the image: its corner\n  - -1.0\n  - 2.0\n  - 0.0\n\n"
      "'occupied_thresh':\n  # more: than this\n  \"0.65\"\n? free_thresh\n: 0.196\n";
  const World world = loadWorld(write(smallWorld() + "\"resolution\" : '0.1'\n" + rest));
  EXPECT_EQ(world.resolution(), 0.1);
  EXPECT_EQ(world.origin(), Eigen::Vector2d(-1.0, 2.0));
}

TEST(WorldFile, RefusesAMonsterByItsHeaderBeforeUnpackingIt) {
  const unsigned char head[33] = {0x89, 'P', 'N', 'G', 13, 10, 26,   10,   0, 0, 0,    13,
                                  'I',  'H', 'D', 'R', 0,  0,  0x4E, 0x20, 0, 0, 0x4E, 0x20};
  std::ofstream(testing::TempDir() + "monster.png", std::ios::binary)
      .write(reinterpret_cast<const char*>(head), sizeof head);
  EXPECT_NE(complaintAbout("image: monster.png\n" + kRest).find("more than 64 million cells"),
            std::string::npos);
}

TEST(WorldFile, RefusesDirectivesOnSomeOfWhichTheYamlLibraryHangs) {
  const std::string hangs(
      "image: small.pgm\n% rgin: [0.0,\xA0"
      "0.0\n");
  EXPECT_NE(complaintAbout(hangs).find("directives"), std::string::npos);
  EXPECT_NE(complaintAbout("%YAML 1.1\n" + kRest).find("directives"), std::string::npos);
}

TEST(WorldFile, ReadsTheFirstDocumentOfAText) {
  for (const char* end : {"...\n", "---\n", "---\nstart: [9, 9]\n"}) {
    const World world = loadWorld(write("---\n" + smallWorld() + kRest + end));
    EXPECT_FALSE(world.start) << end;
    EXPECT_TRUE(world.unknown_keys.empty()) << end;
  }
}

TEST(WorldFile, RefusesNestingThatWouldEndTheStackOfTheYamlLibrary) {
  for (const char* level : {"[", "{a: ", "- ", "? "}) {
    std::string deep;
    for (int k = 0; k < 20000; ++k) deep += level;
    EXPECT_NE(complaintAbout(deep).find("nested too deep"), std::string::npos) << level;
  }
}

TEST(WorldFile, AMissingFileIsNamedAndSoIsAFolder) {
  for (const std::string& path : {std::string("nowhere/world.yaml"), testing::TempDir()}) {
    try {
      loadWorld(path);
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), path + ": cannot be read");
    }
  }
}

TEST(World, ClearanceIsTheDistanceToTheNearestObstacleCell) {
  const World world("free", 100, 100, std::vector<unsigned char>(10000, 0), 0.05, {0.0, 0.0});
  EXPECT_NEAR(world.clearance({1.0, 2.5}, 3.0), 0.95, 1e-12);  // the outermost cells are solid
  EXPECT_NEAR(world.clearance({2.5, 2.5}, 0.3), 0.3, 1e-12);
  EXPECT_EQ(world.clearance({0.02, 2.5}, 0.3), 0.0);
  EXPECT_EQ(world.clearance({-9.0, 2.5}, 0.3), 0.0);
  EXPECT_EQ(world.clearance({1e300, 2.5}, 0.3), 0.0);
  EXPECT_EQ(world.clearance({2.5, NAN}, 0.3), 0.0);
}

// 40 x 20 squares of half a metre. The widest place of all is shut in, or behind a slit of 40 cm.
TEST(DefaultStart, LiesInTheLargestRegionThatTheRobotCanDriveIn) {
  constexpr int kWidth = 400, kHeight = 200;
  for (const int slit : {0, 8}) {
    std::vector<unsigned char> cells(std::size_t{kWidth} * kHeight, 0);
    const auto occupy = [&](int ix, int iy) {
      cells[static_cast<std::size_t>(iy) * kWidth + static_cast<std::size_t>(ix)] = 1;
    };
    for (int iy = 0; iy < kHeight; ++iy) {
      if (iy < 100 || iy >= 100 + slit) occupy(120, iy);
      for (int ix = 160; ix < kWidth; ix += 40) {
        if (iy % 40 < 20) occupy(ix, iy);  // pillars: what is large is narrower
      }
    }
    const World world("rooms", kWidth, kHeight, cells, 0.05, {0.0, 0.0});
    EXPECT_GT(defaultStart(world, 0.25).x, 120 * 0.05) << "slit of " << slit << " cells";
  }
}

TEST(DefaultStart, IsTheWidestPlaceAndRefusesWorldsTooNarrow) {
  const World world("free", 101, 61, std::vector<unsigned char>(101 * 61, 0), 0.05, {1.0, 2.0});
  const Pose2 start = defaultStart(world, 0.25);
  EXPECT_GE(world.clearance(start.position(), 2.0), 1.4);
  EXPECT_THROW(defaultStart(world, 2.0), std::runtime_error);
}

}  // namespace
}  // namespace cca
