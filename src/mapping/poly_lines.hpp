// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mapping/line_merging.hpp"

namespace cca {

/// The segments of a scan, with shared vertices where neighbouring lines meet.
///
/// A line ends where its outermost beams meet it, so that it covers its own rays and no other.
/// Neighbours whose lines intersect between the last beam of one and the first of the other, or
/// beyond up to five beams that lie on both within the noise, both end at the intersection: a
/// corner.
/// Deviation: projecting the outermost points onto the line lets noise along a grazing wall move
/// its end by several beams.
///
/// @param groups  the runs of each line, as groupInterrupted() gives them.
std::vector<LineSegment> polyLines(const ScanPoints& points, const RunFitter& fitter,
                                   const Runs& runs, const std::vector<std::vector<int>>& groups);

}  // namespace cca
