// SPDX-License-Identifier: MIT
#include <tangency/geometry/gap/proof.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tangency/geometry/bodies/double_double_body.hpp>
#include <tangency/geometry/gap/error_bounds.hpp>
#include <tangency/geometry/numbers/two_lanes.hpp>

namespace tangency::inline v0::detail {
namespace {

struct Sides {
  TwoLanes h;          ///< support functions
  TwoLanes inverse;    ///< 1 / h
  TwoLanes thin;       ///< a / h, a the largest semi-axis
  TwoLanesVec3 point;  ///< support points from the centres
};

Sides sides(const Pair& pair, const Vec3& n) noexcept {
  const TwoLanesRotations rotations(pair.a.rotation(), pair.b.rotation());
  const TwoLanesVec3 axes = both(pair.a.semi_axes(), pair.b.semi_axes());
  const TwoLanes largest{pair.a.largest_semi_axis(), pair.b.largest_semi_axis()};
  const TwoLanesVec3 y = rotations.back(n) * axes;
  const TwoLanes h = sqrt(dot(y, y));
  const TwoLanes inverse = 1.0 / h;
  return {h, inverse, largest * inverse, rotations * (y * inverse * axes)};
}

// (N): of |step| a/h.
constexpr double kLongestStep = 0x1p-20;
// Of the last step's length times that of the step from the normal that the Hessian is of: the way
// that is left, in rad. Chosen: normals are worth more than the gap alone needs.
constexpr double kClose = 0x1p-36;

/// (V), (R) and (B). Returns r.
[[gnu::always_inline]] inline Vec3 prove_at(const Pair& pair, const Vec3& normal, const Sides& at,
                                            GapProof& proof) noexcept {
  const TwoLanes largest{pair.a.largest_semi_axis(), pair.b.largest_semi_axis()};
  const Vec3 point_a = at.point.of_a(), point_b = at.point.of_b();
  const Vec3 beyond_a = pair.d - point_a;
  const Vec3 rest = (beyond_a - point_b) + pair.d_low;
  // n.x is h but for the second order of n's rounding, so n.rest has fewer errors than
  // n.d - h_A - h_B.
  const double gap = normal.dot(rest);
  const double axes = sum(largest), radii = sum(largest * at.thin);
  const double error = value_error(axes, sum(at.h), beyond_a.cwiseAbs().maxCoeff(), gap, kOfGap);
  proof.gap = gap;
  proof.low = gap - error;
  const double ball = proof.low + pair.least_radius();
  // (R): rounding, of which the radii of curvature amplify that of the normal.
  const Vec3 r = rest - gap * normal;
  const double reach2 = reach_squared(r.squaredNorm(), rest_error(radii, axes, gap));
  // Beyond kThinnestAlongNormal (V) and (R) do not hold: what low is then is not asked for.
  proof.global = ball > 0.0 && std::max(at.thin[0], at.thin[1]) <= kThinnestAlongNormal;
  // (B): the ball seen from the origin.
  proof.high = proof.global ? gap + (error + reach2 / ball) : GapProof::kUnproven;
  return r;
}

}  // namespace

void prove_gap(const Pair& pair, const Vec3& normal, GapProof& proof) noexcept {
  const Sides at = sides(pair, normal);
  prove_at(pair, normal, at, proof);
  proof.normal = normal;
  proof.arm_a = at.point.of_a();
  proof.arm_b = -at.point.of_b();
}

bool prove_gap_and_step(const Pair& pair, const NearlyStationary& near, GapProof& proof) noexcept {
  const Vec3& n = near.normal;
  const Sides at = sides(pair, n);
  const Vec3 r = prove_at(pair, n, at, proof);
  const Vec3 step = near.step(r, n);
  // (N): x(n + step) = (x + M step / h) / sqrt(1 + y), with y h^2 = (2 h x + M step) . step.
  const TwoLanesSymmetric3 shapes(pair.a.shape(), pair.b.shape());
  const TwoLanesVec3 moved = shapes * step * at.inverse;
  const TwoLanes y = (2.0 * dot(at.point, step) + dot(moved, step)) * at.inverse;
  const TwoLanes shorter = 1.0 - y * (0.5 - 0.375 * y);
  const TwoLanesVec3 point = (at.point + moved) * shorter;
  proof.normal = renormalised(n + step);
  proof.arm_a = point.of_a();
  proof.arm_b = -point.of_b();
  const double square = step.squaredNorm(), thin = std::max(at.thin[0], at.thin[1]);
  return near.step.turned * square <= kClose * kClose &&
         square * (thin * thin) <= kLongestStep * kLongestStep;
}

namespace {

using Vector = DoubleDoubleVector;

constexpr double kValueError = 0x1p-92;    // (V2) of the derivation, of the size of the pair
constexpr double kRestError = 0x1p-92;     // (R2), of size and largest radii of curvature
constexpr double kTangentError = 0x1p-49;  // (R2), of the rest
constexpr double kNarrow = 0x1p-40;        // chosen
// Chosen: one or two moves are common, ten where the curvatures differ by 1e8 and more, and a few
// dozen to where a body is seen along its flat face or across its thin edge.
constexpr int kMoves = 60;
constexpr int kHalvings = 8;  // chosen, of one move
// The same where the move still promises more than kWorthMore of the size: from a normal beside a
// face or an edge f climbs all but straight, and Newton's step is millions of times too long.
// Chosen: 2^40 is far beyond those millions, and below u / 32 of the size no double tells what is
// won.
constexpr int kMoreHalvings = 40;
constexpr double kWorthMore = kUnitRoundoff / 32;

/// f to first and second order at a normal.
struct Local {
  Vec3 normal;
  DoubleDouble f;
  Gradient gradient;
  Hessian hessian;
  Vec3 point_a, point_b;
};

Local evaluate(const Pair& pair, const Vec3& normal) {
  const Vector n = {normal[0], normal[1], normal[2]};
  const DoubleDoubleSide a(pair.a, n), b(pair.b, n);
  const Vector point_a = a.support_point(), point_b = b.support_point();
  const DoubleDouble square = dot(n, n);
  const bool nested = pair.sought == Sought::clearance;
  Vector rest;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<int>(i);
    const DoubleDouble beyond_a = DoubleDouble(pair.d[k], pair.d_low[k]) - point_a[i];
    rest[i] = nested ? beyond_a + point_b[i] : beyond_a - point_b[i];
  }
  // n . rest is n.d - h_A -+ h_B.
  const DoubleDouble along = dot(rest, n), part = along / square;
  const DoubleDouble f = along / sqrt(square);
  Vec3 r;
  for (std::size_t i = 0; i < 3; ++i) r[static_cast<int>(i)] = (rest[i] - part * n[i]).high;
  const auto radius = [](const Ellipsoid& body, const DoubleDoubleSide& side) {
    return body.largest_semi_axis() * (body.largest_semi_axis() / side.support.high);
  };
  const SideAt at_a{a, rounded(point_a)}, at_b{b, rounded(point_b)};
  const Hessian hessian =
      nested ? difference_at(at_a, at_b, normal) : hessian_at(at_a, at_b, normal);
  // A support point is never further off than its body is long.
  const double across = std::min(kRestError * (radius(pair.a, a) + radius(pair.b, b)),
                                 2.0 * (pair.a.largest_semi_axis() + pair.b.largest_semi_axis()));
  const double error = kTangentError * r.norm() + kRestError * pair.size + across;
  return {normal,
          f,
          {f.high, {hessian.tangent[0].dot(r), hessian.tangent[1].dot(r)}, error},
          hessian,
          rounded(point_a),
          rounded(point_b)};
}

Cap cap_of(const Pair& pair, const Local& at, double widest) {
  return pair.sought == Sought::clearance ? cap_within(at.hessian, at.gradient, widest)
                                          : cap_around(at.hessian, at.gradient, widest);
}

/// Newton's step towards the maximum; zero where f is not concave. Of a clearance, whose maxima
/// ascents in double find but roughly, by absolute curvatures instead.
Vec3 step(const Local& at, bool anywhere) {
  Vec3 move = Vec3::Zero();
  for (int i = 0; i < 2; ++i) {
    double curvature = at.hessian.curvature[i] + at.gradient.value;
    if (anywhere) curvature = std::max(std::abs(curvature), 8.0 * std::abs(at.gradient.rest[i]));
    if (!(curvature > 0.0)) return Vec3::Zero();
    move += at.gradient.rest[i] / curvature * at.hessian.tangent[i];
  }
  return move;
}

/// Ascent with backtracking from what an ascent in double found, where values below `error` are
/// no gain.
Local ascend(const Pair& pair, const Vec3& normal, double error) {
  Local at = evaluate(pair, normal);
  int halvings = 0;
  for (int move = 0; move < kMoves && halvings <= kMoreHalvings; ++move) {
    Vec3 delta = step(at, pair.sought == Sought::clearance);
    const double slope = std::hypot(at.gradient.rest[0], at.gradient.rest[1]);
    for (halvings = 0; halvings <= kMoreHalvings; ++halvings, delta *= 0.5) {
      const double turn = delta.norm();
      if (!(turn > 0x1p-54)) return at;
      if (halvings > kHalvings && slope * turn <= kWorthMore * pair.size) return at;
      const Local next = evaluate(pair, (at.normal + delta).normalized());
      if (!((next.f - at.f).high > error)) continue;
      at = next;
      break;
    }
  }
  return at;
}

/// The double above (below) a + b.
double sum_up(double a, double b) { return std::nextafter(a + b, GapProof::kUnproven); }
double sum_down(double a, double b) { return std::nextafter(a + b, -GapProof::kUnproven); }

}  // namespace

