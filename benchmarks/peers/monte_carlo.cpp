// SPDX-License-Identifier: BSD-3-Clause
#include "peers/monte_carlo.hpp"

#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <algorithm>
#include <cmath>

#include "io/poses/mrpt_steps.hpp"

namespace cca::peers {
namespace {

constexpr float kGridCell = 0.05F, kGridMargin = 1.0F;  // m
constexpr double kToldReach = 0.5, kToldTurn = 0.26;    // m, rad: of the start

mrpt::maps::COccupancyGridMap2D::Ptr gridOf(const std::vector<PlanLine>& plan,
                                            const MonteCarloSettings& settings) {
  Eigen::AlignedBox2d box;
  for (const auto& [from, to] : plan) box.extend(from).extend(to);
  const Eigen::Vector2f low = box.min().cast<float>(), high = box.max().cast<float>();
  auto grid = mrpt::maps::COccupancyGridMap2D::Create();
  grid->setSize(low.x() - kGridMargin, high.x() + kGridMargin, low.y() - kGridMargin,
                high.y() + kGridMargin, kGridCell, 1.0F);
  for (const auto& [from, to] : plan) {
    const int steps = 1 + static_cast<int>(2.0 * (to - from).norm() / kGridCell);
    for (int k = 0; k <= steps; ++k) {
      const Eigen::Vector2d p = from + (to - from) * k / steps;
      grid->setPos(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F);
    }
  }
  auto& field = grid->likelihoodOptions;
  field.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
  field.LF_stdHit = static_cast<float>(settings.hit_sigma);
  field.LF_zHit = 0.95F;
  field.LF_zRandom = 0.05F;
  field.LF_maxCorrsDistance = 2.0F;
  return grid;
}

}  // namespace

class MonteCarloFilter {
 public:
  MonteCarloFilter(const std::vector<PlanLine>& plan, const Pose2& T_map_start,
                   const MonteCarloSettings& settings)
      : settings_(settings), grid_(gridOf(plan, settings)), particles_(settings.most) {
    mrpt::random::getRandomGenerator().randomize(1);
    particles_.options.metricMap = grid_;
    auto& kld = particles_.options.KLD_params;
    kld.KLD_binSize_XY = 0.5;
    kld.KLD_binSize_PHI = 10.0 * M_PI / 180.0;
    kld.KLD_epsilon = 0.05;
    kld.KLD_delta = 0.01;
    kld.KLD_minSampleSize = settings.fewest;
    kld.KLD_maxSampleSize = settings.most;
    const Pose2& at = T_map_start;
    particles_.resetUniform(at.x - kToldReach, at.x + kToldReach, at.y - kToldReach,
                            at.y + kToldReach, at.theta - kToldTurn, at.theta + kToldTurn,
                            static_cast<int>(settings.most));
    filter_.m_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
    // The one that MRPT has for a number of particles that changes.
    filter_.m_options.resamplingMethod = mrpt::bayes::CParticleFilter::prMultinomial;
    filter_.m_options.adaptiveSampleSize = settings.fewest < settings.most;
    filter_.m_options.BETA = 0.5;
  }

  Estimate step(const Scan& scan, const Pose2& T_robot_sensor,
                const std::optional<Pose2>& T_odom_robot) {
    auto [actions, frame] = steps_.next(scan, T_robot_sensor, T_odom_robot);
    const auto beams = static_cast<unsigned>(scan.size());
    grid_->likelihoodOptions.LF_decimation = std::max(1U, beams / settings_.beams);
    filter_.executeOn(particles_, &actions, &frame);
    const auto [covariance, mean] = particles_.getCovarianceAndMean();
    Estimate estimate;
    estimate.T_map_robot = {mean.x(), mean.y(), wrapAngle(mean.phi())};
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        estimate.covariance(row, column) = covariance(row, column);
      }
    }
    return estimate;
  }

 private:
  MonteCarloSettings settings_;
  mrpt::maps::COccupancyGridMap2D::Ptr grid_;
  mrpt::slam::CMonteCarloLocalization2D particles_;
  mrpt::bayes::CParticleFilter filter_;
  MrptSteps steps_;
};

MonteCarlo::MonteCarlo(const std::vector<PlanLine>& plan, const Pose2& T_map_start,
                       const MonteCarloSettings& settings)
    : filter_(std::make_unique<MonteCarloFilter>(plan, T_map_start, settings)) {}

MonteCarlo::~MonteCarlo() = default;

Estimate MonteCarlo::update(const Measurement& measurement, const AnalysedScan& analysed,
                            const PastScans& /*past*/) {
  Estimate estimate =
      filter_->step(analysed.scan, measurement.T_robot_sensor, measurement.T_odom_robot);
  estimate.T_map_sensor = estimate.T_map_robot * measurement.T_robot_sensor;
  return estimate;
}

}  // namespace cca::peers
