// SPDX-License-Identifier: BSD-3-Clause
#include "cca_mrpt/evidence/analysis_of_variance.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>
#include <boost/math/distributions/fisher_f.hpp>
#include <limits>
#include <stdexcept>

namespace cca::evidence {
namespace {

/// Sum-to-zero coding: column c is 1 at level c, -1 at the last level.
Eigen::MatrixXd codeFactor(const Experiment& experiment, int factor) {
  const int levels = experiment.factors[factor].levels;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(experiment.responses.size(), levels - 1);
  for (Eigen::Index row = 0; row < columns.rows(); ++row) {
    const int level = experiment.settings[row][factor];
    if (level == levels - 1) {
      columns.row(row).setConstant(-1.0);
    } else {
      columns(row, level) = 1.0;
    }
  }
  return columns;
}

/// The products of all columns of the factors.
Eigen::MatrixXd codeEffect(const Experiment& experiment, const std::vector<int>& effect) {
  Eigen::MatrixXd product = Eigen::MatrixXd::Ones(experiment.responses.size(), 1);
  for (const int factor : effect) {
    const Eigen::MatrixXd columns = codeFactor(experiment, factor);
    Eigen::MatrixXd next(product.rows(), product.cols() * columns.cols());
    for (Eigen::Index a = 0; a < product.cols(); ++a) {
      for (Eigen::Index b = 0; b < columns.cols(); ++b) {
        next.col(a * columns.cols() + b) = product.col(a).cwiseProduct(columns.col(b));
      }
    }
    product = next;
  }
  return product;
}

Eigen::MatrixXd joined(const std::vector<Eigen::MatrixXd>& blocks, Eigen::Index rows,
                       std::size_t left_out) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Ones(rows, 1);
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    if (k == left_out) continue;
    const Eigen::Index before = all.cols();
    all.conservativeResize(Eigen::NoChange, before + blocks[k].cols());
    all.rightCols(blocks[k].cols()) = blocks[k];
  }
  return all;
}

double residual(const Eigen::MatrixXd& columns, const Eigen::VectorXd& response) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  if (qr.rank() < columns.cols()) {
    throw std::runtime_error("the observations do not determine all effects: settings are missing");
  }
  return (response - columns * qr.solve(response)).squaredNorm();
}

std::string nameOf(const Experiment& experiment, const std::vector<int>& effect) {
  std::string name;
  for (const int factor : effect) {
    name += (name.empty() ? "" : " x ") + experiment.factors[factor].name;
  }
  return name;
}

}  // namespace

AnalysisOfVariance analyseVariance(const Experiment& experiment,
                                   const std::vector<std::vector<int>>& effects) {
  const Eigen::Map<const Eigen::VectorXd> response(experiment.responses.data(),
                                                   experiment.responses.size());
  std::vector<Eigen::MatrixXd> blocks;
  for (const auto& effect : effects) blocks.push_back(codeEffect(experiment, effect));
  const Eigen::MatrixXd full = joined(blocks, response.size(), blocks.size());
  AnalysisOfVariance result;
  result.residual_degrees = static_cast<int>(full.rows() - full.cols());
  if (result.residual_degrees < 1) {
    throw std::runtime_error("too few observations: none is left to measure the residual by");
  }
  result.residual_sum_of_squares = residual(full, response);
  result.total_sum_of_squares = (response.array() - response.mean()).matrix().squaredNorm();
  const double residual_mean = result.residual_sum_of_squares / result.residual_degrees;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    Effect e;
    e.name = nameOf(experiment, effects[k]);
    e.degrees = static_cast<int>(blocks[k].cols());
    e.sum_of_squares = std::max(0.0, residual(joined(blocks, response.size(), k), response) -
                                         result.residual_sum_of_squares);
    e.mean_square = e.sum_of_squares / e.degrees;
    const double both = e.sum_of_squares + result.residual_sum_of_squares;
    if (both > 0.0) e.partial_eta_sq = e.sum_of_squares / both;
    if (residual_mean > 0.0) {
      e.f = e.mean_square / residual_mean;
      const boost::math::fisher_f distribution(e.degrees, result.residual_degrees);
      e.p_value = boost::math::cdf(boost::math::complement(distribution, e.f));
    } else if (e.sum_of_squares > 0.0) {
      e.f = std::numeric_limits<double>::infinity();
      e.p_value = 0.0;
    }
    result.effects.push_back(e);
  }
  return result;
}

}  // namespace cca::evidence
