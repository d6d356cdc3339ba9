// SPDX-License-Identifier: BSD-3-Clause
#include "io/replay/replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/system/string_utils.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

namespace cca::replay_test {
namespace {

Scan wallAhead(const Pose2& T_map_sensor) {
  Scan scan;
  scan.angle_min = -0.5;
  scan.angle_increment = 0.01;
  scan.T_map_sensor = T_map_sensor;
  for (int beam = 0; beam <= 100; ++beam) {
    scan.ranges.push_back((10.0 - T_map_sensor.x) / std::cos(scan.bearing(beam)));
  }
  return scan;
}

ReplayMoment momentAt(double time, const Pose2& pose) {
  ReplayMoment moment;
  moment.time = moment.distance = time;
  moment.T_map_robot = pose;
  moment.truth = pose;
  moment.reason = "test";
  return moment;
}

/// A robot that drives at a wall, mm by mm.
Replay drive(int moments) {
  LineMap map;
  Replay replay("wall");
  for (int k = 0; k < moments; ++k) {
    const Pose2 pose{1e-3 * k, 0.0, 0.0};
    const Scan scan = wallAhead(pose);
    if (k < 20) map.insert(scan);
    ReplayMoment moment = momentAt(0.1 * k, pose);
    if (k % 2 == 0) moment.frontier = {{1.0, 1.0}, {1.01, 1.01}};
    replay.add(moment, scan, map);
  }
  replay.finish(map.lines());
  return replay;
}

nlohmann::json unpacked(const std::string& packed) {
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(mrpt::system::decodeBase64(packed, bytes));
  std::string text(100 * bytes.size() + 100000, '\0');
  uLongf size = text.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(text.data()), &size, bytes.data(), bytes.size()),
            Z_OK);
  return nlohmann::json::parse(text.substr(0, size));
}

std::int64_t sum(const nlohmann::json& column) {
  const auto numbers = column.get<std::vector<std::int64_t>>();
  return std::accumulate(numbers.begin(), numbers.end(), std::int64_t{0});
}

TEST(Replay, KeepsTheMomentsOfAShortRun) {
  const auto run = unpacked(drive(100).packed({7.0, 8.0}));
  EXPECT_EQ(run["frames"]["time"].size(), 100u);
  EXPECT_EQ(sum(run["frames"]["time"]), 9900);  // ms
  EXPECT_EQ(sum(run["frames"]["x"]), 99);       // mm
  EXPECT_EQ(run["frames"]["true_x"].size(), 100u);
  EXPECT_EQ(run["origin"], nlohmann::json({7.0, 8.0}));
  EXPECT_EQ(run["lasers"].size(), 1u);
  EXPECT_EQ(run["frames"]["ranges"].size(), 100u * 101u);
  EXPECT_EQ(run["frontier"]["frame"].size(), 100u);  // one block, there and gone
  EXPECT_EQ(run["decisions"].size(), 1u);
}

TEST(Replay, EndsWithTheLinesAsTheyAre) {
  LineMap map;
  for (int k = 0; k < 20; ++k) map.insert(wallAhead({1e-3 * k, 0.0, 0.0}));
  ASSERT_EQ(map.lines().size(), 1u);
  const auto lines = unpacked(drive(100).packed())["lines"];
  EXPECT_EQ(sum(lines["x1"]), std::llround(1e3 * map.lines()[0].segment.start.x()));
  EXPECT_EQ(sum(lines["y2"]), std::llround(1e3 * map.lines()[0].segment.end.y()));
  EXPECT_EQ(sum(lines["support"]), std::llround(map.lines()[0].support));
}

TEST(Replay, ThinsALongRun) {
  const auto run = unpacked(drive(9001).packed());
  const std::size_t moments = run["frames"]["time"].size();
  EXPECT_GE(moments, Replay::kMostMoments / 2);
  EXPECT_LE(moments, Replay::kMostMoments);
  EXPECT_EQ(sum(run["frames"]["time"]), 900000);
  EXPECT_LE(sum(run["lines"]["frame"]), static_cast<std::int64_t>(moments));
}

TEST(Replay, GivesTheSameBytesAgain) { EXPECT_EQ(drive(300).packed(), drive(300).packed()); }

TEST(Replay, LeavesOutWhatIsNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Replay replay;
  replay.add(momentAt(0.0, {nan, 0.0, 0.0}), wallAhead({}), LineMap());
  replay.add(momentAt(nan, {}), wallAhead({}), LineMap());
  EXPECT_TRUE(replay.empty());
  Scan scan = wallAhead({});
  scan.ranges = {nan, -1.0, std::numeric_limits<double>::infinity(), 1e300, 2.0};
  replay.add(momentAt(0.0, {}), scan, LineMap());
  EXPECT_EQ(unpacked(replay.packed())["frames"]["ranges"],
            nlohmann::json({0, 0, 0, 1000000, 200 - 1000000}));
}

TEST(Replay, ShowsNoTruthThatIsNotKnownThroughout) {
  Replay replay;
  replay.add(momentAt(0.0, {}), wallAhead({}), LineMap());
  ReplayMoment unknown = momentAt(1.0, {});
  unknown.truth.reset();
  replay.add(unknown, wallAhead({}), LineMap());
  EXPECT_FALSE(unpacked(replay.packed())["frames"].contains("true_x"));
}

TEST(Replay, PlaysALogThatTellsNoTimes) {
  Replay replay;
  for (int k = 0; k < 5; ++k)
    replay.add(momentAt(0.0, {0.1 * k, 0.0, 0.0}), wallAhead({}), LineMap());
  EXPECT_EQ(unpacked(replay.packed())["frames"]["time"], nlohmann::json({0, 100, 100, 100, 100}));
}

TEST(ReplayPage, HoldsItsRuns) {
  const std::vector<std::string> runs{drive(10).packed(), drive(20).packed()};
  const std::string page = replayPage(runs);
  EXPECT_EQ(runsOfReplayPage(page, "page"), runs);
  EXPECT_THAT(page, testing::Not(testing::HasSubstr("<script src")));
  EXPECT_THAT(page, testing::Not(testing::HasSubstr("<link")));
}

TEST(ReplayPage, KeepsTheRoomsOfARun) {
  PlanRoom room;
  room.id = 3;
  room.name = "caf\xC3\xA9 \"</script>\"";
  room.area = 15.0;
  room.outline = {{0, 0}, {4, 0}, {4, 4.0004}, {0, 4}};
  room.holes = {{{1, 1}, {1, 2}, {2, 2}}};
  const std::string packed = drive(10).packed(), run = withRooms(packed, {room});
  EXPECT_EQ(withRooms(packed, {room}), run);
  EXPECT_EQ(withRooms(packed, {}), packed);
  const std::vector<std::string> runs{run, packed};
  EXPECT_EQ(runsOfReplayPage(replayPage(runs), "page"), runs);
  ASSERT_EQ(run.compare(0, packed.size() + 1, packed + '.'), 0);
  const nlohmann::json rooms = unpacked(run.substr(packed.size() + 1));
  ASSERT_EQ(rooms.size(), 1U);
  EXPECT_EQ(rooms[0]["id"], 3);
  EXPECT_EQ(rooms[0]["name"], room.name);
  EXPECT_EQ(rooms[0]["area"], 15.0);
  EXPECT_EQ(rooms[0]["rings"], nlohmann::json({{0, 0, 4000, 0, 4000, 4000, 0, 4000},
                                               {1000, 1000, 1000, 2000, 2000, 2000}}));
}

TEST(ReplayPage, OfSomethingElseIsToldApart) {
  EXPECT_THROW(runsOfReplayPage("<html></html>", "page"), std::runtime_error);
}

/// Appends the numbers of which a column holds the differences.
void undo(std::vector<std::int64_t>& numbers, const nlohmann::json& column) {
  std::int64_t sum = 0;
  for (const auto& difference : column) numbers.push_back(sum += difference.get<std::int64_t>());
}

using Columns = std::map<std::string, std::vector<std::int64_t>>;

/// As the page takes what it is told, but the frames of changes, which it bounds by what it has.
void append(const nlohmann::json& run, Columns& to) {
  for (const auto& [name, column] : run["frames"].items()) {
    if (name != "ranges") undo(to[name], column);
  }
  for (const auto& [name, column] : run["lines"].items()) {
    if (name != "frame") undo(to["line_" + name], column);
  }
  for (const char* name : {"x", "y"})
    undo(to[std::string("frontier_") + name], run["frontier"][name]);
  for (const auto& range : run["frames"]["ranges"]) to["ranges"].push_back(range);
  for (const auto& decision : run["decisions"]) to["decisions"].push_back(decision["frame"]);
}

TEST(ReplaySince, IsNothingWhereNothingHasCome) {
  const Replay replay = drive(100);
  const auto more = nlohmann::json::parse(replay.since(replay.mark()));
  for (const auto& [name, column] : more["frames"].items()) EXPECT_TRUE(column.empty()) << name;
  for (const auto& [name, column] : more["lines"].items()) EXPECT_TRUE(column.empty()) << name;
  EXPECT_TRUE(more["decisions"].empty());
  EXPECT_TRUE(more["world"].is_null());
}

