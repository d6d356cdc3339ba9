// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace cca {

/// A file for those that read here and there in it: itself where it is not gzipped, else a copy
/// without a name among the temporary files, which goes when this process ends.
/// @return  a path, of use in this process only.
/// @throws std::runtime_error (without the file's name) where the copy cannot be made, or the
///         compressed data is damaged.
std::string unzippedFile(const std::string& path);

}  // namespace cca
