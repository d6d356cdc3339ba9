// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/log_reader.hpp"

#include <stdexcept>

namespace cca {

std::unique_ptr<LogReader> openLog(const std::string& path) {
  throw std::runtime_error(path + ": not a log of a known kind");
}

}  // namespace cca
