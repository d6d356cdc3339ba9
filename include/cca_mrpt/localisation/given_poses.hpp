// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/localisation/localiser.hpp"

namespace cca {

/// Believes the pose that each measurement brings, to the bit: its T_map_robot, and the
/// T_map_sensor of its scan. The robot is lost where there is none.
class GivenPoses : public Localiser {
 public:
  Estimate update(const Measurement& measurement, const AnalysedScan& analysed,
                  const PastScans& past) override;
  bool believesGivenPoses() const override { return true; }
  std::unique_ptr<Localiser> snapshot() const override {
    return std::make_unique<GivenPoses>(*this);
  }
  void restore(const Localiser& snapshot) override {
    *this = dynamic_cast<const GivenPoses&>(snapshot);
  }
};

}  // namespace cca
