// SPDX-License-Identifier: BSD-3-Clause
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/replay/replay.hpp"
#include "replay_template.hpp"

namespace cca {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kRunsHere = "<!-- runs -->";
constexpr const char* kRunBegin = "<script type=\"application/octet-stream\" class=\"run\">";
constexpr const char* kRunEnd = "</script>\n";

constexpr char kRoomsFollow = '.';  // in a run, after what packed() gives; no sign of base64

constexpr std::int64_t kMomentWithoutTime = 100;  // ms, from one to the next

/// One number of each item from one on, as differences to the item before.
template <class Items, class Value>
Json column(const Items& items, Value&& value, std::size_t from = 0) {
  Json numbers = Json::array();
  std::int64_t last = 0;
  for (std::size_t k = from; k < items.size(); ++k) {
    const std::int64_t now = value(items[k]);
    numbers.push_back(now - last);
    last = now;
  }
  return numbers;
}

/// RFC 4648, section 4.
std::string base64Of(const std::vector<std::uint8_t>& bytes) {
  constexpr char kSigns[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t there = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t group = 0;
    for (std::size_t i = 0; i < 3; ++i) group = group << 8 | (i < there ? bytes[k + i] : 0U);
    for (std::size_t i = 0; i < 4; ++i)
      text += i <= there ? kSigns[group >> (18 - 6 * i) & 63U] : '=';
  }
  return text;
}

std::string packedText(const std::string& text) {
  uLongf size = compressBound(text.size());
  std::vector<std::uint8_t> bytes(size);
  if (compress2(bytes.data(), &size, reinterpret_cast<const Bytef*>(text.data()), text.size(),
                Z_DEFAULT_COMPRESSION) != Z_OK) {
    throw std::runtime_error("replay.html: out of memory");
  }
  bytes.resize(size);
  return base64Of(bytes);
}

template <class Laser>
Json jsonOf(const Laser& laser) {
  const auto& [x, y, theta] = laser.T_robot_sensor;
  return {{"x", x},
          {"y", y},
          {"theta", theta},
          {"first", laser.first},
          {"step", laser.step},
          {"beams", laser.beams}};
}

template <class Item>
std::int64_t frameOf(const Item& item) {
  return static_cast<std::int64_t>(item.frame);
}

template <class Change>
Json jsonOfLines(const std::vector<Change>& changes, std::size_t from) {
  Json lines;
  const auto put = [&](const char* name, auto value) {
    lines[name] = column(changes, value, from);
  };
  put("frame", frameOf<Change>);
  put("id", [](const Change& c) { return static_cast<std::int64_t>(c.id); });
  const char* const ends[] = {"x1", "y1", "x2", "y2"};
  for (std::size_t k = 0; k < 4; ++k) put(ends[k], [k](const Change& c) { return c.line.ends[k]; });
  put("support", [](const Change& c) { return c.line.support; });
  put("sigma_offset", [](const Change& c) { return c.line.sigma_offset; });
  put("sigma_angle", [](const Change& c) { return c.line.sigma_angle; });
  return lines;
}

/// x, y, x, y, ... in mm
Json ringOf(const Polygon& polygon) {
  Json numbers = Json::array();
  for (const Eigen::Vector2d& p : polygon) {
    numbers.push_back(std::llround(1e3 * p.x()));
    numbers.push_back(std::llround(1e3 * p.y()));
  }
  return numbers;
}

}  // namespace

