// SPDX-License-Identifier: BSD-3-Clause
#include "robot_check.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>

#include "cca_mrpt/sensing/missing_returns.hpp"
#include "cca_mrpt/session/mapping_session.hpp"
#include "cca_mrpt/slam/slam_localiser.hpp"
#include "geometry/median.hpp"
#include "io/files/text.hpp"
#include "mount_error.hpp"
#include "ros/input/scan_period.hpp"
#include "ros/messages/scan_message.hpp"
#include "ros/nodes/node_localisation.hpp"

namespace cca {
namespace {

constexpr double kSlowLaser = 0.15;   // s; scan_timeout grows with the period from there on
constexpr double kClockAhead = 0.05;  // s; clocks that are kept by the network differ by less
constexpr double kLate = 0.2;         // s, beyond the period: the robot is driven by what was
constexpr double kRarely = 0.07;      // s, between odometry messages: below 15 a second
constexpr double kMostly = 0.9;       // of the scans
constexpr double kBlindArc = 5.0;     // deg; narrower ones are single surfaces that return nothing
constexpr double kLeastTurn = 1.0;    // rad, driven, that scans can tell anything of
constexpr double kLeastWay = 1.0;     // m, the same
constexpr double kWrongScale = 0.05;  // of turn or way: line SLAM learns it, others do not
constexpr double kLongestDelay = 0.2, kDelayStep = 0.01, kLeastDelay = 0.03;  // s
constexpr double kTelling = 10.0;     // times the squared error of the best delay, at the worst one
constexpr double kOneInstant = 0.02;  // s
constexpr double kWrongPlace = 0.04, kWrongTurn = 0.04;  // m, rad, of the laser on the robot
constexpr double kSureOf = 4.0;                          // sigmas
constexpr std::size_t kLeastScans = 10;

template <class Messages>
double medianPeriod(const Messages& messages) {
  std::vector<double> periods;
  for (std::size_t k = 1; k < messages.size(); ++k) {
    periods.push_back((messages[k].header.stamp - messages[k - 1].header.stamp).toSec());
  }
  return median(periods);
}

/// "12 to 40 deg, 355 to 359 deg": runs of beams that `is` holds of, at least as wide as told.
template <class Is>
std::string arcsOf(const sensor_msgs::LaserScan& scan, double least_deg, const Is& is) {
  std::string arcs;
  const std::size_t n = scan.ranges.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t end = i;
    while (end < n && is(end)) ++end;
    const double width =
        kDegreesPerRadian * std::abs(scan.angle_increment) * static_cast<double>(end - i);
    const auto bearing = [&](std::size_t beam) {
      return kDegreesPerRadian *
             (scan.angle_min + static_cast<double>(beam) * scan.angle_increment);
    };
    if (end > i && width >= least_deg) {
      arcs +=
          (arcs.empty() ? "" : ", ") + formatted("%.0f to %.0f deg", bearing(i), bearing(end - 1));
    }
    if (end > i) i = end;
  }
  return arcs;
}

/// Where line SLAM and the odometry have each scan, in its middle.
struct Drive {
  std::vector<Pose2> by_scans, by_wheels;
  std::vector<ros::Time> middles;
};

/// How far the heading goes from one to the next, by rising number.
std::vector<double> turnsOf(const std::vector<Pose2>& poses) {
  std::vector<double> turns;
  for (std::size_t k = 1; k < poses.size(); ++k) {
    turns.push_back(wrapAngle(poses[k].theta - poses[k - 1].theta));
  }
  return turns;
}

double wayOf(const std::vector<Pose2>& poses) {
  double way = 0.0;
  for (std::size_t k = 1; k < poses.size(); ++k) {
    way += (poses[k].position() - poses[k - 1].position()).norm();
  }
  return way;
}

/// The factor that leads from one to the other, by least squares.
double scaleOf(const std::vector<double>& from, const std::vector<double>& to) {
  const double squares = std::inner_product(from.begin(), from.end(), from.begin(), 0.0);
  const double product = std::inner_product(from.begin(), from.end(), to.begin(), 0.0);
  return squares > 0.0 ? product / squares : 1.0;
}

/// @param scale  of the odometry's turns or ways, as the scans show. @param what  of the wheels.
void checkScale(const char* of, double scale, const char* what, Findings& findings) {
  const std::string told = formatted("odom: %s of the scans are %.3f of its own", of, scale);
  if (std::abs(scale - 1.0) < kWrongScale) return findings.good(told);
  findings.note(told, formatted("calibrate the wheels' %s; line SLAM learns it", what));
}

/// s, by how much the odometry's stamps have to be moved to turn when the scans do; nothing where
/// the robot has turned too evenly to tell.
std::optional<double> delayOf(const Drive& drive, const Transforms& transforms,
                              const std::string& odom, const std::string& base) {
  const std::vector<double> by_scans = turnsOf(drive.by_scans);
  double least = INFINITY, most = 0.0, best = 0.0;
  const int steps = static_cast<int>(std::lround(kLongestDelay / kDelayStep));
  for (int step = -steps; step <= steps; ++step) {
    const ros::Duration delay(step * kDelayStep);
    double sum = 0.0, count = 0.0;
    std::optional<double> last, heading;
    for (std::size_t k = 0; k < drive.middles.size(); ++k, last = heading) {
      const ros::Time time = drive.middles[k] + delay;
      heading.reset();
      if (!transforms.has(odom, base, time)) continue;
      heading = transforms.lookup(odom, base, time).pose.theta;
      if (!last) continue;
      const double error = wrapAngle(*heading - *last) - by_scans[k - 1];
      sum += error * error;
      ++count;
    }
    if (count < kLeastScans) continue;
    most = std::max(most, sum / count);
    if (sum / count >= least) continue;
    least = sum / count;
    best = delay.toSec();
  }
  return most > kTelling * least ? std::optional<double>(best) : std::nullopt;
}

}  // namespace

