// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cca {

/// The simulated laser.
struct LaserParameters {
  double range = 8.0;
  double field_of_view_deg = 360.0;
  int beams = 361;
  double range_noise = 0.01;
};

/// See describe(CcaParameters&, ...).
template <class Field>
void describe(LaserParameters& p, Field&& field) {
  field("range", p.range, 0.1, 200.0, "m", "longest range that gives a return");
  field("field_of_view_deg", p.field_of_view_deg, 1.0, 360.0, "deg", "from first to last beam");
  field("beams", p.beams, 1, 100000, "", "number of beams");
  field("range_noise", p.range_noise, 0.0, 10.0, "m", "standard deviation of a range");
}

}  // namespace cca
