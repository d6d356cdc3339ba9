// SPDX-License-Identifier: BSD-3-Clause
#include "scan_period.hpp"

#include <algorithm>
#include <vector>

namespace cca {
namespace {

constexpr double kScansAllowed = 2.2;  // periods, see longestSilence()

}  // namespace

void ScanPeriod::add(const ros::Time& stamp) {
  const double gap = (stamp - last_).toSec();
  const bool is_first = last_.isZero();
  last_ = stamp;
  if (is_first || gap <= 0.0) return;
  gaps_.push_back(gap);
  if (gaps_.size() > kGaps) gaps_.pop_front();
}

double ScanPeriod::seconds() const {
  if (gaps_.size() < 2) return 0.0;
  std::vector<double> gaps(gaps_.begin(), gaps_.end());
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>((gaps.size() - 1) / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  return std::min(*middle, kLongest);
}

double ScanPeriod::longestSilence(double least) const {
  const double period = seconds();
  return std::max(least, std::min(kScansAllowed * period, period + kBlind));
}

}  // namespace cca
