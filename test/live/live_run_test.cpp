// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_run.hpp"

#include <gtest/gtest.h>
#include <mrpt/system/string_utils.h>
#include <zlib.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

namespace cca::live_run_test {
namespace {

using nlohmann::json;

LivePageSettings settings() {
  LivePageSettings page;
  page.title = "a run";
  page.has_robot = true;
  return page;
}

std::vector<MapLine> wallOf(double length) {
  MapLine line;
  line.id = 7;
  line.segment.end = {length, 0.0};
  line.support = 10.0;
  return {line};
}

LiveRun::Glimpse glimpseAt(double x, const std::string& reason = "onwards") {
  LiveRun::Glimpse glimpse;
  glimpse.moment.time = glimpse.moment.distance = x;
  glimpse.moment.T_map_robot = {x, 0.0, 0.0};
  glimpse.moment.reason = reason;
  glimpse.scan.ranges = {1.0, std::numeric_limits<double>::infinity(), 2.0};
  glimpse.scan.angle_increment = 0.1;
  return glimpse;
}

LiveRun::Glimpse anew() {
  LiveRun::Glimpse glimpse;
  glimpse.begins_anew = true;
  return glimpse;
}

json unpacked(const std::string& packed) {
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(mrpt::system::decodeBase64(packed, bytes));
  std::string text(1'000'000, '\0');
  uLongf size = text.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(text.data()), &size, bytes.data(), bytes.size()),
            Z_OK);
  return json::parse(text.substr(0, size));
}

/// A viewer, and what its page has by what it was told.
struct Page {
  explicit Page(LiveRun& live) : run(live) {}

  /// The next event that says something; {} where the run is closed. It is one line of a stream.
  json next() {
    for (;;) {
      const std::string event = run.next(viewed);
      if (event.empty()) return {};
      EXPECT_EQ(event.find("\n\n"), event.size() - 2) << "one event";
      EXPECT_EQ(event.find('\n'), event.size() - 2) << "of one line";
      if (event[0] == ':') continue;
      const json told = json::parse(event.substr(6));
      take(told);
      return told;
    }
  }
  /// All that there is, up to the end of the run.
  void follow() {
    while (!next().is_null()) {
    }
  }
  void take(const json& told) {
    if (told.contains("empty")) moments = lines = 0;
    if (told.contains("whole")) {
      moments = lines = 0;
      ++wholes;
      count(unpacked(told["whole"]));
    }
    if (told.contains("more")) count(told["more"]);
    if (told.contains("robot")) robot = told["robot"];
    end = told["end"];
  }
  void count(const json& data) {
    moments += data["frames"]["x"].size();
    lines += data["lines"]["id"].size();
  }

  LiveRun& run;
  LiveRun::Viewed viewed;
  std::size_t moments = 0, lines = 0, wholes = 0;
  json robot;
  std::string end;
};

TEST(LiveRun, TellsOfARunThatHasNotBegun) {
  LiveRun run(settings());
  Page page(run);
  const json told = page.next();
  EXPECT_TRUE(told["empty"]);
  EXPECT_FALSE(told["paused"]);
  EXPECT_TRUE(told["has_robot"]);
  EXPECT_EQ(told["end"], "");
  EXPECT_FALSE(told.contains("more"));
}

