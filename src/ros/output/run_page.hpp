// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "live/live_page.hpp"
#include "ros/parameters/private_parameters.hpp"

namespace cca {

/// The live page of a node, see docs/live.md. Where nobody asks for one (`~serve`), nothing of this
/// does anything.
class RunPage {
 public:
  struct Settings : LivePageSettings {
    bool serve = false;
    /// ~serve, ~serve_port, ~serve_address.
    void read(PrivateParameters& parameters);
  };

  /// Opens it, and says where on the console.
  /// @param heed  called in the node's own thread, with what viewers want.
  /// @throws std::runtime_error where it cannot be served there.
  RunPage(const ros::NodeHandle& node, const Settings& settings,
          std::function<void(const RunCommand&)> heed);

  /// Whether show() shows anything now.
  bool isDue() const { return page_ && page_->isDue(); }
  /// @param moment  but its time and distance. @param scan  at its T_map_sensor.
  void show(ReplayMoment moment, const Scan& scan, const LineMap& map, const ros::Time& stamp);
  /// The last moment again, where nothing was shown for a second: of a robot that waits, too, its
  /// viewers are told why.
  void repeat(const std::string& reason, const LineMap& map);
  /// The map begins anew.
  void restart();
  void setPaused(bool is_paused);
  void finish(const std::vector<MapLine>& lines, const std::string& reason);

 private:
  std::unique_ptr<LivePage> page_;
  std::function<void(const RunCommand&)> heed_;
  ros::WallTimer timer_;
  ros::WallTime shown_;
  std::optional<ros::Time> begin_;
  std::optional<Eigen::Vector2d> counted_;  ///< m: up to where distance_ counts
  double distance_ = 0.0;                   ///< m
  ReplayMoment moment_;                     ///< the last one that was shown
  Scan scan_;
};

}  // namespace cca
