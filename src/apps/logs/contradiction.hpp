// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cca_mrpt/mapping/scan_agreement.hpp"
#include "io/files/text.hpp"
#include "slam/visit_agreement.hpp"

namespace cca::apps {

/// For people: that scans and map contradict each other. Empty where they agree.
inline std::string contradiction(const ScanAgreement& agreement) {
  if (agreement.overall() >= kPoorAgreement) return "";
  return formatted(
      "scans contradict the map (%.1f %% of their returns agree with it): poses are wrong",
      100.0 * agreement.overall());
}

/// The same of the visits of a place. Empty where they agree.
inline std::string contradiction(const VisitAgreement& visits) {
  if (!visits.isContradiction()) return "";
  return formatted(
      "visits of one place contradict one another (%.1f %% of their returns more than "
      "usual): poses are wrong",
      100.0 * visits.excess());
}

}  // namespace cca::apps
