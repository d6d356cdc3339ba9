// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/io/rawlog_writer.hpp"
#include "cca_mrpt/io/scan_grid.hpp"
#include "cca_mrpt/navigation/explorer.hpp"
#include "cca_mrpt/simulation/coverage.hpp"
#include "cca_mrpt/simulation/simulation.hpp"

namespace cca::apps {

/// What is kept of a simulated exploration for the files of its folder.
class ExplorationRecord {
 public:
  /// How a run ended.
  struct End {
    bool finished = false;
    std::string reason;
    double wall_s = 0.0;
  };

  /// @throws std::runtime_error where the folder cannot be written to.
  ExplorationRecord(const Simulation& simulation, const std::string& folder);

  /// One cycle. @param believed  what the explorer was given. @param step_us  what it took.
  void add(const Simulation& simulation, const Observation& believed, const Action& action,
           double step_us);

  /// Writes every file of the folder. @throws std::runtime_error naming the file.
  void write(const Simulation& simulation, const Explorer& explorer, const End& end);

  long scans() const { return static_cast<long>(step_us_.size()); }
  int goals() const { return goals_; }
  Coverage& coverage() { return coverage_; }
  /// What the map's files are made from, as it stands.
  MapProducts products(const Simulation& simulation, const Explorer& explorer) const;

 private:
  struct Look {
    double time, distance;
  };
  void look(const Simulation& simulation);
  void writeTrajectory(const Simulation& simulation) const;
  void writeCoverage();
  nlohmann::ordered_json summary(const Simulation& simulation, const End& end);

  std::string folder_;
  RawlogWriter rawlog_;
  ScanGrid grid_;
  Coverage coverage_;
  std::vector<Look> looks_;
  std::vector<Pose2> believed_way_;
  std::vector<double> step_us_;
  std::optional<Pose2> last_look_, last_insertion_;
  std::optional<Eigen::Vector2d> goal_;
  int goals_ = 0;
};

}  // namespace cca::apps
