// SPDX-License-Identifier: MIT
#include <tangency/geometry/methods/gap_proof.hpp>

#include <algorithm>
#include <cmath>

#include <tangency/geometry/methods/both.hpp>

namespace tangency::methods {
namespace {

constexpr double kThinnest = 0x1p42;  // of a/h: where terms of second order are below 2^-6 u a

struct Sides {
  Both h;          ///< support functions
  BothVec3 point;  ///< support points from the centres
};

Sides sides(const Pair& pair, const Vec3& n) noexcept {
  const BothRotations rotations(pair.a.rotation(), pair.b.rotation());
  const BothVec3 axes = both(pair.a.semi_axes(), pair.b.semi_axes());
  const BothVec3 y = rotations.back(n) * axes;
  const Both h = sqrt(dot(y, y));
  return {h, rotations * (y * (1.0 / h) * axes)};
}

}  // namespace

void prove_gap(const Pair& pair, const Vec3& normal, GapProof& proof) noexcept {
  const double axis_a = pair.a.largest_semi_axis(), axis_b = pair.b.largest_semi_axis();
  const Sides at = sides(pair, normal);
  const Vec3 point_a = at.point.of_a(), point_b = at.point.of_b();
  const Vec3 beyond_a = pair.d - point_a;
  const Vec3 rest = (beyond_a - point_b) + pair.d_low;
  // n.x is h but for the second order of n's rounding, so n.rest has fewer errors than
  // n.d - h_A - h_B.
  const double gap = normal.dot(rest);
  const double axes = axis_a + axis_b, h = at.h[0] + at.h[1];
  const double thin_a = axis_a / at.h[0], thin_b = axis_b / at.h[1];
  const double radii = axis_a * thin_a + axis_b * thin_b;
  // (V) of the derivation.
  const double value_error =
      kUnitRoundoff *
      (6.71 * axes + 5.51 * h + 2.02 * beyond_a.cwiseAbs().maxCoeff() + 9.71 * std::abs(gap));
  proof.gap = gap;
  proof.low = gap - value_error;
  proof.normal = normal;
  proof.arm_a = point_a;
  proof.arm_b = -point_b;
  const double ball = proof.low + pair.least_radius();
  // (R): rounding, of which the radii of curvature amplify that of the normal.
  const double rest_error = kUnitRoundoff * (8.0 * radii + 32.0 * (axes + std::abs(gap)));
  const double reach2 = 1.01 * ((rest - gap * normal).squaredNorm() + rest_error * rest_error);
  // Beyond kThinnest (V) and (R) do not hold: what low is then is not asked for.
  proof.global = ball > 0.0 && std::max(thin_a, thin_b) <= kThinnest;
  // (B): the ball seen from the origin.
  proof.high = proof.global ? gap + (value_error + reach2 / ball) : GapProof::kUnproven;
}

}  // namespace tangency::methods
