// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "cca_mrpt/navigation/explained_decision.hpp"
#include "io/files/atomic_file.hpp"

namespace cca::apps {

/// The decisions of an exploration as JSON lines, see docs/replay.md.
class DecisionFile {
 public:
  /// @param origin  m, map frame: where the simulation's frame lies.
  /// @throws std::runtime_error where no such file can be written.
  DecisionFile(const std::string& path, const Eigen::Vector2d& origin)
      : origin_(origin), path_(path) {
    AtomicFile probe(path);  // fails now, not after the run
  }

  /// @param time, distance  s, m, since the start.
  void add(const ExplainedDecision& decision, double time, double distance);

  /// Writes the file. @throws std::runtime_error naming the file.
  void commit();

 private:
  Eigen::Vector2d origin_;
  std::string path_, lines_;
};

}  // namespace cca::apps
