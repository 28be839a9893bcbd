// SPDX-License-Identifier: MIT
#include <tangency/geometry/plane/scaled_plane_pair.hpp>

#include <algorithm>
#include <limits>

#include <tangency/geometry/numbers/power_of_two.hpp>

namespace tangency::detail {
namespace {

constexpr double kThinnest = 0x1p-300;  // of a size in [1, 4): what PlanePair asks for

int exponent_of_both(const Vec2& v) { return std::max(exponent_of(v[0]), exponent_of(v[1])); }

Vec2 scaled(const Vec2& v, int exponent) {
  return {scaled_by_power(v[0], -exponent), scaled_by_power(v[1], -exponent)};
}

ScaledPlanePair in_unit(const Ellipse& a, const Ellipse& b, const Vec2& d, const Vec2& d_low,
                        int exponent) {
  const auto body = [&](const Ellipse& e) {
    return Ellipse(Vec2::Zero(), scaled(e.semi_axes(), exponent).cwiseMax(kThinnest),
                   e.direction());
  };
  return {body(a), body(b), d, d_low, exponent};
}

}  // namespace

Vec2 separation_error(const Vec2& centre_a, const Vec2& centre_b, const Vec2& d) noexcept {
  // The error term of Knuth's two-sum of c_B and -c_A.
  const Vec2 part = d - centre_b;
  return (centre_b - (d - part)) - (centre_a + part);
}

ScaledPlanePair scaled_plane_pair(const Ellipse& a, const Ellipse& b, const Vec2& d) noexcept {
  const int exponent = std::max(
      {exponent_of_both(d), exponent_of_both(a.semi_axes()), exponent_of_both(b.semi_axes())});
  return in_unit(a, b, scaled(d, exponent), Vec2::Zero(), exponent);
}

ScaledPlanePair scaled_plane_pair(const Ellipse& a, const Ellipse& b) noexcept {
  const Vec2 d = b.centre() - a.centre();
  if (d.allFinite()) {
    ScaledPlanePair pair = scaled_plane_pair(a, b, d);
    pair.d_low = scaled(separation_error(a.centre(), b.centre(), d), pair.exponent);
    return pair;
  }
  // The difference of the centres overflows: form it in a unit in which it does not.
  constexpr int kLarge = std::numeric_limits<double>::max_exponent;
  const Vec2 ca = scaled(a.centre(), kLarge), cb = scaled(b.centre(), kLarge), between = cb - ca;
  return in_unit(a, b, between, separation_error(ca, cb, between), kLarge);
}

}  // namespace tangency::detail
