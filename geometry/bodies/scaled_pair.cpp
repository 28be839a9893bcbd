// SPDX-License-Identifier: MIT
#include <tangency/geometry/bodies/scaled_pair.hpp>

#include <algorithm>
#include <limits>

#include <tangency/geometry/numbers/power_of_two.hpp>

namespace tangency::detail {
namespace {

constexpr double kThinnest = 0x1p-300;  // of a size in [1, 4): what gap_cap.hpp asks of a Pair

int exponent_of_all(const Vec3& v) {
  return std::max({exponent_of(v[0]), exponent_of(v[1]), exponent_of(v[2])});
}

Vec3 scaled(const Vec3& v, int exponent) {
  return {scaled_by_power(v[0], -exponent), scaled_by_power(v[1], -exponent),
          scaled_by_power(v[2], -exponent)};
}

ScaledPair in_unit(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, const Vec3& d_low,
                   int exponent) {
  const auto body = [&](const Ellipsoid& e) {
    return Ellipsoid(Vec3::Zero(), scaled(e.semi_axes(), exponent).cwiseMax(kThinnest),
                     e.orientation());
  };
  return {body(a), body(b), d, d_low, exponent};
}

}  // namespace

Vec3 separation_error(const Vec3& centre_a, const Vec3& centre_b, const Vec3& d) noexcept {
  // The error term of Knuth's two-sum of c_B and -c_A.
  const Vec3 part = d - centre_b;
  return (centre_b - (d - part)) - (centre_a + part);
}

ScaledPair scaled_pair(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept {
  const int exponent = std::max(
      {exponent_of_all(d), exponent_of_all(a.semi_axes()), exponent_of_all(b.semi_axes())});
  return in_unit(a, b, scaled(d, exponent), Vec3::Zero(), exponent);
}

ScaledPair scaled_pair(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  const Vec3 d = b.centre() - a.centre();
  if (d.allFinite()) {
    ScaledPair pair = scaled_pair(a, b, d);
    pair.d_low = scaled(separation_error(a.centre(), b.centre(), d), pair.exponent);
    return pair;
  }
  // The difference of the centres overflows: form it in a unit in which it does not.
  constexpr int kLarge = std::numeric_limits<double>::max_exponent;
  const Vec3 ca = scaled(a.centre(), kLarge), cb = scaled(b.centre(), kLarge), between = cb - ca;
  return in_unit(a, b, between, separation_error(ca, cb, between), kLarge);
}

}  // namespace tangency::detail
