// SPDX-License-Identifier: BSD-3-Clause
#include "slam/visit_agreement.hpp"

#include <gtest/gtest.h>

#include "two_laps.hpp"

namespace cca {
namespace {

TEST(VisitAgreement, VisitsThatStandRightDoNotContradict) {
  const test::TwoLaps laps;
  const VisitAgreement agreement = agreementOfVisits(laps.frames, doInTurn);
  EXPECT_GT(agreement.other.agree, 10000.0);
  EXPECT_LT(agreement.excess(), 0.005);
  EXPECT_TRUE(agreement.isGood());
}

TEST(VisitAgreement, AVisitThatStandsAMetreOffContradicts) {
  test::TwoLaps laps;
  laps.moveSecond({1.0, 0.0});
  const VisitAgreement agreement = agreementOfVisits(laps.frames, doInTurn);
  EXPECT_GT(agreement.excess(), 0.1);
  EXPECT_FALSE(agreement.isGood());
  EXPECT_TRUE(agreement.isContradiction());
}

TEST(VisitAgreement, PeopleContradictBothAlike) {
  const test::TwoLaps laps(0.1);
  const VisitAgreement agreement = agreementOfVisits(laps.frames, doInTurn);
  EXPECT_LT(agreement.other.agreement(), 0.97);
  EXPECT_TRUE(agreement.isGood());
}

TEST(VisitAgreement, AMapThatLetsVisitsDriftApartExplainsLess) {
  test::TwoLaps laps;
  const double right = agreementOfVisits(laps.frames, doInTurn).gain();
  laps.moveSecond({0.0, 100.0});
  const VisitAgreement apart = agreementOfVisits(laps.frames, doInTurn);
  EXPECT_TRUE(apart.isGood()) << "nothing is seen twice";
  EXPECT_LT(apart.gain(), 0.5 * right);
}

TEST(VisitAgreement, AMetreOffIsWorseThanFarApart) {
  test::TwoLaps laps;
  laps.moveSecond({1.0, 0.0});
  const double off = agreementOfVisits(laps.frames, doInTurn).gain();
  laps.moveSecond({0.0, 100.0});
  EXPECT_LT(off, agreementOfVisits(laps.frames, doInTurn).gain());
}

}  // namespace
}  // namespace cca
