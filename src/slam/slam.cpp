// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/slam/slam.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace cca {
namespace {

/// m, rad; a new key frame after so much way, or turn of a laser that does not see all round: a
/// doorway is passed in two, and of 180 degrees nine tenths are common to neighbours.
constexpr double kFrameDistance = 0.5, kFrameTurn = 0.35;
/// Key frames that a scan is compared with: five metres of way. A scan that becomes no key frame
/// makes do with the nearest of them.
constexpr int kViewFrames = 10;
constexpr std::size_t kMatched = 5;
/// m; of a search around the pose: cells of half the least reach of a match, returns two cells
/// apart, none beyond 12 m, where beams of a degree are farther apart than these.
constexpr double kSearchCell = 0.05, kSearchSpacing = 0.1, kSearchReach = 12.0;
/// Coarsest cells of 0.4 m for a window of one metre. All round of 1.6 m, which nearly spans the
/// window: one bound a direction.
constexpr int kSearchLevels = 3, kLevelsAllRound = 5;
/// 99.7 % of the prior lies within the window.
constexpr double kSearchSigmas = 3.0;
/// m, rad; a wider window finds the next door as well, which is for loop closing to tell apart. A
/// narrower one than the least is what a match reaches by itself.
constexpr double kWidestWindowHere = 1.0, kWidestTurn = 1.0;
constexpr double kLeastSearch = 0.2, kLeastTurn = 0.2;
constexpr double kFirstReach = 0.3;  // m, of a match: the least window and a half
constexpr double kSearchArm = 3.0;   // m, a usual distance of walls
constexpr std::size_t kJudges = 3;   // frames that say how well a scan agrees with them
constexpr double kAgree = 0.2;       // m, within which rays do
/// From a key frame to the next.
constexpr MatchScale kStepMatch{0.15, 0.04};
/// Of its sigma, at least: the walls themselves are no better.
constexpr double kLeastNoise = 0.1;
/// Where the wheels leave little open, a scan that agrees by this is found downhill from there.
constexpr double kClear = 0.9;
/// A scan that agrees less is looked for in all directions; nearly all that are right agree by
/// more.
constexpr double kDoubtful = 0.6, kClearlyBetter = 0.2, kVague = 1e-3;
/// A scan that agrees by so much less than those of late is in doubt; among people all agree less.
constexpr double kUnlike = 0.25, kUsualShare = 0.05;
/// One that is taken for turned agrees where it is found about as well as those of late.
constexpr double kNearlyUsual = 0.1;
/// A place elsewhere has at least this share of the returns in common with earlier scans that the
/// place here has: one that hides from them agrees with everything.
constexpr double kLeastInCommonElsewhere = 0.5;
/// What has less in common with what was seen before, for each return, contradicts nothing.
constexpr double kLeastInCommon = 0.1;
/// Contradicting scans in a row after which the robot is lost, once it has driven so far; and the
/// number without any motion, some seconds.
constexpr int kLostScans = 3, kLostStanding = 50;
constexpr double kLostWay = 1.0;  // m; turns on the spot among people contradict, too
/// m, turns counted: some 80 degrees. Scans that contradict the map and agree by so much with one
/// another are of one place, and neither of people nor of the floor.
constexpr double kLostWayOfOnePlace = 2.0, kOfOnePlace = 0.9;
/// 1/m^2, 1/rad^2; what the wheels say of the step between two of them: to 5 cm and 6 degrees.
const Eigen::Vector3d kDoubtfulStep(400.0, 400.0, 100.0);
/// m; a jump is believed after so much way, or this share of what it claims, whatever is more: a
/// robot that nods on braking sees the floor for a third of a metre. A turn on the spot shows
/// nothing new.
constexpr double kLeastWayThere = 0.5, kWayOfClaim = 0.35;

/// m^2, rad^2; variance of the wheels' edge over a jump, the size of the search for it.
constexpr double kUnknownJump = 1.0;

/// Cells of the likelihood pyramid that a search looks up in one scan: some 5 ms. Of a lost robot
/// in an office it takes five to ten times as many, and a key frame at walking pace as many scans.
constexpr int kCellsAtOnce = 2000000;

/// Poses are solved for again when the graph has grown by this, and by this share: all solutions of
/// a drive together cost a few of the last one.
constexpr int kSettleAfter = 15, kSettleShare = 10;
/// The past has been corrected where a pose of it has moved by this since the last time [m]: about
/// what the maps made from it can tell.
constexpr double kCorrection = 0.05;

/// Length [m] of a motion; a turn by which a key frame is due counts as the way by which one is.
double lengthOf(const Pose2& step) {
  return step.position().norm() + kFrameDistance / kFrameTurn * std::abs(step.theta);
}

Eigen::Matrix3d turned(const Eigen::Matrix3d& matrix, double angle) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  return R * matrix * R.transpose();
}

