// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace cca::evidence {

/// Observations of a factorial experiment.
struct Experiment {
  struct Factor {
    std::string name;
    int levels = 0;
  };
  std::vector<Factor> factors;
  std::vector<std::vector<int>> settings;  ///< per observation: the level of each factor
  std::vector<double> responses;           ///< per observation
};

/// One row of the table: a main effect (one factor) or an interaction (several).
struct Effect {
  std::string name;
  int degrees = 0;  ///< of freedom
  double sum_of_squares = 0.0;
  double mean_square = 0.0;
  double f = 0.0;
  double p_value = 1.0;         ///< of an F at least as large where the effect is nil
  double partial_eta_sq = 0.0;  ///< SS / (SS + SS of the residual)
};

struct AnalysisOfVariance {
  std::vector<Effect> effects;
  int residual_degrees = 0;
  double residual_sum_of_squares = 0.0;
  double total_sum_of_squares = 0.0;  ///< about the mean
};

/// Fixed-effects analysis of variance with sums of squares of type III: by how much the residual
/// of the least-squares fit grows when the effect's columns (sum-to-zero coding) are left out. For
/// a complete, balanced design these are the classical sums [Montgomery 2012, ch. 5].
///
/// @param effects  each a list of factors (by index): {0} a main effect, {0, 1} an interaction.
/// @throws std::runtime_error where the observations do not determine the effects, or leave no
///         degree of freedom to the residual.
/// Cost: O(effects x observations x columns^2).
AnalysisOfVariance analyseVariance(const Experiment& experiment,
                                   const std::vector<std::vector<int>>& effects);

}  // namespace cca::evidence
