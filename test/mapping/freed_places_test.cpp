// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/freed_places.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace cca {
namespace {

TEST(FreedPlaces, HoldWhatWasAddedAndNothingElse) {
  FreedPlaces places;
  EXPECT_FALSE(places.contains({1.0, 1.0}));
  places.add({1.0, -2.0});
  EXPECT_TRUE(places.contains({1.1, -1.9}));
  for (const auto& [x, y] : {std::pair{1.0, 2.0}, {-1.0, -2.0}, {1.0, -2.2}, {1.3, -2.0}})
    EXPECT_FALSE(places.contains({x, y})) << x << ", " << y;
}

TEST(FreedPlaces, TellPlacesApartAcrossTheWholeMap) {
  FreedPlaces places;
  const double far = 9.9e6;  // m
  places.add({far, -0.1});
  EXPECT_TRUE(places.contains({far, -0.1}));
  for (const auto& [x, y] : {std::pair{far, 0.1}, {-far, -0.1}, {far - 0.4, -0.1}, {-0.1, far}})
    EXPECT_FALSE(places.contains({x, y})) << x << ", " << y;
}

}  // namespace
}  // namespace cca