/// How a heading error of the frame turns a position in it.
Eigen::Matrix3d carried(const Eigen::Matrix3d& covariance, const Eigen::Vector2d& arm) {
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  J(0, 2) = -arm.y();
  J(1, 2) = arm.x();
  return J * covariance * J.transpose();
}

/// Both ways: a return behind the wall that stood there contradicts by what it saw through.
SightCount mutualSights(const ScanSurface& reference, const ScanSurface& query,
                        const Pose2& T_reference_query) {
  SightCount sights = compareSights(reference, query, T_reference_query, kAgree);
  if (query.points.empty()) return sights;  // nothing at all says nothing
  sights += compareSights(query, reference, T_reference_query.inverse(), kAgree);
  return sights;
}

struct Sigmas {
  double position, turn;  // m, rad
};

Sigmas sigmasOf(const PoseBelief& prior) {
  const Eigen::Matrix3d covariance = prior.information.inverse();
  return {std::sqrt(0.5 * covariance.topLeftCorner<2, 2>().trace()), std::sqrt(covariance(2, 2))};
}

/// How far off [m] the prior may put what is seen kSearchArm away.
double spanOf(const PoseBelief& prior) {
  const Sigmas sigmas = sigmasOf(prior);
  return kSearchSigmas * (sigmas.position + kSearchArm * sigmas.turn);
}

SearchWindow windowOf(const PoseBelief& prior) {
  const Sigmas sigmas = sigmasOf(prior);
  SearchWindow window;
  window.centre = prior.mean;
  window.half_width = std::clamp(kSearchSigmas * sigmas.position, kLeastSearch, kWidestWindowHere);
  window.half_turn = std::clamp(kSearchSigmas * sigmas.turn, kLeastTurn, kWidestTurn);
  window.prior_information = prior.information.diagonal();
  return window;
}

}  // namespace

SlamWork& SlamWork::operator+=(const SlamWork& other) {
  searches += other.searches;
  iterations += other.iterations;
  return *this;
}

bool Slam::isNewPlace(const Pose2& T_map_sensor, const ScanSurface& surface) const {
  if (surface.points.empty()) return false;
  const Pose2& last = frames_.graph.pose(frames_.size() - 1);
  const double turn = std::abs(wrapAngle(T_map_sensor.theta - last.theta));
  return (T_map_sensor.position() - last.position()).norm() >= kFrameDistance ||
         (turn >= kFrameTurn && !surface.is_full_turn);
}

Pose2 Slam::searched(const ScanSurface& surface, SearchWindow window) const {
  std::vector<SurfacePoint> points, query;
  for (const PlacedSurface& placed : frames_.placed(view_)) {
    for (const auto& point : placed.surface->points) {
      points.push_back({placed.T_map_sensor * point.position});
    }
  }
  for (const auto& point : surface.points) {
    if (point.position.norm() < kSearchReach) query.push_back({point.position});
  }
  query = thinned(query, kSearchSpacing);
  if (query.empty()) return window.centre;
  window.prior_weight = 1.0 / (kIndependent * 3.0 * static_cast<double>(query.size()));
  const int levels = window.half_turn > kWidestTurn ? kLevelsAllRound : kSearchLevels;
  const LikelihoodPyramid pyramid(points, window.centre.position(),
                                  kSearchReach + window.half_width, levels, kSearchCell);
  const auto found = searchPose(query, pyramid, window, 0.2);
  return found ? found->T_map_query : window.centre;
}

