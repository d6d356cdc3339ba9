// SPDX-License-Identifier: BSD-3-Clause
#include "session_warnings.hpp"

#include <algorithm>
#include <vector>

#include "contradiction.hpp"
#include "io/files/stray_places.hpp"
#include "io/files/text.hpp"
#include "slam/loop_review.hpp"

namespace cca::apps {
namespace {

/// Scans that were localised by the laser alone, though the wheels are expected to tell.
std::string withoutOdometry(std::size_t unguided, PoseSource pose) {
  if (unguided == 0 || (pose != PoseSource::kSlam && pose != PoseSource::kIcp)) return "";
  return std::to_string(unguided) + " scan(s) without odometry, located by the laser alone";
}

std::string withoutPlace(const std::vector<bool>& known) {
  const auto unknown = std::count(known.begin(), known.end(), false);
  if (unknown == 0) return "";
  const auto first = std::find(known.begin(), known.end(), false) - known.begin();
  return "the place of " + std::to_string(unknown) +
         " scan(s) is not known, and they are in no map; the first is number " +
         std::to_string(first);
}

/// "1 scan(s) far from all others, the first is number 12 at 1e+07, 3.2 m"; empty where there is
/// none.
std::string strayWarning(const std::vector<Pose2>& trajectory, const Eigen::Vector2d& origin) {
  const std::vector<bool> stray = findStrays(trajectory);
  const auto count = std::count(stray.begin(), stray.end(), true);
  if (count == 0) return "";
  const auto first =
      static_cast<std::size_t>(std::find(stray.begin(), stray.end(), true) - stray.begin());
  const Eigen::Vector2d place = origin + trajectory[first].position();
  return formatted("%td scan(s) far from all others, the first is number %zu at %.9g, %.9g m",
                   count, first, place.x(), place.y());
}

}  // namespace

std::string sessionWarnings(const MappingSession& session, const Slam* slam, PoseSource pose,
                            std::size_t unguided, const std::string& resumed,
                            const Eigen::Vector2d& origin) {
  std::string warnings = withoutOdometry(unguided, pose);
  if (slam) {
    if (!slam->isInMemory()) {
      appendWarning("no place of " + resumed + " was found: this is the map of the log alone",
                    warnings);
    }
    appendWarning(withoutPlace(session.isLocalised()), warnings);
  }
  appendWarning(strayWarning(session.trajectory(), origin), warnings);
  return warnings;
}

std::string shortcomingOf(const MappingSession& session, const Slam* slam) {
  if (session.lineMap().lines().empty()) return "no line was found";
  const std::string by_lines = contradiction(session.agreement());
  return by_lines.empty() && slam ? contradiction(slam->review().agreement) : by_lines;
}

}  // namespace cca::apps
