// SPDX-License-Identifier: BSD-3-Clause
#include "slam/sweep_matching.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "sensing/undistortion.hpp"
#include "walled_world.hpp"

namespace cca {
namespace {

constexpr double kSweep = 0.18;  // s
constexpr int kBeams = 360;
constexpr double kFieldOfView = 359.0 * M_PI / 180.0;  // rad, as rplidar_a1 has it
constexpr double kNoise = 0.01;                        // m
const Twist kTrue{{0.3, 0.02}, 0.8};
const Pose2 kBefore{0.1, 0.2, 0.3}, kMiddle{0.4, 0.1, 0.5};

/// A robot that turns as it drives has an odometry that errs by a tenth of its turn.
class SweepMatching : public testing::Test {
 protected:
  SweepMatching() {
    world_.addBox(-3.0, -2.0, 4.0, 2.5);
    world_.addBox(1.5, -2.0, 2.2, -1.4);
    prior_.mean = kMiddle;
    prior_.information.diagonal() << 1e3, 1e3, 1e3;
    belief_.information.diagonal() << 1e4, 1e4, 1e3;
    reference_ = scanSurface(world_.scan(kBefore, kBeams, kFieldOfView, kNoise));
  }

  /// Each beam from where the laser is by then; one in thirty is lost.
  Scan swept(double duration) {
    Scan scan = world_.scan(kMiddle, kBeams, kFieldOfView);
    scan.sweep_duration = duration;
    for (std::size_t k = 0; k < scan.size(); ++k) {
      if (k % 30 == 7) {
        scan.ranges[k] = std::numeric_limits<double>::quiet_NaN();
        continue;
      }
      const double time = duration * (static_cast<double>(k) / (kBeams - 1) - 0.5);
      scan.ranges[k] =
          world_.scan(kMiddle * moveBy(kTrue, time), kBeams, kFieldOfView, kNoise).ranges[k];
    }
    return scan;
  }

  static Pose2 motionOf(const Twist& twist) {
    return {twist.linear.x() * kSweep, twist.linear.y() * kSweep, twist.angular * kSweep};
  }

  std::optional<Pose2> matched(double duration, const Twist& believed) {
    belief_.step = motionOf(believed);
    const ScanSurface query = scanSurface(undistort(swept(duration), believed));
    return matchSweep(query, duration > 0.0 ? 1.0 : -1.0, belief_.step, kMiddle, prior_, belief_,
                      {{&reference_, kBefore}});
  }

  test::WalledWorld world_;
  PoseBelief prior_;
  SweepBelief belief_;
  ScanSurface reference_;
};

TEST_F(SweepMatching, FindsByHowMuchTheOdometryErrsWithinASweep) {
  const double error = 0.016, truth = motionOf(kTrue).theta;  // rad
  double left = 0.0;
  for (const double duration : {kSweep, -kSweep}) {
    for (const double turn : {-error, error}) {
      const auto motion = matched(duration, {kTrue.linear, kTrue.angular + turn / kSweep});
      ASSERT_TRUE(motion.has_value());
      left += 0.25 * std::abs(motion->theta - truth);
    }
  }
  EXPECT_LT(left, 0.25 * error);
}

TEST_F(SweepMatching, LeavesWhatIsRightAsItIs) {
  const auto motion = matched(kSweep, kTrue);
  ASSERT_TRUE(motion.has_value());
  const Pose2 truth = motionOf(kTrue);
  EXPECT_NEAR(motion->theta, truth.theta, 0.002);
  EXPECT_LT((motion->position() - truth.position()).norm(), 0.005);
}

TEST_F(SweepMatching, HoldsToWhatIsSureOfTheMotion) {
  belief_.information = 1e12 * Eigen::Matrix3d::Identity();
  const Twist wrong{kTrue.linear, kTrue.angular + 0.1};
  const auto motion = matched(kSweep, wrong);
  ASSERT_TRUE(motion.has_value());
  EXPECT_NEAR(motion->theta, motionOf(wrong).theta, 1e-5);
}

TEST_F(SweepMatching, SaysNothingOfAScanThatSeesNothingOfItsSurroundings) {
  const ScanSurface query = scanSurface(undistort(swept(kSweep), kTrue));
  const ScanSurface nothing = scanSurface(world_.scan({500.0, 0.0, 0.0}, kBeams, kFieldOfView));
  EXPECT_FALSE(matchSweep(query, 1.0, {}, kMiddle, prior_, belief_, {{&nothing, kBefore}}));
}

}  // namespace
}  // namespace cca
