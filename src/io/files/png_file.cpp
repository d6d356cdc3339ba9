// SPDX-License-Identifier: BSD-3-Clause
#include "png_file.hpp"

#include <fstream>
#include <stdexcept>
#include <string_view>

#include "io/files/atomic_file.hpp"

namespace cca {
namespace {

/// A full disk cuts a picture off without a word: PNG ends with a chunk of its own.
bool isWhole(const std::string& path) {
  constexpr std::string_view kEnd("IEND\xAE\x42\x60\x82");
  std::ifstream file(path, std::ios::binary);
  std::string tail(kEnd.size(), ' ');
  file.seekg(-static_cast<std::streamoff>(kEnd.size()), std::ios::end);
  file.read(tail.data(), static_cast<std::streamsize>(tail.size()));
  return file && tail == kEnd;
}

bool saved(const mrpt::img::CImage& image, const std::string& path) try {
  return image.saveToFile(path) && isWhole(path);
} catch (const std::exception&) {  // MRPT's own text is a stack of addresses
  return false;
}

}  // namespace

void writePng(const mrpt::img::CImage& image, const std::string& path) {
  AtomicFile file(path);
  if (!saved(image, file.temporary())) {
    throw std::runtime_error(path + ": cannot be written: is it a .png, is the disk full?");
  }
  file.commit();
}

}  // namespace cca
