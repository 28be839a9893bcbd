// SPDX-License-Identifier: MIT
#include <tangency/geometry/gap/inner_ellipsoid.hpp>

#include <algorithm>
#include <cmath>

#include <tangency/geometry/floating_point.hpp>

namespace tangency::inline v0::detail {
namespace {

constexpr double kOrthogonal = 16 * kUnitRoundoff;  // (O) of docs/derivations/bounded-gap.md
constexpr double kShape = 32 * kUnitRoundoff;       // (I), of (a_A + a_B)^2
constexpr double kValue = 32 * kUnitRoundoff;       // (T), of the size of the pair
constexpr double kRest = 16 * kUnitRoundoff;        // (K), and the next two
constexpr double kMinor = 8 * kUnitRoundoff;
constexpr double kDeterminant = 32 * kUnitRoundoff;
constexpr int kRootSteps = 4;             // chosen: Laguerre's method is cubic
constexpr int kSteps = 5;                 // chosen: the depth is flat at its greatest
constexpr double kCloseEnough = 0x1p-12;  // of the root of the level; chosen

Mat3 factor(const Ellipsoid& body) { return body.rotation() * body.semi_axes().asDiagonal(); }

/// Two unit vectors across a unit one and each other.
struct Across {
  Vec3 first, second;
  explicit Across(const Vec3& n) : first(n.unitOrthogonal()), second(n.cross(first)) {}
};

/// The orthogonal O with O to_b = to_a and the greatest sum of O_ij G_ij.
Mat3 aligned(const Mat3& g, const Vec3& to_a, const Vec3& to_b) {
  const Across a(to_a), b(to_b);
  const Vec3 gf = g * b.first, gs = g * b.second;
  const double h11 = a.first.dot(gf), h12 = a.first.dot(gs);
  const double h21 = a.second.dot(gf), h22 = a.second.dot(gs);
  // In the planes across: a turn by (c, s), or that and a reflection.
  const double turn_c = h11 + h22, turn_s = h21 - h12;
  const double other_c = h11 - h22, other_s = h21 + h12;
  const double turn2 = turn_c * turn_c + turn_s * turn_s;
  const double other2 = other_c * other_c + other_s * other_s;
  const bool turns = turn2 >= other2;
  const double length = std::sqrt(turns ? turn2 : other2);
  double c = 1.0, s = 0.0;
  if (length > 0.0)
    c = (turns ? turn_c : other_c) / length, s = (turns ? turn_s : other_s) / length;
  const Vec3 first = c * a.first + s * a.second;
  const Vec3 second = turns ? Vec3(c * a.second - s * a.first) : Vec3(s * a.first - c * a.second);
  return to_a * to_b.transpose() + first * b.first.transpose() + second * b.second.transpose();
}

/// Of a symmetric matrix M and a vector d: det(M - m I) and d' adj(M - m I) d as polynomials in m.
struct Characteristic {
  double c0, c1, c2;
  double n0, n1, n2;

