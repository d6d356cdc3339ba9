// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace cca {

/// Keeps a folder for one run, so that two do not mix their files. Nothing remains of it, however
/// the program ends. On a file system without locks it keeps nobody out.
class FolderLock {
 public:
  /// @throws std::runtime_error where another holds it.
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

}  // namespace cca
