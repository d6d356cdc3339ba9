// SPDX-License-Identifier: BSD-3-Clause
#include "peers/scan_matchers.hpp"

#include <gtest/gtest.h>

#include "slam/walled_world.hpp"

namespace cca::peers {
namespace {

test::WalledWorld room() {
  test::WalledWorld world;
  world.addBox(-3.0, -2.0, 4.0, 2.5);
  world.addBox(1.5, -2.0, 2.2, -1.4);
  return world;
}

TEST(ScanMatchers, EachBringsASecondScanHome) {
  test::WalledWorld world = room();
  const Pose2 first{0.1, 0.2, 0.3}, second{0.25, 0.1, 0.38};
  const ScanSurface a = scanSurface(world.scan(first, 361, M_PI));
  const ScanSurface b = scanSurface(world.scan(second, 361, M_PI));
  const Pose2 start{0.19, 0.15, 0.34};
  const double off = (start.position() - second.position()).norm();
  for (const ScanMatcher& matcher : scanMatchers()) {
    const MatchResult match = matcher.match(b, start, {}, {{&a, first}}, 0.3);
    EXPECT_LT((match.T_map_query.position() - second.position()).norm(), 0.3 * off) << matcher.name;
    EXPECT_NEAR(match.T_map_query.theta, second.theta, 0.02) << matcher.name;
    EXPECT_GT(match.paired, 0.5) << matcher.name;
  }
}

TEST(ScanMatchers, WithoutAnythingToMatchThePoseStays) {
  const ScanSurface scan = scanSurface(room().scan({}, 181, M_PI));
  const Pose2 start{1.0, 2.0, 0.5};
  PoseBelief prior;
  prior.mean = start;
  prior.information.setIdentity();
  for (const ScanMatcher& matcher : scanMatchers()) {
    for (const ScanSurface& query : {scan, ScanSurface{}}) {
      const MatchResult match = matcher.match(query, start, prior, {}, 0.3);
      EXPECT_EQ(match.T_map_query.x, start.x) << matcher.name;
      EXPECT_EQ(match.T_map_query.theta, start.theta) << matcher.name;
    }
  }
}

}  // namespace
}  // namespace cca::peers
