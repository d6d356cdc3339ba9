// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

#include "cca_mrpt/mapping/scan_agreement.hpp"
#include "slam/visit_agreement.hpp"

namespace cca::apps {

/// For people: that scans and map contradict each other. Empty where they agree.
inline std::string contradiction(const ScanAgreement& agreement) {
  if (agreement.overall() >= kPoorAgreement) return "";
  char text[120];
  std::snprintf(
      text, sizeof text,
      "scans contradict the map (%.1f %% of their returns agree with it): poses are wrong",
      100.0 * agreement.overall());
  return text;
}

/// The same of the visits of a place. Empty where they agree.
inline std::string contradiction(const VisitAgreement& visits) {
  if (!visits.isContradiction()) return "";
  char text[140];
  std::snprintf(text, sizeof text,
                "visits of one place contradict one another (%.1f %% of their returns more than "
                "usual): poses are wrong",
                100.0 * visits.excess());
  return text;
}

}  // namespace cca::apps
