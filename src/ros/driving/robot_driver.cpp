// SPDX-License-Identifier: BSD-3-Clause
#include "robot_driver.hpp"

#include <geometry_msgs/Twist.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>

#include "motion/commanded_motion.hpp"
#include "ros/messages/pose_message.hpp"
#include "ros/nodes/node_localisation.hpp"
#include "sensing/beam.hpp"

namespace cca {
namespace {

constexpr double kWatchPeriod = 0.05;  // s
// s, of a scan of one instant; the world has moved on since.
constexpr double kOldestScan = 0.5;
// s, of the odometry that is kept: no scan that is driven by is older.
constexpr double kKept = kOldestScan + ScanPeriod::kLongest;
// m, rad: localisations tremble by less. s: the slowest robot has gone as far.
constexpr double kHeldWithin = 0.05, kHeldFor = 5.0;
constexpr double kOldestOdometry = 0.3;  // s
constexpr double kWorthTelling = 0.05;   // s, that commands act later than told
// m, around the robot, of what other lasers see: it stands long before, from any speed.
constexpr double kHeededBeside = 4.0;
constexpr double kAhead = 5.0;         // m; a laser that looks there sees where the robot drives
constexpr double kThinned = 0.004;     // m, between neighbours: well below the margin that is kept
const ros::WallDuration kInsist(1.0);  // zero is said for so long, then others may drive

/// The fixed frame of scans.
const std::string& fixedFrame(const RobotDriver::Settings& settings) {
  return settings.pose == "slam" ? settings.frames.odom : settings.frames.map;
}

std::vector<Eigen::Vector2d> returnsAround(const Scan& scan, const Eigen::Vector2d& robot) {
  std::vector<Eigen::Vector2d> points;
  const Pose2& T = scan.T_map_sensor;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!isReturn(scan.ranges[i])) continue;
    const double bearing = T.theta + scan.bearing(i);
    const Eigen::Vector2d p =
        T.position() + scan.ranges[i] * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
    if ((p - robot).norm() > kHeededBeside) continue;
    if (points.empty() || (p - points.back()).norm() > kThinned) points.push_back(p);
  }
  return points;
}

}  // namespace

RobotDriver::RobotDriver(ros::NodeHandle& node, ros::NodeHandle& private_node,
                         const Settings& settings, const CcaParameters& mapping,
                         Exploration& exploration)
    : settings_(settings),
      exploration_(exploration),
      last_used_(settings.scans.size()),
      beside_(settings.scans.size()),
      last_moving_(ros::WallTime::now()),
      hazards_(node, {settings.hazard_points, settings.hazard_range, fixedFrame(settings)}),
      scans_(node,
             {settings.scans,
              {fixedFrame(settings), settings.frames.base, settings.frames.odom, std::nullopt,
               settings.frames.odom},
              kOldestScan},
             [this](const PlacedScan& placed) { use(placed); }),
      diagnostics_(node, private_node, scans_.dropped()),
      reconfigure_(private_node, changeable(),
                   [this] { exploration_.changeMotion(settings_.robot); }) {
  if (settings_.pose == "odometry") {
    fixed_transforms_ = node.advertise<tf2_msgs::TFMessage>("/tf_static", 1, true);
    tf2_msgs::TFMessage message;
    message.transforms = {
        transformMessage({}, settings_.frames.map, settings_.frames.odom, ros::Time::now())};
    fixed_transforms_.publish(message);
  }
  auto localiser = makeLocaliser(settings_.pose, settings_.corrections, mapping);
  slam_ = dynamic_cast<const SlamLocaliser*>(localiser.get());
  if (slam_) slam_publisher_.emplace(node, settings_.frames);
  external_ = dynamic_cast<ExternalCorrections*>(localiser.get());
  if (external_) path_ = hearCorrectedPath(node, *external_);
  if (!slam_ && !settings_.resume.empty()) {
    ROS_WARN("_resume:=%s has no effect: the robot is told where it is", settings_.resume.c_str());
  }
  exploration_.begin(std::move(localiser), settings_.resume, [this] {
    // It takes a second where the map is large; nobody else would stop the robot. move_base drives
    // on by its own.
    if (!move_base_) stand();
  });
  if (settings_.pose == "tf" && !settings_.plan.empty()) {
    exploration_.knowPlan(settings_.plan_lines);
  } else if (!settings_.plan.empty()) {
    ROS_WARN("_plan:=%s has no effect: nobody tells where the robot is in it",
             settings_.plan.c_str());
  }
  exploration_.note("pose", settings_.pose);
  if (settings_.driver == "move_base") {
    delegateDriving();
  } else {
    commands_ = node.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  }
  odometry_ =
      node.subscribe("odom", 10, &RobotDriver::take, this, ros::TransportHints().tcpNoDelay());
  watchdog_ =
      node.createTimer(ros::Duration(kWatchPeriod), [this](const ros::TimerEvent&) { watch(); });
}

