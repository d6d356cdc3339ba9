// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/localisation/localiser.hpp"
#include "cca_mrpt/slam/slam.hpp"

namespace cca {

/// Line SLAM as a localiser: the map begins at startOf() the first measurement.
class SlamLocaliser : public Localiser {
 public:
  Estimate update(const Measurement& measurement, const AnalysedScan& analysed,
                  const PastScans& past) override;
  std::optional<SweepHalves> sweepMotion(const Measurement& measurement,
                                         const AnalysedScan& analysed,
                                         const SweptScan& sweep) override {
    return slam_.sweepMotion(analysed, sweep, measurement.T_robot_sensor, measurement.T_odom_robot);
  }
  bool correctsPast() const override { return true; }
  void finish(const DoAll& do_all) override { slam_.finish(do_all); }
  std::vector<Pose2> trajectory() const override { return slam_.trajectory(); }
  std::vector<bool> isLocalised() const override { return slam_.isLocalised(); }
  std::size_t remembered() const override { return static_cast<std::size_t>(slam_.remembered()); }
  std::unique_ptr<Localiser> snapshot() const override {
    return std::make_unique<SlamLocaliser>(*this);
  }
  void restore(const Localiser& snapshot) override {
    *this = dynamic_cast<const SlamLocaliser&>(snapshot);
  }

  /// See Slam::remember() and Slam::startAnywhere().
  void remember(const SlamMemory& memory) { slam_.remember(memory); }
  void startAnywhere() { slam_.startAnywhere(); }

  const Slam& slam() const { return slam_; }
  /// How often the past was corrected.
  int corrections() const { return slam_.version(); }

 private:
  Slam slam_;
  bool has_started_ = false;
  int version_ = 0;
};

}  // namespace cca
