// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/localisation/localiser.hpp"

namespace cca {

/// Where a drive begins: at the pose that the first measurement brings, else where the wheels say,
/// else at the origin of the map.
Pose2 startOf(const Measurement& first);

/// The wheels alone, from startOf() on. A scan without odometry was taken where the wheels last
/// were.
class WheelOdometry : public Localiser {
 public:
  Estimate update(const Measurement& measurement, const AnalysedScan& analysed,
                  const PastScans& past) override;
  std::unique_ptr<Localiser> snapshot() const override {
    return std::make_unique<WheelOdometry>(*this);
  }
  void restore(const Localiser& snapshot) override {
    *this = dynamic_cast<const WheelOdometry&>(snapshot);
  }

 private:
  std::optional<Pose2> T_map_odom_;
  Pose2 T_map_robot_;
};

}  // namespace cca
