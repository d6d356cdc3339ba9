// SPDX-License-Identifier: BSD-3-Clause
#include "bag_recorder.hpp"

#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace cca {

BagRecorder::BagRecorder(const std::string& path) : path_(path) {
  if (path.empty()) return;
  if (std::filesystem::exists(path)) throw std::runtime_error(path + ": is there already");
  try {
    bag_.open(path + ".active", rosbag::bagmode::Write);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path + ": cannot be written (" + error.what() + ")");
  }
}

BagRecorder::~BagRecorder() {
  if (!bag_.isOpen()) return;
  try {
    bag_.close();
    std::filesystem::rename(path_ + ".active", path_);
    ROS_INFO("recorded %s", std::filesystem::absolute(path_).c_str());
  } catch (const std::exception& error) {
    ROS_ERROR("%s: recording failed: %s", path_.c_str(), error.what());
  }
}

}  // namespace cca
