// SPDX-License-Identifier: BSD-3-Clause
#include "slam/visit_agreement.hpp"

#include <algorithm>
#include <cstddef>

#include "slam/tracking.hpp"

namespace cca {
namespace {

constexpr std::size_t kJudgesOfVisit = 3;  // of a frame, with its own visit and with others
constexpr int kPairsAtOnce = 64;           // shares of the work that keep all cores busy
/// Contradictions of other visits that are usual: so many times those within a visit. Sound maps of
/// real logs come to 1.0 to 1.5 times (intel, fhw, freiburg-079, seattle), wrong ones to 13 and
/// more.
constexpr double kUsualTimes = 3.0;
/// And this share more: what was moved between two visits.
constexpr double kMoved = 0.02, kMovedAtMost = 0.04;
constexpr double kOutweighs = 10.0;  // returns that agree, by one contradiction
/// Returns of other visits that say something, so that they decide.
constexpr double kFewestReturns = 500.0;

}  // namespace

double VisitAgreement::excess() const {
  const double all = other.agree + other.contradict;
  if (all < kFewestReturns) return 0.0;
  const double usual = same.agree + same.contradict > 0.0 ? 1.0 - same.agreement() : 0.0;
  return std::max(0.0, 1.0 - other.agreement() - kUsualTimes * usual);
}

bool VisitAgreement::isGood() const { return excess() <= kMoved; }
bool VisitAgreement::isContradiction() const { return excess() > kMovedAtMost; }

double VisitAgreement::gain() const {
  const double all = other.agree + other.contradict;
  return all * (1.0 - kOutweighs * excess()) - kOutweighs * same.contradict;
}

VisitAgreement agreementOfVisits(const KeyFrames& frames, const DoAll& do_all) {
  VisitAgreement agreement;
  for (const FramePair& pair : pairsInView(frames, kJudgesOfVisit)) {
    agreement.pairs.push_back({pair, {}});
  }
  const int count = static_cast<int>(agreement.pairs.size());
  do_all((count + kPairsAtOnce - 1) / kPairsAtOnce, [&](int part) {
    for (int k = part * kPairsAtOnce; k < std::min(count, (part + 1) * kPairsAtOnce); ++k) {
      SeenPair& seen = agreement.pairs[static_cast<std::size_t>(k)];
      const PlacedSurface a = frames.placed(seen.frames.first);
      const PlacedSurface b = frames.placed(seen.frames.second);
      seen.sights = mutualSights(*a.surface, *b.surface, a.T_map_sensor.inverse() * b.T_map_sensor);
    }
  });
  for (const SeenPair& seen : agreement.pairs) {
    (seen.frames.is_same_visit ? agreement.same : agreement.other) += seen.sights;
  }
  return agreement;
}

}  // namespace cca
