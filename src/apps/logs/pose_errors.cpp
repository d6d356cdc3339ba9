// SPDX-License-Identifier: BSD-3-Clause
#include "pose_errors.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "cca_mrpt/geometry/pose2.hpp"

namespace cca::apps {
namespace {

constexpr double kNinetyNine = 11.345;  // quantile of chi^2 of three

}  // namespace

void PoseErrors::add(const Estimate& estimate, const Pose2& T_map_robot) {
  const Eigen::Vector3d e = difference(estimate.T_map_robot, T_map_robot);
  ++count_;
  square_ += e.head<2>().squaredNorm();
  turn_square_ += e.z() * e.z();
  worst_ = std::max(worst_, e.head<2>().norm());
  const Eigen::LLT<Eigen::Matrix3d> covariance(estimate.covariance);
  if (covariance.info() != Eigen::Success) return;
  const double distance = e.dot(covariance.solve(e));
  ++judged_;
  nees_ += distance;
  within_ += distance < kNinetyNine;
}

double PoseErrors::rms() const { return std::sqrt(square_ / std::max(1, count_)); }
double PoseErrors::rmsTurn() const { return std::sqrt(turn_square_ / std::max(1, count_)); }
double PoseErrors::nees() const { return nees_ / std::max(1, judged_); }
double PoseErrors::within() const { return static_cast<double>(within_) / std::max(1, judged_); }

nlohmann::ordered_json PoseErrors::json() const {
  if (count_ == 0) return nullptr;
  return {{"rms_m", rms()},
          {"max_m", worst_},
          {"rms_deg", rmsTurn() * 180.0 / M_PI},
          {"nees", nees()},
          {"within_99", within()}};
}

}  // namespace cca::apps
