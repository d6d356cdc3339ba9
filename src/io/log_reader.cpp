// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/io/log_reader.hpp"

#include <sstream>
#include <stdexcept>

#include "carmen_line.hpp"
#include "carmen_reader.hpp"
#include "gzip_lines.hpp"

namespace cca {
namespace {

constexpr std::size_t kHead = 1 << 16;

bool looksLikeCarmen(const std::string& head) {
  if (head.find('\0') != std::string::npos) return false;
  std::istringstream lines(head);
  for (std::string line; std::getline(lines, line);) {
    if (isCarmenLine(line)) return true;
  }
  return false;
}

}  // namespace

std::unique_ptr<LogReader> openLog(const std::string& path) {
  const std::string head = fileHead(path, kHead);
  if (head.empty()) throw std::runtime_error(path + ": is empty");
  if (looksLikeCarmen(head)) return openCarmenLog(path);
  throw std::runtime_error(path + ": not a log of a known kind (CARMEN .log)");
}

}  // namespace cca
