// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/primitives.hpp>

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace tangency::inline v0::verify {
namespace {

using Vector = Vector120;

constexpr int kSteps = 4000;
const Digits120& tiny() {
  static const Digits120 value = pow(Digits120(10), -110);
  return value;
}

// The columns of R(q/|q|).
std::array<Vector, 3> axes_of(const std::array<double, 4>& orientation) {
  const Digits120 w = orientation[0], x = orientation[1], y = orientation[2], z = orientation[3];
  const Digits120 s = 2 / (w * w + x * x + y * y + z * z);
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
Digits120 multiplier(const Vector& a, const Vector& y) {
  const Digits120 smallest = std::min({a[0], a[1], a[2]});
  const Digits120 floor = -smallest * smallest;
  Digits120 t = floor;
  for (std::size_t i = 0; i < 3; ++i) {
    const Digits120 bound = a[i] * abs(y[i]) - a[i] * a[i];
    if (bound > t) t = bound;
  }
  for (int step = 0; step < kSteps; ++step) {
    Digits120 value = -1, slope = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (y[i] == 0) continue;
      const Digits120 pole = t + a[i] * a[i], term = a[i] * y[i] / pole;
      value += term * term;
      slope += 2 * term * term / pole;
    }
    // Climbs from below; where it no longer does, t is the root to its last digits.
    const Digits120 next = t + value / slope;
    if (value <= tiny() || next <= t) return t;
    t = next;
  }
  throw std::runtime_error("oracle: the closest point was not found");
}

}  // namespace

Digits120 dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Digits120 length(const Vector& v) { return sqrt(dot(v, v)); }
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector exact(const std::array<double, 3>& v) {
  return {Digits120(v[0]), Digits120(v[1]), Digits120(v[2])};
}
Vector from_centre(const RawEllipsoid& body, const std::array<double, 3>& point) {
  return minus(exact(point), exact(body.centre));
}

NearestTruth nearest(const RawEllipsoid& body, const Vector& point) {
  const std::array<Vector, 3> axes = axes_of(body.orientation);
  const Vector a = exact(body.semi_axes);
  const Digits120 size = length(point) + std::max({a[0], a[1], a[2]});
  Vector y = to_body(axes, point);
  for (Digits120& component : y) {
    if (abs(component) < tiny() * size) component = 0;  // the rounding of R
  }
  NearestTruth truth;
  truth.multiplier = multiplier(a, y);
  Vector w{};
  std::size_t least = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const Digits120 pole = truth.multiplier + a[i] * a[i];
    if (y[i] != 0) w[i] = a[i] * y[i] / pole;
    if (least == 3 && a[i] == std::min({a[0], a[1], a[2]})) least = i;
  }
  // Inside the focal curve the smallest axis takes up what is left of |w| = 1.
  if (y[least] == 0 && truth.multiplier == -a[least] * a[least]) {
    const Digits120 rest = 1 - dot(w, w);
    w[least] = rest > 0 ? Digits120(sqrt(rest)) : Digits120(0);
  }
  Vector x, gradient;
  for (std::size_t i = 0; i < 3; ++i) x[i] = a[i] * w[i], gradient[i] = w[i] / a[i];
  const Digits120 scale = length(gradient);
  for (Digits120& component : gradient) component /= scale;
  truth.distance = dot(gradient, minus(y, x));
  truth.point = to_space(axes, x);
  truth.normal = to_space(axes, gradient);
  return truth;
}

LineTruth line(const RawEllipsoid& body, const Vector& origin, const Vector& direction) {
  const std::array<Vector, 3> axes = axes_of(body.orientation);
  Vector z = to_body(axes, origin), v = to_body(axes, direction);
  for (std::size_t i = 0; i < 3; ++i) z[i] /= body.semi_axes[i], v[i] /= body.semi_axes[i];
  const Digits120 square = dot(v, v), middle = -dot(z, v) / square;
  for (std::size_t i = 0; i < 3; ++i) z[i] += middle * v[i];
  LineTruth truth;
  truth.discriminant = 1 - dot(z, z);
  const Digits120 half =
      truth.discriminant > 0 ? Digits120(sqrt(truth.discriminant / square)) : Digits120(0);
  truth.t[0] = middle - half;
  truth.t[1] = middle + half;
  return truth;
}

WallTruth wall(const RawEllipsoid& body, const std::array<double, 3>& normal, double offset) {
  const std::array<Vector, 3> axes = axes_of(body.orientation);
  const Vector n = exact(normal), a = exact(body.semi_axes);
  Vector m = to_body(axes, n);
  for (std::size_t i = 0; i < 3; ++i) m[i] *= a[i];
  const Digits120 support = length(m), scale = length(n);
  WallTruth truth;
  truth.centre_distance = (dot(n, exact(body.centre)) - offset) / scale;
  truth.gap = truth.centre_distance - support / scale;
  for (std::size_t i = 0; i < 3; ++i) m[i] = -m[i] * a[i] / support;
  truth.point = to_space(axes, m);
  return truth;
}

Digits120 plane_distance(const RawEllipse& body, const std::array<double, 2>& point) {
  const Digits120 ux = body.direction[0], uy = body.direction[1], norm = sqrt(ux * ux + uy * uy);
  const Digits120 dx = Digits120(point[0]) - body.centre[0],
                  dy = Digits120(point[1]) - body.centre[1];
  const Digits120 y1 = abs(ux * dx + uy * dy) / norm, y2 = abs(ux * dy - uy * dx) / norm;
  const Digits120 a1 = body.semi_axes[0], a2 = body.semi_axes[1];
  // Half the derivative of the distance's square by the angle, negated: > 0 before the foot.
  const auto ahead = [&](const Digits120& c, const Digits120& s) {
    return (a1 * a1 - a2 * a2) * c * s - a1 * y1 * s + a2 * y2 * c;
  };
  // The angle's tangent is q for q <= 1 and 1 / (2 - q) above: small angles keep their digits.
  const auto point_at = [&](const Digits120& q) {
    const Digits120 other = q <= 1 ? q : Digits120(2 - q), length = sqrt(1 + other * other);
    const Digits120 large = 1 / length, small = other / length;
    return q <= 1 ? std::array<Digits120, 2>{large, small} : std::array<Digits120, 2>{small, large};
  };
  Digits120 low = 0, high = 2;
  constexpr int kHalvings = 380;  // of 398 bits
  for (int i = 0; i < kHalvings; ++i) {
    const Digits120 middle = (low + high) / 2;
    const auto [c, s] = point_at(middle);
    (ahead(c, s) > 0 ? low : high) = middle;
  }
  const auto [c, s] = point_at(low);
  const Digits120 e1 = y1 - a1 * c, e2 = y2 - a2 * s, distance = sqrt(e1 * e1 + e2 * e2);
  const Digits120 w1 = y1 / a1, w2 = y2 / a2;
  return w1 * w1 + w2 * w2 < 1 ? Digits120(-distance) : distance;
}

}  // namespace tangency::inline v0::verify
