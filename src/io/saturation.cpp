// SPDX-License-Identifier: BSD-3-Clause
#include "saturation.hpp"

#include <algorithm>
#include <array>
#include <functional>

namespace cca {
namespace {
constexpr double kTopBand = 0.96, kNextBand = 0.86;
constexpr std::size_t kFewValues = 5;
}  // namespace

double Saturation::lowestKept() const { return kNextBand * largest_; }

void Saturation::add(double range) {
  if (!(range > 0.0 && range <= kImpossible) || range < lowestKept()) return;
  if (range > largest_) {
    largest_ = range;
    for (auto entry = counts_.begin(); entry != counts_.end();) {
      entry = entry->first < lowestKept() ? counts_.erase(entry) : std::next(entry);
    }
  }
  ++counts_[range];
}

double Saturation::threshold() const {
  std::uint64_t top = 0, next = 0;
  std::array<std::uint64_t, kFewValues + 1> most{};  // ascending; the first is room for a candidate
  for (const auto& [range, count] : counts_) {
    if (range < kTopBand * largest_) {
      next += count;
      continue;
    }
    top += count;
    if (count > 1) most.front() = std::max(most.front(), count);
    std::sort(most.begin(), most.end());
    most.front() = 0;
  }
  std::uint64_t in_few_values = 0;
  for (const std::uint64_t count : most) in_few_values += count;
  if (top > next && 2 * in_few_values > top) return kTopBand * largest_;
  return std::numeric_limits<double>::infinity();
}

}  // namespace cca
