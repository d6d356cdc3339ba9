// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "cca_mrpt/io/log_reader.hpp"
#include "cca_mrpt/mapping/line_map.hpp"
#include "cca_mrpt/mapping/scan_agreement.hpp"
#include "evaluation/log_score.hpp"

namespace cca {
namespace {

std::filesystem::path sharedData() {
  const char* named = std::getenv("CCA_SHARED_DATA");
  if (named != nullptr) return named;
  return CCA_SHARED_DATA_BESIDE;
}

class RealLog : public testing::TestWithParam<const char*> {};

/// One configuration for every log. The bounds are those that the project set itself for each log;
/// maps may become better, never worse than this.
TEST_P(RealLog, MapIsCompleteCleanAndOnTheWalls) {
  const auto path = sharedData() / "logs" / (std::string(GetParam()) + "-corrected.log.gz");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing";
  std::vector<Scan> scans;
  const auto reader = openUndistortedLog(path.string());
  while (const auto record = reader->next()) scans.push_back(record->scan);
  LineMap map;
  ScanAgreement agreement;
  double lowest_agreement = 1.0;
  for (const Scan& scan : scans) {
    agreement.add(compareWithMap(scan, map.walls()));
    lowest_agreement = std::min(lowest_agreement, agreement.recent());
    map.insert(scan);
  }
  EXPECT_GT(lowest_agreement, 0.998);  // of 0.99 that stop an exploration
  std::vector<Segment2> segments;
  for (const MapLine& line : map.lines())
    segments.push_back({line.segment.start, line.segment.end});
  LogScoreParameters fewer;
  fewer.max_points = 100000;
  const LogScore score = scoreAgainstLog(scans, segments, fewer);
  EXPECT_GT(score.at("summary").at("f_score"), 0.90);
  EXPECT_GT(score.at("summary").at("precision_clean_length"), 0.94);
  EXPECT_GT(score.at("summary").at("recall_linear_cells_10"), 0.87);
  EXPECT_LT(score.at("redundancy").at("redundant_frac_10"), 0.05);
  EXPECT_LT(score.at("free_space").at("contradicted_frac"), 0.04);  // moved chairs in freiburg-079
  EXPECT_LT(score.at("phantom").at("frac_10"), 0.005);
  EXPECT_LT(score.at("bias").at("rms_m"), 0.025);
}

INSTANTIATE_TEST_SUITE_P(, RealLog,
                         testing::Values("intel", "freiburg-079", "orebro", "fhw", "seattle"),
                         [](const auto& log) {
                           std::string name = log.param;
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

}  // namespace
}  // namespace cca
