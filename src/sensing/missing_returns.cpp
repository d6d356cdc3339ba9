// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/missing_returns.hpp"

namespace cca {
namespace {

constexpr double kFar = 0.9;  // of the reach
/// Of the missing returns, how many have to be matched by far ones. In halls much larger than the
/// laser's reach it is some hundredths; real lasers that lose beams on surfaces have none.
constexpr double kLeastShare = 0.01;

}  // namespace

void MissingReturns::judge(Scan& scan) {
  const double reach = scan.free_range_without_return;
  double missing = 0.0, far = 0.0;
  bool sees = false;
  for (const double range : scan.ranges) {
    missing += isNoReturn(range) ? 1.0 : 0.0;
    far += isReturn(range) && range > kFar * reach ? 1.0 : 0.0;
    sees = sees || isReturn(range);
  }
  if (sees) {
    missing_ += missing;
    far_ += far;
  }
  if (!sees || far_ == 0.0 || far_ < kLeastShare * missing_) scan.free_range_without_return = 0.0;
}

}  // namespace cca
