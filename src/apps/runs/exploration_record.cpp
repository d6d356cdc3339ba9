// SPDX-License-Identifier: BSD-3-Clause
#include "exploration_record.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/options/moved.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/memory_file.hpp"
#include "io/files/text.hpp"
#include "io/maps/map_folder.hpp"
#include "io/poses/local_frame.hpp"
#include "io/poses/trajectory_error.hpp"

namespace cca::apps {

namespace {

double rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

nlohmann::json unreachedJson(const Plan& plan, const Eigen::Vector2d& origin) {
  nlohmann::json parts = nlohmann::json::array();
  for (const UnreachedPart& part : plan.unreached) {
    const Eigen::Vector2d p_map = origin + part.place_map;
    parts.push_back({{"area_m2", rounded(part.area, 1e2)},
                     {"x_m", rounded(p_map.x(), 1e2)},
                     {"y_m", rounded(p_map.y(), 1e2)},
                     {"may_be_passable", part.may_be_passable}});
  }
  return parts;
}

}  // namespace

ExplorationRecord::ExplorationRecord(const Simulation& simulation, const Eigen::Vector2d& origin,
                                     const Parameters& parameters, const std::string& folder)
    : folder_(folder),
      parameters_(parameters),
      origin_(origin),
      rawlog_(folder + "/" + kLog, simulation.parameters().laser.range),
      start_(simulation.T_map_robot().position()),
      grid_(start_),
      coverage_(simulation.world(), simulation.T_map_robot().position(),
                simulation.parameters().robot.radius, simulation.parameters().laser.range),
      replay_(simulation.world().name, simulation.parameters().robot.radius) {}

void ExplorationRecord::add(const Cycle& cycle) {
  truth_.push_back({cycle.time, cycle.T_map_robot});
  if (keepIfMoved(last_look_, cycle.T_map_robot))
    look(cycle.T_map_robot, cycle.time, cycle.distance);
  if (cycle.goal && (!goal_ || *goal_ != *cycle.goal)) ++goals_;
  goal_ = cycle.goal;
  const Scan& believed = cycle.believed.scan;
  rawlog_.insert(cycle.scan, cycle.believed.T_map_robot.inverse() * believed.T_map_sensor,
                 seenFrom(-origin_, cycle.T_odom_robot), cycle.believed.time);
  work_us_.push_back(cycle.work_us + std::exchange(mapping_us_, 0.0));
}

void ExplorationRecord::restart() { grid_ = ScanRaster(start_); }

void ExplorationRecord::record(const MappedScan& mapped, const LineMap& /*map*/) {
  grid_.insert(mapped.scan);
}

void ExplorationRecord::look(const Pose2& T_map_robot, double time, double distance) {
  coverage_.look(T_map_robot);
  looks_.push_back({time, distance});
}

void ExplorationRecord::writeTrajectory(const Simulation& simulation) const {
  std::string text = "t,x,y,theta\n";
  for (const auto& [time, T_local_robot] : simulation.trajectory()) {
    const Pose2 T_map_robot = seenFrom(-origin_, T_local_robot);
    text +=
        formatted("%.4f,%.6f,%.6f,%.6f\n", time, T_map_robot.x, T_map_robot.y, T_map_robot.theta);
  }
  writeFile(folder_ + "/" + kTrajectory, text);
}

/// By the scans' numbers, as openLog() takes what stands beside a log for the truth.
void ExplorationRecord::writeTruth() const {
  std::string text;
  for (std::size_t k = 0; k < truth_.size(); ++k) {
    const Pose2 T_map_robot = seenFrom(-origin_, truth_[k].T_map_robot);
    text += formatted("%zu %.6f %.6f %.8f\n", k, T_map_robot.x, T_map_robot.y, T_map_robot.theta);
  }
  writeFile(folder_ + "/" + kTruth, text);
}

void ExplorationRecord::writeCoverage() {
  const std::vector<double> curve = coverage_.curve();
  std::string text = "t,distance,coverage\n";
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    text += formatted("%.3f,%.4f,", looks_[i].time, looks_[i].distance) +
            (curve.empty() ? "" : formatted("%.6f", curve[i])) + "\n";
  }
  writeFile(folder_ + "/" + kCoverage, text);
}