void RobotCheck::take(const tf2_msgs::TFMessage& transforms, const std::string& sender) {
  for (const auto& transform : transforms.transforms) {
    const std::string parent = frameName(transform.header.frame_id);
    senders_[frameName(transform.child_frame_id)].insert("'" + parent + "' by " + sender);
  }
}

Findings RobotCheck::findings(const Transforms& transforms) const {
  Findings findings;
  checkOdometry(findings);
  checkFrames(transforms, findings);
  checkSenders(findings);
  if (scans_.empty()) return findings;
  checkScans(findings);
  checkStamps(findings);
  checkOwnBody(transforms, findings);
  checkMotion(transforms, findings);
  return findings;
}

void RobotCheck::checkScans(Findings& findings) const {
  std::map<std::string, int> broken;
  for (const auto& message : scans_) {
    try {
      scanFromMessage(message);
    } catch (const std::runtime_error& error) {
      ++broken[error.what()];
    }
  }
  for (const auto& [why, count] : broken) {
    findings.fault(
        formatted("%d of %zu scans are impossible: %s", count, scans_.size(), why.c_str()),
        "mend the driver: such scans are dropped");
  }
  const sensor_msgs::LaserScan& scan = scans_.front();
  const double period = medianPeriod(scans_);
  const std::string what =
      formatted("scan: %.1f a second, %zu beams, %.0f to %.0f deg, %.2f to %.2f m", 1.0 / period,
                scan.ranges.size(), kDegreesPerRadian * scan.angle_min,
                kDegreesPerRadian * scan.angle_max, scan.range_min, scan.range_max);
  if (!(period > 0.0)) {
    findings.fault("scan: all have one stamp", "mend the driver: it does not tell time");
  } else if (period > kSlowLaser) {
    ScanPeriod heard;
    for (const auto& one : scans_) heard.add(one.header.stamp);
    findings.note(what, formatted("none: the robot is stopped %.2f s after the last scan",
                                  heard.longestSilence(0.3)));
  } else {
    findings.good(what);
  }
}

void RobotCheck::checkStamps(Findings& findings) const {
  const double age = median(scan_ages_), allowed = medianPeriod(scans_) + kLate;
  if (age < -kClockAhead) {
    findings.fault(formatted("scan: stamped %.2f s ahead of this computer's clock", -age),
                   "set the clocks by one another (chrony), or use_sim_time");
  } else if (age > allowed) {
    findings.fault(formatted("scan: %.2f s old when it comes", age),
                   "set the clocks by one another (chrony); look for a slow network");
  } else {
    findings.good(formatted("scan: %.2f s old when it comes", age));
  }
}