  Characteristic(const Symmetric3& shape, const Vec3& d) {
    const Symmetric3 adj = adjugate(shape);
    c0 = shape.xx * adj.xx + shape.xy * adj.xy + shape.zx * adj.zx;
    c1 = adj.trace();
    c2 = shape.trace();
    n0 = adj.form(d);
    n2 = d.squaredNorm();
    n1 = c2 * n2 - shape.form(d);
  }
  double det(double m) const { return c0 - m * (c1 - m * (c2 - m)); }
  double det1(double m) const { return -c1 + m * (2.0 * c2 - 3.0 * m); }
  double det2(double m) const { return 2.0 * c2 - 6.0 * m; }
  /// d' M (M - m I)^-2 d, which is 1 where the depth is greatest; what it is at the least root is
  /// not asked.
  double level(double m) const {
    const double p = det(m), q = n0 - m * (n1 - m * n2), inverse = 1.0 / p;
    return inverse * (q + m * inverse * ((-n1 + 2.0 * m * n2) * p - q * det1(m)));
  }
};

/// The least root of det, from below: Laguerre's method for a polynomial with three real roots.
double least_root(const Characteristic& of) {
  double m = 0.0;
  for (int i = 0; i < kRootSteps; ++i) {
    const double p = of.det(m);
    if (!(p > 0.0)) break;
    const double g = of.det1(m) / p, h = g * g - of.det2(m) / p;
    const double step = 3.0 / (std::sqrt(std::max(0.0, 2.0 * (3.0 * h - g * g))) - g);
    if (!(step > 0x1p-30 * m)) break;
    m += step;
  }
  return m;
}

}  // namespace

InnerEllipsoid::InnerEllipsoid(const Pair& pair, const Vec3& normal) noexcept
    : d_(pair.d), size_(pair.size) {
  const Mat3 factor_a = factor(pair.a), factor_b = factor(pair.b);
  const Vec3 y_a = factor_a.transpose() * normal, y_b = factor_b.transpose() * normal;
  const double h_a = y_a.norm(), h_b = y_b.norm();
  const Mat3 o = aligned(factor_a.transpose() * factor_b, y_a / h_a, y_b / h_b);
  // (O): so that no direction is made longer.
  const double defect = (o.transpose() * o - Mat3::Identity()).norm() + kOrthogonal;
  const Mat3 t = factor_a + (1.0 - 0.5 * defect) * (factor_b * o.transpose());
  const double axes = pair.a.largest_semi_axis() + pair.b.largest_semi_axis();
  const double off = kShape * axes * axes;
  const Vec3 x = t.row(0), y = t.row(1), z = t.row(2);
  shape_ = {x.dot(x) - off, y.dot(y) - off, z.dot(z) - off, y.dot(z), z.dot(x), x.dot(y)};
  support_ = h_a + h_b;
}

InnerEllipsoid::Bound InnerEllipsoid::at(double multiplier) const noexcept {
  Bound nothing{kUnproven, d_};
  Symmetric3 k = shape_;
  k.xx -= multiplier, k.yy -= multiplier, k.zz -= multiplier;
  const double scale = k.trace();
  const Symmetric3 adj = adjugate(k);
  const double determinant = k.xx * adj.xx + k.xy * adj.xy + k.zx * adj.zx;
  const bool definite = multiplier > 0.0 && std::min({k.xx, k.yy, k.zz}) > 0.0 &&
                        std::min({adj.xx, adj.yy, adj.zz}) > kMinor * scale * scale &&
                        determinant > 2.0 * kDeterminant * scale * scale * scale;
  if (!definite) return nothing;
  const double least =
      (4.0 - 0x1p-40) * (determinant - kDeterminant * scale * scale * scale) / (scale * scale);
  const Vec3 v = (adj * d_) * (1.0 / determinant);
  const Vec3 rest = d_ - k * v;
  const double length = v.norm(), distance = d_.norm();
  const double off = kRest * (distance + scale * length), reach = rest.norm() + off;
  // (K): d' K^-1 d is no larger.
  const double level =
      v.dot(d_) + v.dot(rest) + reach * reach / least + length * off + kRest * length * distance;
  const double depth2 = multiplier * (1.0 - level);
  // The level's rest is what the axis of least semi-axis has: of two ways out one is taken.
  Vec3 normal = v;
  const double missing = 1.0 - shape_.form(v);
  if (missing > 0x1p-20) {
    const Vec3 axis = adj.xx >= std::max(adj.yy, adj.zz) ? Vec3(adj.xx, adj.xy, adj.zx)
                      : adj.yy >= adj.zz                 ? Vec3(adj.xy, adj.yy, adj.yz)
                                                         : Vec3(adj.zx, adj.yz, adj.zz);
    const double along = std::sqrt(missing / shape_.form(axis));
    normal += (axis.dot(v) < 0.0 ? -along : along) * axis;
  }
  if (!(depth2 > 0.0)) return {kUnproven, normal};
  return {-std::sqrt(depth2) * (1.0 - 0x1p-50) + kValue * size_, normal};
}

InnerEllipsoid::Best InnerEllipsoid::best_multiplier() const noexcept {
  const Characteristic of(shape_, d_);
  const double least = least_root(of);
  Best found{0.0, least, 4.0 * kDeterminant * of.c2 * of.c2 * of.c2 / of.c0};
  // 1 / sqrt(level) falls to 0 at the least root, nearly along a line [MoreSorensen1983].
  const auto left = [&](double m) { return 1.0 / std::sqrt(std::max(of.level(m), 0x1p-80)) - 1.0; };
  double low = 0.0, high = least, at_low = left(0.0), at_high = -1.0;
  if (!(at_low > 0.0)) return found;  // d is outside
  for (int i = 0; i < kSteps; ++i) {
    const double m = low + (high - low) * std::min(at_low / (at_low - at_high), 1.0 - 0x1p-20);
    const double value = left(m);
    found.multiplier = m;
    if (!(m > low && m < high) || !(std::abs(value) > kCloseEnough)) return found;
    if (value > 0.0) {
      low = m, at_low = value;
      at_high *= 0.5;  // so that neither end stays (Illinois)
    } else {
      high = m, at_high = value;
    }
  }
  found.multiplier = low + (high - low) * (at_low / (at_low - at_high));
  return found;
}

InnerEllipsoid::Bound InnerEllipsoid::best() const noexcept {
  const Best found = best_multiplier();
  // So close to the least root that rounding just shows what is left to be definite.
  const double below = std::min(found.below, 0.125);
  const Bound bound = at(std::min(found.multiplier, (1.0 - below) * found.least));
  if (bound.high < kUnproven) return bound;
  return at(std::min(found.multiplier, (1.0 - std::min(16.0 * below, 0.5)) * found.least));
}

}  // namespace tangency::inline v0::detail