CapProof prove_gap_in_double_double(const Pair& pair, const Vec3& normal,
                                    double cap_width) noexcept {
  const double error = kValueError * pair.size;
  const Local at = ascend(pair, normal, error);
  const Cap cap = cap_of(pair, at, cap_width);
  CapProof proof;
  proof.cap = cap;
  proof.low = sum_down(at.f.high, at.f.low - error);
  proof.global = sum_down(proof.low, pair.least_radius()) > 0.0;
  // (C): the cap; (B'): the ball of radius rho, which needs no cap.
  double height = cap.proven ? cap.height : GapProof::kUnproven;
  if (proof.global && !cap.proven) {
    height =
        (std::abs(at.gradient.rest[0]) + std::abs(at.gradient.rest[1]) + 2.0 * at.gradient.error) *
        kMore;
  }
  proof.high = sum_up(at.f.high, at.f.low + (error + height * kMore));
  // In the middle of what is proven, unless that is so wide that f(n) is the better answer.
  const bool narrow = height < kNarrow * pair.size;
  proof.gap = narrow ? (at.f + DoubleDouble(0.5 * height)).high : at.f.high;
  proof.normal = at.normal;
  proof.arm_a = at.point_a;
  proof.arm_b = pair.sought == Sought::clearance ? at.point_b : Vec3(-at.point_b);
  return proof;
}

ContactShift bound_shift(const Pair& pair, const Vec3& normal) noexcept {
  const Local at = evaluate(pair, normal);
  const Cap cap = cap_around(at.hessian, at.gradient, 1.0 / 16);
  const double axis_a = pair.a.largest_semi_axis(), axis_b = pair.b.largest_semi_axis();
  if (!cap.proven) return {std::numbers::pi, 2.0 * axis_a, 2.0 * axis_b};
  // (P): a support point moves by A times the change of its unit vector.
  const auto shift = [&](double axis, const SideHessian& side) {
    const double spread = in_inverse_norm(cap, side.curvature[0], side.curvature[1]);
    return std::min(2.0 * axis, 2.5 * axis * cap.eta * std::sqrt(spread / side.h));
  };
  const double turn = 2.0 * cap.eta * std::sqrt(in_inverse_norm(cap, 1.0, 1.0));
  return {kMore * turn, shift(axis_a, at.hessian.a), shift(axis_b, at.hessian.b)};
}

}  // namespace tangency::inline v0::detail
