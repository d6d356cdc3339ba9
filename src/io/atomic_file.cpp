// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/atomic_file.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace cca {
namespace {

std::runtime_error cannotWrite(const std::string& path) {
  const std::string reason = errno != 0 ? std::strerror(errno) : "unknown reason";
  return std::runtime_error(path + ": cannot be written: " + reason);
}

/// Unique among the processes and threads that may write the same file.
std::string temporaryName(const std::filesystem::path& path) {
  static std::atomic<unsigned> number{0};
  const std::string part = ".part-" + std::to_string(getpid()) + "-" + std::to_string(number++);
  const std::string name = "." + path.stem().string() + part + path.extension().string();
  return (path.parent_path() / name).string();
}

}  // namespace

AtomicFile::AtomicFile(std::string path)
    : path_(std::move(path)), temporary_(temporaryName(path_)) {
  errno = 0;
  if (!std::ofstream(temporary_)) throw cannotWrite(path_);
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;  // nothing is there after commit()
  std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  errno = 0;
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) throw cannotWrite(path_);
}

void writeFile(const std::string& path, std::string_view content) {
  AtomicFile file(path);
  errno = 0;
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  if (!stream) throw cannotWrite(path);
  file.commit();
}

}  // namespace cca
