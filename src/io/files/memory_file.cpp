// SPDX-License-Identifier: BSD-3-Clause
#include "io/files/memory_file.hpp"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "gzip_lines.hpp"
#include "io/poses/local_frame.hpp"

namespace cca {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kFormat = "cca_mrpt memory 1";
/// A day of driving is a tenth of this.
constexpr std::size_t kLargestSize = std::size_t{1} << 30;
constexpr std::size_t kMostCompressed = 1100;    // times, by deflate
constexpr std::size_t kMostRemembered = 100000;  // beams of a scan

json asJson(const Pose2& pose) { return {pose.x, pose.y, pose.theta}; }

json asJson(const KeyScan& key, const Pose2& T_map_sensor) {
  const Scan& scan = key.scan;
  std::vector<float> ranges(scan.ranges.begin(), scan.ranges.end());
  std::vector<std::uint8_t> bytes(ranges.size() * sizeof(float));
  if (!bytes.empty()) std::memcpy(bytes.data(), ranges.data(), bytes.size());
  return {{"pose", asJson(T_map_sensor)},
          {"mount", asJson(key.T_robot_sensor)},
          {"angle_min", scan.angle_min},
          {"angle_increment", scan.angle_increment},
          {"free_range", scan.free_range_without_return},
          {"ranges", json::binary(std::move(bytes))}};
}

json asJson(const GraphEdge& edge) {
  const Eigen::Matrix3d& i = edge.information;
  return {edge.from,        edge.to,          static_cast<int>(edge.kind),
          edge.T_from_to.x, edge.T_from_to.y, edge.T_from_to.theta,
          i(0, 0),          i(0, 1),          i(0, 2),
          i(1, 1),          i(1, 2),          i(2, 2)};
}

double finite(const json& number) {
  const double value = number.get<double>();
  if (!std::isfinite(value)) throw std::runtime_error("holds a number that is not finite");
  return value;
}

Pose2 poseOf(const json& values) {
  return {finite(values.at(0)), finite(values.at(1)), finite(values.at(2))};
}

KeyScan keyScanOf(const json& frame) {
  KeyScan key;
  key.T_robot_sensor = poseOf(frame.at("mount"));
  key.scan.angle_min = finite(frame.at("angle_min"));
  key.scan.angle_increment = finite(frame.at("angle_increment"));
  key.scan.free_range_without_return = finite(frame.at("free_range"));
  const auto& bytes = frame.at("ranges").get_binary();
  std::vector<float> ranges(bytes.size() / sizeof(float));
  if (ranges.size() > kMostRemembered) throw std::runtime_error("holds a scan of too many beams");
  if (!ranges.empty()) std::memcpy(ranges.data(), bytes.data(), ranges.size() * sizeof(float));
  key.scan.ranges.assign(ranges.begin(), ranges.end());
  return key;
}

GraphEdge edgeOf(const json& values, int frames) {
  GraphEdge edge;
  edge.from = values.at(0).get<int>();
  edge.to = values.at(1).get<int>();
  const int kind = values.at(2).get<int>();
  const auto isThere = [&](int frame) { return frame >= 0 && frame < frames; };
  if (!isThere(edge.from) || !isThere(edge.to) || edge.from == edge.to || kind < 0 ||
      kind > static_cast<int>(EdgeKind::kLoop)) {
    throw std::runtime_error("holds an edge to a frame that is not there");
  }
  edge.kind = static_cast<EdgeKind>(kind);
  edge.T_from_to = {finite(values.at(3)), finite(values.at(4)), finite(values.at(5))};
  std::size_t next = 6;
  for (int row = 0; row < 3; ++row) {
    for (int column = row; column < 3; ++column) {
      edge.information(row, column) = edge.information(column, row) = finite(values.at(next++));
    }
  }
  return edge;
}

StoredMemory memoryOf(const json& stored) {
  if (stored.at("format").get<std::string>() != kFormat) {
    throw std::runtime_error("is of another version of this program");
  }
  StoredMemory loaded;
  loaded.origin = {finite(stored.at("origin").at(0)), finite(stored.at("origin").at(1))};
  SlamMemory& memory = loaded.memory;
  for (const json& frame : stored.at("frames")) {
    memory.scans.push_back(keyScanOf(frame));
    memory.graph.add(poseOf(frame.at("pose")));
  }
  for (const json& edge : stored.at("edges")) {
    memory.graph.connect(edgeOf(edge, memory.graph.size()));
  }
  return loaded;
}

}  // namespace

std::string packedMemory(const StoredMemory& stored) {
  const SlamMemory& memory = stored.memory;
  json frames = json::array(), edges = json::array();
  for (int k = 0; k < memory.graph.size(); ++k) {
    frames.push_back(asJson(memory.scans[static_cast<std::size_t>(k)], memory.graph.pose(k)));
  }
  for (const GraphEdge& edge : memory.graph.edges()) edges.push_back(asJson(edge));
  const std::vector<std::uint8_t> bytes =
      json::to_cbor({{"format", kFormat},
                     {"origin", {stored.origin.x(), stored.origin.y()}},
                     {"frames", std::move(frames)},
                     {"edges", std::move(edges)}});
  return gzipped({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

StoredMemory loadMemory(const std::string& path) {
  const std::string file = fs::is_directory(path) ? (fs::path(path) / kMemoryFile).string() : path;
  if (!fs::is_regular_file(file)) {
    throw std::runtime_error(file + ": is not there; runs with --pose slam leave it");
  }
  const std::size_t size = lengthInGzipTrailer(file);
  const bool is_likely = size <= kLargestSize && size <= kMostCompressed * fs::file_size(file);
  // A byte more: what is behind the last one is looked at, and gzip's sum of all.
  const std::string bytes = is_likely ? fileHead(file, size + 1) : "";
  if (bytes.size() != size) throw std::runtime_error(file + ": is damaged, or no map.slam");
  try {
    return memoryOf(json::from_cbor(bytes));
  } catch (const json::exception&) {
    throw std::runtime_error(file + ": is damaged, or no map.slam");
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

SlamMemory seenFrom(const Eigen::Vector2d& p_origin, StoredMemory stored) {
  PoseGraph& graph = stored.memory.graph;
  for (int k = 0; k < graph.size(); ++k) {
    graph.place(k, seenFrom(p_origin - stored.origin, graph.pose(k)));
  }
  return std::move(stored.memory);
}

}  // namespace cca
