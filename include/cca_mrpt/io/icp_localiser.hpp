// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "cca_mrpt/localisation/localiser.hpp"

namespace cca {

/// How scans are matched to the points seen before.
struct IcpParameters {
  double match_distance = 0.5;
  double match_angle_deg = 3.0;
  double smallest_match_distance = 0.05;
  int iterations = 80;
  double insert_distance = 0.5;
  double insert_angle_deg = 20.0;
  double point_spacing = 0.04;
  double least_goodness = 0.4;
};

/// See describe(CcaParameters&, ...).
template <class Field>
void describe(IcpParameters& p, Field&& field) {
  field("match_distance", p.match_distance, 0.01, 10.0, "m", "points are first paired within this");
  field("match_angle_deg", p.match_angle_deg, 0.0, 45.0, "deg",
        "heading error that widens the pairing of far points");
  field("smallest_match_distance", p.smallest_match_distance, 0.001, 10.0, "m",
        "points are last paired within this");
  field("iterations", p.iterations, 1, 10000, "", "at most so many a scan");
  field("insert_distance", p.insert_distance, 0.0, 100.0, "m",
        "a scan is added to the points after this way");
  field("insert_angle_deg", p.insert_angle_deg, 0.0, 360.0, "deg",
        "a scan is added to the points after this turn");
  field("point_spacing", p.point_spacing, 0.0, 10.0, "m", "neighbouring points kept of a scan");
  field("least_goodness", p.least_goodness, 0.0, 1.0, "",
        "share of paired points below which the odometry is believed instead");
}

class IcpMatcher;

/// Where the robot is, by MRPT's ICP-SLAM (CMetricMapBuilderICP): each scan is matched to the
/// points of the earlier ones, starting from the odometry. Where a scan has none, the robot is
/// looked for where it was at the last one. The map begins at startOf() the first measurement.
/// Deterministic. Cost of a scan: linear in the points of the map.
class IcpLocaliser : public Localiser {
 public:
  /// @throws std::runtime_error where the library that holds MRPT's ICP cannot be loaded.
  explicit IcpLocaliser(const IcpParameters& parameters = {});
  ~IcpLocaliser() override;

  Estimate update(const Measurement& measurement, const AnalysedScan& analysed,
                  const PastScans& past) override;

 private:
  std::optional<Pose2> T_map_start_;
  std::unique_ptr<IcpMatcher> matcher_;
};

}  // namespace cca
