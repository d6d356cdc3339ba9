// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/late_library.hpp"

#include <dlfcn.h>

#include <stdexcept>
#include <string>

namespace cca {

void* lateFunction(const char* library, const char* function) {
  // Never closed: objects made by it may outlive any scope here.
  void* const handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  void* const found = handle ? dlsym(handle, function) : nullptr;
  if (!found) throw std::runtime_error(std::string(library) + ": cannot be loaded: " + dlerror());
  return found;
}

}  // namespace cca
