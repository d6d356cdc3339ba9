// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "io/files/text.hpp"
#include "text_formats.hpp"

namespace cca {
namespace {

using CsmObject = nlohmann::json;

constexpr double kMostCsmRays = 1e6;  // no laser has as many; more would be damage
/// Of the spacing of the rays: theta is written with six digits.
constexpr double kThetaOff = 0.5;
constexpr double kSamePose = 1e-6;  // m, rad: what six digits leave

/// Null and words stand for NaN there.
double numberIn(const CsmObject& value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

double finiteField(const CsmObject& scan, const char* name) {
  const auto found = scan.find(name);
  const double value = found == scan.end() ? NAN : numberIn(*found);
  if (!std::isfinite(value)) throw MalformedLine(std::string(name) + ": a finite number is needed");
  return value;
}

/// Empty where it is missing. @throws MalformedLine where it has another length.
std::vector<double> arrayField(const CsmObject& scan, const char* name, std::size_t size) {
  const auto found = scan.find(name);
  if (found == scan.end() || found->is_null()) return {};
  if (!found->is_array() || found->size() != size) {
    throw MalformedLine(std::string(name) + ": an array of " + std::to_string(size) + " is needed" +
                        (found->is_array() ? ", not of " + std::to_string(found->size()) : ""));
  }
  std::vector<double> values;
  for (const CsmObject& value : *found) values.push_back(numberIn(value));
  return values;
}

std::optional<Pose2> poseField(const CsmObject& scan, const char* name) {
  const std::vector<double> p = arrayField(scan, name, 3);
  if (p.empty() || !std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
    return std::nullopt;
  return Pose2{p[0], p[1], wrapAngle(p[2])};
}

/// @throws MalformedLine where rays are not spaced evenly.
void requireEvenRays(const CsmObject& object, const Scan& scan) {
  const std::vector<double> theta = arrayField(object, "theta", scan.size());
  for (std::size_t k = 0; k < theta.size(); ++k) {
    const double off = std::abs(theta[k] - scan.bearing(k));
    if (off > kThetaOff * std::abs(scan.angle_increment)) {
      throw MalformedLine(
          "theta: the rays must be spaced evenly from min_theta to max_theta; ray " +
          std::to_string(k) + " is not");
    }
  }
}

Scan scanIn(const CsmObject& object) {
  const double rays = finiteField(object, "nrays");
  if (rays < 2.0 || rays > kMostCsmRays || rays != std::floor(rays))
    throw MalformedLine("nrays: a whole number from 2 on is needed");
  Scan scan;
  const auto size = static_cast<std::size_t>(rays);
  scan.angle_min = finiteField(object, "min_theta");
  scan.angle_increment = (finiteField(object, "max_theta") - scan.angle_min) / (rays - 1.0);
  scan.ranges = arrayField(object, "readings", size);
  if (scan.ranges.empty()) throw MalformedLine("readings: are missing");
  requireOneTurn(scan);
  requireEvenRays(object, scan);
  const std::vector<double> valid = arrayField(object, "valid", size);
  for (std::size_t k = 0; k < valid.size(); ++k) {
    if (valid[k] == 0.0) scan.ranges[k] = NAN;
  }
  return scan;
}

class CsmLines : public LineFormat {
 public:
  std::optional<LogRecord> parse(std::string_view line) override {
    if (withoutBlanks(line).empty()) return std::nullopt;
    const CsmObject object = CsmObject::parse(line, nullptr, false);
    if (!object.is_object()) throw MalformedLine("a JSON object is needed, whole on this line");
    LogRecord record;
    record.scan = scanIn(object);
    record.odometry = poseField(object, "odometry");
    record.truth = poseField(object, "true_pose");
    record.corrected = poseField(object, "estimate");
    // Where nobody has corrected anything, they write the odometry again.
    if (record.corrected && record.odometry &&
        areNear(*record.corrected, *record.odometry, kSamePose)) {
      record.corrected.reset();
    }
    record.scan.T_map_sensor =
        record.corrected ? *record.corrected : record.odometry.value_or(Pose2());
    const std::vector<double> stamp = arrayField(object, "timestamp", 2);
    record.has_time = !stamp.empty() && stamp[0] >= 0.0 && stamp[1] >= 0.0;
    if (record.has_time) record.time = stamp[0] + 1e-6 * stamp[1];
    return record;
  }
};

}  // namespace

std::unique_ptr<LineFormat> csmLines() { return std::make_unique<CsmLines>(); }

bool looksLikeCsm(const std::string& head) {
  const std::size_t begin = head.find_first_not_of(" \t\r\n");
  return begin != std::string::npos && head[begin] == '{' &&
         head.find("\"nrays\"") != std::string::npos;
}

}  // namespace cca
