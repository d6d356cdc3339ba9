// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cca {

/// A function of one of our own libraries that is loaded when it is first needed.
///
/// MRPT's ICP-SLAM and its windows bring some 150 shared libraries with them. Linked, they cost
/// every command of the program, also those that need neither, more than it takes to map a hundred
/// scans.
///
/// @param library   file name, as "libcca_icp.so"; looked for beside this library, then where the
///                  program finds its own.
/// @param function  its name, of C linkage.
/// @throws std::runtime_error naming the library and the reason.
void* lateFunction(const char* library, const char* function);

}  // namespace cca
