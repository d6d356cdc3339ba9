// SPDX-License-Identifier: BSD-3-Clause
//
// Localisation in a plan that shows no furniture, in the robot's own map, and in plans that people
// have drawn, by a laser that sweeps and loses beams, on wheels that err. docs/localisation.md has
// the results; CCA_LOCALISATIONS sets how many robots start in each world, and with 20 and more all
// worlds are driven.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "io/plans/plan_reader.hpp"
#include "localised_drive.hpp"

namespace cca {
namespace {

using namespace test;

constexpr const char* kLaser = "rplidar_a1";
constexpr double kRms = 0.03, kWorst = 0.15;       // m
constexpr double kNotice = 1.0, kFindAgain = 5.0;  // m

int starts() {
  const char* text = std::getenv("CCA_LOCALISATIONS");
  return text ? std::atoi(text) : 6;
}

bool isLong() { return starts() >= 20; }

std::filesystem::path sharedPlans() {
  const char* told = std::getenv("CCA_SHARED_DATA");
  return std::filesystem::path(told ? told : CCA_SHARED_DATA_BESIDE) / "plans";
}

struct Place {
  World world;
  Pose2 start;
};

Place placeOf(const std::string& yaml) {
  const Parameters parameters;
  Place place{loadWorld(yaml), {}};
  place.start = defaultStart(place.world, parameters.robot.radius);
  return place;
}

Place ourPlace(const std::string& name) {
  return placeOf(std::string(CCA_MAPS_FOLDER) + "/" + name + ".yaml");
}

void report(const Errors& errors, const std::string& what) {
  std::printf(
      "%-34s rms %.4f m, worst %.3f m, lost %d, unknown %d of %d, NEES %.2f, %.1f %% within "
      "99 %%\n",
      what.c_str(), errors.rms, errors.worst, errors.lost, errors.unknown,
      errors.scans + errors.unknown, errors.nees, 100.0 * errors.within);
}

void expectGood(const Errors& errors, const std::string& what) {
  report(errors, what);
  EXPECT_LE(errors.rms, kRms) << what;
  EXPECT_LE(errors.worst, kWorst) << what;
  EXPECT_EQ(errors.lost, 0) << what;
  EXPECT_EQ(errors.unknown, 0) << what;
}

Errors tracked(const Drive& drive, const std::vector<PlanLine>& plan) {
  KnownMap localiser(plan);
  return errorsOf(drive, localiser, drive.truth.front());
}

void startAnywhere(const Drive& drive, const std::vector<PlanLine>& plan, const std::string& what) {
  const Starts found = startsOn(drive, plan, starts());
  std::printf("%-34s one scan: %d of %d right, %d wrong; 3 m: %d right, %d wrong\n", what.c_str(),
              found.right_at_once, found.all, found.wrong_at_once, found.right, found.wrong);
  EXPECT_EQ(found.wrong_at_once, 0) << what;
  EXPECT_EQ(found.wrong, 0) << what;
  EXPECT_GE(found.right, 0.8 * found.all) << what;
}

/// @param find_again  m, of way.
void carry(const Drive& drive, const std::vector<PlanLine>& plan, const std::string& what,
           double find_again) {
  const Kidnaps carried = kidnapsOn(drive, plan, isLong() ? 10 : 3);
  std::printf(
      "%-34s carried %d: noticed %d (mean %.2f, worst %.2f m), found %d (mean %.2f, worst "
      "%.2f m), %d wrong\n",
      what.c_str(), carried.all, carried.noticed, carried.mean_notice, carried.worst_notice,
      carried.found, carried.mean_find, carried.worst_find, carried.wrong);
  EXPECT_EQ(carried.noticed, carried.all) << what;
  EXPECT_LE(carried.worst_notice, kNotice) << what;
  EXPECT_EQ(carried.wrong, 0) << what;
  EXPECT_LE(carried.worst_find, find_again) << what;
}

std::vector<std::string> worlds() {
  if (!isLong()) return {"apartment", "office"};
  return {"apartment", "office", "warehouse", "gallery", "random"};
}

TEST(Localisation, InAPlanWithoutItsFurnitureIsToThreeCentimetres) {
  for (const std::string& name : worlds()) {
    const Place place = ourPlace(name);
    const Drive drive = explorationOf(place.world, place.start, kLaser, isLong() ? 200.0 : 90.0);
    const std::vector<PlanLine> all = trueLines(name), plan = unfurnished(all);
    ASSERT_LT(plan.size(), all.size()) << "nothing of " << name << " is furniture";
    for (const auto& [lines, what] :
         {std::pair(all, ", true lines"), std::pair(plan, ", unfurnished")}) {
      const Errors errors = tracked(drive, lines);
      expectGood(errors, name + what);
      EXPECT_LT(errors.nees, 6.0) << name << what;  // mean of chi^2(3): 3
      EXPECT_GT(errors.nees, 0.5) << name << what;
    }
    startAnywhere(drive, plan, name + ", unfurnished");
    carry(drive, plan, name + ", unfurnished", isLong() ? HUGE_VAL : kFindAgain);
  }
}

// To three centimetres, or as good as the map: that of line SLAM with this laser may be 3 cm off
// itself, and no pose in it is better.
TEST(Localisation, InTheMapOfAnEarlierDriveIsAsGoodAsTheMap) {
  const double seconds = isLong() ? 200.0 : 90.0;
  for (const std::string& name : worlds()) {
    const Place place = ourPlace(name);
    const OwnMap map = ownMapOf(explorationOf(place.world, place.start, kLaser, seconds, 1));
    const Drive drive = explorationOf(place.world, place.start, kLaser, seconds, 2);
    const Errors errors = tracked(drive, map.lines);
    report(errors, name + ", own map");
    std::printf("%-34s rms %.4f m\n", (name + ", that map itself").c_str(), map.rms);
    EXPECT_LE(errors.rms, std::max(0.03, map.rms + 0.01)) << name;
    EXPECT_LE(errors.worst, kWorst) << name;
    EXPECT_EQ(errors.lost + errors.unknown, 0) << name;
    startAnywhere(drive, map.lines, name + ", own map");
  }
}

TEST(Localisation, InAnEmptyPlanOfAFurnishedBuildingThatPeopleDrew) {
  if (!std::filesystem::exists(sharedPlans())) {
    GTEST_SKIP() << sharedPlans() << " is missing: set CCA_SHARED_DATA to the data of the trials";
  }
  std::vector<std::string> names{"lab_ipa"};
  if (isLong()) names = {"lab_ipa", "lab_c_scan", "lab_d_scan", "office_d", "Freiburg52_scan"};
  const auto folder = std::filesystem::temp_directory_path() /
                      ("cca_plans_" + std::to_string(static_cast<long>(::getpid())));
  std::filesystem::create_directories(folder);
  for (const std::string& name : names) {
    const auto source = sharedPlans() / name;
    std::filesystem::copy_file(source / "plain.png", folder / "plain.png",
                               std::filesystem::copy_options::overwrite_existing);
    std::ifstream furnished(source / "world.yaml");
    std::ofstream plain(folder / "plain.yaml");
    for (std::string row; std::getline(furnished, row);) {
      plain << (row.rfind("image:", 0) == 0 ? "image: plain.png" : row) << "\n";
    }
    plain.close();
    const PlanFile plan = readPlan((folder / "plain.yaml").string());
    const Place place = placeOf((source / "world.yaml").string());
    const Drive drive = explorationOf(place.world, place.start, kLaser, isLong() ? 200.0 : 90.0);
    expectGood(tracked(drive, plan.lines), name + ", empty plan");
    startAnywhere(drive, plan.lines, name + ", empty plan");
    carry(drive, plan.lines, name + ", empty plan", isLong() ? HUGE_VAL : kFindAgain);
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace cca
