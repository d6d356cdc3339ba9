// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

#include <optional>
#include <vector>

#include "cca_mrpt/io/geo_reference.hpp"
#include "cca_mrpt/sensing/scan.hpp"

namespace cca::python {

namespace nb = nanobind;

/// Takes the ranges out of any one-dimensional array of numbers; one copy, and no other where they
/// are float64 or float32. A masked array's masked beams are NaN: invalid.
/// @throws nb::value_error where they are none.
void readRanges(nb::handle from, std::vector<double>& ranges);

/// A scan from what the Python functions take.
/// @throws nb::value_error naming the argument: angles that are not finite, an increment of 0,
///         what looks like degrees (a first beam beyond two turns, a field of view beyond one) or
///         like millimetres (most returns beyond 200 m).
void readScan(nb::handle ranges, double angle_min, double angle_increment, Scan& scan);

/// Sets where a scan was taken, and how far its beams saw.
/// @throws nb::value_error where the pose is not (x, y, theta), or the range is negative or NaN.
void readPlace(nb::handle pose, double free_range_without_return, Scan& scan);

/// `count` finite numbers of any sequence or array.
/// @param expected  for the message: what the argument holds.
/// @throws nb::value_error naming the argument.
void readNumbers(nb::handle from, const char* argument, const char* expected, int count,
                 double* numbers);

/// Where the map lies on the Earth, from (latitude, longitude, turn), degrees; None: nobody says.
/// @throws nb::value_error naming the range.
std::optional<GeoReference> readOrigin(nb::handle from);

/// A pose from (x, y, theta). @throws nb::value_error naming the argument.
Pose2 readPose(nb::handle from, const char* argument);
/// The same of a place that people tell. @throws nb::value_error where its heading looks like
/// degrees, too.
Pose2 readPoseInRadians(nb::handle from, const char* argument);

}  // namespace cca::python
