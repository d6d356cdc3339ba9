// SPDX-License-Identifier: BSD-3-Clause
#include "mapping/map_noise.hpp"

#include <algorithm>
#include <cmath>

namespace cca {
namespace {

constexpr double kMedianOfMagnitude = 0.6745;  // of a normal deviate, in its sigmas
constexpr double kFinestOffset = 0.003;        // m; nothing is known better than that
constexpr double kFinestAngle = 0.001;         // rad: the same 3 mm over three metres
constexpr double kLongestMemory = 500.0;  // innovations; a step is then 0.4 %, and may still follow

double stepped(double sigma, double innovation, double own_variance, double samples) {
  const double step = 2.0 / (20.0 + samples);
  const double expected = kMedianOfMagnitude * std::sqrt(sigma * sigma + own_variance);
  return sigma * (std::abs(innovation) > expected ? 1.0 + step : 1.0 / (1.0 + step));
}

}  // namespace

void MapNoise::learnOffset(double offset, double own_variance) {
  offsets_ = std::min(offsets_ + 1.0, kLongestMemory);
  offset_ = std::clamp(stepped(offset_, offset, own_variance, offsets_), kFinestOffset, 0.3);
  own_offset_ = std::clamp(stepped(own_offset_, offset, own_variance, offsets_), 1e-4, 0.3);
}

void MapNoise::learnAngle(double angle, double own_variance) {
  angles_ = std::min(angles_ + 1.0, kLongestMemory);
  angle_ = std::clamp(stepped(angle_, angle, own_variance, angles_), kFinestAngle, 0.1);
  own_angle_ = std::clamp(stepped(own_angle_, angle, own_variance, angles_), 1e-5, 0.1);
}

void MapNoise::learnRange(double variance) {
  ranges_ = std::min(ranges_ + 1.0, kLongestMemory);
  if (range_variance_ <= 0.0) range_variance_ = variance;
  const double step = 4.0 / (20.0 + ranges_);
  range_variance_ *= variance > range_variance_ ? 1.0 + step : 1.0 / (1.0 + step);
}

double MapNoise::lateralSigma() const { return std::sqrt(offset_ * offset_ + range_variance_); }

}  // namespace cca
