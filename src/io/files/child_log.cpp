// SPDX-License-Identifier: BSD-3-Clause
#include "child_log.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/files/text.hpp"

namespace cca {
namespace {

/// What goes through the pipe for each scan, before its warnings and ranges; both ends are one
/// program.
struct Message {
  enum Kind : std::uint32_t { kRecord, kEnd, kFailed } kind;
  bool has_time;
  std::uint64_t beams, text_length;
  double progress, time, angle_min, angle_increment, free_range_without_return, sweep_duration;
  Pose2 T_map_sensor, T_robot_sensor;
  std::optional<Pose2> corrected, odometry, truth;
  SweepMotion motion;
};
static_assert(std::is_trivially_copyable_v<Message>);

constexpr std::uint64_t kMostTold = 1U << 27;  // what is more was never written by a sound child

/// What reading a file of this size can need at most. Zipped, a file can grow by 1032 at most
/// [zlib]; no log needs a gigabyte beyond a few times what is in its file.
std::size_t mostMemory(std::size_t file_bytes) {
  constexpr std::size_t kMegabyte = 1 << 20;
  return std::min(64 * kMegabyte + 4 * 1032 * file_bytes, 1024 * kMegabyte + 16 * file_bytes);
}

/// Bytes of address space in use; 0 where the system does not tell.
std::size_t processSize() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// From here on this process grows by so many bytes only; where it would not, it is left alone.
void limitMemory(std::size_t bytes) {
  const std::size_t size = processSize();
  rlimit limit{};
  if (size == 0 || getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, size + bytes);
  setrlimit(RLIMIT_AS, &limit);
}

/// @return  whether all of it came through.
template <class Transfer, class Byte>
bool transferAll(Transfer transfer, int pipe, Byte* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t done = transfer(pipe, bytes, count);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes += done;
    count -= static_cast<std::size_t>(done);
  }
  return true;
}

void send(int pipe, Message message, const std::string& text, const std::vector<double>& ranges) {
  message.text_length = text.size();
  message.beams = ranges.size();
  const auto* const head = reinterpret_cast<const char*>(&message);
  const auto* const beams = reinterpret_cast<const char*>(ranges.data());
  const bool arrived = transferAll(::write, pipe, head, sizeof message) &&
                       transferAll(::write, pipe, text.data(), text.size()) &&
                       transferAll(::write, pipe, beams, ranges.size() * sizeof(double));
  if (!arrived) _exit(0);  // nobody reads any more
}

/// Calls copy(of the message, of the record) for all that a message tells of a record.
template <class M, class Record, class Copy>
void eachField(M& m, Record& record, Copy copy) {
  copy(m.has_time, record.has_time);
  copy(m.time, record.time);
  copy(m.angle_min, record.scan.angle_min);
  copy(m.angle_increment, record.scan.angle_increment);
  copy(m.sweep_duration, record.scan.sweep_duration);
  copy(m.free_range_without_return, record.scan.free_range_without_return);
  copy(m.T_map_sensor, record.scan.T_map_sensor);
  copy(m.T_robot_sensor, record.T_robot_sensor);
  copy(m.corrected, record.corrected);
  copy(m.odometry, record.odometry);
  copy(m.truth, record.truth);
  copy(m.motion, record.motion);
}

Message toMessage(const LogRecord& record, double progress) {
  Message m{};
  m.kind = Message::kRecord;
  m.progress = progress;
  eachField(m, record, [](auto& of_message, const auto& value) { of_message = value; });
  return m;
}

LogRecord toRecord(const Message& m, std::vector<double> ranges) {
  LogRecord record;
  record.scan.ranges = std::move(ranges);
  eachField(m, record, [](const auto& value, auto& of_record) { of_record = value; });
  return record;
}

[[noreturn]] void readForParent(int pipe, std::size_t file_bytes,
                                const std::function<std::unique_ptr<LogReader>()>& open) {
  // Ctrl-C goes to the terminal's whole group, and it is the parent that decides what it means.
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGTERM, SIG_DFL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  limitMemory(mostMemory(file_bytes));
  Message last{};
  std::string text;
  try {
    const auto log = open();
    while (const auto record = log->next()) {
      send(pipe, toMessage(*record, log->progress()), log->warnings(), record->scan.ranges);
    }
    last.kind = Message::kEnd;
    text = log->warnings();
  } catch (const std::bad_alloc&) {
    raise(SIGKILL);  // as where a library has not looked at what it was given
  } catch (const std::exception& error) {
    last.kind = Message::kFailed;
    text = error.what();
  }
  send(pipe, last, text, {});
  _exit(0);
}

class ChildLog : public LogReader {
 public:
  ChildLog(const std::string& path, const std::function<std::unique_ptr<LogReader>()>& open) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) throw std::runtime_error(path + ": " + std::strerror(errno));
    std::error_code none;
    const auto bytes = static_cast<std::size_t>(std::filesystem::file_size(path, none));
    child_ = fork();
    if (child_ == 0) {
      close(ends[0]);
      readForParent(ends[1], none ? 0 : bytes, open);
    }
    close(ends[1]);
    pipe_ = ends[0];
    if (child_ < 0) throw std::runtime_error(path + ": " + std::strerror(errno));
  }

  ~ChildLog() override {
    close(pipe_);
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
  ChildLog(const ChildLog&) = delete;
  ChildLog& operator=(const ChildLog&) = delete;

  std::optional<LogRecord> next() override {
    if (ended_) return std::nullopt;
    Message m{};
    std::vector<double> ranges;
    std::string text;
    if (!receive(m, text, ranges)) {
      ended_ = true;
      appendWarning(
          "unreadable from there on: damaged, or an object claims more than a file of this size "
          "can hold",
          warnings_);
      return std::nullopt;
    }
    progress_ = m.progress;
    if (m.kind == Message::kFailed) {
      ended_ = true;
      throw std::runtime_error(text);
    }
    warnings_ = text;
    ended_ = m.kind == Message::kEnd;
    if (ended_) return std::nullopt;
    return toRecord(m, std::move(ranges));
  }

  std::string warnings() const override { return warnings_; }
  double progress() const override { return ended_ ? 1.0 : progress_; }

 private:
  bool receive(Message& m, std::string& text, std::vector<double>& ranges) const {
    if (!transferAll(::read, pipe_, reinterpret_cast<char*>(&m), sizeof m)) return false;
    if (m.beams > kMostTold || m.text_length > kMostTold) return false;
    text.resize(m.text_length);
    ranges.resize(m.beams);
    return transferAll(::read, pipe_, text.data(), text.size()) &&
           transferAll(::read, pipe_, reinterpret_cast<char*>(ranges.data()),
                       ranges.size() * sizeof(double));
  }

  std::string warnings_;
  int pipe_ = -1;
  pid_t child_ = -1;
  double progress_ = 0.0;
  bool ended_ = false;
};

}  // namespace

std::unique_ptr<LogReader> readInChild(const std::string& path,
                                       const std::function<std::unique_ptr<LogReader>()>& open) {
  return std::make_unique<ChildLog>(path, open);
}

}  // namespace cca
