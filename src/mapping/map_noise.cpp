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
constexpr double kFirstOctave = 0.25;     // m, where it begins; few lasers see anything nearer
constexpr double kFewestLines = 20.0;     // for a median of them to be told

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

void MapNoise::Median::learn(double value) {
  samples = std::min(samples + 1.0, kLongestMemory);
  if (variance <= 0.0) variance = value;
  const double step = 4.0 / (20.0 + samples);
  variance *= value > variance ? 1.0 + step : 1.0 / (1.0 + step);
}

std::size_t MapNoise::octaveOf(double distance) {
  return static_cast<std::size_t>(
      std::clamp(std::ilogb(distance / kFirstOctave), 0, static_cast<int>(kOctaves) - 1));
}

void MapNoise::learnRange(double variance, double distance) {
  of_all_.learn(variance);
  of_octave_[octaveOf(distance)].learn(variance);
}

double MapNoise::lateralSigma() const { return std::sqrt(offset_ * offset_ + of_all_.variance); }

double MapNoise::rangeVariance(double distance) const {
  std::size_t octave = octaveOf(distance);
  while (octave > 0 && of_octave_[octave].samples < kFewestLines) --octave;
  return std::max(of_all_.variance, of_octave_[octave].variance);
}

double MapNoise::lateralVariance(double range) const {
  return offset_ * offset_ + rangeVariance(range);
}

}  // namespace cca