TEST(LiveRun, ShowsTheSameToWhoFollowsAndToWhoComesAtTheEnd) {
  LiveRun run(settings());
  Page follower(run), late(run);
  std::thread thread([&] { follower.follow(); });
  for (int k = 0; k < 200; ++k) {
    LiveRun::Glimpse glimpse = glimpseAt(0.1 * k);
    if (k % 10 == 0) glimpse.lines = wallOf(0.1 * k + 1.0);
    run.hand(std::move(glimpse));
    if (k % 5 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  run.finish(wallOf(3.0), "all is seen");
  run.close();
  thread.join();
  late.follow();
  EXPECT_GT(late.moments, 0u);
  EXPECT_EQ(follower.moments, late.moments);
  EXPECT_EQ(follower.lines, late.lines);
  EXPECT_EQ(follower.robot, late.robot);
  EXPECT_EQ(follower.end, "all is seen");
  // The second moment tells whether the run has times; from then on there is the rest alone.
  EXPECT_LE(follower.wholes, 2u);
}

TEST(LiveRun, GivesASlowViewerAllAtOnce) {
  LiveRun run(settings());
  for (int k = 0; k < 50; ++k) run.hand(glimpseAt(k));
  run.finish({}, "");
  Page page(run);
  page.next();
  EXPECT_EQ(page.moments, 50u);
}

TEST(LiveRun, KeepsNoMomentOfARobotThatStandsButShowsIt) {
  LiveRun run(settings());
  for (int k = 0; k < 60; ++k) {
    LiveRun::Glimpse glimpse = glimpseAt(1.0 + 1e-4 * k);
    glimpse.moment.time = k;
    glimpse.lines = wallOf(k < 30 ? 1.0 : 2.0);
    run.hand(std::move(glimpse));
  }
  run.finish(wallOf(2.0), "");
  Page page(run);
  const json told = page.next();
  EXPECT_EQ(page.moments, 1u);
  EXPECT_EQ(page.lines, 3u) << "the wall, as it has grown, and at the end";
  EXPECT_EQ(told["robot"]["time"], 59.0);
}

TEST(LiveRun, BeginsAnewWhereTheMapDoes) {
  LiveRun run(settings());
  Page page(run);
  for (int k = 0; k < 20; ++k) run.hand(glimpseAt(k));
  run.finish({}, "");
  while (page.moments < 20) page.next();
  run.hand(anew());
  run.finish({}, "");
  EXPECT_TRUE(page.next()["empty"]);
  EXPECT_EQ(page.moments, 0u);
  for (int k = 0; k < 30; ++k) run.hand(glimpseAt(-k));
  run.finish({}, "");
  while (page.moments < 30) page.next();
  EXPECT_EQ(page.moments, 30u);
  EXPECT_EQ(page.robot["x"], -29.0);
}

TEST(LiveRun, IsNotConfusedByAViewerWhoClaimsToHaveMore) {
  LiveRun run(settings());
  for (int k = 0; k < 5; ++k) run.hand(glimpseAt(k));
  run.finish({}, "");
  for (const std::size_t run_number : {std::size_t{0}, std::size_t{1}, std::size_t{99}}) {
    Page page(run);
    page.viewed.run = run_number;
    page.viewed.version = 12345;
    page.viewed.mark = {1, 3, 1'000'000, 1'000'000, 1'000'000, false, true};
    page.next();
    EXPECT_EQ(page.moments, 5u);
  }
}

TEST(LiveRun, SaysWhatNeedNotBeText) {
  LiveRun run(settings());
  Page page(run);
  const std::string evil = "line\n\ndata: {\"end\": \"no\"}\r\n</script>\0\xff\xfe";
  run.hand(glimpseAt(1.0, evil));
  run.finish({}, "\xc3\x28\n\n");
  while (page.end.empty()) page.next();
  EXPECT_EQ(page.robot["reason"].get<std::string>().substr(0, 6), "line\n\n");
  EXPECT_EQ(page.moments, 1u);
}

TEST(LiveRun, LeavesOutWhatIsNoPlaceOrTime) {
  LiveRun run(settings());
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                   kInf = std::numeric_limits<double>::infinity();
  for (const double x : {kNan, kInf, -kInf}) run.hand(glimpseAt(x));
  LiveRun::Glimpse no_scan = glimpseAt(0.0);
  no_scan.scan.ranges.clear();
  run.hand(std::move(no_scan));
  for (const double x : {1e300, -1e300}) {
    LiveRun::Glimpse far = glimpseAt(x);
    far.scan.ranges = {kNan, -1.0, 1e300};
    run.hand(std::move(far));
  }
  run.finish({}, "");
  Page page(run);
  page.next();
  EXPECT_EQ(page.moments, 3u);
}

TEST(LiveRun, WaitsForNobodyAndDropsWhatIsTooMuch) {
  LiveRun run(settings());
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < 20'000; ++k) run.hand(glimpseAt(k));
  run.finish({}, "done");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  Page page(run);
  page.next();
  EXPECT_GE(page.moments, 100u);
  EXPECT_LE(page.moments, Replay::kMostMoments);
  EXPECT_EQ(page.end, "done");
}

TEST(LiveRun, ShowsALongRunWhoseMomentsAreThinnedOut) {
  LiveRun run(settings());
  Page page(run);
  for (std::size_t k = 0; k < 2 * Replay::kMostMoments; ++k) {
    run.hand(glimpseAt(static_cast<double>(k)));
    if (k % 50 == 0) run.finish({}, "");  // all so far is taken
    if (k % 500 == 0) page.next();
  }
  run.finish({}, "done");
  while (page.end != "done") page.next();
  Page late(run);
  late.next();
  EXPECT_EQ(page.moments, late.moments);
  EXPECT_GT(page.moments, Replay::kMostMoments / 2 - 1);
}

TEST(LiveRun, SpeaksOnceASecondWhereNothingHappens) {
  LiveRun run(settings());
  Page page(run);
  page.next();
  EXPECT_EQ(run.next(page.viewed), ": still here\n\n");
}

TEST(LiveRun, TellsWhoIsPausedOnceAndEndsAllWhoWait) {
  LiveRun run(settings());
  Page page(run);
  page.next();
  run.setPaused(true);
  EXPECT_TRUE(page.next()["paused"]);
  run.setPaused(true);
  std::vector<std::thread> viewers;
  for (int k = 0; k < 8; ++k) {
    viewers.emplace_back([&run] { Page(run).follow(); });
  }
  run.close();
  for (std::thread& viewer : viewers) viewer.join();
  EXPECT_EQ(run.next(page.viewed), "");
}

TEST(LiveRun, EndsWithMuchThatWaits) {
  for (int k = 0; k < 20; ++k) {
    LiveRun run(settings());
    for (int i = 0; i < 100; ++i) run.hand(glimpseAt(i));
  }
}

}  // namespace
}  // namespace cca::live_run_test