RobotDriver::~RobotDriver() {
  watchdog_.stop();
  stand();
  ros::WallDuration(0.1).sleep();  // for the message to leave before the connection does
  if (!exploration_.finished()) exploration_.finishPoses();
}

// Radius and margin are in all that is known of ways, and stay.
std::vector<ReconfigureServer::Number> RobotDriver::changeable() {
  std::vector<ReconfigureServer::Number> numbers;
  describe(settings_.robot, [&](const std::string& name, double& value, double lowest,
                                double highest, const std::string& unit, const std::string& what) {
    if (name == "radius" || name == "safety_margin") return;
    numbers.push_back({name, "robot/" + name, what + " [" + unit + "]", lowest, highest, &value});
  });
  numbers.push_back({"scan_timeout", "scan_timeout",
                     "without a usable scan for longer, the robot is stopped [s]",
                     kScanTimeouts.first, kScanTimeouts.second, &settings_.scan_timeout});
  return numbers;
}

void RobotDriver::delegateDriving() {
  exploration_.delegateDriving();
  move_base_.emplace(
      settings_.frames.map, [this](DriveOutcome outcome) { exploration_.noteOutcome(outcome); },
      [this](const std::string& why) {
        if (exploration_.drives()) exploration_.pause(why);
        ROS_WARN("%s: call ~pause with false to go on", why.c_str());
      });
}

void RobotDriver::take(const nav_msgs::Odometry& odometry) {
  const auto isTooOld = [&](const nav_msgs::Odometry& other) {
    const double age = (odometry.header.stamp - other.header.stamp).toSec();
    return age < 0.0 || age > kKept;  // the clock was set back, or so it is
  };
  while (!lately_.empty() && isTooOld(lately_.front())) lately_.pop_front();
  lately_.push_back(odometry);
}

// When the scan was taken: what the base has done since is the commands' affair.
Velocity RobotDriver::measuredVelocity(const ros::Time& stamp) const {
  double least = kOldestOdometry;
  Velocity velocity = command_;
  for (const auto& odometry : lately_) {
    const auto& twist = odometry.twist.twist;
    const double off = std::abs((odometry.header.stamp - stamp).toSec());
    if (off >= least || !std::isfinite(twist.linear.x) || !std::isfinite(twist.angular.z)) continue;
    least = off;
    velocity = {twist.linear.x, twist.angular.z};
  }
  return velocity;
}

void RobotDriver::checkLatency() {
  const ActuationModel& shown = exploration_.actuation();
  const bool is_later = shown.earliest() > settings_.robot.latency + kWorthTelling;
  if (!shown.knowsLatency() || !is_later) return;
  ROS_WARN_ONCE(
      "odom shows that commands act %.2f s late; robot/latency says %.2f s: the larger is used",
      shown.latency(), settings_.robot.latency);
}

