// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/sensing/saturation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "sensing/beam.hpp"
#include "sensing/scan_faults.hpp"

namespace cca {
namespace {

constexpr double kAlike = 2e-3;        // of the value: the codes of one SICK lie so far apart
constexpr double kClearlyLess = 0.96;  // of the value: such a reading is from another surface
/// Different readings that stand for no return: two are known of one laser (81.91 and 81.83 m).
/// What is read with noise in five places differs more, even by a laser that tells whole
/// centimetres.
constexpr std::size_t kMostCodes = 2;
constexpr double kSameCode = 1e-5;  // of the value: what a way through floats leaves of it
constexpr std::size_t kPlaces = 4;  // as many as the like corners of a room, seen from its middle
constexpr double kWide = 15.0 * M_PI / 180.0;  // rad, twice what a flat surface can have
constexpr double kChange = 0.05;  // of the median reading, that the robot must have moved
constexpr int kEstablished = 10;  // scores that establish a value
constexpr int kMostScore = 1000;  // that a laser whose scale has changed is believed again

double largestReading(const Scan& scan) {
  double largest = 0.0;
  for (const double range : scan.ranges) {
    if (isReturn(range) && range <= Saturation::kImpossible) largest = std::max(largest, range);
  }
  return largest;
}

/// How many different numbers there are. @param readings  their order is lost.
std::size_t codesAmong(std::vector<double>& readings) {
  std::sort(readings.begin(), readings.end());
  std::size_t codes = 0;
  double code = -1.0;
  for (const double reading : readings) {
    if (reading <= (1.0 + kSameCode) * code) continue;
    code = reading;
    ++codes;
  }
  return codes;
}

/// Beams near the largest reading of a scan.
struct Top {
  std::size_t at = 0;      ///< alike
  std::size_t below = 0;   ///< less than alike, but not clearly
  std::size_t nearer = 0;  ///< clearly less
  std::size_t places = 0;  ///< runs of the first kind that begin beside one of the last
  std::size_t codes = 0;   ///< different readings among the first kind
};

Top topOf(const Scan& scan, double largest) {
  const std::size_t n = scan.size();
  Top top;
  std::vector<double> alike;
  bool was_nearer = seesAllAround(scan) && isReturn(scan.ranges.back()) &&
                    scan.ranges.back() < kClearlyLess * largest;
  for (std::size_t i = 0; i < n; ++i) {
    const double range = scan.ranges[i];
    const bool is_any = isReturn(range) && range <= largest;
    const bool is_nearer = is_any && range < kClearlyLess * largest;
    const bool is_at = is_any && range >= (1.0 - kAlike) * largest;
    top.at += is_at;
    if (is_at) alike.push_back(range);
    top.nearer += is_nearer;
    top.below += is_any && !is_at && !is_nearer;
    top.places += is_at && was_nearer;
    was_nearer = is_nearer;
  }
  top.codes = codesAmong(alike);
  return top;
}

}  // namespace

/// What the scan says for its largest reading as a sign of no return.
int Saturation::scoreOf(const Scan& scan, double largest) {
  const Top top = topOf(scan, largest);
  if (top.places == 0 || top.at <= top.below || top.at > top.nearer) return 0;
  if (top.codes > kMostCodes) return 0;
  const double width = static_cast<double>(top.at) * std::abs(scan.angle_increment);
  if (top.places > kPlaces || width > kWide) return kEstablished;
  if (top.below > 0) return 0;
  const double median = medianReturn(scan);
  if (std::abs(median - last_median_) < kChange * median) return 0;
  last_median_ = median;
  return 1;
}

void Saturation::add(const Scan& scan) {
  const double largest = largestReading(scan);
  if (largest == 0.0) return;
  const int score = scoreOf(scan, largest);
  const bool exceeds = largest > (1.0 + kAlike) * value_;
  if (score_ > 0 && !exceeds && largest >= (1.0 - kAlike) * value_) {
    score_ = std::min(score_ + score, kMostScore);
  } else if (score_ >= kEstablished && !exceeds && score < kEstablished) {
    return;  // a single far beam in a scan without missing returns
  } else if (score_ > 0) {
    score_ = std::max(0, score_ - std::max(score, 1));
  } else if (score > 0) {
    value_ = largest;
    score_ = score;
  }
}

double Saturation::threshold() const {
  return score_ >= kEstablished ? kClearlyLess * value_ : std::numeric_limits<double>::infinity();
}

}  // namespace cca
