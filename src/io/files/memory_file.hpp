// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "cca_mrpt/slam/slam.hpp"

namespace cca {

/// The name of the file in a map's folder.
inline constexpr const char* kMemoryFile = "map.slam";

/// What a drive remembers, and where its frame lies.
struct StoredMemory {
  SlamMemory memory;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< m, map frame; see localOrigin()
};

/// map.slam: the key frames (scans as single-precision ranges, poses, mounting) and the graph that
/// ties them, as CBOR (RFC 8949) in gzip.
std::string packedMemory(const StoredMemory& stored);

/// Reads it from a map's folder, or the file itself.
/// @throws std::runtime_error naming the file and what is wrong with it: none there, damaged, an
///         edge to a frame that is not there, a pose that is not finite.
StoredMemory loadMemory(const std::string& path);

/// What it remembers, in a frame whose origin lies at p_origin (m, map frame).
SlamMemory seenFrom(const Eigen::Vector2d& p_origin, StoredMemory stored);

}  // namespace cca
