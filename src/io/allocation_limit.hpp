// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/resource.h>

#include <cstddef>

namespace cca {

/// While one lives, the process can grow by so many bytes only; beyond, allocations throw
/// std::bad_alloc. For code of others that believes every size that a file claims.
///
/// It holds for all threads. Cost: four system calls. Where the system does not tell its size:
/// none.
class AllocationLimit {
 public:
  explicit AllocationLimit(std::size_t bytes);
  ~AllocationLimit();
  AllocationLimit(const AllocationLimit&) = delete;
  AllocationLimit& operator=(const AllocationLimit&) = delete;

 private:
  rlimit before_{};
  bool set_ = false;
};

}  // namespace cca
