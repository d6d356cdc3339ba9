// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "line_log.hpp"

namespace cca {

/// Bytes of a file that tell its kind: the header of a CSV with four thousand columns.
inline constexpr std::size_t kLogHead = 1 << 16;

/// Opens a log of one of the kinds of this header, by its content.
/// @param head  the first bytes of the file, unzipped.
/// @return  null where it is none of them. @throws std::runtime_error naming file, line and rule.
std::unique_ptr<LogReader> openTextLog(const std::string& path, const std::string& head);

/// The kinds, for messages.
inline constexpr const char* kTextLogKinds =
    "CARMEN .log and .clf, CSV of ranges, CoreSLAM .dat, csm .json";

/// Reads a CARMEN log, plain or gzipped: FLASER and RLASER, or ROBOTLASER1/2 where those are the
/// more frequent (a log may carry the same laser twice). RAWLASER1 where there are none of these:
/// its scans are at the odometry of the ODOM lines about them, interpolated by time. RAWLASER2,
/// which looks back, where there is no RAWLASER1 either: how far apart the two lasers are no line
/// tells, and a map would have each wall twice. Nor does one tell where LASER3, LASER4 and
/// RAWLASER3 to 5 look: these are counted in a warning.
///
/// No return: see Saturation; for ROBOTLASER also 0.999 of the line's own maximum range. Such beams
/// say nothing about free space (glass and black cloth give them too). PARAM lines are not trusted.
/// Logs that GMapping rewrote carry corrected poses in place of the odometry; where ODOM lines lead
/// from scan to scan, the raw odometry is put together again from them.
/// @throws std::runtime_error where the file cannot be read or holds no laser scan.
std::unique_ptr<LogReader> openCarmenLog(const std::string& path);

/// CSV with a row a scan, and a header that names the columns; ',', ';' or tab separates them.
/// Case, quotes, a leading '%' and the prefixes of `rostopic echo -p` (field.header.) do not count.
/// - Ranges [m]: `ranges0`, `ranges1`, ... (also range_0, r0, ranges[0]), and `angle_min` with
///   `angle_increment` or `angle_max` [rad, or with the suffix _deg] as columns, or in lines
///   `# angle_min=-1.57 angle_max=1.57` above the header. Or columns whose names are the angles: in
///   degrees (-90, -89.5, 45_deg) where one is beyond 2 pi or has the suffix, else in radians.
/// - Time: stamp, timestamp or time, in seconds, or as a suffix tells (_ms, _us, _ns); without one,
///   numbers from 1e11 on are milliseconds, from 1e14 microseconds, from 1e17 nanoseconds.
/// - Odometry: x, y, theta, or odom_x, odom_y, odom_theta; corrected poses: pose_x, pose_y,
///   pose_theta [m, rad; theta_deg: degrees; yaw is theta].
/// - range_min, range_max [m], as columns or above the header: shorter ranges are invalid, longer
///   ones no returns. inf is no return; an empty field and nan are invalid.
/// Columns of other names are passed over.
std::unique_ptr<LineFormat> csvOfRanges();
bool looksLikeCsvOfRanges(const std::string& head);

/// The .dat files of CoreSLAM [Steux & El Hamzaoui 2010] (exp1.dat of BreezySLAM): a line a scan of
/// blank-separated numbers. The first is the time [us], the third and fourth are the ticks of the
/// left and right wheel, the last 682 the ranges [mm] of a Hokuyo URG-04LX.
std::unique_ptr<LineFormat> coreSlamLines();
bool looksLikeCoreSlam(const std::string& head);

/// The JSON of the Canonical Scan Matcher [Censi 2008]: an object a line, of nrays, min_theta,
/// max_theta [rad], readings [m], and, where it tells, theta, valid, odometry, estimate, true_pose
/// (m, m, rad) and timestamp (s, us).
std::unique_ptr<LineFormat> csmLines();
bool looksLikeCsm(const std::string& head);

}  // namespace cca