Slam::Located Slam::located(const ScanSurface& surface, const PoseBelief& prior, const Pose2& start,
                            double reach) const {
  std::vector<PlacedSurface> references = frames_.placed(view_);
  if (references.size() > kMatched) references.resize(kMatched);
  Located found;
  found.match = matcher_(surface, start, prior, references, reach);
  SightCount sights;
  for (std::size_t i = 0; i < references.size() && i < kJudges; ++i) {
    sights += mutualSights(*references[i].surface, surface,
                           references[i].T_map_sensor.inverse() * found.match.T_map_query);
  }
  found.agreement = sights.agreement();
  found.in_common = 0.5 * (sights.agree + sights.contradict);
  return found;
}

PoseBelief Slam::beliefAfter(const MotionBelief& motion) const {
  PoseBelief belief;
  belief.mean = T_map_sensor_ * motion.T_before_after;
  const Eigen::Vector2d arm = belief.mean.position() - T_map_sensor_.position();
  const Eigen::Matrix3d covariance =
      carried(covariance_, arm) + turned(motion.covariance, T_map_sensor_.theta);
  belief.information = covariance.inverse();
  return belief;
}

Slam::Located Slam::locatedAbout(const ScanSurface& surface, const PoseBelief& prior) const {
  const SearchWindow window = windowOf(prior);
  Located found;
  if (window.half_width <= kLeastSearch && window.half_turn <= kLeastTurn) {
    found = located(surface, prior, prior.mean, std::min(kFirstReach, spanOf(prior)));
  }
  if (found.agreement < kClear)
    found = located(surface, prior, searched(surface, window), kFirstReach);
  return found;
}

/// Goes on with the place that an earlier scan suggested, and takes it when enough scans over
/// enough way agree there. Without such a place: looks for one around, in all directions.
/// @return  where the scan is, if the robot is there now.
std::optional<Slam::Located> Slam::trackElsewhere(const ScanSurface& surface,
                                                  const MotionBelief& motion,
                                                  const PoseBelief& prior, const Located& here) {
  const Pose2& T_map_frame = frames_.graph.pose(frames_.size() - 1);
  if (elsewhere_) {
    // Wheels that know nothing of the jump know nothing of how it goes on.
    PoseBelief from_there = prior;
    from_there.information *= kVague;
    from_there.mean = T_map_frame * elsewhere_->T_frame_sensor.back() * motion.T_before_after;
    const Located there = locatedAbout(surface, from_there);
    if (isClearlyBetter(there, here)) {
      elsewhere_->T_frame_sensor.push_back(T_map_frame.inverse() * there.match.T_map_query);
      elsewhere_->way += motion.T_before_after.position().norm();
      if (isBelieved(*elsewhere_)) return there;
      return std::nullopt;
    }
    elsewhere_.reset();
  }
  if (here.agreement >= kDoubtful || surface.points.empty()) return std::nullopt;
  SearchWindow anywhere;
  anywhere.centre = prior.mean;
  anywhere.half_width = kWidestWindowHere;
  anywhere.half_turn = M_PI;
  PoseBelief vague = prior;
  vague.information *= kVague;
  const Located there = located(surface, vague, searched(surface, anywhere), kFirstReach);
  if (!isClearlyBetter(there, here)) return std::nullopt;
  elsewhere_ = Elsewhere{{T_map_frame.inverse() * there.match.T_map_query},
                         lengthOf(prior.mean.inverse() * there.match.T_map_query)};
  return std::nullopt;
}

