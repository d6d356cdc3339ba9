// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "slam/loop_closing.hpp"
#include "slam/visit_agreement.hpp"

namespace cca {

/// The best of the other maps that the loops allow, where it is another one.
struct RunnerUp {
  double excess = 0.0;    ///< VisitAgreement::excess() of it
  double distance = 0.0;  ///< m, from a frame's place in it to that in the map, at most
};

/// What came of reviewLoops().
struct LoopReview {
  VisitAgreement agreement;  ///< of the map that stands
  int hypotheses = 0;        ///< sets of loops that were solved and judged; 0: nothing was in doubt
  bool has_changed = false;  ///< whether another set stands than the one that was believed
  std::vector<LoopVerdict> loops;  ///< that stand
  std::optional<RunnerUp> runner_up;
};

/// Where the visits of the finished map contradict one another, sets of loops are hypotheses:
/// without each cluster of loops that say the same, with each cluster that was refused, and with
/// what is found where the map contradicts itself, looked for near to where it stands. Each is
/// solved and judged by how all visits agree with one another; the best one stands, and is the
/// first of the next round.
///
/// Where places repeat, one loop is as good as another by the rays of its own frames; in the map
/// that it makes, the scans of the whole drive contradict it.
///
/// Nothing changes, and nothing is spent but the judgement, where the visits agree. Else the work
/// is bounded: four rounds of some twenty solutions of the graph, but of one where what is found at
/// once makes them agree.
/// @param believed, verdicts  loops that are in the graph; all that were found.
/// @param remembered          the first frames, of earlier drives: what ties them stays.
LoopReview reviewLoops(KeyFrames& frames, const std::vector<LoopVerdict>& believed,
                       const std::vector<LoopVerdict>& verdicts, int remembered,
                       const DoAll& do_all);

}  // namespace cca
