// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Random bodies for the tests of the oracles: needles, discs and between, at their aspect ratio.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::verify {

class RawSampler {
 public:
  explicit RawSampler(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) { return low + (high - low) * unit_(engine_); }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  std::array<double, 3> vector() { return {normal_(engine_), normal_(engine_), normal_(engine_)}; }

  // Smallest semi-axis `size`.
  RawEllipsoid body(double size, double aspect) {
    RawEllipsoid e{vector(), {size, size * log_uniform(1, aspect), size * aspect}, {}};
    const double kind = uniform(0, 1);
    if (kind < 0.3) e.semi_axes[1] = e.semi_axes[0];
    if (kind > 0.7) e.semi_axes[1] = e.semi_axes[2];
    std::ranges::shuffle(e.semi_axes, engine_);
    for (double& v : e.orientation) v = normal_(engine_);
    return e;
  }

 private:
  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> unit_;
  std::normal_distribution<double> normal_;
};

}  // namespace tangency::verify
