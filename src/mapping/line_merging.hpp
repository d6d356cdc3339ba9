// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cca_mrpt/sensing/scan.hpp"
#include "mapping/description_length.hpp"
#include "mapping/similarity.hpp"

namespace cca {

/// One round of SIM, ROC and merging among runs that follow one another.
/// @return     true where something merged.
/// Cost: O(n) memberships, n = runs.
bool mergeConsecutive(const ScanPoints& points, const RunFitter& fitter, const AlphaCut& cut,
                      Runs* runs);

/// SIM and ROC among all lines: joins the pieces of walls that something hides in part.
///
/// @param runs  those that are lines count; the others are clutter that no line explains.
/// @return      groups of indices into runs, each rising; ordered by their first.
/// Cost: O(n^2) fits, n = lines, and the rays between those that fit.
std::vector<std::vector<int>> groupInterrupted(const ScanPoints& points, const RunFitter& fitter,
                                               const AlphaCut& cut, const Runs& runs);

}  // namespace cca
