// SPDX-License-Identifier: MIT
#include <tangency/geometry/gap_derivatives.hpp>

#include <algorithm>
#include <cmath>

#include <tangency/geometry/bodies/plane_tensor.hpp>
#include <tangency/geometry/bodies/scaled_pair.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency::inline v0 {
namespace {

using detail::PlaneBasis;
using detail::PlaneTensor;
using UnitPair = detail::UnitPair<Ellipsoid>;
using Mat2 = Eigen::Matrix2d;
using Mat23 = Eigen::Matrix<double, 2, 3>;
using Mat218 = Eigen::Matrix<double, 2, 18>;

constexpr double kRounding =
    kOrdinaryGapErrorBound * kUnitRoundoff;    // of L: n.d is half of f(n) - f(-n)
constexpr double kWorstConditioned = 0x1p-10;  // chosen: of u kappa' beta; three digits are left
// A Gap's normal is off by sqrt(u kappa) at most, so that these mostly do; and where they do not.
constexpr int kPolishingSteps = 2, kMostSteps = 8;
// Of the step from a settled normal, in u deep (kappa + sqrt(kappa beta)): what its rounding may
// come to, docs/derivations/derivatives-and-curvature.md.
constexpr double kSettled = 16.0;

GapDerivatives none(DerivativeStatus status) {
  return {GapGradient::Zero(), GapHessian::Zero(), 0.0, status};
}

Mat3 cross_matrix(const Vec3& v) {
  return (Mat3() << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0).finished();
}

/// A body at a normal.
struct Side {
  Side(const Ellipsoid& body, const Vec3& n, const PlaneBasis& basis)
      : w(body.rotation().transpose() * n) {
    const Vec3 z = body.semi_axes().cwiseProduct(w);
    h = z.stableNorm();
    y = z / h;
    point = body.rotation() * body.semi_axes().cwiseProduct(y);
    hessian = detail::radius_tensor(body, basis, h);
    sharpness = body.largest_semi_axis() / h;
  }

  Vec3 w;               ///< R'n
  Vec3 y;               ///< diag(a) w / h, unit
  Vec3 point;           ///< support point
  double h;             ///< support function
  PlaneTensor hessian;  ///< E' Hess h E
  double sharpness;     ///< a_max / h
};

Mat2 matrix(const PlaneTensor& t) { return (Mat2() << t.xx(), t.xy(), t.xy(), t.yy()).finished(); }

/// f = n.d - h_A - h_B to second order about a normal.
struct Expansion {
  Expansion(const Ellipsoid& body_a, const Ellipsoid& body_b, const Vec3& d, const Vec3& normal)
      : n(normal),
        basis(detail::tangent_basis(normal)),
        a(body_a, normal, basis),
        b(body_b, normal, basis),
        slope(basis.transpose() * (d - a.point - b.point)) {
    gap = n.dot(d) - a.h - b.h;
    const double traces = a.hessian.trace() + b.hessian.trace();
    w = matrix(a.hessian) + matrix(b.hessian) + gap * Mat2::Identity();
    const double determinant = a.hessian.determinant + b.hessian.determinant +
                               detail::mixed_determinant(a.hessian, b.hessian) + gap * traces +
                               gap * gap;
    inverse = (Mat2() << w(1, 1), -w(0, 1), -w(0, 1), w(0, 0)).finished() / determinant;
    const bool definite = w.trace() > 0.0 && determinant > 0.0;
    least =
        definite ? detail::principal_values(w(0, 0), w(1, 1), w(0, 1), determinant).smaller : 0.0;
  }

  double beta() const { return std::max(a.sharpness, b.sharpness); }
  double kappa(double size) const { return 1.0 + size / least; }
  double deep() const { return 1.0 + std::max(0.0, -gap / least); }
  bool safe(double size) const {
    return least > 0.0 && kUnitRoundoff * kappa(size) * deep() * beta() <= kWorstConditioned;
  }
  Eigen::Vector2d move() const { return inverse * slope; }  ///< Newton's step of the normal
  bool settled(double size) const {
    const double rounding =
        kUnitRoundoff * deep() * (kappa(size) + std::sqrt(kappa(size) * beta()));
    return move().norm() <= kSettled * rounding;
  }

