// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

#include <string>
#include <vector>

#include "cca_mrpt/io/map_products.hpp"

namespace cca::python {

/// What a session has made of its scans, in the session's frame. The summary lacks what
/// filesAndArrays() counts.
struct MappedScans {
  MapProducts products;
  std::vector<bool> is_placed;
  std::string warnings, shortcoming;
};

/// (dict of arrays and numbers, dict of files by name), in the map frame.
nanobind::object filesAndArrays(const MappedScans& result);

}  // namespace cca::python
