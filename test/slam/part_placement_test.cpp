// SPDX-License-Identifier: BSD-3-Clause
#include "slam/part_placement.hpp"

#include <gtest/gtest.h>

#include "walled_world.hpp"

namespace cca {
namespace {

/// Four equal rooms, 5 m apart, along a corridor that is closed at both ends.
test::WalledWorld likeRooms() {
  test::WalledWorld world;
  world.addBox(0.0, 0.0, 20.0, 6.0);
  for (int room = 0; room < 4; ++room) {
    const double x = 5.0 * room;
    world.addWall({x, 2.0}, {x, 6.0});
    world.addWall({x, 2.0}, {x + 1.0, 2.0});
    world.addWall({x + 2.2, 2.0}, {x + 5.0, 2.0});
  }
  return world;
}

/// A map of the corridor and of two rooms, and a drive out of the second one, whose place in the
/// map is not known.
class LikeRooms : public testing::Test {
 protected:
  explicit LikeRooms(std::size_t seen = 9) {
    const std::vector<Pose2> poses{{2.5, 4.0, 0.0},  {1.6, 3.0, 0.0},  {1.6, 1.0, 0.0},
                                   {6.0, 1.0, 0.0},  {9.0, 1.0, 0.0},  {11.6, 1.0, 0.0},
                                   {11.6, 3.0, 0.0}, {12.5, 4.0, 0.0}, {16.0, 1.0, 0.0}};
    for (std::size_t k = 0; k < seen; ++k) add(poses[k], poses[k]);
    first_of_part_ = frames_.size();
  }

  void drive(const std::vector<Pose2>& truth) {
    for (const Pose2& pose : truth) add(pose, T_part_map_ * pose);
  }

  void add(const Pose2& truth, const Pose2& pose) {
    frames_.surfaces.push_back(scanSurface(world_.scan(truth, 361, 2.0 * M_PI, 0.01)));
    const int k = frames_.graph.add(pose);
    truth_.push_back(truth);
    if (k == 0 || k == first_of_part_) return;
    frames_.graph.connect({k - 1, k, frames_.graph.pose(k - 1).inverse() * pose,
                           100.0 * Eigen::Matrix3d::Identity(), EdgeKind::kMatch});
  }

  /// The place of the n-th frame of the drive, as a search finds it that is `off` beside it.
  LoopVerdict loop(int n, int candidate, double off) const {
    LoopVerdict verdict;
    verdict.frame = first_of_part_ + n;
    verdict.candidate = candidate;
    Pose2 there = truth_[static_cast<std::size_t>(verdict.frame)];
    there.x += off;
    verdict.T_candidate_frame = truth_[static_cast<std::size_t>(candidate)].inverse() * there;
    verdict.agreement = 1.0;
    verdict.common = 0.5;
    return verdict;
  }
  std::vector<LoopVerdict> decide() const {
    return placement_.decide(frames_, frames_.graph.part(first_of_part_), 0);
  }

  const std::vector<Pose2> in_room_{
      {12.5, 4.5, 0.0}, {13.5, 4.5, 0.0}, {13.5, 3.5, 0.0}, {12.5, 3.5, 0.0}};
  const std::vector<Pose2> into_corridor_{
      {11.6, 3.0, 0.0}, {11.6, 1.0, 0.0}, {13.0, 1.0, 0.0}, {14.5, 1.0, 0.0}};
  const double to_like_ = -10.0;
  Pose2 T_part_map_{3.0, -20.0, 1.2};  // carried
  test::WalledWorld world_ = likeRooms();
  KeyFrames frames_;
  std::vector<Pose2> truth_;
  int first_of_part_ = -1;
  PartPlacement placement_;
};

TEST_F(LikeRooms, TheLikeIsRefutedByWhatIsSeenBehindTheDoor) {
  drive(in_room_);
  placement_.add(frames_, loop(1, 0, to_like_));
  placement_.add(frames_, loop(1, 7, 0.0));
  placement_.add(frames_, loop(3, 0, to_like_));
  placement_.add(frames_, loop(3, 7, 0.0));
  EXPECT_TRUE(decide().empty()) << "both rooms look like this";
  drive(into_corridor_);
  const std::vector<LoopVerdict> believed = decide();
  ASSERT_EQ(believed.size(), 2u);
  for (const LoopVerdict& loop : believed) EXPECT_EQ(loop.candidate, 7);
}

TEST_F(LikeRooms, ALikeWithoutRivalIsNotBelievedOnceScansContradictIt) {
  drive(in_room_);
  drive(into_corridor_);
  placement_.add(frames_, loop(1, 0, to_like_));
  placement_.add(frames_, loop(3, 0, to_like_));
  EXPECT_TRUE(decide().empty());
}

TEST_F(LikeRooms, NothingIsBelievedBeforeTwoMetresNorByOneFrame) {
  drive({in_room_[0], in_room_[1]});
  placement_.add(frames_, loop(0, 7, 0.0));
  placement_.add(frames_, loop(1, 7, 0.0));
  EXPECT_TRUE(decide().empty()) << "after a metre";
  drive({in_room_[2], in_room_[3]});
  EXPECT_EQ(decide().size(), 2u);
  PartPlacement by_one;
  by_one.add(frames_, loop(1, 7, 0.0));
  by_one.add(frames_, loop(1, 7, 0.01));
  EXPECT_TRUE(by_one.decide(frames_, frames_.graph.part(first_of_part_), 0).empty());
}

TEST_F(LikeRooms, RaysOfBothPartsAgreeInTheRightPlaceAlone) {
  drive(in_room_);
  drive(into_corridor_);
  EXPECT_GT(sightsOfParts(frames_, loop(3, 7, 0.0)).agreement(), 0.99);
  EXPECT_LT(sightsOfParts(frames_, loop(3, 0, to_like_)).agreement(), 0.98);
}

TEST_F(LikeRooms, OneFrameIsEnoughWhereTheOdometryHasTheRobotGoOn) {
  T_part_map_ = {0.3, -0.2, 0.05};  // a slip
  drive(in_room_);
  placement_.add(frames_, loop(1, 7, 0.0));
  const std::vector<LoopVerdict> believed = decide();
  ASSERT_EQ(believed.size(), 1u);
  EXPECT_EQ(believed[0].candidate, 7);
}

/// The same where only the first room was seen, and the corridor as far as the second: the drive
/// begins in a room that is new.
class RoomNotSeen : public LikeRooms {
 protected:
  RoomNotSeen() : LikeRooms(5) {}
};

TEST_F(RoomNotSeen, TheOdometryIsBelievedBeforeALikeRoomThatHasMoreInCommon) {
  T_part_map_ = {0.3, -0.2, 0.05};
  for (int lap = 0; lap < 2; ++lap) drive(in_room_);
  placement_.add(frames_, loop(1, 4, 0.0));
  placement_.add(frames_, loop(1, 0, to_like_));
  placement_.add(frames_, loop(3, 0, to_like_));
  const std::vector<LoopVerdict> believed = decide();
  ASSERT_EQ(believed.size(), 1u);
  EXPECT_EQ(believed[0].candidate, 4);
}

}  // namespace
}  // namespace cca