/// Beams that end on the robot, or nowhere.
void RobotCheck::checkOwnBody(const Transforms& transforms, Findings& findings) const {
  const sensor_msgs::LaserScan& first = scans_.front();
  const std::size_t n = first.ranges.size();
  const std::string laser = frameName(first.header.frame_id);
  Pose2 T_base_laser;
  if (transforms.has(settings_.base_frame, laser, ros::Time())) {
    T_base_laser = transforms.lookup(settings_.base_frame, laser, ros::Time()).pose;
  }
  std::vector<double> on_robot(n), nothing(n), count(n);
  for (const auto& message : scans_) {
    if (message.ranges.size() != n) continue;
    for (std::size_t i = 0; i < n; ++i) {
      const double range = message.ranges[i];
      const double bearing = first.angle_min + static_cast<double>(i) * first.angle_increment;
      const bool returns = std::isfinite(range) && range > 0.0 && range < message.range_max;
      const Eigen::Vector2d p =
          T_base_laser * Eigen::Vector2d(range * std::cos(bearing), range * std::sin(bearing));
      ++count[i];
      nothing[i] += !returns;
      on_robot[i] += returns && p.norm() < settings_.radius;
    }
  }
  const auto mostly = [&](const std::vector<double>& of) {
    return [&](std::size_t i) { return of[i] > kMostly * count[i]; };
  };
  const std::string own = arcsOf(first, 0.0, mostly(on_robot));
  if (!own.empty()) {
    findings.fault("scan: meets the robot itself at " + own,
                   formatted("range_min of the driver above %.2f m, or a laser_filters mask",
                             settings_.radius));
  }
  const std::string blind = arcsOf(first, kBlindArc, mostly(nothing));
  if (!blind.empty()) {
    findings.note("scan: nothing comes back at " + blind,
                  "none where that is open space; else see what covers the laser");
  }
}

void RobotCheck::checkOdometry(Findings& findings) const {
  if (odometry_.empty()) return;
  const nav_msgs::Odometry& first = odometry_.front();
  const double period = medianPeriod(odometry_);
  if (period > kRarely || !(period > 0.0)) {
    findings.fault(formatted("odom: one message in %.2f s", period),
                   "20 a second or more: latency and brakes are learned from it");
  } else {
    findings.good(formatted("odom: %.0f a second", 1.0 / period));
  }
  const std::string odom = frameName(first.header.frame_id), base = frameName(first.child_frame_id);
  if (!odom.empty() && odom != settings_.odom_frame) {
    findings.fault("odom: its frame is '" + odom + "', not '" + settings_.odom_frame + "'",
                   "odom_frame: " + odom);
  }
  if (!base.empty() && base != settings_.base_frame) {
    findings.note("odom: it tells of '" + base + "', not of '" + settings_.base_frame + "'",
                  "base_frame: " + base + " (where that is the robot's middle)");
  }
}

void RobotCheck::checkFrames(const Transforms& tf, Findings& findings) const {
  const auto& [odom, base, map, radius] = settings_;
  if (tf.has(odom, base, ros::Time())) {
    findings.good("tf: " + odom + " -> " + base);
  } else {
    findings.fault("tf: " + tf.whyNot(odom, base), "odom_frame, base_frame: as tf has them");
  }
  const bool is_told = tf.has(map, base, ros::Time());
  findings.good((is_told ? "tf: somebody tells " : "tf: nobody tells ") + map + " -> " + odom +
                (is_told ? " (pose: tf)" : " (pose: slam)"));
  if (scans_.empty()) return;
  const std::string laser = frameName(scans_.front().header.frame_id);
  if (laser == base) return;
  if (!tf.has(base, laser, ros::Time())) {
    findings.fault("tf: " + tf.whyNot(base, laser),
                   "static_transform_publisher X Y Z YAW PITCH ROLL " + base + " " + laser);
    return;
  }
  try {
    const PlanarPose mount = tf.lookup(base, laser, ros::Time());
    const Pose2& T = mount.pose;
    findings.good(formatted("tf: the laser is at %.2f, %.2f m, %.0f deg%s", T.x, T.y,
                            kDegreesPerRadian * T.theta, mount.upside_down ? ", upside down" : ""));
  } catch (const std::runtime_error& error) {
    findings.fault(std::string("tf: the laser: ") + error.what(),
                   "scans of a level laser are needed");
  }
}

/// tf keeps one place of a frame: of two it is now here, now there.
void RobotCheck::checkSenders(Findings& findings) const {
  for (const auto& [child, senders] : senders_) {
    if (senders.size() < 2) continue;
    std::string list;
    for (const std::string& sender : senders) list += (list.empty() ? "" : ", and in ") + sender;
    findings.fault("tf: where '" + child + "' is, is told in " + list,
                   "let one of them only: end the other, or its publish_tf");
  }
  const double age = median(pose_ages_);
  if (age > kLate) {
    findings.fault("tf: " + settings_.odom_frame + " -> " + settings_.base_frame +
                       formatted(" is %.2f s old when a scan comes", age),
                   "send it 20 times a second or more; set the clocks by one another (chrony)");
  }
}

