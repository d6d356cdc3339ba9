// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/serialization/CSerializable.h>

#include <string>

#include "io/files/atomic_file.hpp"

namespace cca {

/// A file of MRPT's objects, one after the other, compressed by gzip, which appears whole or not at
/// all: rawlogs, maps and scenes are such files.
class GzipArchive {
 public:
  /// @throws std::runtime_error naming the file where it cannot be written.
  explicit GzipArchive(const std::string& path);

  /// Appends an object. @throws std::runtime_error naming the file, e.g. where the disk is full.
  void write(const mrpt::serialization::CSerializable& object);

  /// Gives the file its name; without it, nothing remains.
  /// @throws std::runtime_error naming the file where not all of it has reached the disk.
  void commit();

 private:
  std::string path_;
  AtomicFile file_;
  mrpt::io::CFileGZOutputStream stream_;
};

}  // namespace cca
