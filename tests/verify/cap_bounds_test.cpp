// SPDX-License-Identifier: GPL-3.0-or-later
//
// The bounds on caps against f, its radii of curvature and its maxima at normals drawn from the
// caps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include <tangency/verify/oracles/cap_bounds.hpp>

namespace tangency::verify {
namespace {

using Triple = ascent::Triple<long double>;

// Chosen: above the roundings of lengths up to 30, and of radii of curvature up to 1000.
constexpr double kRounding = 1e-11;

class Sampler {
 public:
  explicit Sampler(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) { return low + (high - low) * unit_(engine_); }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  Triple vector() { return {normal_(engine_), normal_(engine_), normal_(engine_)}; }

  Shape<long double> shape(double aspect) {
    Shape<long double> body;
    for (long double& a : body.semi_axes) a = log_uniform(1, aspect);
    body.axes[0] = ascent::normalised(vector());
    const auto rest = ascent::tangents(body.axes[0], ascent::most_normal_axis(body.axes[0]));
    body.axes[1] = rest[0];
    body.axes[2] = rest[1];
    return body;
  }

  // Overlapping by any depth, or apart.
  Separation<long double> pair(double aspect) {
    return {ascent::scaled<long double>(uniform(0, aspect), ascent::normalised(vector())),
            shape(aspect), shape(aspect)};
  }

  // Within `angle` of n; a third on the rim.
  Triple nearby(const Triple& n, double angle) {
    const auto basis = ascent::tangents(n, ascent::most_normal_axis(n));
    const long double part = uniform(0, 1) < 0.3 ? 0.999999 : std::sqrt(uniform(0, 1));
    const long double turn = uniform(0, 7), tilt = angle * part;
    const long double s = std::cos(turn) * std::tan(tilt), t = std::sin(turn) * std::tan(tilt);
    return ascent::normalised(ascent::combined(n, s, basis[0], t, basis[1]));
  }

 private:
  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> unit_;
  std::normal_distribution<double> normal_;
};

Separation<cap::Interval> in_intervals(const Separation<long double>& pair) {
  const auto interval = [](long double v) { return cap::Interval(static_cast<double>(v)); };
  Separation<cap::Interval> result;
  const auto convert = [&](const Shape<long double>& from, Shape<cap::Interval>& to) {
    std::ranges::transform(from.semi_axes, to.semi_axes.begin(), interval);
    for (std::size_t k = 0; k < 3; ++k) {
      std::ranges::transform(from.axes[k], to.axes[k].begin(), interval);
    }
  };
  convert(pair.a, result.a);
  convert(pair.b, result.b);
  std::ranges::transform(pair.d, result.d.begin(), interval);
  return result;
}

struct Bounds {
  double upper, by_plane, lower, radius;
  bool no_maximum;

  Bounds(const Separation<long double>& pair, const Triple& centre, double angle) {
    const CGAL::Protect_FPU_rounding<true> rounding_up;
    const auto intervals = in_intervals(pair);
    cap::Direction c;
    std::ranges::transform(centre, c.begin(), [](long double v) { return static_cast<double>(v); });
    const cap::Point at(intervals, c);
    upper = cap::upper_bound(at, angle);
    by_plane = cap::upper_bound_by_plane(intervals, at, angle);
    lower = cap::lower_bound(at, angle);
    radius = cap::least_radius(intervals, at, angle);
    no_maximum = cap::holds_no_maximum(intervals, at, angle);
  }
};

TEST(CapBounds, HoldAtEveryNormalOfTheCap) {
  Sampler sample(20261122);
  int bounded_below = 0, curved = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto pair = sample.pair(i % 2 == 0 ? 3 : 10);
    const Triple centre = ascent::normalised(sample.vector());
    const double angle = sample.log_uniform(1e-4, 0.6);
    const Bounds bounds(pair, centre, angle);
    bounded_below += std::isfinite(bounds.lower) ? 1 : 0;
    curved += bounds.radius > 0 ? 1 : 0;
    for (int k = 0; k < 30; ++k) {
      const auto at = ascent::value(pair, sample.nearby(centre, angle));
      ASSERT_LE(at.f, bounds.upper + kRounding) << i;
      ASSERT_LE(at.f, bounds.by_plane + kRounding) << i;
      ASSERT_GE(at.f, bounds.lower - kRounding) << i;
      ASSERT_GE(ascent::principal(at).low - at.f, bounds.radius - kRounding) << i;
    }
  }
  EXPECT_GE(bounded_below, 2000);
  EXPECT_GE(curved, 2000);
}

TEST(CapBounds, NeverDenyAMaximumThatIsInTheCap) {
  Sampler sample(20261123);
  int denied = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto pair = sample.pair(10);
    const auto top = ascent::ascend<long double>(pair, sample.vector(), 1e-15L, 200);
    ASSERT_TRUE(top.stationary);
    const double angle = sample.log_uniform(1e-4, 0.6);
    EXPECT_FALSE(Bounds(pair, sample.nearby(top.at.n, angle), angle).no_maximum) << i;
    denied += Bounds(pair, ascent::normalised(sample.vector()), angle).no_maximum ? 1 : 0;
  }
  EXPECT_GE(denied, 1000);
}

// f and its gradient are met; what is left goes with the square of the angle.
TEST(CapBounds, AreSharpToTheSecondOrder) {
  Sampler sample(20261124);
  for (int i = 0; i < 300; ++i) {
    const auto pair = sample.pair(3);
    const Triple centre = ascent::normalised(sample.vector());
    const auto excess = [&](double angle) {
      const auto at = ascent::value(pair, centre);
      const Bounds bounds(pair, centre, angle);
      const auto linear = static_cast<double>(at.f + at.residual * angle);
      return (bounds.upper - linear) / (angle * angle);
    };
    EXPECT_LT(std::abs(excess(1e-3)), 100) << i;
    EXPECT_LT(std::abs(excess(1e-4)), 100) << i;
  }
}

}  // namespace
}  // namespace tangency::verify
