// SPDX-License-Identifier: MIT
#include <tangency/geometry/relation/overlap_filter.hpp>

#include <cmath>

#include <tangency/geometry/bodies/double_double_body.hpp>
#include <tangency/geometry/normals/newton.hpp>
#include <tangency/geometry/normals/perram_wertheim.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0::detail {
namespace {

/// The most by which one operation errs relative to its result, whatever the rounding mode.
constexpr double kEpsilon = 0x1p-52;
constexpr int kSteps = 24;  // chosen: neither test fires at an exact touch, so the search must end

constexpr double kPolynomial = 720 * kEpsilon;  // E1 of the derivation
constexpr double kTurned = 16 * kEpsilon;       // E2
constexpr double kDirection = 64 * kEpsilon;    // E3
constexpr double kSum = 16 * kEpsilon;          // E4

/// Bounds of D and N that no cancellation makes small: the yardsticks of their errors.
struct Yardstick {
  double det, num;
};

/// With t = tr M_A + l tr M_B, D <= t^3 and N <= |d|^2 t^2: cheap, and enough for ordinary shapes.
struct WideYardstick {
  WideYardstick(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d)
      : trace_a(a.shape().trace()), trace_b(b.shape().trace()), d2(d.squaredNorm()) {}
  Yardstick at(double l) const {
    const double t = trace_a + l * trace_b, square = t * t;
    return {square * t, d2 * square};
  }

  double trace_a, trace_b, d2;
};

/// Coefficient by coefficient: tr J_A tr M_B and so on.
Yardstick narrow_yardstick(const Ellipsoid& a, const Ellipsoid& b, const WideYardstick& wide,
                           const PerramWertheimAt& p) {
  const double ja = a.shape_adjugate().trace(), jb = b.shape_adjugate().trace(), l = p.l;
  return {p.d0 + l * (ja * wide.trace_b + l * jb * wide.trace_a) + p.d3,
          wide.d2 * (ja + l * (wide.trace_a * wide.trace_b + l * jb))};
}

/// What the polynomials say at one l, before their errors are asked about.
struct Signs {
  explicit Signs(const PerramWertheimAt& p) : l(p.l) {
    const double det = p.det(), num = p.num();
    apart = l * num - (1.0 + l) * det;
    // At c_A + M_A v the levels are (l N/D)' and -l^2 (N/D)'; times D^2 they are free of division.
    const double square = det * det, cross = p.num1() * det - num * p.det1();
    in_a = square - num * det - cross;
    in_b = square + l * cross;
  }
  /// F(l) > 1 proves the solids apart; a point where both levels are < 1, that the interiors meet.
  Filtered proven(const Yardstick& y) const {
    // Below 2^500 neither side of a comparison overflows; a search that went astray is not below.
    if (!(y.det + (1.0 + l) * y.num < 0x1p500)) return Filtered::unknown;
    if (apart > kPolynomial * (l * y.num + (1.0 + l) * y.det)) return Filtered::apart;
    const double bound = 13.0 * kPolynomial * y.det;
    const bool meet = in_a > bound * (y.det + y.num) && in_b > bound * (y.det + l * y.num);
    return meet ? Filtered::interiors_meet : Filtered::unknown;
  }
  bool tell() const { return apart > 0.0 || (in_a > 0.0 && in_b > 0.0); }

  double l, apart, in_a, in_b;
};

/// n times a power of two that brings its largest component to [1, 2); a coordinate axis for what
/// is no direction.
Vec3 with_largest_component_near_1(const Vec3& n) {
  const double largest = n.cwiseAbs().maxCoeff();
  if (is_zero(largest) || !n.allFinite()) return Vec3::UnitX();
  return scaled_by_power(n, -exponent_of(largest));
}

/// diag(a) R' n
Vec3 stretched(const Ellipsoid& e, const Vec3& n) {
  return e.semi_axes().cwiseProduct(e.rotation().transpose() * n);
}

double sum_of_absolutes(const Vec3& v) { return v.cwiseAbs().sum(); }

double reach(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) {
  return sum_of_absolutes(d) + a.largest_semi_axis() + b.largest_semi_axis();
}

/// n.d - h_A - h_B > 0 proven, for n with its largest component in [1/2, 2).
bool separates(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, const Vec3& n) {
  const double value = n.dot(d) - stretched(a, n).norm() - stretched(b, n).norm();
  return value > kDirection * sum_of_absolutes(n) * reach(a, b, d);
}

/// Level < 1 proven at p from the centre, each component of p known to within `error`.
bool inside(const Ellipsoid& e, const Vec3& p, double error) {
  const double turned = kTurned * sum_of_absolutes(p) + 2.0 * error;
  const Vec3 body = (e.rotation().transpose() * p).cwiseAbs() + Vec3::Constant(turned);
  return body.cwiseQuotient(e.semi_axes()).squaredNorm() * (1.0 + kSum) < 1.0;
}

/// Interiors that meet at a point, given from A's centre.
bool meet_at(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, const Vec3& point) {
  const Vec3 beyond = point - d;
  const double error = kEpsilon * (sum_of_absolutes(d) + sum_of_absolutes(beyond));
  return inside(a, point, 0.0) && inside(b, beyond, error);
}

/// The tests of the polynomials again, at one normal and a point between its witness points, from
/// the factors of the shapes: their errors grow with the aspect ratio, those of the polynomials
/// with its square.
Filtered decide_by_factors(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, const Vec3& n) {
  if (separates(a, b, d, n)) return Filtered::apart;
  const Vec3 ya = stretched(a, n), yb = stretched(b, n);
  const Vec3 from_a = a.rotation() * (a.semi_axes().cwiseProduct(ya) / ya.norm());
  const Vec3 from_b = b.rotation() * (b.semi_axes().cwiseProduct(yb) / -yb.norm());
  return meet_at(a, b, d, 0.5 * (from_a + (d + from_b))) ? Filtered::interiors_meet
                                                         : Filtered::unknown;
}

}  // namespace

