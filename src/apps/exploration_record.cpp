// SPDX-License-Identifier: BSD-3-Clause
#include "exploration_record.hpp"

#include <cmath>
#include <cstdio>

#include "cca_mrpt/evidence/statistics.hpp"
#include "cca_mrpt/io/atomic_file.hpp"

namespace cca::apps {

namespace {

constexpr double kEveryDistance = 0.1, kEveryTurn = 0.25;  // m, rad, between kept scans

double rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit; }

}  // namespace

bool keepIfMoved(std::optional<Pose2>& last, const Pose2& now) {
  if (last && (now.position() - last->position()).norm() < kEveryDistance &&
      std::abs(wrapAngle(now.theta - last->theta)) < kEveryTurn) {
    return false;
  }
  last = now;
  return true;
}

ExplorationRecord::ExplorationRecord(const Simulation& simulation, const std::string& folder)
    : folder_(folder),
      rawlog_(folder + "/run.rawlog", simulation.parameters().laser.range),
      coverage_(simulation.world(), simulation.T_map_robot().position(),
                simulation.parameters().robot.radius, simulation.parameters().laser.range) {}

void ExplorationRecord::add(const Cycle& cycle) {
  ++scans_;
  if (keepIfMoved(last_look_, cycle.T_map_robot))
    look(cycle.T_map_robot, cycle.time, cycle.distance);
  if (cycle.goal && (!goal_ || *goal_ != *cycle.goal)) ++goals_;
  goal_ = cycle.goal;
  const auto& [scan, T_map_robot, velocity, time] = cycle.believed;
  rawlog_.insert(scan, T_map_robot.inverse() * scan.T_map_sensor, cycle.T_odom_robot, time);
  if (keepIfMoved(last_insertion_, T_map_robot)) {
    grid_.insert(scan);
    believed_way_.push_back(T_map_robot);
  }
  work_us_.push_back(cycle.work_us);
}

void ExplorationRecord::look(const Pose2& T_map_robot, double time, double distance) {
  coverage_.look(T_map_robot);
  looks_.push_back({time, distance});
}

void ExplorationRecord::writeTrajectory(const Simulation& simulation) const {
  std::string text = "t,x,y,theta\n";
  for (const auto& [time, T_map_robot] : simulation.trajectory()) {
    char line[120];
    std::snprintf(line, sizeof line, "%.4f,%.6f,%.6f,%.6f\n", time, T_map_robot.x, T_map_robot.y,
                  T_map_robot.theta);
    text += line;
  }
  writeFile(folder_ + "/trajectory.csv", text);
}

void ExplorationRecord::writeCoverage() {
  const std::vector<double> curve = coverage_.curve();
  std::string text = "t,distance,coverage\n";
  for (std::size_t i = 0; i < curve.size(); ++i) {
    char line[120];
    std::snprintf(line, sizeof line, "%.3f,%.4f,%.6f\n", looks_[i].time, looks_[i].distance,
                  curve[i]);
    text += line;
  }
  writeFile(folder_ + "/coverage.csv", text);
}

nlohmann::ordered_json ExplorationRecord::summary(const Simulation& simulation, const End& end) {
  nlohmann::ordered_json summary;
  summary["world"] = simulation.world().name;
  summary["finished"] = end.finished;
  summary["reason"] = end.reason;
  summary["distance_m"] = rounded(simulation.distance(), 1e4);
  summary["duration_s"] = rounded(simulation.time(), 1e4);
  summary["wall_s"] = rounded(end.wall_s, 1e3);
  summary["coverage"] = rounded(coverage_.sofar().value_or(0.0), 1e6);
  summary["goals"] = goals_;
  summary["collisions"] = simulation.collisions();
  summary["mover_contacts"] = simulation.moverContacts();
  summary["scans"] = scans();
  summary["scan_us_median"] = rounded(evidence::quantile(work_us_, 0.5), 10.0);
  summary["scan_us_p99"] = rounded(evidence::quantile(work_us_, 0.99), 10.0);
  return summary;
}

MapProducts ExplorationRecord::products(const Simulation& simulation,
                                        const Explorer& explorer) const {
  MapProducts products;
  products.title = simulation.world().name;
  products.lines = explorer.lineMap().lines();
  products.poly_lines = explorer.lineMap().polyLines();
  products.trajectory = believed_way_;
  products.grid = grid_.grid();
  return products;
}

void ExplorationRecord::write(const Simulation& simulation, const Explorer& explorer,
                              const End& end) {
  look(simulation.T_map_robot(), simulation.time(), simulation.distance());
  withdrawSummary(folder_);
  rawlog_.commit();
  writeTrajectory(simulation);
  writeCoverage();
  MapProducts all = products(simulation, explorer);
  all.summary = summary(simulation, end);
  writeMapFolder(folder_, all);
}

}  // namespace cca::apps
