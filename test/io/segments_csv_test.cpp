// SPDX-License-Identifier: BSD-3-Clause
#include "io/lines/segments_csv.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

namespace cca {
namespace {

TEST(LoadSegments, PassesOverCommentsAndHeader) {
  const std::string path = testing::TempDir() + "segments.csv";
  std::ofstream(path) << "# a comment\nx1,y1,x2,y2,id\n\n0,0,1,0,7\n# another\n1;0 1 2\r\n";
  const auto segments = loadSegments(path);
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[1].end, Eigen::Vector2d(1.0, 2.0));
  std::ofstream(path) << "0,0,1e6,0\n";
  EXPECT_THROW(loadSegments(path), std::runtime_error);
}

TEST(LoadSegments, GoesByTheNamesOfTheHeader) {
  const std::string path = testing::TempDir() + "extracted.csv";
  std::ofstream(path) << "scan_id,y2,x1,y1,x2\n17,4,1,2,3\n";
  const auto segments = loadSegments(path);
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_EQ(segments[0].start, Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(segments[0].end, Eigen::Vector2d(3.0, 4.0));
  std::ofstream(path) << "\xEF\xBB\xBFx1,y1,x2,y2\r\n1,2,3,4\r\n";  // of a spreadsheet
  EXPECT_EQ(loadSegments(path).size(), 1U);
  std::ofstream(path) << "x1,y1,x2,y2\n";
  EXPECT_TRUE(loadSegments(path).empty());
  for (const char* text :
       {"", "# nothing\n", "a,b,c,d\n0,0,1,1\n", "0,0,1m,1\n", "0,0,1,1\nx1,y1,x2,y2\n"}) {
    std::ofstream(path) << text;
    EXPECT_THROW(loadSegments(path), std::runtime_error) << text;
  }
}

TEST(LoadSegments, NamesFileAndLineOfWhatItCannotRead) {
  const std::string path = testing::TempDir() + "edges.csv";
  std::ofstream(path) << "x1,y1,x2,y2\n0,0,1,0\n0,zero,1,1\n";
  try {
    loadSegments(path);
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("edges.csv:3"), std::string::npos) << error.what();
  }
  EXPECT_THROW(loadSegments(path + ".absent"), std::runtime_error);
}

}  // namespace
}  // namespace cca