/// The explorer sets aside one goal after another then; that it does not move, and why not, is for
/// somebody else to see.
void RobotDriver::tellIfHeld(const PlacedScan& placed) {
  const double passed = std::clamp((placed.stamp - last_stamp_).toSec(), 0.0, kOldestScan);
  last_stamp_ = placed.stamp;
  const Pose2 moved = T_fixed_held_.inverse() * placed.at.T_fixed_robot;
  if (moved.position().norm() > kHeldWithin || std::abs(wrapAngle(moved.theta)) > kHeldWithin) {
    T_fixed_held_ = placed.at.T_fixed_robot;
    held_for_ = 0.0;
  } else if (command_.linear != 0.0 || command_.angular != 0.0) {
    held_for_ += passed;
  }
  if (held_for_ <= kHeldFor) return;
  ROS_WARN_THROTTLE(10.0,
                    "the robot was told to move for %.0f s, and has not: motors off, an emergency "
                    "stop, something else that is obeyed first?",
                    held_for_);
}

void RobotDriver::use(const PlacedScan& placed) {
  tellSlowLaser(placed.topic);
  if (placed.topic != 0) return useBeside(placed);
  const ros::WallTime begin = ros::WallTime::now();
  if (exploration_.isAtEnd()) return exploration_.conclude(placed.stamp);
  Measurement measurement = measurementOf(placed, slam_ != nullptr);
  // SLAM's map begins where the robot stands at its first scan.
  if (slam_ && exploration_.session().mapping().times().empty()) measurement.T_map_robot = Pose2{};
  Observation observation = exploration_.sense(measurement, measuredVelocity(placed.stamp));
  const ExplorationSession& session = exploration_.session();
  if (slam_) {
    slam_publisher_->publish(session.estimate(), placed.at.T_fixed_robot, *slam_, placed.stamp,
                             diagnostics_);
  } else if (session.estimate().was_corrected) {
    logCorrection(*external_);
    // What is kept stands in the frame of the map.
    hazards_.move(session.mapping().past().correctionHere());
    for (Beside& beside : beside_) beside.points.clear();  // the next are a tenth of a second away
  }
  if (const char* why = deaf()) {
    if (exploration_.drives()) exploration_.wait(why);
    if (move_base_) move_base_->forget();
    return;
  }
  if (!move_base_ &&
      !looksTowards(placed.scan, placed.at.T_fixed_robot * Eigen::Vector2d(kAhead, 0)))
    return waitForSight(placed);
  if (const auto silent = silentLaser(1)) {
    if (exploration_.drives()) waitForLaser(*silent);
    return stand();
  }
  // By a scan that has become old meanwhile nobody drives.
  if ((ros::WallTime::now() - begin).toSec() > settings_.scan_timeout) return;
  addObstacles(placed, observation);
  tellIfHeld(placed);
  obey(exploration_.step(std::move(observation), placed.stamp));
  last_used_[0] = placed.arrival;
  diagnostics_.scanUsed((ros::WallTime::now() - begin).toSec(), exploration_.agreement());
}

/// What other sensors see.
void RobotDriver::addObstacles(const PlacedScan& placed, Observation& observation) {
  const Pose2 T_map_fixed = observation.T_map_robot * placed.at.T_fixed_robot.inverse();
  observation.seen_elsewhere = seenElsewhere(placed.stamp, T_map_fixed);
  observation.hazards =
      hazards_.around(placed.at.T_fixed_robot.position(), placed.stamp, scans_.transforms());
  for (Eigen::Vector2d& p : observation.hazards) p = T_map_fixed * p;
}

void RobotDriver::obey(const Velocity& velocity) {
  if (!move_base_) {
    command(velocity);
    checkLatency();
  } else if (exploration_.goal() && exploration_.drives()) {
    move_base_->driveTo(*exploration_.goal());
  } else {
    stand();
  }
}

