// SPDX-License-Identifier: BSD-3-Clause
#include "known_map/open_doors.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace cca {
namespace {

constexpr PieceSight kThrough{1, true}, kExplained{1, false};

TEST(OpenDoors, APieceIsOpenOnceManyMoreRaysGoThroughThanEndOnIt) {
  OpenDoors doors(3);
  doors.learn({kExplained, kExplained}, 1.0);
  doors.learn(std::vector<PieceSight>(6, kThrough), 1.0);
  EXPECT_FALSE(doors.isOpen()[1]);  // six, three times the two that ended there
  doors.learn({kThrough}, 1.0);
  EXPECT_EQ(doors.isOpen(), (std::vector<bool>{false, true, false}));
}

TEST(OpenDoors, ARobotThatStandsSaysTheSameAgain) {
  OpenDoors doors(2);
  for (int scan = 0; scan < 50; ++scan) doors.learn(std::vector<PieceSight>(2, kThrough), 0.02);
  EXPECT_FALSE(doors.isOpen()[1]);
}

TEST(OpenDoors, ADoorThatIsShutAfterADayIsShutAgain) {
  OpenDoors doors(2);
  doors.learn(std::vector<PieceSight>(1000, kThrough), 1.0);
  ASSERT_TRUE(doors.isOpen()[1]);
  doors.learn(std::vector<PieceSight>(20, kExplained), 1.0);
  EXPECT_FALSE(doors.isOpen()[1]);
}

}  // namespace
}  // namespace cca