/// Whether a scan agrees about as well as usual there, and clearly better than here.
bool Slam::isClearlyBetter(const Located& there, const Located& here) const {
  return there.agreement > here.agreement + kClearlyBetter &&
         there.agreement > usual_ - kNearlyUsual &&
         there.in_common > kLeastInCommonElsewhere * here.in_common;
}

bool Slam::isBelieved(const Elsewhere& elsewhere) {
  const int scans = static_cast<int>(elsewhere.T_frame_sensor.size());
  const double enough = std::max(kLeastWayThere, kWayOfClaim * elsewhere.claim);
  return scans >= kLostStanding || (scans > 1 && elsewhere.way >= enough);
}

/// The robot has been elsewhere since the first scan that said so.
void Slam::moveElsewhere() {
  const Pose2& T_map_frame = frames_.graph.pose(frames_.size() - 1);
  const std::size_t earlier = elsewhere_->T_frame_sensor.size() - 1;
  for (std::size_t k = 0; k < earlier; ++k) {
    Passed& scan = passed_[passed_.size() - earlier + k];
    scan.T_frame_sensor = elsewhere_->T_frame_sensor[k];
    scan.is_doubtful = false;
  }
  // The wheels have not seen the jump: what they tell since the last key frame is worth nothing.
  T_frame_wheels_ = elsewhere_->T_frame_sensor.back();
  wheels_covariance_ += kUnknownJump * Eigen::Matrix3d::Identity();
  wheels_tell_ = false;
  if (earlier > 0) T_map_sensor_ = T_map_frame * elsewhere_->T_frame_sensor[earlier - 1];
  elsewhere_.reset();
}

SlamPose Slam::step(const Scan& scan, const Pose2& T_robot_sensor,
                    const std::optional<Pose2>& T_odom_robot) {
  work_ = {};
  ScanSurface surface = scanSurface(scan);
  std::optional<Pose2> wheel_step;
  std::optional<Pose2> T_odom_sensor;
  if (T_odom_robot && isFinite(*T_odom_robot)) T_odom_sensor = *T_odom_robot * T_robot_sensor;
  if (T_odom_sensor && last_odom_sensor_) {
    wheel_step = last_odom_sensor_->inverse() * *T_odom_sensor;
  }
  last_odom_sensor_ = T_odom_sensor;

  if (frames_.size() == remembered_ || starts_anywhere_) {
    if (frames_.size() == remembered_) T_map_sensor_ = T_map_start_ * T_robot_sensor;
    const int frame = newFrame(scan, T_robot_sensor, std::move(surface));
    if (frame == remembered_) map_part_ = frame;
    startPart(frame);
    starts_anywhere_ = false;
    passed_.push_back({frame, {}, T_robot_sensor, false});
    return poseNow(T_robot_sensor, 1.0);
  }
  MotionBelief motion = motion_.predict(wheel_step);
  PoseBelief prior = beliefAfter(motion);
  Located found = locatedAbout(surface, prior);
  if (found.agreement < kClear && wheel_step && !elsewhere_) {
    // Some encoders count alike forwards and backwards.
    const Pose2 back{-wheel_step->x, -wheel_step->y, wheel_step->theta};
    const MotionBelief backwards = motion_.predict(back);
    const PoseBelief behind = beliefAfter(backwards);
    const Located there = located(surface, behind, behind.mean, kFirstReach);
    if (isClearlyBetter(there, found)) {
      wheel_step = back;
      motion = backwards;
      prior = behind;
      found = there;
    }
  }
  // Of the wheels alone, since the last key frame.
  const Eigen::Vector2d wheel_arm =
      T_frame_wheels_ * motion.T_before_after.position() - T_frame_wheels_.position();
  wheels_covariance_ =
      carried(wheels_covariance_, wheel_arm) + turned(motion.covariance, T_frame_wheels_.theta);
  T_frame_wheels_ = T_frame_wheels_ * motion.T_before_after;
  wheels_tell_ = wheels_tell_ && wheel_step;

  if (const auto elsewhere = trackElsewhere(surface, motion, prior, found)) {
    found = *elsewhere;
    moveElsewhere();
  }
  const MatchResult& match = found.match;
  const Pose2 before = T_map_sensor_;
  const bool is_doubtful =
      elsewhere_ || (found.agreement < leastAgreement() &&
                     found.in_common > kLeastInCommon * static_cast<double>(surface.points.size()));
  const bool is_matched = match.paired > 0.0 && !is_doubtful;
  T_map_sensor_ = is_matched ? match.T_map_query : prior.mean;
  covariance_ = is_matched ? match.posterior.inverse().eval() : prior.information.inverse().eval();
  if (found.in_common > 0.0 && !elsewhere_) {
    // A scan that contradicts counts by the motion since the last one: a stay of some seconds does
    // not make contradiction usual.
    const double scans =
        is_doubtful ? std::min(1.0, lengthOf(motion.T_before_after) / kFrameDistance) : 1.0;
    usual_ += kUsualShare * scans * (found.agreement - usual_);
  }
  if (!is_doubtful) {
    motion_.learn(wheel_step, motion, before.inverse() * T_map_sensor_,
                  turned(covariance_, -before.theta));
  }

  countDoubt(is_doubtful, motion.T_before_after, surface);
  if (isLostByDoubt()) {
    startPart(newFrame(scan, T_robot_sensor, std::move(surface)));
  } else if (!is_doubtful && isNewPlace(T_map_sensor_, surface)) {
    const GraphEdge wheels{frames_.size() - 1, frames_.size(), T_frame_wheels_,
                           wheels_covariance_.inverse(), EdgeKind::kWheels};
    const bool is_told = wheels_tell_;
    goOn(newFrame(scan, T_robot_sensor, std::move(surface)), wheels, is_told);
  }
  const int frame = frames_.size() - 1;
  passed_.push_back(
      {frame, frames_.graph.pose(frame).inverse() * T_map_sensor_, T_robot_sensor, is_doubtful});
  workOnce();
  return poseNow(T_robot_sensor, found.agreement);
}

