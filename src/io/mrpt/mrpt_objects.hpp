// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <string>

namespace cca {

/// The objects of a file of MRPT's, zipped or not, one by one, up to the first that cannot be read.
/// MRPT believes all numbers in a file, and may crash: see readInChild() for files of others.
class MrptObjects {
 public:
  /// @throws std::runtime_error naming the file.
  explicit MrptObjects(const std::string& path);

  /// The next object; null at the end of what can be read.
  mrpt::serialization::CSerializable::Ptr next();

  /// Why reading stopped before the end of the file; empty where it did not.
  const std::string& fault() const { return fault_; }

  /// How much of the file has been read, in [0, 1].
  double progress() const;

 private:
  mrpt::io::CFileGZInputStream file_;
  double bytes_;  ///< of the file, unzipped
  std::string fault_;
  bool ended_ = false;
};

/// The class name at the start of a file of MRPT's objects; empty where there is none.
std::string mrptClassName(const std::string& head);

}  // namespace cca
