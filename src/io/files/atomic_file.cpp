// SPDX-License-Identifier: BSD-3-Clause
#include "io/files/atomic_file.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace cca {
namespace {

namespace fs = std::filesystem;

std::runtime_error cannotWrite(const std::string& path) {
  const std::string reason = errno != 0 ? std::strerror(errno) : "unknown reason";
  return std::runtime_error(path + ": cannot be written: " + reason);
}

/// Unique among the processes and threads that may write the same file.
std::string temporaryName(const fs::path& path) {
  static std::atomic<unsigned> number{0};
  const std::string part = ".part-" + std::to_string(getpid()) + "-" + std::to_string(number++);
  const std::string name = "." + path.stem().string() + part + path.extension().string();
  return (path.parent_path() / name).string();
}

/// The process that writes, or wrote, under a temporary name; 0 where the name is none.
int writerOf(std::string_view name) {
  constexpr std::string_view kPart = ".part-";
  const std::size_t at = name.rfind(kPart);
  if (at == std::string_view::npos || at == 0 || name.front() != '.') return 0;
  const char* const end = name.data() + name.size();
  int process = 0;
  unsigned number = 0;
  const auto writer = std::from_chars(name.data() + at + kPart.size(), end, process);
  if (writer.ec != std::errc() || writer.ptr == end || *writer.ptr != '-') return 0;
  const auto part = std::from_chars(writer.ptr + 1, end, number);
  const bool is_whole = part.ec == std::errc() && (part.ptr == end || *part.ptr == '.');
  return is_whole && process > 0 ? process : 0;
}

/// Where a link leads: renamed onto, the link itself would become the file.
std::string behindLinks(const std::string& path) {
  std::error_code none;
  if (!fs::is_symlink(fs::symlink_status(path, none))) return path;
  const std::string target = fs::canonical(path, none).string();
  return target.empty() ? path : target;
}

/// A terminal, a pipe, /dev/null: nothing that a rename may take the place of.
bool isDevice(const std::string& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void write(const std::string& to, std::string_view content, const std::string& path) {
  errno = 0;
  std::ofstream stream(to, std::ios::binary);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  if (!stream) throw cannotWrite(path);
}

}  // namespace

AtomicFile::AtomicFile(std::string path)
    : path_(std::move(path)), target_(behindLinks(path_)), temporary_(temporaryName(target_)) {
  if (path_.empty()) throw std::runtime_error("a file to be written has an empty name");
  if (isDevice(target_)) throw std::runtime_error(path_ + ": is no regular file");
  errno = fs::is_directory(target_) ? EISDIR : 0;
  if (errno != 0) throw cannotWrite(path_);
  if (!std::ofstream(temporary_)) throw cannotWrite(path_);
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;  // nothing is there after commit()
  fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  errno = 0;
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) throw cannotWrite(path_);
}

void requireNew(const std::string& path, bool overwrite) {
  if (fs::is_directory(path)) throw std::runtime_error(path + ": is a folder");
  if (overwrite || !fs::exists(path) || isDevice(path)) return;
  throw std::runtime_error(path + ": is there already (--force overwrites it)");
}

void requireApart(const std::string& path, std::initializer_list<std::string> others) {
  if (path.empty() || isDevice(path)) return;
  const auto placeOf = [](const std::string& name) {
    std::error_code unknown;
    return fs::weakly_canonical(fs::absolute(name, unknown), unknown);
  };
  for (const std::string& other : others) {
    if (other.empty() || placeOf(path) != placeOf(other)) continue;
    throw std::runtime_error(path + ": is named twice; what is written needs a file of its own");
  }
}

void removeLeftovers(const std::string& folder) {
  std::error_code gone;
  for (const auto& entry : fs::directory_iterator(folder, gone)) {
    const int writer = writerOf(entry.path().filename().string());
    if (writer > 0 && kill(writer, 0) != 0 && errno == ESRCH) fs::remove(entry.path(), gone);
  }
}

void makeFolder(const std::string& path) {
  if (path.empty()) throw std::runtime_error("a folder to be made has an empty name");
  std::error_code error, none;
  std::filesystem::create_directories(path, error);
  if (error || !std::filesystem::is_directory(path, none)) {
    throw std::runtime_error(path + ": cannot be made a folder" +
                             (error ? ": " + error.message() : ""));
  }
}

void writeFile(const std::string& path, std::string_view content) {
  if (isDevice(path)) return write(path, content, path);
  AtomicFile file(path);
  write(file.temporary(), content, path);
  file.commit();
}

}  // namespace cca
