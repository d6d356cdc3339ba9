// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/time.h>

#include <cstddef>
#include <deque>

namespace cca {

/// From one scan of a laser to the next, as their stamps show it, and what follows from it for who
/// drives by them. Scans that are lost now and then do not count.
class ScanPeriod {
 public:
  /// @param stamp  of each scan that comes, whatever is done with it.
  void add(const ros::Time& stamp);
  /// s, the median of the last gaps, at most kLongest; 0 until three scans have come.
  double seconds() const;

  /// s, how long nothing may be heard of this laser: `least`, or its period and as long again,
  /// since one scan may be lost, and a fifth for stamps that are not even. Beyond a period a robot
  /// drives blind: never for more than kBlind.
  double longestSilence(double least) const;
  /// s, how old a stamp may be that is driven by: it may be that of the first beam, and a sweep
  /// takes a period.
  double oldest(double least) const { return least + seconds(); }

  static constexpr double kLongest = 1.0;  ///< s; no command is reckoned to stand for longer
  static constexpr double kBlind = 0.25;   ///< s

 private:
  static constexpr std::size_t kGaps = 9;
  ros::Time last_;
  std::deque<double> gaps_;  ///< s
};

}  // namespace cca