TEST(ReplaySince, OfARunWithoutMomentsIsEmpty) {
  const Replay replay("nothing");
  EXPECT_TRUE(Replay::Mark().generation == 0 && !Replay::Mark().isBefore(replay.mark()));
  const auto more = nlohmann::json::parse(replay.since(replay.mark()));
  EXPECT_TRUE(more["frames"]["x"].empty());
}

TEST(ReplaySince, AddsUpToTheWholeInPartsOfAnySize) {
  LineMap map;
  Replay replay("wall");
  Replay::Mark mark;
  Columns followed;
  int parts = 0;
  for (int k = 0; k < 1000; ++k) {
    const Pose2 pose{1e-2 * k, 0.01 * (k % 7), 0.001 * (k % 11)};
    const Scan scan = wallAhead(pose);
    if (k % 50 == 0) map.insert(scan);
    ReplayMoment moment = momentAt(0.1 * k, pose);
    moment.reason = "reason " + std::to_string(k / 13);
    if (k % 3 == 0) moment.frontier = {{0.2 * (k % 17), 1.0}, {1.0, 0.2 * (k % 5)}};
    replay.add(moment, scan, map);
    if (k * k % 23 > 3) continue;
    if (!mark.isBefore(replay.mark())) followed.clear();
    const Replay::Mark from = mark.isBefore(replay.mark())
                                  ? mark
                                  : Replay::Mark{replay.mark().generation, 0, 0, 0, 0, true, true};
    append(nlohmann::json::parse(replay.since(from)), followed);
    mark = replay.mark();
    ++parts;
  }
  replay.redraw({});
  replay.finish(map.lines());
  append(nlohmann::json::parse(replay.since(mark)), followed);
  Columns whole;
  append(unpacked(replay.packed()), whole);
  EXPECT_GT(parts, 50);
  for (const auto& [name, column] : whole) EXPECT_EQ(followed[name], column) << name;
}

TEST(ReplaySince, IsVoidOnceMomentsWereDropped) {
  LineMap map;
  Replay replay("long");
  Replay::Mark mark;
  for (std::size_t k = 0; k <= Replay::kMostMoments; ++k) {
    mark = replay.mark();
    const Pose2 pose{1e-3 * static_cast<double>(k), 0.0, 0.0};
    replay.add(momentAt(0.1 * static_cast<double>(k), pose), wallAhead(pose), map);
  }
  EXPECT_FALSE(mark.isBefore(replay.mark()));
}

TEST(ReplaySince, IsVoidOnceTheTruthIsNotKnownAnyMore) {
  Replay replay = drive(10);
  const Replay::Mark mark = replay.mark();
  ReplayMoment moment = momentAt(2.0, {1.0, 0.0, 0.0});
  moment.truth.reset();
  replay.add(moment, wallAhead(moment.T_map_robot), LineMap());
  EXPECT_FALSE(mark.isBefore(replay.mark()));
}

TEST(ReplaySince, NoMarkOfMoreThanThereIsIsBefore) {
  const Replay replay = drive(10);
  const Replay::Mark now = replay.mark();
  EXPECT_TRUE(now.isBefore(now));
  for (std::size_t Replay::Mark::*count : {&Replay::Mark::frames, &Replay::Mark::decisions,
                                           &Replay::Mark::toggles, &Replay::Mark::changes}) {
    Replay::Mark later = now;
    ++(later.*count);
    EXPECT_FALSE(later.isBefore(now));
    later.*count = static_cast<std::size_t>(-1);
    EXPECT_FALSE(later.isBefore(now));
  }
}

TEST(Replay, HoldsNumbersThatAPageReadsExactly) {
  Replay replay("astray");
  for (const double x : {0.0, 1e300, -1e300, 5.0}) {
    ReplayMoment moment = momentAt(1.0, {x, 0.0, 0.0});
    moment.distance = std::numeric_limits<double>::quiet_NaN();
    moment.goal = {{x, std::numeric_limits<double>::infinity()}};
    replay.add(moment, wallAhead({}), LineMap());
  }
  Columns columns;
  append(unpacked(replay.packed()), columns);
  EXPECT_EQ(columns["x"].back(), 5000);
  for (const std::int64_t x : columns["x"]) EXPECT_LT(std::abs(x), std::int64_t{1} << 53);
}

}  // namespace
}  // namespace cca::replay_test
