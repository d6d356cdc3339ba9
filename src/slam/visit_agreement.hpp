// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "slam/key_frames.hpp"
#include "slam/surface_matching.hpp"

namespace cca {

/// What the rays of two frames in view of each other say of each other's returns.
struct SeenPair {
  FramePair frames;
  SightCount sights;
};

/// How far the visits of a map agree with one another, measured by what scans of one visit say of
/// each other: people, glass and noise contradict both alike, a wrong loop, or one that was not
/// found, the visits alone. It needs neither lines nor dense scans.
struct VisitAgreement {
  std::vector<SeenPair> pairs;
  SightCount same;   ///< of the pairs of one visit
  SightCount other;  ///< of the pairs of two visits

  /// Share of the returns of other visits that rays contradict, beyond what is usual within a
  /// visit, [0, 1].
  double excess() const;
  /// Whether nothing says that a loop is wrong, or missing.
  bool isGood() const;
  /// Whether the visits contradict one another clearly: poses are wrong.
  bool isContradiction() const;
  /// By how much the map explains the scans: visits that agree speak for it, and a contradiction
  /// outweighs ten returns that agree. A map that lets visits drift apart gains nothing by that.
  double gain() const;
};

/// Asks three frames of the same visit and three of others for each frame, within the common view.
/// Cost: some 50 us a frame.
/// @param do_all  shares the pairs out; the result is the same to the bit.
VisitAgreement agreementOfVisits(const KeyFrames& frames, const DoAll& do_all);

}  // namespace cca