/// What the scans tell of sweep and wheels, where the robot has moved.
void RobotCheck::checkMotion(const Transforms& tf, Findings& findings) const {
  const PlacementFrames frames{settings_.odom_frame, settings_.base_frame, "", std::nullopt, ""};
  MappingSession::Settings settings;
  settings.maps_at_the_end = true;
  MappingSession session(std::make_unique<SlamLocaliser>(), settings);
  MissingReturns missing_returns;
  Drive drive;
  for (const auto& message : scans_) {
    const std::string laser = frameName(message.header.frame_id);
    const ros::Time middle = sweepMiddle(message);
    if (!hasPlacement(tf, frames, laser, middle)) continue;
    try {
      PlacedScan placed;
      placed.scan = scanFromMessage(message);
      placed.middle = middle;
      placed.at = placeByTf(placed.scan, tf, frames, laser, middle);
      missing_returns.judge(placed.scan);
      session.add(measurementOf(placed, true));
      drive.by_wheels.push_back(placed.at.T_fixed_robot);
      drive.middles.push_back(middle);
    } catch (const std::runtime_error&) {  // it has been told above
      continue;
    }
  }
  if (drive.middles.size() < kLeastScans) return;
  drive.by_scans = session.trajectory();
  const std::vector<double> by_scans = turnsOf(drive.by_scans),
                            by_wheels = turnsOf(drive.by_wheels);
  double turned = 0.0;
  for (const double turn : by_scans) turned += std::abs(turn);
  const double way = wayOf(drive.by_scans);
  if (turned < kLeastTurn) {
    findings.note(formatted("the robot has turned by %.0f deg and gone %.1f m",
                            kDegreesPerRadian * turned, way),
                  "drive and turn it by hand meanwhile: scans tell sweep and odometry then");
    return;
  }
  const double sweep = session.sweepDuration(0);  // negative: the last beam first
  findings.good(std::abs(sweep) < kOneInstant
                    ? "scan: all beams of one instant"
                    : formatted("scan: one sweep takes %.3f s, %s beam first; that is undone",
                                std::abs(sweep), sweep > 0.0 ? "the first" : "the last"));
  checkScale("turns", scaleOf(by_wheels, by_scans), "distance", findings);
  if (way > kLeastWay) {
    const double scale = way / std::max(1e-3, wayOf(drive.by_wheels));
    checkScale("ways", scale, "radius", findings);
  }
  checkMount(tf, drive.by_scans, drive.by_wheels, findings);
  const auto delay = delayOf(drive, tf, settings_.odom_frame, settings_.base_frame);
  if (!delay) return;
  if (std::abs(*delay) < kLeastDelay) return findings.good("scan: its stamps are the odometry's");
  findings.fault(formatted("scan: its stamps are %.2f s %s the odometry's", std::abs(*delay),
                           *delay > 0.0 ? "before" : "after"),
                 formatted("move the driver's stamps by %+.2f s", *delay));
}

/// Where the laser is on the robot, by how both have moved.
void RobotCheck::checkMount(const Transforms& tf, const std::vector<Pose2>& by_scans,
                            const std::vector<Pose2>& by_wheels, Findings& findings) const {
  const std::string &base = settings_.base_frame, laser = frameName(scans_.front().header.frame_id);
  const auto error = mountError(by_scans, by_wheels);
  if (!error || laser == base || !tf.has(base, laser, ros::Time())) return;
  const Pose2& off = error->T_true_told;
  const double place = off.position().norm(), turn = std::abs(off.theta);
  const bool is_off = place > kWrongPlace + kSureOf * error->sigma;
  const bool is_turned = turn > kWrongTurn + kSureOf * error->turn_sigma;
  if (is_off || is_turned) {
    const Pose2 told = tf.lookup(base, laser, ros::Time()).pose;
    const Pose2 mount = Pose2{is_off ? off.x : 0.0, is_off ? off.y : 0.0, off.theta} * told;
    findings.fault(
        formatted(
            "tf: by how it moves, the laser is at %.2f, %.2f m, %.0f deg, not where tf has it",
            mount.x, mount.y, kDegreesPerRadian * mount.theta),
        formatted("static_transform_publisher %.2f %.2f Z %.3f PITCH ROLL ", mount.x, mount.y,
                  mount.theta) +
            base + " " + laser);
  } else if (error->sigma < kWrongPlace && error->turn_sigma < kWrongTurn) {
    findings.good("tf: the laser moves as its place there has it");
  }
}

}  // namespace cca
