// SPDX-License-Identifier: BSD-3-Clause
#include "arguments.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

namespace cca::python {
namespace {

/// The memory of a Python object, for as long as this lives; none where it lends none.
class LentMemory {
 public:
  explicit LentMemory(nb::handle from) {
    lent_ = PyObject_GetBuffer(from.ptr(), &view_, PyBUF_FORMAT | PyBUF_STRIDES) == 0;
    if (!lent_) PyErr_Clear();
  }
  ~LentMemory() {
    if (lent_) PyBuffer_Release(&view_);
  }
  LentMemory(const LentMemory&) = delete;
  LentMemory& operator=(const LentMemory&) = delete;

  bool isRowOf(const char* format) const {
    return lent_ && view_.ndim == 1 && view_.format && std::strcmp(view_.format, format) == 0;
  }
  template <class Number>
  void copyTo(std::vector<double>& numbers) const {
    numbers.resize(static_cast<std::size_t>(view_.shape[0]));
    const char* item = static_cast<const char*>(view_.buf);
    for (double& number : numbers) {
      Number value;
      std::memcpy(&value, item, sizeof value);
      number = static_cast<double>(value);
      item += view_.strides[0];
    }
  }

 private:
  Py_buffer view_;
  bool lent_ = false;
};

[[noreturn]] void refuse(const char* argument, const std::string& reason) {
  throw nb::value_error((std::string(argument) + ": " + reason).c_str());
}

std::string text(nb::handle object) { return nb::str(object).c_str(); }

/// What no sensor measures.
constexpr double kFarthestBearing = 4.0 * M_PI;  // rad
constexpr double kFarthestReturn = 200.0;        // m: few 2-D lasers see half as far

bool mayHaveMask(nb::handle from) { return nb::hasattr(from, "mask"); }

/// An array of float64, NaN where it is masked; whatever is no array of real numbers is refused.
nb::object asNumbers(nb::handle from, const char* argument, const char* expected) {
  const nb::module_ numpy = nb::module_::import_("numpy");
  try {
    const nb::object array = numpy.attr("asarray")(from);
    const std::string kind = nb::str(array.attr("dtype").attr("kind")).c_str();
    if (kind == "f" || kind == "i" || kind == "u") {
      const nb::object numbers = array.attr("astype")(numpy.attr("float64"));
      if (!mayHaveMask(from)) return numbers;
      const nb::object ma = numpy.attr("ma");
      return ma.attr("array")(numbers, nb::arg("mask") = ma.attr("getmask")(from))
          .attr("filled")(std::numeric_limits<double>::quiet_NaN());
    }
    refuse(argument, std::string(expected) + " needed, not dtype " + text(array.attr("dtype")));
  } catch (nb::python_error& error) {
    refuse(argument, std::string(expected) + " needed (" + text(error.value()) + ")");
  }
}

void requireFinite(double value, const char* argument) {
  if (!std::isfinite(value)) refuse(argument, "a finite number is needed");
}

std::string inRadians(double value) {
  const nb::str written = nb::str("{:g} rad").format(value);
  return written.c_str();
}

/// @throws nb::value_error where this is no bearing in radians.
void requireBearing(double angle, const char* argument) {
  if (std::abs(angle) > kFarthestBearing)
    refuse(argument, inRadians(angle) + " is more than two turns; are these degrees?");
}

/// @throws nb::value_error where these are no radians.
void requireRadians(double angle_min, double angle_increment, std::size_t beams) {
  requireBearing(angle_min, "angle_min");
  const double step = std::abs(angle_increment);
  const double field_of_view = step * static_cast<double>(beams > 0 ? beams - 1 : 0);
  // A whole turn may end where it began, or a step further.
  if (field_of_view > 2.0 * M_PI + step * 1.001 || step > 2.0 * M_PI) {
    refuse("angle_increment", inRadians(angle_increment) + " make " + std::to_string(beams) +
                                  " beams cover " + inRadians(field_of_view) +
                                  ", more than a turn; are these degrees?");
  }
}

/// @throws nb::value_error where most returns are farther away than lasers see.
void requireMetres(const std::vector<double>& ranges) {
  std::size_t returns = 0, far = 0;
  double nearest = HUGE_VAL;
  for (const double range : ranges) {
    if (!(range > 0.0 && range < HUGE_VAL)) continue;
    ++returns;
    far += range > kFarthestReturn;
    nearest = std::min(nearest, range);
  }
  if (2 * far <= returns) return;
  const nb::str text = nb::str("{} of {} returns lie beyond {:g} m, the nearest at {:g} m; ")
                           .format(far, returns, kFarthestReturn, nearest);
  refuse("ranges", text.c_str() + std::string("are these millimetres?"));
}

}  // namespace

void readRanges(nb::handle from, std::vector<double>& ranges) {
  if (!mayHaveMask(from)) {
    const LentMemory memory(from);
    if (memory.isRowOf("d")) return memory.copyTo<double>(ranges);
    if (memory.isRowOf("f")) return memory.copyTo<float>(ranges);
  }
  constexpr const char* kExpected = "a one-dimensional array of metres is";
  const nb::object array = asNumbers(from, "ranges", kExpected);
  const LentMemory memory(array);
  if (!memory.isRowOf("d"))
    refuse("ranges", std::string(kExpected) + " needed, not shape " + text(array.attr("shape")));
  memory.copyTo<double>(ranges);
}

void readScan(nb::handle ranges, double angle_min, double angle_increment, Scan& scan) {
  requireFinite(angle_min, "angle_min");
  requireFinite(angle_increment, "angle_increment");
  if (angle_increment == 0.0) refuse("angle_increment", "must not be 0");
  readRanges(ranges, scan.ranges);
  requireRadians(angle_min, angle_increment, scan.ranges.size());
  requireMetres(scan.ranges);
  scan.angle_min = angle_min;
  scan.angle_increment = angle_increment;
}

void readPlace(nb::handle pose, double free_range_without_return, Scan& scan) {
  if (!(free_range_without_return >= 0.0) || !std::isfinite(free_range_without_return))
    refuse("free_range_without_return", "a finite number of metres, 0 at least, is needed");
  scan.free_range_without_return = free_range_without_return;
  scan.T_map_sensor = readPose(pose, "pose");
}

void readNumbers(nb::handle from, const char* argument, const char* expected, int count,
                 double* numbers) {
  const std::string needed = std::string(expected) + " is";
  const nb::object array = asNumbers(from, argument, needed.c_str());
  const LentMemory memory(array);
  std::vector<double> values;
  if (memory.isRowOf("d")) memory.copyTo<double>(values);
  if (values.size() != static_cast<std::size_t>(count))
    refuse(argument, needed + " needed, not shape " + text(array.attr("shape")));
  for (int k = 0; k < count; ++k) {
    requireFinite(values[static_cast<std::size_t>(k)], argument);
    numbers[k] = values[static_cast<std::size_t>(k)];
  }
}

std::optional<GeoReference> readOrigin(nb::handle from) {
  if (from.is_none()) return std::nullopt;
  double n[3];
  readNumbers(from, "origin", "(latitude, longitude, turn) in degrees", 3, n);
  const GeoReference place{n[0], n[1], n[2]};
  if (!place.isOnEarth())
    throw nb::value_error("origin: must be in [-89.9, 89.9], [-180, 180] and [-360, 360] degrees");
  return place;
}

Pose2 readPose(nb::handle from, const char* argument) {
  double numbers[3];
  readNumbers(from, argument, "(x, y, theta)", 3, numbers);
  return {numbers[0], numbers[1], numbers[2]};
}

Pose2 readPoseInRadians(nb::handle from, const char* argument) {
  const Pose2 pose = readPose(from, argument);
  requireBearing(pose.theta, argument);
  return pose;
}

}  // namespace cca::python
