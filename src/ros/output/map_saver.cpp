// SPDX-License-Identifier: BSD-3-Clause
#include "map_saver.hpp"

#include <exception>
#include <filesystem>
#include <optional>

#include "io/files/memory_file.hpp"
#include "io/maps/map_folder.hpp"

namespace cca {

MapSaver::MapSaver(const ros::NodeHandle& private_node, std::string folder, Snapshot snapshot)
    : folder_(std::filesystem::absolute(folder).string()),
      snapshot_(std::move(snapshot)),
      node_(private_node),
      spinner_(1, &queue_) {
  node_.setCallbackQueue(&queue_);
  tellIfNothingCanBeWritten();
  service_ = node_.advertiseService("save", &MapSaver::onSave, this);
  spinner_.start();
}

MapProducts MapSaver::products() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return snapshot_();
}

void MapSaver::save() {
  const std::lock_guard<std::mutex> one_at_a_time(writing_);
  std::optional<SlamMemory> memory;
  bool is_apart = false;
  MapProducts products = [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (slam_) {
      const Slam& slam = slam_();
      memory = slam.memory();
      is_apart = slam.remembered() > 0 && !slam.isInMemory();
    }
    return snapshot_();
  }();
  if (memory) products.memory = packedMemory({*memory});
  const FolderLock lock = prepareMapFolder(folder_, true);
  if (is_apart && !has_saved_) {
    const std::string kept = keepMemory(folder_);
    if (!kept.empty())
      ROS_WARN("no place of the earlier map was found, it is kept: %s", kept.c_str());
  }
  writeMapFolder(folder_, products);
  has_saved_ = true;
  ROS_INFO("map saved to %s", folder_.c_str());
}

void MapSaver::saveMemory(std::function<const Slam&()> slam) {
  const std::lock_guard<std::mutex> lock(mutex_);
  slam_ = std::move(slam);
}

void MapSaver::tellIfNothingCanBeWritten() const try {
  const bool is_new = !std::filesystem::exists(folder_);
  static_cast<void>(prepareMapFolder(folder_, true));
  if (is_new) std::filesystem::remove(folder_);
} catch (const std::exception& error) {
  ROS_ERROR("no map can be saved: %s", error.what());
}

void MapSaver::saveOrTell() try { save(); } catch (const std::exception& error) {
  ROS_ERROR("the map could not be saved: %s", error.what());
}

void MapSaver::saveSoon() {
  const auto callback = [this](const ros::WallTimerEvent&) { saveOrTell(); };
  soon_ = node_.createWallTimer(ros::WallDuration(0.001), callback, true);
}

bool MapSaver::onSave(std_srvs::Trigger::Request& /*request*/,
                      std_srvs::Trigger::Response& response) try {
  save();
  response.success = true;
  response.message = folder_;
  return true;
} catch (const std::exception& error) {
  response.message = error.what();
  return true;
}

}  // namespace cca
