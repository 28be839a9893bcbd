// SPDX-License-Identifier: MIT
#include <tangency/geometry/gap/cap.hpp>

#include <algorithm>
#include <cmath>

namespace tangency::inline v0::detail {
namespace {

using Root = Eigen::Matrix<double, 6, 1>;  ///< of A, and below it of B

// (S) of the derivation: the errors of y x diag(a) R'e and of h in double-double, of the product of
// the two largest semi-axes and of the largest; what a rotation in double and tangents in double
// are off by.
constexpr double kRootError = 0x1p-94;
constexpr double kSupportError = 0x1p-94;
constexpr double kTurnError = 0x1p-50;
constexpr double kPointError = 0x1p-92;  // (R2)

/// y x diag(a) R'e with y = diag(a) R'n: its square is h^3 e' Hess h e, and it is linear in e.
DoubleDoubleVector hessian_root(const DoubleDoubleSide& side, const Vec3& e) {
  const DoubleDoubleVector& y = side.stretched;
  DoubleDoubleVector z = turned_back(side.rotation, exactly(e)), root;
  for (std::size_t k = 0; k < 3; ++k) z[k] = side.axis(k) * z[k];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    root[i] = y[j] * z[k] - y[k] * z[j];
  }
  return root;
}

/// The roots of one body along two tangents.
struct Roots {
  DoubleDoubleVector e, m;
  double scale;    ///< h^-1.5
  double error;    ///< of both, scaled
  double largest;  ///< semi-axis

  Roots(const DoubleDoubleSide& side, const Vec3& along_e, const Vec3& along_m)
      : e(hessian_root(side, along_e)),
        m(hessian_root(side, along_m)),
        scale(1.0 / (side.support.high * std::sqrt(side.support.high))),
        largest(side.semi_axes->maxCoeff()) {
    const Vec3& a = *side.semi_axes;
    error = kRootError * std::max({a[0] * a[1], a[1] * a[2], a[2] * a[0]}) * scale;
  }

  void turn(double cosine, double sine) {
    const DoubleDoubleVector before = e;
    e = DoubleDouble(cosine) * before + DoubleDouble(sine) * m;
    m = DoubleDouble(cosine) * m + DoubleDouble(-sine) * before;
  }
};

double square(double x) { return x * x; }

SideHessian side_hessian(const SideAt& at, const Roots& roots, const Root& along_e,
                         const Root& along_m, int first, double error, const Vec3 tangent[2]) {
  const double h = at.side.support.high, reach = roots.largest;
  const double off = kTurnError * reach + std::min(kPointError * reach * (reach / h), 2.0 * reach);
  SideHessian hessian{h - kSupportError * reach, {}, {}};
  for (int i = 0; i < 2; ++i) {
    const Root& root = i == 0 ? along_e : along_m;
    hessian.curvature[i] = square(root.segment<3>(first).norm() + roots.error + error);
    // A'e is, across y, of the square h e' Hess h e; along y it is e . x_A.
    hessian.stretch[i] =
        h * hessian.curvature[i] + square(std::abs(tangent[i].dot(at.point)) + off);
  }
  return hessian;
}

}  // namespace

Hessian hessian_at(const SideAt& a, const SideAt& b, const Vec3& normal) noexcept {
  Vec3 e = normal.unitOrthogonal(), m = normal.cross(e).normalized();
  Roots of_a(a.side, e, m), of_b(b.side, e, m);
  Root root_e, root_m;
  double cosine = 1.0, sine = 0.0;
  // A Jacobi rotation of the tangents makes their roots orthogonal but for rounding, in
  // double-double, so that a small curvature beside a large one is not lost.
  const auto take_roots = [&] {
    root_e << rounded(of_a.e) * of_a.scale, rounded(of_b.e) * of_b.scale;
    root_m << rounded(of_a.m) * of_a.scale, rounded(of_b.m) * of_b.scale;
    const double difference = 0.5 * (root_e.squaredNorm() - root_m.squaredNorm());
    const double angle = 0.5 * std::atan2(root_e.dot(root_m), difference);
    cosine = std::cos(angle), sine = std::sin(angle);
  };
  const auto turn = [&](auto& along_e, auto& along_m) {
    const auto before = along_e;
    along_e = cosine * before + sine * along_m;
    along_m = cosine * along_m - sine * before;
  };
  take_roots();
  of_a.turn(cosine, sine), of_b.turn(cosine, sine);
  turn(e, m);
  // A second one, by next to nothing, takes what rounding left.
  take_roots();
  turn(root_e, root_m);
  turn(e, m);

  const double larger = std::max(root_e.norm(), root_m.norm());
  const double smaller = std::min(root_e.norm(), root_m.norm());
  const double turned = kTurnError * std::abs(sine) * larger;
  const double thin =
      std::max(of_a.largest / a.side.support.high, of_b.largest / b.side.support.high);
  const double skew = std::abs(root_e.dot(root_m)) / (larger * smaller);
  const double loss =
      skew + 3.0 * ((of_a.error + of_b.error + turned) / smaller) + 4.0 * kSupportError * thin;
  const Vec3 tangent[2] = {e, m};
  return {{e, m},
          {root_e.squaredNorm(), root_m.squaredNorm()},
          loss,
          side_hessian(a, of_a, root_e, root_m, 0, turned, tangent),
          side_hessian(b, of_b, root_e, root_m, 3, turned, tangent)};
}

namespace {

/// e' (Hess h) e, e' (Hess h) m and m' (Hess h) m of one body, within `error`.
struct Bending {
  DoubleDouble ee, em, mm;
  double error;