bool Slam::agreesWithFrame(const ScanSurface& surface, int frame,
                           const Pose2& T_frame_sensor) const {
  const ScanSurface& reference = frames_.surfaces[static_cast<std::size_t>(frame)];
  return mutualSights(reference, surface, T_frame_sensor).agreement() >= usual_ - kUnlike;
}

SlamPose Slam::poseNow(const Pose2& T_robot_sensor, double agreement) const {
  SlamPose pose;
  pose.T_map_robot = T_map_sensor_ * T_robot_sensor.inverse();
  pose.covariance = covariance_;
  pose.agreement = agreement;
  pose.version = version_;
  pose.is_lost = isLost();
  return pose;
}

void Slam::countDoubt(bool is_doubtful, const Pose2& step, const ScanSurface& surface) {
  if (!is_doubtful) {
    doubt_ = {};
    return;
  }
  if (doubt_.surfaces.empty()) {
    doubt_.usual = usual_;
  } else {
    // The wheels alone turn too far off within a radian.
    const PoseBelief by_wheels{step, kDoubtfulStep.asDiagonal()};
    const Pose2 matched =
        matchSurface(surface, step, by_wheels, {{&doubt_.surfaces.back(), Pose2{}}}, kFirstReach)
            .T_map_query;
    doubt_.T_first_last = doubt_.T_first_last * matched;
    const auto agreesWith = [&](const ScanSurface& before, const Pose2& T_before_now) {
      return mutualSights(before, surface, T_before_now).agreement() > kOfOnePlace;
    };
    doubt_.is_of_one_place = doubt_.is_of_one_place &&
                             agreesWith(doubt_.surfaces.back(), matched) &&
                             agreesWith(doubt_.surfaces.front(), doubt_.T_first_last);
  }
  doubt_.surfaces.push_back(surface);
  doubt_.way += step.position().norm();
  doubt_.way_with_turns += lengthOf(step);
}