void RobotDriver::useBeside(const PlacedScan& placed) {
  last_used_[placed.topic] = placed.arrival;
  Scan scan = exploration_.addSecondary(measurementOf(placed, slam_ != nullptr), placed.topic);
  scan.T_map_sensor = placed.scan.T_map_sensor;
  beside_[placed.topic] = {returnsAround(scan, placed.at.T_fixed_robot.position()), placed.stamp};
}

std::vector<Eigen::Vector2d> RobotDriver::seenElsewhere(const ros::Time& stamp,
                                                        const Pose2& T_map_fixed) const {
  std::vector<Eigen::Vector2d> points_map;
  for (std::size_t topic = 0; topic < beside_.size(); ++topic) {
    const Beside& beside = beside_[topic];
    if (std::abs((stamp - beside.stamp).toSec()) > longestSilence(topic)) continue;
    for (const Eigen::Vector2d& p : beside.points) points_map.push_back(T_map_fixed * p);
  }
  return points_map;
}

double RobotDriver::longestSilence(std::size_t topic) const {
  return scans_.period(topic).longestSilence(settings_.scan_timeout);
}

void RobotDriver::tellSlowLaser(std::size_t topic) {
  const double limit = longestSilence(topic);
  if (limit <= settings_.scan_timeout) return;
  ROS_WARN_ONCE(
      "'%s' comes %.1f times a second: the robot is stopped %.2f s after the last one, not "
      "%.2f s (scan_timeout)",
      settings_.scans[topic].c_str(), 1.0 / scans_.period(topic).seconds(), limit,
      settings_.scan_timeout);
}

std::optional<std::size_t> RobotDriver::silentLaser(std::size_t first) const {
  const ros::Time now = ros::Time::now();
  for (std::size_t topic = first; topic < last_used_.size(); ++topic) {
    const double age = (now - last_used_[topic]).toSec();
    if (age < 0.0 || age > longestSilence(topic)) return topic;
  }
  return std::nullopt;
}

void RobotDriver::waitForLaser(std::size_t topic) {
  const std::string which =
      settings_.scans.size() > 1 ? " of '" + settings_.scans[topic] + "'" : "";
  exploration_.wait("no usable scan" + which + scans_.lastTrouble());
}

// It drives forwards only.
void RobotDriver::waitForSight(const PlacedScan& placed) {
  last_used_[placed.topic] = placed.arrival;
  if (exploration_.drives()) {
    exploration_.wait("'" + settings_.scans[placed.topic] + "' does not look ahead of '" +
                      settings_.frames.base +
                      "', where the robot drives: a laser that does has to be the first of ~scans");
  }
  stand();
}

void RobotDriver::watch() {
  const ros::Time now = ros::Time::now();
  const auto silent = silentLaser(0);
  for (ros::Time& used : last_used_) {
    if (now < used) used = ros::Time();  // the clock was set back
  }
  if (silent && exploration_.drives()) {
    const char* why = deaf();
    why ? exploration_.wait(why) : waitForLaser(*silent);
  }
  if (silent || !exploration_.drives()) {
    stand();
  } else if (!move_base_) {
    command(command_);
  }
  diagnostics_.setState(exploration_.state());
}

const char* RobotDriver::deaf() const {
  if (move_base_) return move_base_->isThere() ? nullptr : "no move_base is there";
  return commands_.getNumSubscribers() > 0 ? nullptr : "nobody listens to cmd_vel";
}

void RobotDriver::stand() {
  if (move_base_) {
    move_base_->stop();
  } else {
    command({});
  }
}

void RobotDriver::command(const Velocity& velocity) {
  const ros::WallTime now = ros::WallTime::now();
  const bool moving = velocity.linear != 0.0 || velocity.angular != 0.0;
  command_ = velocity;
  if (moving || exploration_.drives()) last_moving_ = now;
  if (now - last_moving_ > kInsist) return;
  geometry_msgs::Twist twist;
  twist.linear.x = velocity.linear;
  twist.angular.z = velocity.angular;
  commands_.publish(twist);
}

}  // namespace cca
