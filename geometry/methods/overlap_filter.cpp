// SPDX-License-Identifier: MIT
#include <tangency/geometry/methods/overlap_filter.hpp>

#include <cmath>

#include <tangency/geometry/methods/gap_newton.hpp>
#include <tangency/geometry/methods/perram_wertheim.hpp>

namespace tangency::methods {
namespace {

/// The most by which one operation errs relative to its result, whatever the rounding mode.
constexpr double kEpsilon = 0x1p-52;
constexpr int kSteps = 24;  // chosen: neither test fires at an exact touch, so the search must end

constexpr double kPolynomial = 720 * kEpsilon;  // E1 of the derivation
constexpr double kTurned = 16 * kEpsilon;       // E2
constexpr double kDirection = 64 * kEpsilon;    // E3
constexpr double kSum = 16 * kEpsilon;          // E4

/// Upper bounds of D and N that no cancellation makes small: the yardstick of their errors.
struct Yardstick {
  Yardstick(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) {
    const double ma = a.shape().trace(), mb = b.shape().trace();
    const double ja = a.shape_adjugate().trace(), jb = b.shape_adjugate().trace();
    const double d2 = d.squaredNorm();
    det[0] = a.shape_determinant(), det[1] = ja * mb, det[2] = jb * ma, det[3] = b.shape_determinant();
    num[0] = ja * d2, num[1] = ma * mb * d2, num[2] = jb * d2;
  }
  double det_at(double l) const { return det[0] + l * (det[1] + l * (det[2] + l * det[3])); }
  double num_at(double l) const { return num[0] + l * (num[1] + l * num[2]); }

  double det[4], num[3];
};

/// F(l) > 1 proves the solids apart; a point where both levels are below 1, that the interiors meet.
Filtered decide(const PerramWertheimAt& p, const Yardstick& yardstick) {
  const double det = yardstick.det_at(p.l), num = yardstick.num_at(p.l);
  const double apart = p.l * p.num - (1.0 + p.l) * p.det;
  const double apart_error = kPolynomial * (p.l * num + (1.0 + p.l) * det);
  if (apart > apart_error) return Filtered::apart;
  // At c_A + M_A v the levels are (l N/D)' and -l^2 (N/D)'; times D^2 they are free of division.
  const double square = p.det * p.det, cross = p.num1 * p.det - p.num * p.det1;
  const double in_a = square - p.num * p.det - cross;
  const double in_b = square + p.l * cross;
  if (in_a > 13.0 * kPolynomial * det * (det + num) &&
      in_b > 13.0 * kPolynomial * det * (det + p.l * num)) {
    return Filtered::interiors_meet;
  }
  return Filtered::unknown;
}

/// diag(a) R' n
Vec3 stretched(const Ellipsoid& e, const Vec3& n) {
  return e.semi_axes().cwiseProduct(e.rotation().transpose() * n);
}

double sum_of_absolutes(const Vec3& v) { return v.cwiseAbs().sum(); }

double reach(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) {
  return sum_of_absolutes(d) + a.largest_semi_axis() + b.largest_semi_axis();
}

/// n.d - h_A - h_B > 0 proven, for n of any length.
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

/// The tests of the polynomials again, at one normal and one point, from the factors of the shapes:
/// their errors grow with the aspect ratio, those of the polynomials with its square.
Filtered decide_by_factors(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, const Vec3& n) {
  if (separates(a, b, d, n)) return Filtered::apart;
  const Vec3 ya = stretched(a, n), yb = stretched(b, n);
  const double ha = ya.norm(), hb = yb.norm();
  // A point of the lens: between the witness points of the normal.
  const Vec3 from_a = a.rotation() * (a.semi_axes().cwiseProduct(ya) / ha);
  const Vec3 from_b = b.rotation() * (b.semi_axes().cwiseProduct(yb) / -hb);
  const Vec3 point = 0.5 * (from_a + (d + from_b));
  const Vec3 beyond = point - d;
  const double error = kEpsilon * (sum_of_absolutes(d) + sum_of_absolutes(beyond));
  if (inside(a, point, 0.0) && inside(b, beyond, error)) return Filtered::interiors_meet;
  return Filtered::unknown;
}

}  // namespace

OverlapFilter::OverlapFilter(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept
    : form_(a, b, d) {
  const Yardstick yardstick(a, b, d);
  constexpr double kSettled = 1e-4;  // of l, chosen: the rest is left to Newton's method on n
  PerramWertheimSearch search;
  l_ = form_.first_guess();
  for (int step = 0; step < kSteps; ++step) {
    const PerramWertheimAt at = form_.at(l_);
    answer_ = decide(at, yardstick);
    if (answer_ != Filtered::unknown) return;
    const double next = search.next(at);
    const bool settled = std::abs(next - l_) < kSettled * l_;
    l_ = next;
    if (settled) break;
  }
  settle(a, b, d);
}

void OverlapFilter::settle(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept {
  normal_ = newton_from(a, b, d, form_.normal_direction(l_).normalized()).normal;
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

}  // namespace tangency::methods