/// Of a scan that is not in doubt. Scans of one place that contradict the map say that the robot is
/// not where the map has it: no scan ends that doubt that agrees by half with the map.
double Slam::leastAgreement() const {
  const bool is_placed_wrongly =
      static_cast<int>(doubt_.surfaces.size()) >= kLostScans && doubt_.is_of_one_place;
  return is_placed_wrongly ? doubt_.usual - kNearlyUsual : usual_ - kUnlike;
}

bool Slam::isLostByDoubt() const {
  const int scans = static_cast<int>(doubt_.surfaces.size());
  if (scans >= kLostStanding) return true;
  return scans >= kLostScans &&
         (doubt_.way >= kLostWay ||
          (doubt_.is_of_one_place && doubt_.way_with_turns >= kLostWayOfOnePlace));
}

int Slam::newFrame(const Scan& scan, const Pose2& T_robot_sensor, ScanSurface surface) {
  frames_.surfaces.push_back(std::move(surface));
  key_scans_.push_back({scan, T_robot_sensor});
  at_version_.push_back(T_map_sensor_);
  T_frame_wheels_ = {};
  wheels_tell_ = true;
  wheels_covariance_.setZero();
  covariance_.setZero();
  return frames_.graph.add(T_map_sensor_);
}

/// Of a new frame and of those in view, each by what the others saw.
void Slam::forgetMovers(int frame) {
  std::vector<int> around{frame};
  for (std::size_t i = 0; i < view_.size() && i < kJudges; ++i) around.push_back(view_[i]);
  for (const int seen : around) {
    std::vector<PlacedSurface> others;
    for (const int other : around) {
      if (other != seen) others.push_back(frames_.placed(other));
    }
    forgetWhatMoved(frames_.surfaces[static_cast<std::size_t>(seen)], frames_.graph.pose(seen),
                    others, kAgree);
  }
}

void Slam::goOn(int frame, const GraphEdge& wheels, bool is_told) {
  if (is_told) {
    wheel_edges_.push_back({static_cast<int>(frames_.graph.edges().size()), motion_.longer()});
  }
  frames_.graph.connect(wheels);
  forgetMovers(frame);
  for (const int other : view_) {
    if (auto edge = matchEdge(frames_, other, frame, kStepMatch)) {
      if (other == wheels.from && is_told) learnWay(wheels, *edge);
      if (other >= frame - 20) edge->kind = EdgeKind::kMatch;
      unsettled_ = unsettled_ || edge->kind == EdgeKind::kLoop;
      frames_.graph.connect(*edge);
    }
  }
  loop_closer_.seek(frame);
  if (soughtPart(frame)) places_.push_back(frame);
  view_ = framesInView(frames_, frame, frames_.graph.pose(frame), kViewFrames);
  T_map_sensor_ = frames_.graph.pose(frame);
}

void Slam::learnWay(const GraphEdge& wheels, const GraphEdge& match) {
  const Eigen::Vector2d by_wheels = wheels.T_from_to.position();
  const double way = by_wheels.norm();
  if (way == 0.0) return;
  const Eigen::Vector2d ahead = by_wheels / way;
  // Its returns count as if they erred by the reach of the match; they err less. What it says
  // nothing of may be off by a metre.
  const double noise = frames_.surfaces[static_cast<std::size_t>(match.to)].range_sigma;
  const double share = std::clamp(noise / kStepMatch.sigma, kLeastNoise, 1.0);
  const Eigen::Matrix3d covariance =
      (match.information / (share * share) + Eigen::Matrix3d::Identity()).inverse();
  motion_.learnWay(way / (1.0 + motion_.longer()), ahead.dot(match.T_from_to.position()),
                   ahead.dot(covariance.topLeftCorner<2, 2>() * ahead));
}

