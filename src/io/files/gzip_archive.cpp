// SPDX-License-Identifier: BSD-3-Clause
#include "io/files/gzip_archive.hpp"

#include <mrpt/serialization/CArchive.h>

#include <cstdint>
#include <stdexcept>

#include "gzip_lines.hpp"

namespace cca {
namespace {

constexpr int kCompression = 1;  // the fastest: higher levels gain little on ranges

std::runtime_error notWritten(const std::string& path) {
  return std::runtime_error(path + ": cannot be written whole: is the disk full?");
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
  if (lengthInGzipTrailer(file_.temporary()) != length) throw notWritten(path_);
  file_.commit();
}

}  // namespace cca