std::string ExplorationRecord::packedReplay(const Simulation& simulation,
                                            const std::vector<MapLine>& lines) {
  std::vector<double> distances;
  for (const Look& kept : looks_) distances.push_back(kept.distance);
  replay_.setCoverage(distances, coverage_.curve());
  replay_.setWorld(replayWorld(simulation.world()));
  replay_.finish(lines);
  return replay_.packed(origin_);
}

nlohmann::ordered_json ExplorationRecord::summary(const Simulation& simulation,
                                                  const MappingSession& mapping,
                                                  const SlamLocaliser* slam, const End& end) {
  nlohmann::ordered_json summary;
  summary["program"] = "cca-mrpt " CCA_VERSION;
  summary["world"] = simulation.world().name;
  summary["finished"] = end.finished;
  summary["reason"] = end.reason;
  summary["distance_m"] = rounded(simulation.distance(), 1e4);
  summary["duration_s"] = rounded(simulation.time(), 1e4);
  summary["wall_s"] = rounded(end.wall_s, 1e3);
  const auto seen = coverage_.sofar();
  summary["coverage"] = seen ? nlohmann::json(rounded(*seen, 1e6)) : nullptr;  // nobody waited
  summary["coverage_of"] = "what a laser sees from where the robot gets to, by its radius";
  summary["unreached_m2"] = rounded(end.plan.unreachedArea(), 1e2);
  summary["unreached"] = unreachedJson(end.plan, origin_);
  summary["agreement"] = rounded(mapping.agreement().overall(), 1e5);
  summary["goals"] = goals_;
  summary["collisions"] = simulation.collisions();
  summary["mover_contacts"] = simulation.moverContacts();
  std::vector<Pose2> truth;
  for (const TimedPose& pose : truth_) truth.push_back(pose.T_map_robot);
  const TrajectoryError error = compareTrajectories(mapping.trajectory(), truth);
  summary["pose"] = parameters_.run.pose;
  summary["pose_error_rms_m"] = rounded(error.rms_m, 1e4);
  summary["pose_error_worst_m"] = rounded(error.max_m, 1e4);
  summary["loops"] = slam ? slam->slam().loopsClosed() : 0;
  summary["corrections"] = slam ? slam->corrections() : 0;
  if (slam && slam->remembered() > 0) {
    summary["found_in_memory"] = slam->slam().isInMemory();
  }
  summary["scans"] = scans();
  summary["scan_us_median"] = rounded(quantile(work_us_, 0.5), 10.0);
  summary["scan_us_p99"] = rounded(quantile(work_us_, 0.99), 10.0);
  const Pose2 start = seenFrom(-origin_, simulation.trajectory().front().T_map_robot);
  summary["start"] = {{"x_m", start.x}, {"y_m", start.y}, {"yaw_deg", start.theta * 180.0 / M_PI}};
  summary["parameters"] = parametersJson(
      parameters_, {"run", "exploration", "robot", "laser", "odometry", "mapping", "icp"});
  return summary;
}

MapProducts ExplorationRecord::products(const Simulation& simulation,
                                        const MappingSession& mapping) const {
  MapProducts products = mapProducts(simulation.world().name, mapping);
  products.grid = grid_.raster();
  products.origin = origin_;
  return products;
}

void ExplorationRecord::write(const Simulation& simulation, const MappingSession& mapping,
                              const SlamLocaliser* slam, const End& end) {
  look(simulation.T_map_robot(), simulation.time(), simulation.distance());
  withdrawSummary(folder_);
  rawlog_.commit();
  writeTruth();
  writeTrajectory(simulation);
  writeCoverage();
  MapProducts all = products(simulation, mapping);
  all.replay = packedReplay(simulation, all.lines);
  if (slam) {
    all.graph = slam->slam().graph();
    all.memory = packedMemory({slam->slam().memory(), origin_});
  }
  all.summary = summary(simulation, mapping, slam, end);
  all.beside.assign({kTrajectory, kCoverage});
  writeMapFolder(folder_, all);
}

}  // namespace cca::apps
