// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/primitives.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace tangency::verify {
namespace {

using Real = Digits120;
using Vector = Vector120;

constexpr int kSteps = 4000;
const Real& tiny() {
  static const Real value = pow(Real(10), -110);
  return value;
}

// The columns of R(q/|q|).
std::array<Vector, 3> axes_of(const std::array<double, 4>& orientation) {
  const Real w = orientation[0], x = orientation[1], y = orientation[2], z = orientation[3];
  const Real s = 2 / (w * w + x * x + y * y + z * z);
  return {{{1 - s * (y * y + z * z), s * (x * y + w * z), s * (z * x - w * y)},
           {s * (x * y - w * z), 1 - s * (z * z + x * x), s * (y * z + w * x)},
           {s * (z * x + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)}}};
}

Vector to_body(const std::array<Vector, 3>& axes, const Vector& v) {
  return {dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)};
}

Vector to_space(const std::array<Vector, 3>& axes, const Vector& v) {
  Vector result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = axes[0][i] * v[0] + axes[1][i] * v[1] + axes[2][i] * v[2];
  }
  return result;
}

// The greatest t >= -a_min^2 with sum (a y / (t + a^2))^2 = 1, or -a_min^2 where the sum stays
// below 1: Newton's method from the left on a convex decreasing function.
Real multiplier(const Vector& a, const Vector& y) {
  const Real smallest = std::min({a[0], a[1], a[2]});
  const Real floor = -smallest * smallest;
  Real t = floor;
  for (std::size_t i = 0; i < 3; ++i) {
    const Real bound = a[i] * abs(y[i]) - a[i] * a[i];
    if (bound > t) t = bound;
  }
  for (int step = 0; step < kSteps; ++step) {
    Real value = -1, slope = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (y[i] == 0) continue;
      const Real pole = t + a[i] * a[i], term = a[i] * y[i] / pole;
      value += term * term;
      slope += 2 * term * term / pole;
    }
    // Climbs from below; where it no longer does, t is the root to its last digits.
    const Real next = t + value / slope;
    if (value <= tiny() || next <= t) return t;
    t = next;
  }
  throw std::runtime_error("oracle: the closest point was not found");
}

}  // namespace

Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Real length(const Vector& v) { return sqrt(dot(v, v)); }
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector exact(const std::array<double, 3>& v) { return {Real(v[0]), Real(v[1]), Real(v[2])}; }
Vector from_centre(const RawEllipsoid& body, const std::array<double, 3>& point) {
  return minus(exact(point), exact(body.centre));
}

NearestTruth nearest(const RawEllipsoid& body, const Vector& point) {
  const std::array<Vector, 3> axes = axes_of(body.orientation);
  const Vector a = exact(body.semi_axes);
  const Real size = length(point) + std::max({a[0], a[1], a[2]});
  Vector y = to_body(axes, point);
  for (Real& component : y) {
    if (abs(component) < tiny() * size) component = 0;  // the rounding of R
  }
  NearestTruth truth;
  truth.multiplier = multiplier(a, y);
  Vector w{};
  std::size_t least = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const Real pole = truth.multiplier + a[i] * a[i];
    if (y[i] != 0) w[i] = a[i] * y[i] / pole;
    if (least == 3 && a[i] == std::min({a[0], a[1], a[2]})) least = i;
  }
  // Inside the focal curve the smallest axis takes up what is left of |w| = 1.
  if (y[least] == 0 && truth.multiplier == -a[least] * a[least]) {
    const Real rest = 1 - dot(w, w);
    w[least] = rest > 0 ? Real(sqrt(rest)) : Real(0);
  }
  Vector x, gradient;
  for (std::size_t i = 0; i < 3; ++i) x[i] = a[i] * w[i], gradient[i] = w[i] / a[i];
  const Real scale = length(gradient);
  for (Real& component : gradient) component /= scale;
  truth.distance = dot(gradient, minus(y, x));
  truth.point = to_space(axes, x);
  truth.normal = to_space(axes, gradient);
  return truth;
}

LineTruth line(const RawEllipsoid& body, const Vector& origin, const Vector& direction) {
  const std::array<Vector, 3> axes = axes_of(body.orientation);
  Vector z = to_body(axes, origin), v = to_body(axes, direction);
  for (std::size_t i = 0; i < 3; ++i) z[i] /= body.semi_axes[i], v[i] /= body.semi_axes[i];
  const Real square = dot(v, v), middle = -dot(z, v) / square;
  for (std::size_t i = 0; i < 3; ++i) z[i] += middle * v[i];
  LineTruth truth;
  truth.discriminant = 1 - dot(z, z);
  const Real half = truth.discriminant > 0 ? Real(sqrt(truth.discriminant / square)) : Real(0);
  truth.t[0] = middle - half;
  truth.t[1] = middle + half;
  return truth;
}

WallTruth wall(const RawEllipsoid& body, const std::array<double, 3>& normal, double offset) {
  const std::array<Vector, 3> axes = axes_of(body.orientation);
  const Vector n = exact(normal), a = exact(body.semi_axes);
  Vector m = to_body(axes, n);
  for (std::size_t i = 0; i < 3; ++i) m[i] *= a[i];
  const Real support = length(m), scale = length(n);
  WallTruth truth;
  truth.centre_distance = (dot(n, exact(body.centre)) - offset) / scale;
  truth.gap = truth.centre_distance - support / scale;
  for (std::size_t i = 0; i < 3; ++i) m[i] = -m[i] * a[i] / support;
  truth.point = to_space(axes, m);
  return truth;
}

Real plane_distance(const RawEllipse& body, const std::array<double, 2>& point) {
  const Real ux = body.direction[0], uy = body.direction[1], norm = sqrt(ux * ux + uy * uy);
  const Real dx = Real(point[0]) - body.centre[0], dy = Real(point[1]) - body.centre[1];
  const Real y1 = abs(ux * dx + uy * dy) / norm, y2 = abs(ux * dy - uy * dx) / norm;
  const Real a1 = body.semi_axes[0], a2 = body.semi_axes[1];
  // Half the derivative of the distance's square by the angle, negated: > 0 before the foot.
  const auto ahead = [&](const Real& c, const Real& s) {
    return (a1 * a1 - a2 * a2) * c * s - a1 * y1 * s + a2 * y2 * c;
  };
  // The angle's tangent is q for q <= 1 and 1 / (2 - q) above: small angles keep their digits.
  const auto point_at = [&](const Real& q) {
    const Real other = q <= 1 ? q : Real(2 - q), length = sqrt(1 + other * other);
    const Real large = 1 / length, small = other / length;
    return q <= 1 ? std::array<Real, 2>{large, small} : std::array<Real, 2>{small, large};
  };
  Real low = 0, high = 2;
  constexpr int kHalvings = 380;  // of 398 bits
  for (int i = 0; i < kHalvings; ++i) {
    const Real middle = (low + high) / 2;
    const auto [c, s] = point_at(middle);
    (ahead(c, s) > 0 ? low : high) = middle;
  }
  const auto [c, s] = point_at(low);
  const Real e1 = y1 - a1 * c, e2 = y2 - a2 * s, distance = sqrt(e1 * e1 + e2 * e2);
  const Real w1 = y1 / a1, w2 = y2 / a2;
  return w1 * w1 + w2 * w2 < 1 ? Real(-distance) : distance;
}

}  // namespace tangency::verify
