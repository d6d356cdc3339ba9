// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

#include "cca_mrpt/mapping/scan_agreement.hpp"

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

}  // namespace cca::apps
