// SPDX-License-Identifier: MIT
#include <tangency/geometry/other_gaps.hpp>

#include <cmath>

#include <tangency/geometry/floating_point_environment.hpp>
#include <tangency/geometry/methods/equal_level.hpp>
#include <tangency/geometry/methods/scaled_pair.hpp>

namespace tangency {
namespace {

using exact::DoubleDouble;
using exact::DoubleDoubleVector;
using methods::Direction;
using methods::DoubleDoubleShape;
using methods::EqualLevel;

/// Both bodies in one unit, and what was found between them.
struct Found {
  const DoubleDoubleShape& a;
  const DoubleDoubleShape& b;
  const Direction& d;
  const EqualLevel& at;
};

OtherGap nothing(OtherGapStatus status) {
  return {0.0, Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), status};
}

OtherGap rounded(const DoubleDouble& gap, const DoubleDoubleVector& normal,
                 const DoubleDoubleVector& arm_a, const DoubleDoubleVector& arm_b) {
  return {gap.high, exact::rounded(normal), exact::rounded(arm_a), exact::rounded(arm_b),
          OtherGapStatus::ok};
}

OtherGap between_tangent_planes(const Found& pair) {
  const auto& n = pair.at.normal;
  const DoubleDoubleVector y_a = pair.a.stretched(n), y_b = pair.b.stretched(n);
  const DoubleDouble h_a = exact::length(y_a), h_b = exact::length(y_b), one = 1.0;
  const DoubleDouble along = dot(n, pair.d.vector);
  const DoubleDouble reach = {std::scalbn(along.high, pair.d.exponent),
                              std::scalbn(along.low, pair.d.exponent)};
  return rounded(reach - h_a - h_b, n, pair.a.spread((one / h_a) * y_a),
                 -pair.b.spread((one / h_b) * y_b));
}

OtherGap along_the_normal(const Found& pair) {
  const auto& n = pair.at.normal;
  // At x + t n the level of A is F + 2 |v| t + n'M_A^-1 n t^2, that of B is F - 2 l |v| t + ...: of
  // the two roots of level = 1 the one nearer to 0, so written that nothing cancels.
  const DoubleDouble inside = DoubleDouble(1.0) - pair.at.level;
  bool meets = true;
  const auto root = [&](const DoubleDoubleShape& body, const DoubleDouble& slope) {
    const DoubleDouble discriminant = slope * slope + body.inverse_form(n) * inside;
    if (discriminant.high < 0.0) meets = false;
    return inside / (slope + sqrt(discriminant));
  };
  const DoubleDouble t_a = root(pair.a, pair.at.slope);
  const DoubleDouble t_b = -root(pair.b, pair.at.ratio * pair.at.slope);
  if (!meets) return nothing(OtherGapStatus::not_applicable);
  return rounded(t_b - t_a, n, pair.at.from_a + t_a * n, pair.at.from_b + t_b * n);
}

/// The answer of measure(Found) in the unit of the bodies as given, times 2^exponent.
template <class Measure>
OtherGap solve(const Ellipsoid& a, const Ellipsoid& b, const Direction& d, int exponent,
               const Measure& measure) {
  const DoubleDoubleShape shape_a(a), shape_b(b);
  const auto at = methods::find_equal_level(shape_a, shape_b, d);
  if (!at) return nothing(OtherGapStatus::not_converged);
  OtherGap result = measure(Found{shape_a, shape_b, d, *at});
  const bool finite = std::isfinite(result.gap) && result.normal.allFinite() &&
                      result.arm_a.allFinite() && result.arm_b.allFinite();
  if (!finite) return nothing(OtherGapStatus::not_converged);
  if (exponent != 0) {
    result.gap = std::scalbn(result.gap, exponent);
    for (Vec3* arm : {&result.arm_a, &result.arm_b}) {
      for (double& component : *arm) component = std::scalbn(component, exponent);
    }
  }
  return result;
}

Direction direction(const Vec3& d, const Vec3& d_low) {
  DoubleDoubleVector v;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = {d[static_cast<int>(i)], d_low[static_cast<int>(i)]};
  }
  return methods::direction(v);
}

/// @param separation  null: that of the centres
template <class Measure>
OtherGap answer(const Ellipsoid& a, const Ellipsoid& b, const Vec3* separation,
                const Measure& measure) {
  const Vec3 d = separation != nullptr ? *separation : Vec3(b.centre() - a.centre());
  if (d == Vec3::Zero()) return nothing(OtherGapStatus::not_applicable);
  const Vec3 d_low = separation != nullptr ? Vec3(Vec3::Zero())
                                           : methods::separation_error(a.centre(), b.centre(), d);
  if (methods::moderate(a, b, d)) return solve(a, b, direction(d, d_low), 0, measure);
  const methods::ScaledPair pair =
      separation != nullptr ? methods::scaled_pair(a, b, d) : methods::scaled_pair(a, b);
  // d itself, unless it overflows: in the unit of large bodies a small d would lose digits.
  Direction between = direction(pair.d, pair.d_low);
  if (d.allFinite()) {
    between = direction(d, d_low);
    between.exponent -= pair.exponent;
  }
  return solve(pair.a, pair.b, between, pair.exponent, measure);
}

}  // namespace

OtherGap perram_wertheim_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return in_default_environment([&] { return answer(a, b, nullptr, between_tangent_planes); });
}

OtherGap perram_wertheim_gap(const Ellipsoid& a, const Ellipsoid& b,
                             const Vec3& separation) noexcept {
  return in_default_environment(
      [&] { return answer(a, b, &separation, between_tangent_planes); });
}

OtherGap midpoint_potential_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return in_default_environment([&] { return answer(a, b, nullptr, along_the_normal); });
}

OtherGap midpoint_potential_gap(const Ellipsoid& a, const Ellipsoid& b,
                                const Vec3& separation) noexcept {
  return in_default_environment([&] { return answer(a, b, &separation, along_the_normal); });
}

}  // namespace tangency
