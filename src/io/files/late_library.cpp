// SPDX-License-Identifier: BSD-3-Clause
#include "io/files/late_library.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace cca {
namespace {

/// The path of a file that lies beside this library. A bare name would be looked for where the
/// caller of dlopen() looks, and under the sanitizers that is not this library.
std::string besideThisLibrary(const char* file) {
  static const char anchor = 0;
  Dl_info self{};
  if (dladdr(&anchor, &self) == 0 || !self.dli_fname) return file;
  return (std::filesystem::absolute(self.dli_fname).parent_path() / file).string();
}

}  // namespace

void* lateFunction(const char* library, const char* function) {
  // Never closed: objects made by it may outlive any scope here.
  void* handle = dlopen(besideThisLibrary(library).c_str(), RTLD_NOW | RTLD_LOCAL);
  // Linked statically, this is the program, which knows where its libraries lie.
  if (!handle) handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  void* const found = handle ? dlsym(handle, function) : nullptr;
  if (!found) throw std::runtime_error(std::string(library) + ": cannot be loaded: " + dlerror());
  return found;
}

}  // namespace cca
