// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <mutex>
#include <string>

#include "cca_mrpt/io/map_products.hpp"
#include "cca_mrpt/slam/slam.hpp"

namespace cca {

/// Writes the map's folder on `~save` and when asked to, in a thread of its own: pictures and
/// scenes take a second, and for that long a robot must not be left alone with its last command.
class MapSaver {
 public:
  /// A copy of all that is to be written; called under the mutex.
  /// @throws std::runtime_error where there is nothing yet.
  using Snapshot = std::function<MapProducts()>;

  /// Tells on the console, before the work, where the folder cannot be written.
  MapSaver(const ros::NodeHandle& private_node, std::string folder, Snapshot snapshot);

  /// The memory of a SLAM goes with the map as map.slam. As long as it has found no place of the
  /// earlier map that it should have gone on with, a map.slam that is there is kept.
  /// @param slam  called under the mutex, like the snapshot.
  void saveMemory(std::function<const Slam&()> slam);

  /// To be held wherever what the snapshot reads is changed.
  std::mutex& mutex() { return mutex_; }
  /// What the snapshot gives, under the mutex.
  MapProducts products();
  /// In the caller's thread. @throws std::runtime_error naming the file and the reason.
  void save();
  /// The same where nobody is there to catch: a failure is told on the console.
  void saveOrTell();
  /// As soon as may be, in the saver's thread.
  void saveSoon();

 private:
  void tellIfNothingCanBeWritten() const;
  bool onSave(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response);

  std::string folder_;
  Snapshot snapshot_;
  std::function<const Slam&()> slam_;
  bool has_saved_ = false;  ///< what is there is ours
  std::mutex mutex_, writing_;
  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  ros::ServiceServer service_;
  ros::WallTimer soon_;
  ros::AsyncSpinner spinner_;  // last: its thread ends before anything that it uses
};

}  // namespace cca
