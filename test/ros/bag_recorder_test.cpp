// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bags/bag_recorder.hpp"

#include <gtest/gtest.h>
#include <std_msgs/String.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

namespace cca {
namespace {

/// Files of this process grow no further, as on a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(BagRecorder, AFullDiskEndsTheRecordingAndNotTheProgram) {
  const std::string path = testing::TempDir() + "full_disk.bag";
  std_msgs::String message;
  message.data.assign(1000000, 'x');  // more than rosbag keeps in memory
  for (const int count : {0, 3}) {    // the disk is full at the end, and before
    std::filesystem::remove(path + ".active");
    const FullDisk disk(count == 0 ? 4200 : 1500000);
    BagRecorder recorder(path);
    for (int k = 0; k < count; ++k) recorder.write("/chatter", ros::Time(1.0 + k), message);
    std_msgs::String short_message;
    short_message.data = "x";
    recorder.write("/chatter", ros::Time(9.0), short_message);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(std::filesystem::exists(path + ".active"));
  std::filesystem::remove(path + ".active");
}

}  // namespace
}  // namespace cca
