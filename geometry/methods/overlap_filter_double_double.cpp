// SPDX-License-Identifier: MIT
#include <tangency/geometry/methods/overlap_filter_double_double.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <tangency/geometry/exact/double_double.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::methods {
namespace {

using exact::DoubleDouble;
using Vector = std::array<DoubleDouble, 3>;
using Matrix = std::array<Vector, 3>;

constexpr double kDirection = 64 * exact::kDoubleDoubleEpsilon;  // E5 of the derivation
constexpr double kTurned = 64 * exact::kDoubleDoubleEpsilon;     // E6

/// R(q/|q|), each entry within 20 units of kDoubleDoubleEpsilon.
Matrix rotation(const Eigen::Quaterniond& q) {
  const int exponent =
      std::max({exponent_of(q.w()), exponent_of(q.x()), exponent_of(q.y()), exponent_of(q.z())});
  const double w = scaled_by_power(q.w(), -exponent), x = scaled_by_power(q.x(), -exponent);
  const double y = scaled_by_power(q.y(), -exponent), z = scaled_by_power(q.z(), -exponent);
  using exact::two_product;
  const DoubleDouble ww = two_product(w, w), xx = two_product(x, x);
  const DoubleDouble yy = two_product(y, y), zz = two_product(z, z);
  const DoubleDouble wx = two_product(w, x), wy = two_product(w, y), wz = two_product(w, z);
  const DoubleDouble xy = two_product(x, y), yz = two_product(y, z), zx = two_product(z, x);
  const DoubleDouble s = DoubleDouble(1.0) / (ww + xx + (yy + zz)), t = s + s;
  return {{{s * (ww + xx - (yy + zz)), t * (xy - wz), t * (zx + wy)},
           {t * (xy + wz), s * (ww + yy - (xx + zz)), t * (yz - wx)},
           {t * (zx - wy), t * (yz + wx), s * (ww + zz - (xx + yy))}}};
}

struct Side {
  Matrix rotation;
  const Vec3* semi_axes;
  Vector stretched;  ///< diag(a) R' n
  DoubleDouble support;
};

/// R' v
Vector turned_back(const Matrix& r, const Vector& v) {
  Vector result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = r[0][k] * v[0] + r[1][k] * v[1] + r[2][k] * v[2];
  }
  return result;
}

DoubleDouble axis(const Side& s, std::size_t k) { return (*s.semi_axes)[static_cast<int>(k)]; }

Side side(const Ellipsoid& e, const Vector& n) {
  Side s{rotation(e.orientation()), &e.semi_axes(), {}, {}};
  s.stretched = turned_back(s.rotation, n);
  DoubleDouble square;
  for (std::size_t k = 0; k < 3; ++k) {
    s.stretched[k] = axis(s, k) * s.stretched[k];
    square = square + s.stretched[k] * s.stretched[k];
  }
  s.support = sqrt(square);
  return s;
}

/// Support point from the centre.
Vector support_point(const Side& s) {
  Vector body, point;
  for (std::size_t k = 0; k < 3; ++k) body[k] = axis(s, k) * s.stretched[k] / s.support;
  for (std::size_t i = 0; i < 3; ++i) {
    point[i] = s.rotation[i][0] * body[0] + s.rotation[i][1] * body[1] + s.rotation[i][2] * body[2];
  }
  return point;
}

double sum_of_absolutes(const Vector& v) {
  return std::abs(v[0].high) + std::abs(v[1].high) + std::abs(v[2].high);
}

/// Level < 1 proven at p from the centre, each component of p known to within `error`.
bool inside(const Side& s, const Vector& p, double error) {
  const DoubleDouble turned(kTurned * sum_of_absolutes(p) + 2.0 * error);
  const Vector body = turned_back(s.rotation, p);
  DoubleDouble level;
  for (std::size_t k = 0; k < 3; ++k) {
    const DoubleDouble ratio = (abs(body[k]) + turned) / axis(s, k);
    level = level + ratio * ratio;
  }
  return (DoubleDouble(1.0) - level).high > 32 * exact::kDoubleDoubleEpsilon;
}

}  // namespace

Filtered filter_overlap_in_double_double(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                                         const Vec3& d_low, const Vec3& n) noexcept {
  const Vector normal = {n[0], n[1], n[2]};
  const Vector between = {DoubleDouble(d[0], d_low[0]), {d[1], d_low[1]}, {d[2], d_low[2]}};
  const Side sa = side(a, normal), sb = side(b, normal);
  const DoubleDouble along =
      between[0] * normal[0] + between[1] * normal[1] + between[2] * normal[2];
  const DoubleDouble gap = along - sa.support - sb.support;
  const double size = sum_of_absolutes(between) + a.largest_semi_axis() + b.largest_semi_axis();
  if (gap.high > kDirection * n.cwiseAbs().sum() * size) return Filtered::apart;

  // A point of the lens, between the witness points of the normal.
  const Vector from_a = support_point(sa), from_b = support_point(sb);
  Vector point, beyond;
  for (std::size_t i = 0; i < 3; ++i) {
    point[i] = DoubleDouble(0.5) * (from_a[i] + (between[i] - from_b[i]));
    beyond[i] = point[i] - between[i];
  }
  const double error =
      2.0 * exact::kDoubleDoubleEpsilon * (sum_of_absolutes(between) + sum_of_absolutes(point));
  const bool meet = inside(sa, point, 0.0) && inside(sb, beyond, error);
  return meet ? Filtered::interiors_meet : Filtered::unknown;
}

}  // namespace tangency::methods
