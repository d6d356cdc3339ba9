// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "cca_mrpt/localisation/localiser.hpp"
#include "known_map/plan_lines.hpp"

namespace cca::peers {

/// How MRPT's Monte Carlo localisation works.
struct MonteCarloSettings {
  unsigned fewest = 100, most = 5000;  ///< particles; the number between by KLD sampling
  unsigned beams = 30;                 ///< of a scan that are looked at, about
  double hit_sigma = 0.2;              ///< m, of the likelihood field
};

class MonteCarloFilter;

/// What a localisation in lines is compared with: MRPT's CMonteCarloLocalization2D, particles on
/// the likelihood field [Thrun, Burgard & Fox 2005, 6.4] of an occupancy grid of 5 cm in which the
/// plan's lines are drawn. By default with the settings of ROS's amcl; a step for every scan. The
/// same input gives the same poses.
class MonteCarlo : public Localiser {
 public:
  /// @param T_map_start  where the robot is, to half a metre and 15 degrees.
  MonteCarlo(const std::vector<PlanLine>& plan, const Pose2& T_map_start,
             const MonteCarloSettings& settings);
  ~MonteCarlo() override;

  Estimate update(const Measurement& measurement, const AnalysedScan& analysed,
                  const PastScans& past) override;

 private:
  std::unique_ptr<MonteCarloFilter> filter_;
};

}  // namespace cca::peers
