// SPDX-License-Identifier: BSD-3-Clause
#include "unzipped_file.hpp"

#include <unistd.h>
#include <zlib.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <vector>

namespace cca {
namespace {

constexpr std::size_t kCopiedAtOnce = 1 << 20;  // bytes

/// A path to a file that nobody else opens: it has lost its name at once.
std::string openNameless() {
  std::string name = (std::filesystem::temp_directory_path() / "cca_XXXXXX").string();
  const int file = mkstemp(name.data());
  if (file < 0) throw std::runtime_error("no temporary file can be made like " + name);
  unlink(name.c_str());
  return "/proc/self/fd/" + std::to_string(file);
}

}  // namespace

std::string unzippedFile(const std::string& path) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> zipped(gzopen(path.c_str(), "rb"), gzclose);
  if (!zipped) throw std::runtime_error("cannot be opened");
  if (gzdirect(zipped.get()) == 1) return path;
  const std::string copy_path = openNameless();
  std::ofstream copy(copy_path, std::ios::binary);
  std::vector<char> block(kCopiedAtOnce);
  int got = 0;
  while ((got = gzread(zipped.get(), block.data(), static_cast<unsigned>(block.size()))) > 0) {
    copy.write(block.data(), got);
  }
  copy.close();
  if (!copy) {
    throw std::runtime_error("cannot be unzipped into " +
                             std::filesystem::temp_directory_path().string() +
                             ": is the disk full?");
  }
  int error = Z_OK;
  gzerror(zipped.get(), &error);
  if (got < 0 || error != Z_OK) {
    throw std::runtime_error("the compressed file is damaged, or was broken off");
  }
  return copy_path;
}

}  // namespace cca
