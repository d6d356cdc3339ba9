// SPDX-License-Identifier: BSD-3-Clause
#include "png_file.hpp"

#include <stdexcept>

#include "cca_mrpt/io/atomic_file.hpp"

namespace cca {
namespace {

bool saved(const mrpt::img::CImage& image, const std::string& path) try {
  return image.saveToFile(path);
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
