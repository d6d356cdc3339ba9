// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "carmen_line.hpp"
#include "io/files/text.hpp"
#include "text_formats.hpp"

namespace cca {
namespace {

bool looksLikeCarmen(std::string_view head) {
  while (!head.empty()) {
    const std::size_t end = std::min(head.find('\n'), head.size());
    if (isCarmenLine(head.substr(0, end))) return true;
    head.remove_prefix(std::min(end + 1, head.size()));
  }
  return false;
}

}  // namespace

std::unique_ptr<LogReader> openTextLog(const std::string& path, const std::string& bytes) {
  const std::string head(withoutMark(bytes));
  if (looksLikeCsm(head)) return openLineLog(path, csmLines());
  if (looksLikeCoreSlam(head)) return openLineLog(path, coreSlamLines());
  // A comment of a CSV looks like one of CARMEN's.
  if (looksLikeCsvOfRanges(head)) return openLineLog(path, csvOfRanges());
  if (looksLikeCarmen(head)) return openCarmenLog(path);
  return nullptr;
}

}  // namespace cca
