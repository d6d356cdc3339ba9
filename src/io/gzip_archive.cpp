// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/gzip_archive.hpp"

#include <mrpt/serialization/CArchive.h>

#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace cca {
namespace {

constexpr int kCompression = 1;  // the fastest: higher levels gain little on ranges

std::runtime_error notWritten(const std::string& path) {
  return std::runtime_error(path + ": cannot be written whole: is the disk full?");
}

/// What gzip's trailer says of the length before compression, modulo 2^32; 0 for no file.
std::uint32_t lengthInTrailer(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  file.seekg(-4, std::ios::end);
  unsigned char bytes[4] = {};
  if (!file.read(reinterpret_cast<char*>(bytes), sizeof bytes)) return 0;
  return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
}

}  // namespace

GzipArchive::GzipArchive(const std::string& path) : path_(path), file_(path) {
  if (!stream_.open(file_.temporary(), kCompression)) {
    throw std::runtime_error(path + ": cannot be written");
  }
}

void GzipArchive::write(const mrpt::serialization::CSerializable& object) {
  try {
    auto archive = mrpt::serialization::archiveFrom(stream_);
    archive << object;
  } catch (const std::exception&) {  // MRPT's own text is a stack of addresses
    throw notWritten(path_);
  }
}

void GzipArchive::commit() {
  const auto length = static_cast<std::uint32_t>(stream_.getPosition());
  stream_.close();  // MRPT does not tell whether the rest could be written: the trailer does
  if (lengthInTrailer(file_.temporary()) != length) throw notWritten(path_);
  file_.commit();
}

}  // namespace cca
