// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/correlative_search.hpp"

#include <gtest/gtest.h>

#include "walled_world.hpp"

namespace cca {
namespace {

std::vector<Eigen::Vector2d> pointsOf(const Scan& scan, const Pose2& T_map_sensor) {
  std::vector<Eigen::Vector2d> points;
  for (const auto& point : scanSurface(scan).points) {
    points.push_back(T_map_sensor * point.position);
  }
  return points;
}

class CorrelativeSearch : public testing::Test {
 protected:
  CorrelativeSearch() {
    world_.addBox(-3.0, -2.0, 4.0, 2.5);
    world_.addBox(1.5, -2.0, 2.2, -1.4);
    reference_ = pointsOf(world_.scan({}, 361, 2.0 * M_PI), {});
    query_ = thinned(pointsOf(world_.scan(truth_, 361, 2.0 * M_PI), {}), 0.2);
  }
  test::WalledWorld world_;
  const Pose2 truth_{0.62, -0.33, 0.45};
  std::vector<Eigen::Vector2d> reference_, query_;
};

TEST_F(CorrelativeSearch, FindsAPoseFarFromTheCentreOfItsWindow) {
  const LikelihoodPyramid pyramid(reference_, {0.0, 0.0}, 15.0, 4, 0.05);
  SearchWindow window;
  window.half_width = 1.0;
  window.half_turn = 0.6;
  const auto found = searchPose(query_, pyramid, window, 0.3);
  ASSERT_TRUE(found);
  EXPECT_LT(difference(found->T_map_query, truth_).head<2>().norm(), 0.08);
  EXPECT_NEAR(found->T_map_query.theta, truth_.theta, 0.02);
  EXPECT_GT(found->score, 0.8);
}

TEST_F(CorrelativeSearch, BranchAndBoundFindsWhatTryingAllPosesFinds) {
  SearchWindow window;
  window.half_width = 0.4;
  window.half_turn = 0.3;
  window.centre = {0.5, -0.2, 0.3};
  window.prior_information = {4.0, 4.0, 30.0};
  window.prior_weight = 0.05;
  const LikelihoodPyramid fine(reference_, {0.0, 0.0}, 15.0, 0, 0.05);
  const LikelihoodPyramid coarse(reference_, {0.0, 0.0}, 15.0, 5, 0.05);
  const auto all = searchPose(query_, fine, window, 0.1);
  const auto bounded = searchPose(query_, coarse, window, 0.1);
  ASSERT_TRUE(all && bounded);
  EXPECT_DOUBLE_EQ(bounded->score, all->score);
  EXPECT_EQ(difference(bounded->T_map_query, all->T_map_query).norm(), 0.0);
}

TEST_F(CorrelativeSearch, WhatIsExcludedIsNotFound) {
  const LikelihoodPyramid pyramid(reference_, {0.0, 0.0}, 15.0, 4, 0.05);
  SearchWindow window;
  window.half_width = 1.0;
  window.half_turn = 0.6;
  window.excluded = truth_;
  window.excluded_distance = 0.5;
  window.excluded_turn = 0.3;
  const auto found = searchPose(query_, pyramid, window, 0.1);
  EXPECT_LT(found ? found->score : 0.0, 0.8);
}

TEST_F(CorrelativeSearch, NothingScoresWhereNothingIsAlike) {
  const LikelihoodPyramid pyramid(reference_, {0.0, 0.0}, 15.0, 4, 0.05);
  SearchWindow window;
  window.centre = {100.0, 0.0, 0.0};
  EXPECT_FALSE(searchPose(query_, pyramid, window, 0.3));
  EXPECT_FALSE(searchPose({}, pyramid, window, 0.3));
}

}  // namespace
}  // namespace cca
