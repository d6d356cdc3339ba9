// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace cca::apps {

/// A world's file for what a user has named: a path as it is; a bare name ("office") stands for the
/// map of that name among those that come with the program, wherever it is installed.
/// @throws std::runtime_error naming these where a bare name is none of them.
std::string findWorld(const std::string& path_or_name);

}  // namespace cca::apps
