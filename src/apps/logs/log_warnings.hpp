// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

namespace cca::apps {

/// Tells on the terminal what of a log could not be read, once it has been read.
inline void tellWarnings(const std::string& path, const std::string& warnings) {
  if (warnings.empty()) return;
  std::fprintf(stderr, "cca-mrpt: %s: %s\n", path.c_str(), warnings.c_str());
}

}  // namespace cca::apps
