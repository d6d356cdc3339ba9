// SPDX-License-Identifier: BSD-3-Clause
#include "slam/correlative_search.hpp"

#include <gtest/gtest.h>

#include "walled_world.hpp"

namespace cca {
namespace {

std::vector<SurfacePoint> pointsOf(const Scan& scan, const Pose2& T_map_sensor) {
  std::vector<SurfacePoint> points;
  for (const auto& point : scanSurface(scan).points) {
    points.push_back(
        {T_map_sensor * point.position, Pose2{0.0, 0.0, T_map_sensor.theta} * point.normal});
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
  std::vector<SurfacePoint> reference_, query_;
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

TEST_F(CorrelativeSearch, SeveralPlacesAreTheBestOneAndOthersWellApart) {
  const LikelihoodPyramid pyramid(reference_, {0.0, 0.0}, 15.0, 4, 0.1);
  SearchWindow window;
  window.half_width = 2.0;
  window.half_turn = M_PI;
  PoseSearch search(query_, pyramid, window, 0.2);
  search.keepSeveral(5, 0.5, 0.3);
  search.run();
  const std::vector<SearchResult>& several = search.several();
  ASSERT_EQ(several.size(), 5U);
  EXPECT_EQ(several.front().score, searchPose(query_, pyramid, window, 0.2)->score);
  for (std::size_t i = 0; i < several.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(several[j].score, several[i].score);
      const Eigen::Vector3d off = difference(several[i].T_map_query, several[j].T_map_query);
      EXPECT_TRUE(off.head<2>().norm() >= 0.5 || std::abs(off.z()) >= 0.3);
    }
  }
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

TEST_F(CorrelativeSearch, BitByBitFindsTheSame) {
  SearchWindow window;
  window.half_width = 1.0;
  window.half_turn = M_PI;
  const LikelihoodPyramid pyramid(reference_, {0.0, 0.0}, 15.0, 4, 0.05);
  const auto at_once = searchPose(query_, pyramid, window, 0.3);
  PoseSearch search(query_, pyramid, window, 0.3);
  int bits = 1;
  while (!search.advance(2000)) ++bits;
  EXPECT_GT(bits, 20);
  ASSERT_TRUE(at_once && search.found());
  EXPECT_EQ(search.found()->score, at_once->score);
  EXPECT_EQ(difference(search.found()->T_map_query, at_once->T_map_query).norm(), 0.0);
}

TEST_F(CorrelativeSearch, APlaceThatIsOneOfAKindHasNoRival) {
  SearchWindow window;
  window.half_width = 1.0;
  window.half_turn = 0.6;
  PoseSearch search(query_, LikelihoodPyramid(reference_, {0.0, 0.0}, 15.0, 4, 0.05), window, 0.3);
  search.run();
  search.seekRival(0.5, 0.3, 0.8);
  search.run();
  EXPECT_FALSE(search.found());
}

TEST_F(CorrelativeSearch, OneOfTwoPlacesAlikeIsTheOthersRival) {
  std::vector<SurfacePoint> twice = reference_;
  const Eigen::Vector2d apart(20.0, 0.0);
  for (const SurfacePoint& p : reference_) twice.push_back({p.position + apart, p.normal});
  SearchWindow window;
  window.centre = {10.0, 0.0, 0.0};
  window.half_width = 12.0;
  window.half_turn = 0.6;
  PoseSearch search(query_, LikelihoodPyramid(twice, {10.0, 0.0}, 30.0, 5, 0.05), window, 0.3);
  search.run();
  ASSERT_TRUE(search.found());
  const Pose2 best = search.found()->T_map_query;
  search.seekRival(0.5, 0.3, 0.9 * search.found()->score);
  search.run();
  ASSERT_TRUE(search.found());
  EXPECT_NEAR((search.found()->T_map_query.position() - best.position()).norm(), apart.x(), 0.6);
}

TEST_F(CorrelativeSearch, AWallSeenFromBehindIsAnother) {
  const std::vector<SurfacePoint> wall{{{1.0, 0.0}, {-1.0, 0.0}}, {{1.0, 1.0}, {0.0, 0.0}}};
  const LikelihoodPyramid any(wall, {0.0, 0.0}, 5.0, 2, 0.05);
  const LikelihoodPyramid alike(wall, {0.0, 0.0}, 5.0, 2, 0.05, LikelihoodPyramid::Facing::kAlike);
  const auto valueAt = [](const LikelihoodPyramid& pyramid, int point, double facing) {
    const Eigen::Vector2d at = pyramid.toCells({1.0, static_cast<double>(point)});
    return pyramid.at(0, pyramid.layerOf(facing), static_cast<int>(at.x()),
                      static_cast<int>(at.y()));
  };
  EXPECT_EQ(valueAt(alike, 0, M_PI), 255);
  EXPECT_EQ(valueAt(alike, 0, -M_PI + 0.35), 255) << "20 degrees are as alike as normals are known";
  EXPECT_EQ(valueAt(alike, 0, 0.0), 0);
  EXPECT_EQ(valueAt(alike, 0, M_PI_2), 0);
  EXPECT_EQ(valueAt(alike, 1, M_PI), 0) << "faces nowhere";
  EXPECT_EQ(valueAt(any, 0, 0.0), 255);
  EXPECT_EQ(valueAt(any, 1, 0.0), 255);
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