  Vec3 n;
  PlaneBasis basis;
  Side a, b;
  Eigen::Vector2d slope;  ///< f_n
  double gap;
  Mat2 w, inverse;  ///< W = -f_nn and its inverse
  double least;     ///< smallest eigenvalue of W, 0 if W is not positive definite
};

/// Adds what belongs to one body: its gradient, columns of f_theta_n and blocks of f_theta_theta.
/// @param sign   of n in dg/dc: -1 for A, 1 for B
void add_body(const Ellipsoid& body, const Side& side, const Expansion& f, double sign, int first,
              GapGradient& gradient, Mat218& mixed, GapHessian& hessian) {
  const int c = first + kCentre, v = first + kRotation, s = first + kSemiAxes;
  const Mat3 n_cross = cross_matrix(f.n);
  const Mat23 plane = f.basis.transpose();
  const Mat23 turn = plane * n_cross;  // v moves the body's normal, seen in space, by n x v
  const Mat2 radii = matrix(side.hessian);
  const Vec3& y = side.y;
  const Vec3& w = side.w;

  // d(support point)/da = R [diag(y) + diag(a) (I - y y') diag(w) / h], where a_k w_k / h = y_k
  Mat3 shift;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      const double others = y[(k + 1) % 3] * y[(k + 1) % 3] + y[(k + 2) % 3] * y[(k + 2) % 3];
      const double slant = body.semi_axes()[i] * y[i] / side.h;  // a_i y_i / h
      shift(i, k) = i == k ? y[k] * (1.0 + others) : -slant * y[k] * w[k];
      hessian(s + i, s + k) = -(w[i] * w[k] / side.h) * (i == k ? others : -y[i] * y[k]);
    }
  }
  shift = (body.rotation() * shift).eval();

  gradient.segment<3>(c) = sign * f.n;
  gradient.segment<3>(v) = f.n.cross(side.point);
  gradient.segment<3>(s) = -y.cwiseProduct(w);

  mixed.middleCols<3>(c) = sign * plane;
  mixed.middleCols<3>(v) = plane * cross_matrix(side.point) - radii * turn;
  mixed.middleCols<3>(s) = -plane * shift;

  // h(exp(-[v]x) n) = h + x.(n x v) + (n x v)'H(n x v) / 2 + x.(v x (v x n)) / 2
  const Mat3 xn = side.point * f.n.transpose();
  hessian.block<3, 3>(v, v) =
      side.h * Mat3::Identity() - 0.5 * (xn + xn.transpose()) - turn.transpose() * radii * turn;
  hessian.block<3, 3>(v, s) = n_cross * shift;
  hessian.block<3, 3>(s, v) = hessian.block<3, 3>(v, s).transpose();
}

GapDerivatives derivatives_at(const Ellipsoid& a, const Ellipsoid& b, const Expansion& f,
                              DerivativeStatus status) {
  GapDerivatives result = none(status);
  result.least_radius = f.least;
  Mat218 mixed;
  add_body(a, f.a, f, -1.0, 0, result.gradient, mixed, result.hessian);
  add_body(b, f.b, f, 1.0, kOfBodyB, result.gradient, mixed, result.hessian);
  const Mat218 response = f.inverse * mixed;  // dn/dtheta, in the tangent plane
  for (int j = 0; j < 18; ++j) {
    for (int i = 0; i <= j; ++i) {
      result.hessian(i, j) += mixed.col(i).dot(response.col(j));
      result.hessian(j, i) = result.hessian(i, j);
    }
  }
  return result;
}

GapDerivatives solve(const UnitPair& pair, const Gap& gap) {
  const Ellipsoid &a = pair.a, &b = pair.b;
  const Vec3& d = pair.d;
  const double size = d.norm() + a.largest_semi_axis() + b.largest_semi_axis();
  if (gap.status == GapStatus::beyond) return none(DerivativeStatus::degenerate);
  if (std::abs(gap.normal.dot(d)) <= kRounding * size) return none(DerivativeStatus::tie);
  Expansion f(a, b, d, gap.normal);
  for (int step = 0;; ++step) {
    if (!f.safe(size)) return none(DerivativeStatus::degenerate);
    if (step >= kPolishingSteps && f.settled(size)) break;
    if (step == kMostSteps) return none(DerivativeStatus::degenerate);
    f = Expansion(a, b, d, (f.n + f.basis * f.move()).normalized());
  }
  const bool ok = gap.status == GapStatus::ok;
  return derivatives_at(a, b, f, ok ? DerivativeStatus::ok : DerivativeStatus::local);
}

/// From units of 2^exponent: a derivative has the unit length^(1 - number of lengths it is taken
/// by).
void scale_back(GapDerivatives& result, int exponent) {
  const auto is_angle = [](int i) { return i % kOfBodyB / 3 == kRotation / 3; };
  for (int i = 0; i < 18; ++i) {
    if (is_angle(i)) result.gradient[i] = std::scalbn(result.gradient[i], exponent);
    for (int j = 0; j < 18; ++j) {
      const int power = is_angle(i) + is_angle(j) - 1;
      result.hessian(i, j) = std::scalbn(result.hessian(i, j), power * exponent);
    }
  }
  result.least_radius = std::scalbn(result.least_radius, exponent);
}

GapDerivatives answer(const detail::AskedPair<Ellipsoid>& asked, const Gap& gap) {
  const Vec3 d = asked.d();
  const UnitPair pair(asked, d, detail::moderate_size(asked.a, asked.b, d));
  GapDerivatives found = solve(pair, gap);
  if (!pair.in_own_unit()) scale_back(found, pair.exponent);
  return found;
}

}  // namespace

GapDerivatives gap_derivatives(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation,
                               const Gap& gap) noexcept {
  contract::require_finite("gap_derivatives", "separation", separation);
  return in_default_environment([&] { return answer({a, b, &separation}, gap); });
}

GapDerivatives gap_derivatives(const Ellipsoid& a, const Ellipsoid& b, const Gap& gap) noexcept {
  return in_default_environment([&] { return answer({a, b}, gap); });
}

}  // namespace tangency::inline v0
