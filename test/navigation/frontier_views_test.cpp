// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/navigation/goals/frontier_views.hpp"

#include <gtest/gtest.h>

#include "known_world.hpp"

namespace cca {
namespace {

/// Squares of half a metre: a room with a door to the right and one to the left, and what is seen
/// from its middle.
const KnownWorld kRoomWithTwoDoors{
    {"###################", "#....#.......#....#", "#....#.......#....#", "#.................#",
     "#.................#", "#....#.......#....#", "#....#.......#....#", "###################"},
    10};
const Eigen::Vector2d kMiddle{4.75, 2.0};

struct View {
  KnownPlace place{0.27};
  FrontierViews views{0.1, 5};

  View() {
    place.observe(kRoomWithTwoDoors.scanFrom({kMiddle.x(), kMiddle.y(), 0.0}), kMiddle);
    place.findWays(kMiddle);
  }
  void find() { views.find(place, place.grid().cellOf(kMiddle)); }
  double x(const ViewPoint& v) const { return place.grid().centreOf(v.target).x(); }
};

TEST(FrontierViews, LookThroughEachDoorFromAReachedPlace) {
  View view;
  view.find();
  int left = 0, right = 0;
  for (const ViewPoint& v : view.views.viewPoints()) {
    EXPECT_TRUE(view.place.space().isTraversable(v.cell));
    EXPECT_EQ(view.place.grid().at(v.target), CellState::kUnknown);
    EXPECT_LT(v.distance, DistanceField::kUnreached);
    EXPECT_GT(v.gain, 0.1);
    left += view.x(v) < 2.5;
    right += view.x(v) > 7.0;
  }
  EXPECT_GT(left, 0);
  EXPECT_GT(right, 0);
}

TEST(FrontierViews, EndAtTheLimitsTargetAndPlace) {
  View view;
  view.views.limitTo({{3.0, 0.0}, {9.5, 0.0}, {9.5, 4.0}, {3.0, 4.0}});  // not the left room
  view.find();
  EXPECT_FALSE(view.views.viewPoints().empty());
  for (const auto* found : {&view.views.viewPoints(), &view.views.entries()}) {
    for (const ViewPoint& v : *found) {
      EXPECT_GT(view.x(v), 3.0);
      EXPECT_GT(view.place.grid().centreOf(v.cell).x(), 3.0);
    }
  }
  // In sight from inside the limits or not: from outside nobody is to look.
  view.views.limitTo({{20.0, 0.0}, {21.0, 0.0}, {21.0, 1.0}});
  const Cell in_left_room = view.place.grid().cellOf({1.0, 0.7});
  EXPECT_FALSE(view.views.viewOf(view.place, in_left_room));
  view.views.limitTo({});
  EXPECT_TRUE(view.views.viewOf(view.place, in_left_room));
}

// The frontier gets another chance with a nearer target.
TEST(FrontierViews, LeaveOutWhatWasSetAside) {
  View view;
  view.find();
  const Cell target = view.views.viewPoints().front().target;
  view.place.noteFailure(target, Failure::kNotReached);
  view.find();
  for (const auto* found : {&view.views.viewPoints(), &view.views.entries()}) {
    for (const ViewPoint& v : *found) EXPECT_FALSE(v.target == target);
  }
}

TEST(FrontierViews, KeepTheGoalInPlaceOfMuchTheSame) {
  View view;
  view.find();
  const std::size_t count = view.views.viewPoints().size();
  ViewPoint goal = view.views.viewPoints().front();
  goal.target.y += view.place.grid().at(goal.target + Cell{0, 2}) == CellState::kUnknown ? 2 : -2;
  ASSERT_TRUE(view.views.keep(view.place, goal));
  EXPECT_EQ(view.views.viewPoints().size(), count);
  EXPECT_EQ(view.views.viewPoints().front().target, goal.target);
  // And a goal that nobody sees is not kept.
  goal.target = view.place.grid().cellOf({-50.0, -50.0});
  EXPECT_FALSE(view.views.keep(view.place, goal));
  EXPECT_EQ(view.views.viewPoints().size(), count);
}

}  // namespace
}  // namespace cca
