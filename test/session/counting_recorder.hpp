// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "cca_mrpt/session/mapping_session.hpp"

namespace cca {

/// The numbers of the scans of a map, and how often it began anew.
struct CountingRecorder : MapRecorder {
  std::vector<std::size_t> numbers;
  int restarts = 0;
  void restart() override {
    ++restarts;
    numbers.clear();
  }
  void record(const MappedScan& mapped, const LineMap& /*map*/) override {
    numbers.push_back(mapped.number);
  }
};

}  // namespace cca
