// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MultiEchoLaserScan.h>

#include <stdexcept>
#include <string>

#include "cca_mrpt/sensing/scan.hpp"

namespace cca {

/// Of a message that no laser can have meant.
class MalformedScan : public std::runtime_error {
 public:
  /// @param values  of this message, that break it.
  MalformedScan(const std::string& rule, const std::string& values)
      : std::runtime_error(rule + " (" + values + ")"), rule_(rule) {}
  /// The same for each message with this fault.
  const std::string& rule() const { return rule_; }

 private:
  std::string rule_;
};

/// A scan from a message, as REP-117 reads ranges: +inf is no return, -inf (too close) and NaN
/// (error) are invalid, and so is a value below range_min; invalid becomes NaN. A value above
/// range_max is no return: drivers write the end of their scale. (MissingReturns judges those of
/// range_max itself.) Bearings are the message's own, whatever field of view or direction. Beams
/// without return are declared to be free up to range_max.
///
/// MRPT's own bridge is not used: it shifts every ray by one for several common lasers and ignores
/// REP-117.
///
/// @return  T_map_sensor is the identity: a message does not tell it.
/// @throws MalformedScan with rule and values: bearings not finite, no increment between several
///         beams, more than one turn of them, another number or direction of them than lead from
///         angle_min to angle_max, range limits that allow no range, or ranges of which half are
///         beyond 250 m, which are millimetres. A message without beams is a scan without beams.
Scan scanFromMessage(const sensor_msgs::LaserScan& message);

/// The scan of the nearest surface on each beam. A beam without any echo says nothing.
sensor_msgs::LaserScan firstEchoes(const sensor_msgs::MultiEchoLaserScan& message);

/// What a laser tells of itself besides its scan.
struct LaserLimits {
  double range_min = 0.0;       ///< m
  double range_max = 0.0;       ///< m
  double scan_time = 0.0;       ///< s from one scan to the next
  double time_increment = 0.0;  ///< s from one beam to the next; 0: all at once
};

/// The inverse of scanFromMessage() up to the rounding to 32 bits; stamp and frame are the
/// caller's. A finite range beyond the limits stays as it is: the reader's to discard. Invalid
/// ranges leave as NaN.
sensor_msgs::LaserScan scanToMessage(const Scan& scan, const LaserLimits& limits,
                                     const std_msgs::Header& header);

/// When the middle beam was taken. A message is stamped with its first beam; one pose for a whole
/// sweep of a turning laser errs least at its middle.
ros::Time sweepMiddle(const sensor_msgs::LaserScan& message);

/// Fraction of the beams that say something: a return, or that there is none. 0 where no beam
/// returned: so does a laser that is covered or fails.
double seeingFraction(const Scan& scan);

}  // namespace cca
