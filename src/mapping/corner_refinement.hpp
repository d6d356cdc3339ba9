// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cca_mrpt/mapping/ablation.hpp"
#include "cca_mrpt/sensing/scan.hpp"
#include "mapping/description_length.hpp"

namespace cca {

/// K-means again, of lines that have been merged, and with another K where that tells the scan more
/// briefly; each step lowers the description length of the scan, so that it ends.
///
/// In turn: kMeans() moves the boundaries; a line falls apart at its best corner; loose points in a
/// row form the lines that hide among them; a run is shared out between its two neighbours.
/// @return  true where a point changed its run.
bool refineCorners(const ScanPoints& points, const RunFitter& fitter, Runs* runs,
                   const Ablation& without = {});

/// Moves each boundary of two neighbouring lines to the best place near by at which they meet.
///
/// Two walls that touch part the points where they intersect, so that a boundary elsewhere has
/// beams of one wall on the line of the other, and both lines turned a little. Where the lines do
/// not meet between the two beams beside their boundary, the cheapest parting with which they do
/// takes its place, if it is dearer by no more than that condition explains. Else something lies
/// between them that no line tells, and all stays. To be called last: it may lengthen the telling.
/// Cost: O(1) for each two neighbours.
void meetAtCorners(const ScanPoints& points, const RunFitter& fitter, Runs* runs);

/// Finds the short edges between two lines that both have taken over, or that hide among the loose
/// points between them.
///
/// An edge that meets its neighbours in the gaps beside it is no free line: they fix where it
/// begins and ends, and it takes the price of one vertex. Two points will do, for the neighbours
/// are the third that could have spoken against it. So the steep edges are found that few beams
/// enter, as any closed outline of many corners has. Cost: O(1) for each two neighbours, most of
/// which are dismissed by a bound.
void tellEdgesBetween(const ScanPoints& points, const RunFitter& fitter, Runs* runs);

}  // namespace cca
