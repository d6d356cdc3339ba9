// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/missing_returns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sensing/beam.hpp"

namespace cca {
namespace {

constexpr double kInfinity =
    std::numeric_limits<double>::infinity();  // what a beam reads that met nothing
constexpr double kFar = 0.9;                  // of the reach: surfaces do not shun its last tenth
/// Of the missing returns, how many have to be matched by far ones. In halls much larger than the
/// laser's reach it is some hundredths; real lasers that lose beams on surfaces have none.
constexpr double kLeastShare = 0.01;

/// Before anything has been learned: a usual indoor laser loses 3 % of its beams, said with the
/// weight of a scan.
constexpr double kUsualLoss = 0.03, kUsualBeams = 360.0;
constexpr double kMostLoss = 0.5;    // a laser that loses more is no use
constexpr double kFalseRuns = 1e-3;  // a scan: one in two minutes at ten a second
constexpr double kBeamsKept = 1e6;   // that the rate follows a laser that gets dirty

/// Beams without return next to each other; of a full turn they may go on past the last beam.
struct Run {
  std::size_t first, length;
  double nearer;  ///< m, the smaller of its neighbours' ranges; infinite where there is none
};

/// m, the first return from beam `i` on, past invalid beams; infinite where there is none.
double neighbour(const Scan& scan, std::size_t i, bool upwards, bool closed) {
  const std::size_t n = scan.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (!closed && i >= n) return kInfinity;  // below 0, too
    const double range = scan.ranges[i % n];
    if (isReturn(range) || isNoReturn(range)) return range;
    i = upwards ? i + 1 : i + (closed ? n - 1 : std::size_t(-1));
  }
  return kInfinity;
}

/// The runs of missing returns of a scan that has a return.
std::vector<Run> missingRuns(const Scan& scan) {
  const std::size_t n = scan.size();
  const bool closed = seesAllAround(scan);
  const auto isMissing = [&](std::size_t i) { return isNoReturn(scan.ranges[i % n]); };
  std::vector<Run> runs;
  std::size_t begin = 0;
  while (closed && begin < n && isMissing(begin)) ++begin;  // a run over the seam comes last
  for (std::size_t i = begin; i < begin + n && (closed || i < n);) {
    if (!isMissing(i)) {
      ++i;
      continue;
    }
    Run run{i, 0, neighbour(scan, closed ? i + n - 1 : i - 1, false, closed)};
    while (i < begin + n && (closed || i < n) && isMissing(i)) ++i;
    run.length = i - run.first;
    run.nearer = std::min(run.nearer, neighbour(scan, i, true, closed));
    runs.push_back(run);
  }
  return runs;
}

/// Readings from `top` on become no returns.
void cutOff(Scan& scan, double top) {
  for (double& range : scan.ranges) {
    if (isReturn(range) && range >= top) range = kInfinity;
  }
}

}  // namespace

void MissingReturns::judge(Scan& scan) {
  double& reach = scan.free_range_without_return;
  if (reach > 0.0) cutOff(scan, kOfReach * reach);
  saturation_.add(scan);
  cutOff(scan, saturation_.threshold());
  if (!(reach > 0.0)) return;
  reach = std::min(reach, saturation_.threshold());
  if (std::none_of(scan.ranges.begin(), scan.ranges.end(), isReturn)) {
    reach = 0.0;
    return;
  }
  const std::vector<Run> runs = missingRuns(scan);
  for (const Run& run : runs) lost_ += run.length == 1 && std::isfinite(run.nearer);
  beams_ += static_cast<double>(scan.size());
  const std::size_t least = leastBeams(scan.size());
  std::size_t open = 0;
  for (const Run& run : runs) {
    const double angle = static_cast<double>(run.length) * std::abs(scan.angle_increment);
    if (run.length >= least && angle * run.nearer >= kNarrowestOpening) {
      open += run.length;
      continue;
    }
    for (std::size_t k = 0; k < run.length; ++k) {
      scan.ranges[(run.first + k) % scan.size()] = std::numeric_limits<double>::quiet_NaN();
    }
  }
  learnReach(scan, open);
}

/// The shortest run that beams lost at random seldom make up: beams * rate^length < kFalseRuns.
std::size_t MissingReturns::leastBeams(std::size_t beams) const {
  const double rate =
      std::min(kMostLoss, (lost_ + kUsualLoss * kUsualBeams) / (beams_ + kUsualBeams));
  const double runs = kFalseRuns / static_cast<double>(beams);
  return static_cast<std::size_t>(std::ceil(std::log(runs) / std::log(rate)));
}

void MissingReturns::learnReach(Scan& scan, std::size_t open) {
  const double far = kFar * scan.free_range_without_return;
  missing_ += static_cast<double>(open);
  far_ += static_cast<double>(
      std::count_if(scan.ranges.begin(), scan.ranges.end(),
                    [far](double range) { return isReturn(range) && range > far; }));
  if (beams_ > kBeamsKept) {
    beams_ *= 0.5;
    lost_ *= 0.5;
  }
  if (far_ == 0.0 || far_ < kLeastShare * missing_) scan.free_range_without_return = 0.0;
}

}  // namespace cca
