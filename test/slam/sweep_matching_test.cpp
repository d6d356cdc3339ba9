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
    belief_.information.diagonal() << 2e4, 2e4, 2e3;
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

  /// By half of a sweep.
  static Pose2 motionOf(const Twist& twist) { return moved(twist, 0.5 * kSweep); }
  static Pose2 moved(const Twist& twist, double time) {
    return {twist.linear.x() * time, twist.linear.y() * time, twist.angular * time};
  }
  static Pose2 wholeOf(const SweepHalves& motion) {
    const auto& [before, after] = motion;
    return {before.x + after.x, before.y + after.y, before.theta + after.theta};
  }

  std::optional<SweepFit> matched(double duration, const Twist& before, const Twist& after) {
    belief_.motion = {motionOf(before), motionOf(after)};
    const ScanSurface query = scanSurface(undistort(swept(duration), before, after));
    return matchSweep(query, {belief_.motion, duration > 0.0 ? 1.0 : -1.0}, kMiddle, prior_,
                      belief_, {{&reference_, kBefore}});
  }
  std::optional<Pose2> matched(double duration, const Twist& believed) {
    const auto fit = matched(duration, believed, believed);
    return fit ? std::optional(wholeOf(fit->motion)) : std::nullopt;
  }

  test::WalledWorld world_;
  PoseBelief prior_;
  SweepBelief belief_;
  ScanSurface reference_;
};

TEST_F(SweepMatching, FindsByHowMuchTheOdometryErrsWithinASweep) {
  const double error = 0.016, truth = moved(kTrue, kSweep).theta;  // rad
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

// Of a change that is none the robot's heading would be wrong: both walls of a corridor are seen
// a quarter of the sweep from its middle.
TEST_F(SweepMatching, FindsThatTheVelocityDidNotChangeAsTheOdometrySays) {
  const double error = 0.008;  // rad, of either half
  double left = 0.0;
  for (const double turn : {-error, error}) {
    const double rate = turn / (0.5 * kSweep);
    const auto fit =
        matched(kSweep, {kTrue.linear, kTrue.angular - rate}, {kTrue.linear, kTrue.angular + rate});
    ASSERT_TRUE(fit.has_value());
    left += 0.5 * std::abs(fit->motion.after.theta - fit->motion.before.theta);
    EXPECT_GT(fit->change_error, 0.0);  // the wheels tell a change, and the scan does not show it
  }
  EXPECT_LT(left, 0.25 * 2.0 * error);
}

TEST_F(SweepMatching, LeavesWhatIsRightAsItIs) {
  const auto motion = matched(kSweep, kTrue);
  ASSERT_TRUE(motion.has_value());
  const Pose2 truth = moved(kTrue, kSweep);
  EXPECT_NEAR(motion->theta, truth.theta, 0.002);
  EXPECT_LT((motion->position() - truth.position()).norm(), 0.005);
}

TEST_F(SweepMatching, BendsASurfaceAsTheOtherMotionWouldHaveUndoneIt) {
  const Twist wrong{kTrue.linear, kTrue.angular + 0.2};
  for (const double duration : {kSweep, -kSweep}) {
    const Scan scan = swept(duration);
    const SweptScan sweep{{motionOf(wrong), motionOf(wrong)}, duration > 0.0 ? 1.0 : -1.0};
    const ScanSurface exact = scanSurface(world_.scan(kMiddle, kBeams, kFieldOfView));
    const auto off = [&exact](const ScanSurface& seen) {  // m rms
      const MatchQuadric pairs = matchQuadric(seen, {}, {{&exact, Pose2()}}, {0.1, 0.025, 1});
      return std::sqrt(pairs.sum_sq / pairs.sum_weights);
    };
    const ScanSurface undone = scanSurface(undistort(scan, kTrue));
    ScanSurface surface = scanSurface(undistort(scan, wrong));
    EXPECT_GT(off(surface), 1.5 * off(undone));
    bendBy({motionOf(kTrue), motionOf(kTrue)}, sweep, surface);
    EXPECT_LT(off(surface), 1.1 * off(undone));
  }
}

TEST_F(SweepMatching, HoldsToWhatIsSureOfTheMotion) {
  belief_.information = 1e12 * Eigen::Matrix3d::Identity();
  const Twist wrong{kTrue.linear, kTrue.angular + 0.1};
  const auto motion = matched(kSweep, wrong);
  ASSERT_TRUE(motion.has_value());
  EXPECT_NEAR(motion->theta, moved(wrong, kSweep).theta, 1e-5);
}

TEST_F(SweepMatching, SaysNothingOfAScanThatSeesNothingOfItsSurroundings) {
  const ScanSurface query = scanSurface(undistort(swept(kSweep), kTrue));
  const ScanSurface nothing = scanSurface(world_.scan({500.0, 0.0, 0.0}, kBeams, kFieldOfView));
  EXPECT_FALSE(matchSweep(query, {}, kMiddle, prior_, belief_, {{&nothing, kBefore}}));
}

}  // namespace
}  // namespace cca