  Bending(const DoubleDoubleSide& side, const Roots& roots) {
    const DoubleDouble h3 = side.support * side.support * side.support;
    ee = dot(roots.e, roots.e) / h3;
    em = dot(roots.e, roots.m) / h3;
    mm = dot(roots.m, roots.m) / h3;
    const double most = std::max(ee.high, mm.high), thin = roots.largest / side.support.high;
    error = kMore * (roots.error * (2.0 * std::sqrt(most) + roots.error) +
                     4.0 * kSupportError * thin * most);
  }
};

SideHessian side_hessian(const SideAt& at, const Roots& roots, const Bending& bending,
                         const Vec3 tangent[2]) {
  const double h = at.side.support.high, reach = roots.largest;
  const double off = kTurnError * reach + std::min(kPointError * reach * (reach / h), 2.0 * reach);
  SideHessian hessian{h - kSupportError * reach, {}, {}};
  for (int i = 0; i < 2; ++i) {
    hessian.curvature[i] = kMore * (i == 0 ? bending.ee : bending.mm).high + bending.error;
    hessian.stretch[i] =
        h * hessian.curvature[i] + square(std::abs(tangent[i].dot(at.point)) + off);
  }
  return hessian;
}

/// Does the region that holds the maximum lie in the chart of one body?
bool holds(const Cap& cap, double eta2, const SideHessian& side) {
  const double spread = in_inverse_norm(cap, side.stretch[0], side.stretch[1]);
  const double width = cap.width * side.h;
  return 4.0 * kMore * eta2 * spread <= width * width;
}

/// What the cap proves, its width and `least` given.
void prove(Cap& cap, const Hessian& hessian, const Gradient& gradient) {
  const double r0 = std::abs(gradient.rest[0]) + gradient.error;
  const double r1 = std::abs(gradient.rest[1]) + gradient.error;
  const double eta2 = kMore * in_inverse_norm(cap, r0 * r0, r1 * r1);
  cap.eta = std::sqrt(eta2);
  cap.height = 0.5 * kMore * eta2;
  const double tilt = in_inverse_norm(cap, 1.0, 1.0);
  cap.proven = holds(cap, eta2, hessian.a) && holds(cap, eta2, hessian.b) &&
               (gradient.value <= 0.0 || kMore * eta2 * tilt <= cap.width);
}

}  // namespace

Hessian difference_at(const SideAt& a, const SideAt& b, const Vec3& normal) noexcept {
  Vec3 e = normal.unitOrthogonal(), m = normal.cross(e).normalized();
  Roots of_a(a.side, e, m), of_b(b.side, e, m);
  DoubleDouble off;
  const auto turn = [&] {
    const Bending bend_a(a.side, of_a), bend_b(b.side, of_b);
    off = bend_a.em - bend_b.em;
    const double difference = 0.5 * ((bend_a.ee - bend_b.ee) - (bend_a.mm - bend_b.mm)).high;
    const double angle = 0.5 * std::atan2(off.high, difference);
    const double cosine = std::cos(angle), sine = std::sin(angle);
    of_a.turn(cosine, sine), of_b.turn(cosine, sine);
    const Vec3 before = e;
    e = cosine * before + sine * m;
    m = cosine * m - sine * before;
  };
  // The first turn leaves of what is off the diagonal a rounding, the second next to nothing.
  turn(), turn();
  const Bending bend_a(a.side, of_a), bend_b(b.side, of_b);
  const Vec3 tangent[2] = {e, m};
  Hessian found{{e, m},
                {(bend_a.ee - bend_b.ee).high, (bend_a.mm - bend_b.mm).high},
                0.0,
                side_hessian(a, of_a, bend_a, tangent),
                side_hessian(b, of_b, bend_b, tangent)};
  found.off =
      kMore * (std::abs((bend_a.em - bend_b.em).high) + 2.0 * (bend_a.error + bend_b.error) +
               kTurnError * std::max(std::abs(found.curvature[0]), std::abs(found.curvature[1])));
  return found;
}

Cap cap_within(const Hessian& hessian, const Gradient& gradient, double widest) noexcept {
  const double f = gradient.value;
  Cap cap;
  cap.width = std::min(widest, 0.5);
  double slack[2];
  for (int i = 0; i < 2; ++i) {
    // (N): of G without its width; what the width takes is half of it at most.
    slack[i] = (hessian.curvature[i] + f) - (hessian.off + 2.0 * kTurnError * std::abs(f));
    const double taken =
        hessian.a.curvature[i] + 2.0 * hessian.b.curvature[i] + 0.5 * std::max(f, 0.0);
    if (!(slack[i] > 0.0)) return cap;
    cap.width = std::min(cap.width, kLess * 0.25 * (slack[i] / taken));
  }
  for (int i = 0; i < 2; ++i) cap.least[i] = 0.5 * kLess * slack[i];
  if (cap.width > 0.0) prove(cap, hessian, gradient);
  return cap;
}

Cap cap_around(const Hessian& hessian, const Gradient& gradient, double widest) noexcept {
  const double f = gradient.value;
  const double keep = kLess - hessian.loss;
  const double least = std::min(hessian.curvature[0], hessian.curvature[1]) * keep;
  Cap cap;
  cap.width = f < 0.0 ? std::min(widest, std::sqrt(least / -f) - 1.0) : widest;
  if (!(keep > 0.5) || !(cap.width > 64.0 * kRoundings)) return cap;
  for (int i = 0; i < 2; ++i) {
    cap.least[i] = (hessian.curvature[i] * keep + std::max(f, 0.0)) / (1.0 + cap.width) +
                   kMore * std::min(f, 0.0);
    if (!(cap.least[i] > 0.0)) return cap;
  }
  prove(cap, hessian, gradient);
  return cap;
}

}  // namespace tangency::inline v0::detail
