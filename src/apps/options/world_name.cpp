// SPDX-License-Identifier: BSD-3-Clause
#include "world_name.hpp"

#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>
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

/// Each after a blank, in order.
std::string namesOfOurs() {
  std::set<std::string> names;
  std::error_code none;
  for (const fs::path& folder : mapFolders()) {
    for (const auto& entry : fs::directory_iterator(folder, none)) {
      const fs::path& file = entry.path();
      // Beside WORLD.yaml may lie what moves in it, WORLD.movers.yaml.
      if (file.extension() == ".yaml" && !file.stem().has_extension())
        names.insert(file.stem().string());
    }
  }
  std::string all;
  for (const std::string& name : names) all += " " + name;
  return all;
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
  throw std::runtime_error(path_or_name + ": is no file, and no world of ours:" + namesOfOurs());
}

}  // namespace cca::apps
