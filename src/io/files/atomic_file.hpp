// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace cca {

/// A file that appears whole or not at all: it is written under a temporary name in the same folder
/// and renamed at the end. A file of that name that was there before survives a failed write. Where
/// the path is a link, the file that it leads to is written.
class AtomicFile {
 public:
  /// @throws std::runtime_error where the folder does not exist or cannot be written to, and where
  ///         something that is no regular file has that name.
  explicit AtomicFile(std::string path);
  /// Removes what was not committed.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write to; it has the extension of the file's own name (writers choose by it).
  const std::string& temporary() const { return temporary_; }

  /// Gives the file its name. @throws std::runtime_error naming the file and the reason.
  void commit();

 private:
  std::string path_, target_, temporary_;
};

/// @throws std::runtime_error where something is there already that must not be overwritten, or a
/// folder, which nothing overwrites; into devices and pipes anybody may write.
void requireNew(const std::string& path, bool overwrite);

/// @throws std::runtime_error where a file to be written is one of the others that a command names:
/// it would be lost, and --force does not mean that. Others may be empty; devices hold nothing.
void requireApart(const std::string& path, std::initializer_list<std::string> others);

/// Removes what AtomicFiles have left in a folder whose program was killed.
void removeLeftovers(const std::string& folder);

/// Makes a folder, and those that it lies in; one that is there stays as it is. @throws
/// std::runtime_error naming the folder and the reason.
void makeFolder(const std::string& path);

/// Writes a whole file at once; into devices and pipes (/dev/stdout) directly. @throws
/// std::runtime_error naming the file and the reason.
void writeFile(const std::string& path, std::string_view content);

}  // namespace cca