/// By what is known of the wheels now: where no wall told how far, they alone did.
void Slam::measureWaysAnew() {
  for (WheelEdge& told : wheel_edges_) {
    frames_.graph.lengthen(told.edge, (1.0 + motion_.longer()) / (1.0 + told.longer));
    told.longer = motion_.longer();
  }
}

void Slam::workOnce() {
  if (settlement_) {
    ++work_.iterations;
    if (settlement_->advance()) takeSettled();
  } else if (loop_closer_.isSeeking() || !places_.empty()) {
    const std::vector<GraphEdge> loops = soughtOnce();
    if (!loops.empty()) beginSettling(loops);
  } else {
    const int grown = frames_.size() - 1 - last_optimised_;
    const int share = (frames_.size() - 1) / kSettleShare;
    if (unsettled_ && grown >= std::max(kSettleAfter, share)) beginSettling({});
  }
}

/// Goes on looking for a frame at a visit, or in another part of the graph.
std::vector<GraphEdge> Slam::soughtOnce() {
  if (!loop_closer_.isSearching() && !loop_closer_.beginNext(frames_)) {
    if (loop_closer_.isSeeking() || places_.empty()) return {};
    const int frame = places_.front();
    places_.pop_front();
    const auto part = soughtPart(frame);
    if (!part) return {};
    loop_closer_.beginAnywhere(frames_, frame, *part);
  }
  ++work_.searches;
  return loop_closer_.advance(frames_, kCellsAtOnce);
}

void Slam::beginSettling(const std::vector<GraphEdge>& loops) {
  closing_ = loops;
  measureWaysAnew();
  PoseGraph graph = frames_.graph;
  if (!closing_.empty()) connectLoops(graph, closing_);
  settlement_.emplace(graph, !closing_.empty());
  last_optimised_ = frames_.size() - 1;
  unsettled_ = false;
}

void Slam::takeSettled() {
  PoseGraph& graph = frames_.graph;
  const int last = frames_.size() - 1;
  const Pose2 before = graph.pose(last);
  settlement_->applyTo(graph);
  settlement_.reset();
  const Pose2& after = graph.pose(last);
  T_map_sensor_ = after * (before.inverse() * T_map_sensor_);
  covariance_ = turned(covariance_, after.theta - before.theta);
  if (!closing_.empty()) {
    const bool joins = graph.part(closing_.back().from) != graph.part(closing_.back().to);
    for (const GraphEdge& edge : closing_) graph.connect(edge);
    map_part_ = graph.part(map_part_);
    // From the frame that closed the loop on, whose surroundings alone know of it so far.
    const int closed = closing_.back().to;
    closing_.clear();
    tieVisits(closed);
    for (int k = std::max(closed + 1, last + 1 - kViewFrames); k <= last; ++k) tieVisits(k);
    if (joins) ++version_;  // what is in the map is more now
  }
  view_ = framesInView(frames_, last, after, kViewFrames);
  countVersion();
}

/// Matches a frame to those of other visits in its view; what they say waits for the next
/// settlement.
void Slam::tieVisits(int frame) {
  for (const int other : framesInView(frames_, frame, frames_.graph.pose(frame), kViewFrames)) {
    if (other >= frame - kViewFrames) continue;
    const auto edge = matchEdge(frames_, other, frame, {0.3, 0.08});
    if (edge) frames_.graph.connect(*edge);
    unsettled_ = unsettled_ || edge;
  }
}

void Slam::countVersion() {
  double moved = 0.0;
  for (std::size_t k = 0; k < at_version_.size(); ++k) {
    moved = std::max(
        moved,
        (frames_.graph.pose(static_cast<int>(k)).position() - at_version_[k].position()).norm());
  }
  if (moved <= kCorrection) return;
  for (int k = 0; k < frames_.size(); ++k)
    at_version_[static_cast<std::size_t>(k)] = frames_.graph.pose(k);
  ++version_;
}

}  // namespace cca
