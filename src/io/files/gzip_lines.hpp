// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <zlib.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cca {

/// The lines of a text file, plain or gzipped (told by content), in constant memory.
class GzipLines {
 public:
  /// @throws std::runtime_error naming the file where it cannot be opened or is no regular file.
  explicit GzipLines(const std::string& path);

  /// The next line without its end; valid until the next call. Nothing at the end of what can be
  /// read. Lines beyond 16 MiB are cut there: no format of ours has such lines.
  std::optional<std::string_view> next();

  /// True where the compressed data broke off or was damaged before its end.
  bool damaged() const { return damaged_; }

  /// How much of the file has been read, in [0, 1].
  double progress() const;

 private:
  bool fill();

  std::unique_ptr<gzFile_s, int (*)(gzFile)> file_;
  double bytes_;
  std::vector<char> block_;
  std::size_t begin_ = 0, end_ = 0;  ///< what of block_ has not been given out
  std::string pieces_;               ///< a line that spans blocks
  bool damaged_ = false;
};

/// The first bytes of a file, unzipped where it is gzipped.
/// @throws std::runtime_error naming the file where it cannot be opened or is no regular file.
std::string fileHead(const std::string& path, std::size_t bytes);

/// Bytes as a gzip file holds them: the same for the same bytes, whenever. (MRPT's
/// compress_gz_data_block() goes through a file of /tmp that is named after the second.)
/// @throws std::runtime_error where memory does not suffice.
std::string gzipped(std::string_view bytes);

/// What gzip's trailer says of the length before compression, modulo 2^32; 0 for no file.
std::uint32_t lengthInGzipTrailer(const std::string& path);

/// Bytes of a file, unzipped where it is gzipped: for people, since a file beyond 4 GiB, or one
/// that was broken off, does not tell.
double unzippedBytes(const std::string& path);

}  // namespace cca
