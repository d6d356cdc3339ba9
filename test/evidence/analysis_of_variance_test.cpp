// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/evidence/analysis_of_variance.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace cca::evidence {
namespace {

/// Battery life by material and temperature, four each [Montgomery, Design and Analysis of
/// Experiments, Table 5.1; the analysis is his Table 5.5].
Experiment batteries() {
  const double life[3][3][4] = {
      {{130, 155, 74, 180}, {34, 40, 80, 75}, {20, 70, 82, 58}},
      {{150, 188, 159, 126}, {136, 122, 106, 115}, {25, 70, 58, 45}},
      {{138, 110, 168, 160}, {174, 120, 150, 139}, {96, 104, 82, 60}},
  };
  Experiment e;
  e.factors = {{"material", 3}, {"temperature", 3}};
  for (int m = 0; m < 3; ++m) {
    for (int t = 0; t < 3; ++t) {
      for (const double hours : life[m][t]) {
        e.settings.push_back({m, t});
        e.responses.push_back(hours);
      }
    }
  }
  return e;
}

TEST(AnalysisOfVariance, ReproducesTheTextbook) {
  const AnalysisOfVariance a = analyseVariance(batteries(), {{0}, {1}, {0, 1}});
  ASSERT_EQ(a.effects.size(), 3u);
  EXPECT_EQ(a.effects[2].name, "material x temperature");
  const double sums[] = {10683.72, 39118.72, 9613.78}, f[] = {7.91, 28.97, 3.56};
  const int degrees[] = {2, 2, 4};
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(a.effects[k].sum_of_squares, sums[k], 0.01);
    EXPECT_NEAR(a.effects[k].f, f[k], 0.005);
    EXPECT_EQ(a.effects[k].degrees, degrees[k]);
  }
  EXPECT_NEAR(a.effects[0].p_value, 0.0020, 5e-5);
  EXPECT_LT(a.effects[1].p_value, 1e-4);
  EXPECT_NEAR(a.effects[2].p_value, 0.0186, 5e-5);
  EXPECT_NEAR(a.residual_sum_of_squares, 18230.75, 0.01);
  EXPECT_EQ(a.residual_degrees, 27);
  EXPECT_NEAR(a.total_sum_of_squares, 77646.97, 0.01);
}

TEST(AnalysisOfVariance, SumsOfABalancedDesignAddUp) {
  const AnalysisOfVariance a = analyseVariance(batteries(), {{0}, {1}, {0, 1}});
  double sum = a.residual_sum_of_squares;
  for (const Effect& e : a.effects) sum += e.sum_of_squares;
  EXPECT_NEAR(sum, a.total_sum_of_squares, 1e-6);
}

TEST(AnalysisOfVariance, DoesNotDependOnTheOrderOfObservations) {
  Experiment e = batteries();
  const AnalysisOfVariance a = analyseVariance(e, {{0}, {1}});
  std::swap(e.settings[3], e.settings[30]);
  std::swap(e.responses[3], e.responses[30]);
  const AnalysisOfVariance b = analyseVariance(e, {{0}, {1}});
  EXPECT_NEAR(a.effects[0].sum_of_squares, b.effects[0].sum_of_squares, 1e-6);
}

TEST(AnalysisOfVariance, RefusesWhatCannotBeDetermined) {
  Experiment e = batteries();
  EXPECT_THROW(analyseVariance(e, {{0}, {0}}), std::runtime_error);
  e.settings.resize(3);
  e.responses.resize(3);
  EXPECT_THROW(analyseVariance(e, {{0}, {1}}), std::runtime_error);
}

}  // namespace
}  // namespace cca::evidence
