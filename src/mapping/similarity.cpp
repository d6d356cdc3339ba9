// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/mapping/similarity.hpp"

#include <algorithm>

namespace cca {
namespace {

/// m^2, of what is told by lines.
double residuals(const FittedSegment& a, const FittedSegment& b) {
  return (a.is_line ? a.line.residual_sum_sq : 0.0) + (b.is_line ? b.line.residual_sum_sq : 0.0);
}

/// @param growth  of the residuals, in variances of a point about the common line: over the noise
/// of each line by itself, a long wall that is met at many angles would seem bent.
double fitOfGrowth(const FittedSegment& a, const FittedSegment& b, double growth,
                   double line_price) {
  double saved = -line_price;
  for (const FittedSegment* part : {&a, &b}) saved += part->is_line ? line_price : part->price;
  return saved <= 0.0 ? 0.0 : bell(0.5 * std::max(0.0, growth), saved);
}

}  // namespace

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

double mostFitMembership(const FittedSegment& a, const FittedSegment& b, double least_residual,
                         double most_variance, double line_price) {
  return fitOfGrowth(a, b, (least_residual - residuals(a, b)) / most_variance, line_price);
}

double fitMembership(const FittedSegment& a, const FittedSegment& b, const JointFit& joint,
                     double line_price) {
  if (joint.points < kFewestPoints) return 0.0;
  return fitOfGrowth(a, b, (joint.residual_sum_sq - residuals(a, b)) / joint.variance, line_price);
}

Memberships memberships(const FittedSegment& a, const FittedSegment& b, const JointFit& joint,
                        double gap_evidence, double line_price) {
  Memberships mu;
  mu.gap = bell(gap_evidence, kGapGate);
  mu.fit = fitMembership(a, b, joint, line_price);
  mu.orientation = mu.offset = mu.overlap = 1.0;
  return mu;
}

}  // namespace cca
