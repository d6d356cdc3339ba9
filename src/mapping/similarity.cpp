// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/similarity.hpp"

#include <algorithm>

namespace cca {

double Memberships::similarity() const {
  return std::min({orientation, offset, gap, fit, overlap});
}

double AlphaCut::similarity(const Memberships& mu) const {
  Memberships asked = mu;
  if (without(Part::kOrientation)) asked.orientation = 1.0;
  if (without(Part::kOffset)) asked.offset = 1.0;
  if (without(Part::kGap)) asked.gap = 1.0;
  if (without(Part::kFit)) asked.fit = 1.0;
  if (without(Part::kOverlap)) asked.overlap = 1.0;
  return asked.similarity();
}

double fitMembership(const FittedSegment& a, const FittedSegment& b, const FittedSegment& joint,
                     double line_price) {
  if (joint.moments.weight < kFewestPoints) return 0.0;
  double saved = -line_price, residuals = 0.0;
  for (const FittedSegment* part : {&a, &b}) {
    saved += part->is_line ? line_price : part->price;
    residuals += part->is_line ? part->line.residual_sum_sq : 0.0;
  }
  // In variances of a point about the common line: over the noise of each line by itself, a long
  // wall that is met at many angles would seem bent.
  const double growth = std::max(0.0, joint.line.residual_sum_sq - residuals) / joint.variance;
  return saved <= 0.0 ? 0.0 : bell(0.5 * growth, saved);
}

Memberships memberships(const FittedSegment& a, const FittedSegment& b, const FittedSegment& joint,
                        double gap_evidence, double line_price) {
  return {1.0, 1.0, bell(gap_evidence, kGapGate), fitMembership(a, b, joint, line_price), 1.0};
}

}  // namespace cca