OverlapFilter::OverlapFilter(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept
    : form_(a, b, d) {
  const WideYardstick wide(a, b, d);
  constexpr double kSettled = 1e-4;  // of l, chosen: the rest is left to Newton's method on n
  PerramWertheimSearch search;
  l_ = form_.first_guess();
  for (int step = 0; step < kSteps; ++step) {
    const PerramWertheimAt at = form_.at(l_);
    const Signs signs(at);
    answer_ = signs.proven(wide.at(l_));
    if (answer_ != Filtered::unknown) return;
    if (signs.tell()) {
      answer_ = signs.proven(narrow_yardstick(a, b, wide, at));
      if (answer_ != Filtered::unknown) return;
      // The same direction and the same point from the factors: F > 1 at l makes v(l) separate.
      const Vec3 point = a.shape() * (form_.normal_direction(l_) / at.det());
      if (signs.apart > 0.0 ? separates(a, b, d, scaled_normal()) : meet_at(a, b, d, point)) {
        answer_ = signs.apart > 0.0 ? Filtered::apart : Filtered::interiors_meet;
        return;
      }
      break;
    }
    const double next = search.next(at);
    const bool settled = std::abs(next - l_) < kSettled * l_;
    l_ = next;
    if (settled) break;
  }
  settle(a, b, d);
}

Vec3 OverlapFilter::scaled_normal() const noexcept {
  // d may be as small as a subnormal number, and n with it: its squares would be nothing.
  return with_largest_component_near_1(form_.normal_direction(l_));
}

void OverlapFilter::settle(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept {
  const Stationary found = newton_from(a, b, d, scaled_normal().normalized());
  normal_ = with_largest_component_near_1(found.normal);
  settled_ = true;
  answer_ = decide_by_factors(a, b, d, normal_);
}

bool proves_sticking_out(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                         const Vec3& normal) noexcept {
  // h_A(n) + |n.d| > h_B(n): along n or -n, away from B, A reaches further than B.
  const auto sticks_out = [&](const Vec3& n) {
    const double value = std::abs(n.dot(d)) + stretched(a, n).norm() - stretched(b, n).norm();
    return value > kDirection * sum_of_absolutes(n) * reach(a, b, d);
  };
  if (sticks_out(normal)) return true;
  for (int i = 0; i < 3; ++i) {
    if (sticks_out(a.rotation().col(i)) || sticks_out(b.rotation().col(i))) return true;
  }
  return false;
}

bool proves_inside(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept {
  // In coordinates that make B the unit ball A is p + K y, |y| <= 1: inside if |p| + |K|_F < 1, the
  // Frobenius norm being no less than the spectral one.
  const Vec3 inverse = b.semi_axes().cwiseInverse();
  const Mat3 turned = b.rotation().transpose() * a.rotation();
  const double spread = (inverse.asDiagonal() * turned * a.semi_axes().asDiagonal()).norm();
  const double distance = inverse.cwiseProduct(b.rotation().transpose() * d).norm();
  const double error = 4.0 * kDirection * reach(a, b, d) / b.smallest_semi_axis();
  return distance + spread + error < 1.0;
}

namespace {

using Vector = DoubleDoubleVector;
using Side = DoubleDoubleSide;

constexpr double kDirectionInDoubleDouble = 64 * kDoubleDoubleEpsilon;  // E5 of the derivation
constexpr double kTurnedInDoubleDouble = 64 * kDoubleDoubleEpsilon;     // E6

/// Level < 1 proven at p from the centre, each component of p known to within `error`.
bool inside(const Side& s, const Vector& p, double error) {
  const DoubleDouble turned(kTurnedInDoubleDouble * sum_of_absolutes(p) + 2.0 * error);
  const Vector body = turned_back(s.rotation, p);
  DoubleDouble level;
  for (std::size_t k = 0; k < 3; ++k) {
    const DoubleDouble ratio = (abs(body[k]) + turned) / s.axis(k);
    level = level + ratio * ratio;
  }
  return (DoubleDouble(1.0) - level).high > 32 * kDoubleDoubleEpsilon;
}

}  // namespace

Filtered filter_overlap_in_double_double(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                                         const Vec3& d_low, const Vec3& n) noexcept {
  const Vector normal = {n[0], n[1], n[2]};
  const Vector between = {DoubleDouble(d[0], d_low[0]), {d[1], d_low[1]}, {d[2], d_low[2]}};
  const Side sa(a, normal), sb(b, normal);
  const DoubleDouble gap = dot(between, normal) - sa.support - sb.support;
  const double size = sum_of_absolutes(between) + a.largest_semi_axis() + b.largest_semi_axis();
  if (gap.high > kDirectionInDoubleDouble * n.cwiseAbs().sum() * size) return Filtered::apart;

  // A point of the lens, between the witness points of the normal.
  const Vector from_a = sa.support_point(), from_b = sb.support_point();
  Vector point, beyond;
  for (std::size_t i = 0; i < 3; ++i) {
    point[i] = DoubleDouble(0.5) * (from_a[i] + (between[i] - from_b[i]));
    beyond[i] = point[i] - between[i];
  }
  const double error =
      2.0 * kDoubleDoubleEpsilon * (sum_of_absolutes(between) + sum_of_absolutes(point));
  const bool meet = inside(sa, point, 0.0) && inside(sb, beyond, error);
  return meet ? Filtered::interiors_meet : Filtered::unknown;
}

}  // namespace tangency::inline v0::detail
