// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/log_reader.hpp"

#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

#include "io/files/child_log.hpp"
#include "io/files/gzip_lines.hpp"
#include "io/files/unzipped_file.hpp"
#include "io/mrpt/mrpt_objects.hpp"
#include "io/poses/truth_file.hpp"
#include "rawlog_reader.hpp"
#include "sound_log.hpp"
#include "text_formats.hpp"
#include "undistorted_log.hpp"

namespace cca {
namespace {

constexpr const char* kSqlite = "SQLite format 3";

/// Both names are in use; the last is that of files from before 2006.
bool isSimpleMap(const std::string& class_name) {
  return class_name == "mrpt::maps::CSimpleMap" || class_name == "CSimpleMap" ||
         class_name == "CSensFrameProbSequence";
}

std::vector<LogKind>& addedKinds() {
  static std::vector<LogKind> kinds;
  return kinds;
}

std::unique_ptr<LogReader> openAdded(const LogKind& kind, const std::string& path,
                                     const LogHints& hints) try {
  return kind.open(unzippedFile(path), hints);
} catch (const std::runtime_error& error) {
  throw std::runtime_error(path + ": " + error.what());
}

/// Of a folder: of what ROS 2 records in it.
std::string headOf(const std::string& path) {
  const bool is_recording = std::filesystem::exists(std::filesystem::path(path) / "metadata.yaml");
  return is_recording ? kSqlite : fileHead(path, kLogHead);
}

/// Logs that are known, and not read. @return  what this is one of; empty for any other.
std::string unreadKind(const std::string& head) {
  const auto begins = [&](const std::string& bytes) { return head.rfind(bytes, 0) == 0; };
  if (begins("#ROSBAG")) return "a ROS bag, and this program was built without ROS";
  if (begins("#ROSRECORD")) return "a ROS bag of version 1; those of version 2.0 are read";
  if (begins("\x89MCAP") || begins(kSqlite)) {
    return "a ROS 2 recording; Python reads it: 'python -m cca_mrpt map' (docs/python.md)";
  }
  return "";
}

std::unique_ptr<LogReader> openAsWhatItIs(const std::string& path, const LogHints& hints) {
  const std::string head = headOf(path);
  if (head.empty()) throw std::runtime_error(path + ": is empty, or a damaged compressed file");
  for (const LogKind& kind : addedKinds()) {
    if (!kind.recognizes(head)) continue;
    return readInChild(path, [&] { return openAdded(kind, path, hints); });
  }
  const std::string unread = unreadKind(head);
  if (!unread.empty()) throw std::runtime_error(path + ": is " + unread);
  if (!hints.empty()) {
    throw std::runtime_error(path + ": is no ROS bag: topic, base frame and mount tell of bags");
  }
  const std::string mrpt_class = mrptClassName(head);
  if (isSimpleMap(mrpt_class)) return readInChild(path, [&] { return openSimpleMap(path); });
  if (!mrpt_class.empty()) return readInChild(path, [&] { return openRawlog(path); });
  if (auto log = openTextLog(path, head)) return log;
  std::string known = std::string("MRPT .rawlog and .simplemap, ") + kTextLogKinds;
  for (const LogKind& kind : addedKinds()) known += ", " + kind.name;
  throw std::runtime_error(path + ": not a log of a known kind (" + known + ")");
}

}  // namespace

void addLogKind(LogKind kind) { addedKinds().push_back(std::move(kind)); }

std::unique_ptr<LogReader> openLog(const std::string& path, const LogHints& hints) {
  auto log = openAsWhatItIs(path, hints);
  if (const auto truth = findTruthFile(path)) log = withTruth(std::move(log), *truth);
  return soundScansOf(std::move(log), path);
}

std::unique_ptr<LogReader> openUndistortedLog(const std::string& path, const LogHints& hints) {
  return undistortedLog([&] { return openLog(path, hints); }, hints.sweep);
}

}  // namespace cca
