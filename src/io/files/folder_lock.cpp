// SPDX-License-Identifier: BSD-3-Clause
#include "io/files/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

namespace cca {

FolderLock::FolderLock(const std::string& folder)
    : file_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (file_ < 0 || flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(file_);
  throw std::runtime_error(folder + ": another run is writing there");
}

FolderLock::~FolderLock() {
  if (file_ >= 0) close(file_);
}

}  // namespace cca
