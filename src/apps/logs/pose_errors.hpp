// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "cca_mrpt/localisation/localiser.hpp"

namespace cca::apps {

/// How far poses in a map are from where the robot was, and whether their covariances are those of
/// these errors.
class PoseErrors {
 public:
  void add(const Estimate& estimate, const Pose2& T_map_robot);

  int count() const { return count_; }
  double rms() const;                      ///< m
  double rmsTurn() const;                  ///< rad
  double worst() const { return worst_; }  ///< m
  /// Mean of e' P^-1 e over (x, y, theta): 3 where the covariances are honest.
  double nees() const;
  /// Share of poses with e' P^-1 e below 11.34: 0.99 where the covariances are honest.
  double within() const;
  /// `rms_m`, `max_m`, `rms_deg`, `nees`, `within_99`; null where there is none.
  nlohmann::ordered_json json() const;

 private:
  int count_ = 0, judged_ = 0, within_ = 0;
  double square_ = 0.0, turn_square_ = 0.0, worst_ = 0.0, nees_ = 0.0;
};

}  // namespace cca::apps
