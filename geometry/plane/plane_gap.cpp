// SPDX-License-Identifier: MIT
#include <tangency/geometry/plane/plane_gap.hpp>

#include <algorithm>
#include <cmath>

#include <tangency/geometry/gap/error_bounds.hpp>

namespace tangency::inline v0::detail {
namespace {

constexpr int kMostSteps = 12;        // chosen: ordinary contacts take 2 to 4
constexpr double kLongestStep = 0.5;  // rad; chosen

/// Half of the shape matrix' adjugate times d, and what else the form needs of one body.
struct Weighted {
  Vec2 vector;  ///< J d, J = adj M
  double form;  ///< d' J d
  double determinant;
};

Weighted weighted(const Ellipse& e, const Vec2& d) noexcept {
  const Vec2& a = e.semi_axes();
  const Vec2 y = turned_back(e.axis(), d);
  const Vec2 scaled(a[1] * a[1] * y[0], a[0] * a[0] * y[1]);
  return {turned(e.axis(), scaled), scaled.dot(y), (a[0] * a[1]) * (a[0] * a[1])};
}

/// tr(J_A M_B)
double mixed(const Ellipse& a, const Ellipse& b) noexcept {
  const Vec2 sa = a.semi_axes().cwiseAbs2(), sb = b.semi_axes().cwiseAbs2();
  const Vec2 between = turned_back(a.axis(), b.axis());
  const double c2 = between[0] * between[0], s2 = between[1] * between[1];
  return c2 * (sa[1] * sb[0] + sa[0] * sb[1]) + s2 * (sa[0] * sb[0] + sa[1] * sb[1]);
}

/// One body at a normal.
struct Side {
  double h;       ///< support function
  Vec2 point;     ///< support point from the centre
  double radius;  ///< of curvature there
};

Side side(const Ellipse& e, const Vec2& n) noexcept {
  const Vec2& a = e.semi_axes();
  const Vec2 y = a.cwiseProduct(turned_back(e.axis(), n));
  const double h = std::sqrt(y.squaredNorm()), inverse = 1.0 / h;
  const double ratio = a[0] * a[1] * inverse;
  return {h, turned(e.axis(), (y * inverse).cwiseProduct(a)), ratio * ratio * inverse};
}

}  // namespace

Vec2 perram_wertheim_normal(const PlanePair& pair) noexcept {
  const Weighted a = weighted(pair.a, pair.d), b = weighted(pair.b, pair.d);
  const double x = mixed(pair.a, pair.b);
  double l = std::sqrt((b.form * a.determinant) / (a.form * b.determinant));
  // F = l N / ((1 + l) D), N = a.form + l b.form, D = a.determinant + l x + l^2 b.determinant:
  // Newton's method for d ln F / d ln l = 0, the exponential of the step by its quotient of lines.
  for (int step = 0; step < 3; ++step) {
    const double p = l * b.form / (a.form + l * b.form), s = l / (1.0 + l);
    const double linear = l * x, square = l * l * b.determinant;
    const double d = a.determinant + linear + square, q = (linear + 2.0 * square) / d;
    const double slope = 1.0 + p - s - q;
    const double curvature = p * (1.0 - p) - s * (1.0 - s) - (linear + 4.0 * square) / d + q * q;
    const double change = std::clamp(-slope / std::min(curvature, -0.05), -1.0, 1.0);
    l *= (2.0 + change) / (2.0 - change);
  }
  return (a.vector + l * b.vector).stableNormalized();
}

bool settle_plane_gap(const PlanePair& pair, Vec2& normal, PlaneProof& proof) noexcept {
  const double axis_a = pair.a.largest_semi_axis(), axis_b = pair.b.largest_semi_axis();
  const double axes = axis_a + axis_b, rho = pair.a.least_radius() + pair.b.least_radius();
  const double unit = kUnitRoundoff * pair.size;
  for (int step = 0; step < kMostSteps; ++step) {
    const Vec2 n = normal;
    const Side at_a = side(pair.a, n), at_b = side(pair.b, n);
    const Vec2 beyond_a = pair.d - at_a.point, rest = (beyond_a - at_b.point) + pair.d_low;
    const double gap = n.dot(rest), tangential = n[0] * rest[1] - n[1] * rest[0];
    const double radii = axis_a * (axis_a / at_a.h) + axis_b * (axis_b / at_b.h);
    // (V), (R) and (B): the operations are those of space without the third component.
    const double error =
        value_error(axes, at_a.h + at_b.h, beyond_a.cwiseAbs().maxCoeff(), gap, kOfGapNormalised);
    const double ball = gap - error + rho;
    const double reach2 = reach_squared(tangential * tangential, rest_error(radii, axes, gap));
    const double above = error + reach2 / ball;
    if (ball > 0.0 && above - error <= unit && above <= kOrdinaryError * pair.size) {
      proof = {gap, gap - error, gap + above, true, n, at_a.point, -at_b.point};
      return proof.low > 0.0 || proof.high < 0.0;
    }
    const double curvature = gap + at_a.radius + at_b.radius;
    if (!(curvature > 0.0)) return false;
    const double turn = std::clamp(tangential / curvature, -kLongestStep, kLongestStep);
    normal = Vec2(n[0] - turn * n[1], n[1] + turn * n[0]).normalized();
    if (std::abs(turn) < 4.0 * kUnitRoundoff) return false;
  }
  return false;
}

}  // namespace tangency::inline v0::detail
