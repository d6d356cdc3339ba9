// SPDX-License-Identifier: BSD-3-Clause
#include "world_name.hpp"

#include <filesystem>
#include <sstream>
#include <system_error>
#include <vector>

namespace cca::apps {
namespace {

namespace fs = std::filesystem;

/// Beside an installed program (BIN/../share), then where this one was built from and for.
std::vector<fs::path> mapFolders() {
  std::vector<fs::path> folders;
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  if (!unknown) {
    folders.push_back(program.parent_path().parent_path() / "share" / "cca_mrpt" / "maps");
  }
  std::istringstream built_in(CCA_MAPS_FOLDERS);
  for (std::string folder; std::getline(built_in, folder, ':');) folders.emplace_back(folder);
  return folders;
}

}  // namespace

std::string findWorld(const std::string& path_or_name) {
  const fs::path given(path_or_name);
  std::error_code unknown;
  if (fs::exists(given, unknown) || given.has_parent_path() || given.has_extension()) {
    return path_or_name;
  }
  for (const fs::path& folder : mapFolders()) {
    const fs::path file = folder / (path_or_name + ".yaml");
    if (fs::exists(file, unknown)) return file.string();
  }
  return path_or_name;
}

}  // namespace cca::apps
