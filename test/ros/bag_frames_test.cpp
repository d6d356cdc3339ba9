// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bags/bag_frames.hpp"

#include <gtest/gtest.h>

#include "ros/messages/pose_message.hpp"

namespace cca {
namespace {

class Tree {
 public:
  /// @param moves  two transforms that differ.
  Tree& joint(const std::string& parent, const std::string& child, bool moves = false) {
    for (int k = 0; k < 2; ++k) {
      geometry_msgs::TransformStamped stamped;
      stamped.header.stamp = ros::Time(100.0 + k);
      stamped.header.frame_id = parent;
      stamped.child_frame_id = child;
      stamped.transform = transformMessage({moves ? 0.1 * k : 0.2, 0.0, 0.0});
      tf2_msgs::TFMessage message;
      message.transforms.push_back(stamped);
      messages_.push_back({message, false});
    }
    return *this;
  }

  /// "map odom base", and "?" where the laser has no place on it.
  std::string found(const std::string& laser, const OdometryFrames& odometry = {},
                    const std::string& base = "") const {
    const BagFrames frames = findFrames(messages_, laser, odometry, base);
    const auto word = [](const std::string& name) { return name.empty() ? "-" : name; };
    return word(frames.map) + " " + word(frames.odom) + " " + word(frames.base) +
           (frames.mount_is_known ? "" : " ?");
  }

 private:
  std::vector<Transforms::Message> messages_;
};

TEST(BagFrames, AreThoseOfRep105) {
  const auto tree = Tree()
                        .joint("map", "odom", true)
                        .joint("odom", "base_footprint", true)
                        .joint("base_footprint", "base_link")
                        .joint("base_link", "laser");
  EXPECT_EQ(tree.found("laser"), "map odom base_link");
  EXPECT_EQ(tree.found("laser", {"odom", "base_footprint"}), "map odom base_link");
}

TEST(BagFrames, MayHaveAPrefixAndTheLaserTellsWhose) {
  const auto tree = Tree()
                        .joint("robot1/odom", "robot1/base_link", true)
                        .joint("robot1/base_link", "robot1/laser")
                        .joint("map", "robot2/odom", true)
                        .joint("/robot2/odom", "/robot2/base_link", true)
                        .joint("robot2/base_link", "robot2/laser");
  EXPECT_EQ(tree.found("robot1/laser"), "- robot1/odom robot1/base_link");
  EXPECT_EQ(tree.found("robot2/laser"), "map robot2/odom robot2/base_link");
}

TEST(BagFrames, OfAnyNameAreToldByTheOdometryOrByWhatMoves) {
  const auto tree = Tree()
                        .joint("world", "wheels", true)
                        .joint("wheels", "chassis", true)
                        .joint("chassis", "tower")
                        .joint("tower", "lidar");
  EXPECT_EQ(tree.found("lidar", {"wheels", "tower"}), "- wheels tower");
  EXPECT_EQ(tree.found("lidar"), "- wheels chassis");
  EXPECT_EQ(Tree().joint("t265_odom_frame", "body").joint("body", "lidar").found("lidar"),
            "- t265_odom_frame body");
}

TEST(BagFrames, ALaserThatHangsOnNothingHasNoPlaceOnTheRobot) {
  const auto tree = Tree().joint("odom", "base_link", true).joint("mast", "laser");
  EXPECT_EQ(tree.found("laser"), "- odom base_link ?");
  EXPECT_EQ(tree.found("unheard_of"), "- odom base_link ?");
  EXPECT_EQ(Tree().found("laser", {"odom", "base"}), "- - base ?");
}

TEST(BagFrames, ALaserAloneStandsForItsRobot) {
  EXPECT_EQ(Tree().found("laser"), "- - laser");
  EXPECT_EQ(Tree().joint("odom", "laser", true).found("laser"), "- odom laser");
  EXPECT_EQ(Tree().joint("map", "laser", true).found("laser"), "map - laser");
}

TEST(BagFrames, TheBaseThatIsAskedForIsTheBase) {
  const auto tree = Tree()
                        .joint("odom", "base_footprint", true)
                        .joint("base_footprint", "base_link")
                        .joint("base_link", "laser");
  EXPECT_EQ(tree.found("laser", {}, "base_footprint"), "- odom base_footprint");
}

TEST(BagFrames, ATreeThatBitesItsTailHasAnEnd) {
  const auto tree = Tree().joint("a", "b").joint("b", "a").joint("b", "laser");
  EXPECT_EQ(tree.found("laser").substr(0, 4), "- - ");
}

}  // namespace
}  // namespace cca
