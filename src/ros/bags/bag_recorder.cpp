// SPDX-License-Identifier: BSD-3-Clause
#include "bag_recorder.hpp"

#include <filesystem>
#include <stdexcept>

namespace cca {

BagRecorder::BagRecorder(const std::string& path) : path_(path) {
  if (path.empty()) return;
  if (std::filesystem::exists(path)) throw std::runtime_error(path + ": is there already");
  try {
    bag_ = std::make_unique<rosbag::Bag>(path + ".active", rosbag::bagmode::Write);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path + ": cannot be written (" + error.what() + ")");
  }
}

BagRecorder::~BagRecorder() {
  if (!bag_) return;
  try {
    bag_->close();
    std::filesystem::rename(path_ + ".active", path_);
    ROS_INFO("recorded %s", std::filesystem::absolute(path_).c_str());
  } catch (const std::exception& error) {
    giveUp(error.what());
  }
}

void BagRecorder::giveUp(const char* why) {
  ROS_ERROR("%s: recording has ended: %s; rosbag reindex %s.active makes the rest readable",
            path_.c_str(), why, path_.c_str());
  // Its destructor would write once more, and end the program where that fails.
  static_cast<void>(bag_.release());
}

}  // namespace cca
