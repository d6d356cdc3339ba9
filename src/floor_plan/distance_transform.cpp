// SPDX-License-Identifier: BSD-3-Clause
#include "floor_plan/distance_transform.hpp"

#include <algorithm>
#include <limits>

namespace cca {
namespace {

constexpr float kFar = 1e12F;  // squared cells; more than any raster holds

/// The lower envelope of the parabolas (x - i)^2 + height[i], at each x.
class LowerEnvelope {
 public:
  explicit LowerEnvelope(std::size_t longest) : apex_(longest), begin_(longest + 1) {}

  void operator()(const std::vector<float>& height, std::size_t n, std::vector<float>& lowest) {
    const auto crossing = [&](std::size_t a, std::size_t b) {
      const double xa = static_cast<double>(a), xb = static_cast<double>(b);
      return (height[b] + xb * xb - height[a] - xa * xa) / (2.0 * (xb - xa));
    };
    std::size_t last = 0;
    apex_[0] = 0;
    begin_[0] = -std::numeric_limits<double>::infinity();
    for (std::size_t x = 1; x < n; ++x) {
      double s = crossing(apex_[last], x);
      while (last > 0 && s <= begin_[last]) s = crossing(apex_[--last], x);
      apex_[++last] = x;
      begin_[last] = s;
    }
    begin_[last + 1] = std::numeric_limits<double>::infinity();
    std::size_t k = 0;
    for (std::size_t x = 0; x < n; ++x) {
      while (begin_[k + 1] < static_cast<double>(x)) ++k;
      const float d = static_cast<float>(x) - static_cast<float>(apex_[k]);
      lowest[x] = d * d + height[apex_[k]];
    }
  }

 private:
  std::vector<std::size_t> apex_;
  std::vector<double> begin_;
};

/// One line of the raster with a set cell at both ends, which stands for what lies beyond.
void transformLine(LowerEnvelope& envelope, std::vector<float>& in, std::vector<float>& out,
                   std::size_t n) {
  in[0] = in[n + 1] = 0.0F;
  envelope(in, n + 2, out);
}

}  // namespace

Raster<float> distanceTransform(const Mask& obstacles) {
  Raster<float> squares = obstacles.alike(0.0F);
  const auto columns = static_cast<std::size_t>(obstacles.columns);
  const auto rows = static_cast<std::size_t>(obstacles.rows);
  const std::size_t longest = std::max(columns, rows) + 2;
  LowerEnvelope envelope(longest);
  std::vector<float> in(longest), out(longest);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t first = row * columns;
    for (std::size_t x = 0; x < columns; ++x) in[x + 1] = obstacles.values[first + x] ? 0.0F : kFar;
    transformLine(envelope, in, out, columns);
    for (std::size_t x = 0; x < columns; ++x) squares.values[first + x] = out[x + 1];
  }
  for (std::size_t x = 0; x < columns; ++x) {
    for (std::size_t row = 0; row < rows; ++row) in[row + 1] = squares.values[row * columns + x];
    transformLine(envelope, in, out, rows);
    for (std::size_t row = 0; row < rows; ++row) {
      squares.values[row * columns + x] =
          static_cast<float>(obstacles.resolution) * std::sqrt(out[row + 1]);
    }
  }
  return squares;
}

}  // namespace cca