std::string withRooms(const std::string& packed, const std::vector<PlanRoom>& rooms) {
  if (rooms.empty()) return packed;
  Json all = Json::array();
  for (const PlanRoom& room : rooms) {
    Json rings = Json::array({ringOf(room.outline)});
    for (const Polygon& hole : room.holes) rings.push_back(ringOf(hole));
    all.push_back({{"id", room.id}, {"name", room.name}, {"area", room.area}, {"rings", rings}});
  }
  return packed + kRoomsFollow +
         packedText(all.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string Replay::packed(const Eigen::Vector2d& origin) const {
  return packedText(json({}, origin, world_));
}

std::string Replay::since(const Mark& mark) const { return json(mark, {0.0, 0.0}, ""); }

std::string Replay::json(const Mark& from, const Eigen::Vector2d& origin,
                         const std::string& world) const {
  Json run;
  run["title"] = title_;
  run["origin"] = {origin.x(), origin.y()};
  run["robot_radius"] = robot_radius_;
  run["frontier_block"] = kFrontierBlock;
  run["world"] = world.empty() ? Json() : Json::parse(world);
  for (const Laser& laser : lasers_) run["lasers"].push_back(jsonOf(laser));
  Json& frames = run["frames"];
  const bool has_times = hasTimes();
  const auto put = [&](const std::string& name, auto value) {
    frames[name] = column(frames_, value, from.frames);
  };
  put("time", [&](const Frame& f) {
    return has_times ? f.time : kMomentWithoutTime * (&f - frames_.data());
  });
  put("distance", [](const Frame& f) { return f.distance; });
  const char* const names[] = {"x", "y", "theta"};
  for (std::size_t k = 0; k < 3; ++k) {
    put(names[k], [k](const Frame& f) { return f.pose[k]; });
    if (has_truth_)
      put(std::string("true_") + names[k], [k](const Frame& f) { return f.truth[k]; });
  }
  put("laser", [](const Frame& f) { return static_cast<std::int64_t>(f.laser); });
  frames["ranges"] = Json::array();
  for (std::size_t k = from.frames; k < frames_.size(); ++k) {
    for (Json& range : column(frames_[k].ranges, [](int r) { return r; })) {
      frames["ranges"].push_back(std::move(range));
    }
  }
  run["decisions"] = Json::array();
  for (std::size_t k = from.decisions; k < decisions_.size(); ++k) {
    const Decision& decision = decisions_[k];
    run["decisions"].push_back({{"frame", decision.frame},
                                {"goal", decision.goal ? Json(*decision.goal) : Json()},
                                {"reason", decision.reason},
                                {"way", decision.way}});
  }
  Json& frontier = run["frontier"];
  frontier["frame"] = column(toggles_, frameOf<Toggle>, from.toggles);
  frontier["x"] = column(
      toggles_, [](const Toggle& t) { return t.block.first; }, from.toggles);
  frontier["y"] = column(
      toggles_, [](const Toggle& t) { return t.block.second; }, from.toggles);
  run["lines"] = jsonOfLines(changes_, from.changes);
  run["coverage"]["distance"] = column(coverage_distance_, [](std::int64_t d) { return d; });
  run["coverage"]["share"] = column(coverage_share_, [](std::int64_t s) { return s; });
  return run.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string livePage() {
  std::string page = kReplayTemplate;
  const auto put = [&page](const std::string& place, const std::string& text) {
    page.replace(page.find(place), place.size(), text);
  };
  put("img-src data:", "img-src data:; connect-src 'self'");
  put(kRunsHere, "<script type=\"application/octet-stream\" class=\"live\"></script>\n");
  return page;
}

std::string replayPage(const std::vector<std::string>& runs) {
  std::string page = kReplayTemplate;
  std::string data;
  for (const std::string& run : runs) data += kRunBegin + run + kRunEnd;
  return page.replace(page.find(kRunsHere), std::string(kRunsHere).size(), data);
}

std::vector<std::string> runsOfReplayPage(const std::string& page, const std::string& name) {
  const std::string begin = kRunBegin;
  std::vector<std::string> runs;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    runs.push_back(page.substr(
        at, page.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                   "0123456789+/=.\r\n",
                                   at) -
                at));
  }
  if (runs.empty()) throw std::runtime_error(name + ": holds no run");
  return runs;
}

}  // namespace cca
