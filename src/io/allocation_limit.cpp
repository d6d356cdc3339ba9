// SPDX-License-Identifier: BSD-3-Clause
#include "allocation_limit.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <charconv>

namespace cca {
namespace {

/// Bytes of address space in use; 0 where the system does not tell.
std::size_t processSize() {
  static const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  std::array<char, 128> text{};
  const ssize_t length = file < 0 ? -1 : pread(file, text.data(), text.size(), 0);
  std::size_t pages = 0;
  if (length > 0) std::from_chars(text.data(), text.data() + length, pages);
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace

AllocationLimit::AllocationLimit(std::size_t bytes) {
  const std::size_t size = processSize();
  if (size == 0 || getrlimit(RLIMIT_AS, &before_) != 0) return;
  rlimit limit = before_;
  limit.rlim_cur = size + bytes;
  if (limit.rlim_cur < before_.rlim_cur) set_ = setrlimit(RLIMIT_AS, &limit) == 0;
}

AllocationLimit::~AllocationLimit() {
  if (set_) setrlimit(RLIMIT_AS, &before_);
}

}  // namespace cca
