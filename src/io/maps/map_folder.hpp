// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "io/files/folder_lock.hpp"

namespace cca {

/// Takes back what says that all is there, before the first of the files is replaced.
void withdrawSummary(const std::string& folder);

/// Moves the map.slam that is there out of the way of another one: to earlier.slam, or
/// earlier-2.slam and so on. @return its path now; empty where there was none.
/// @throws std::runtime_error naming the file and the reason.
std::string keepMemory(const std::string& folder);

/// Makes the folder for a run's files, before the work is done.
/// @param beside  names of files that the run writes there itself.
/// @param inputs  files that the run reads: none is written over.
/// @return  to be kept while the run writes there.
/// @throws std::runtime_error where it cannot be made or written to, where another run is writing
///         to it, and where one of the files is there already and overwriting is not allowed.
[[nodiscard]] FolderLock prepareMapFolder(const std::string& folder, bool overwrite,
                                          const std::vector<const char*>& beside = {},
                                          const std::vector<std::string>& inputs = {});

}  // namespace cca
