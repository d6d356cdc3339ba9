// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace cca {

/// Two-sided 99.9 % quantile of the normal distribution: a residual beyond so many of its
/// deviations is no noise.
constexpr double kNormalGate = 3.29;

/// 99.9 % quantile of chi-square with one degree of freedom: the same for squares over their
/// variance.
constexpr double kChiSquareGate1 = 10.83;

/// rad; a wall seen at less cannot be told from a step in depth [Borges & Aldon 2004].
constexpr double kGrazing = 4.0 * M_PI / 180.0;

/// Deviation of what lies anywhere within a width, as a share of it: 1 / sqrt(12).
constexpr double kUniformToSigma = 0.28867513459481287;

/// m/s, rad/s; twice what indoor robots do. What is faster has not driven: a pose has leapt.
constexpr double kFastest = 3.0, kFastestTurn = 6.0;

}  // namespace cca
