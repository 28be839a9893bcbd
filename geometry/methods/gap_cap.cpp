// SPDX-License-Identifier: MIT
#include <tangency/geometry/methods/gap_cap.hpp>

#include <algorithm>
#include <cmath>

namespace tangency::methods {
namespace {

/// diag(a2 a3, a3 a1, a1 a2) R' m / h^1.5, whose square is hessian_along().
Vec3 hessian_root(const Ellipsoid& body, double h, const Vec3& m) {
  const Vec3& a = body.semi_axes();
  const Vec3 products(a[1] * (a[2] / h), a[2] * (a[0] / h), a[0] * (a[1] / h));
  return products.cwiseProduct(body.rotation().transpose() * m) / std::sqrt(h);
}

double stretch(const Ellipsoid& body, const Vec3& e) {
  return body.semi_axes().cwiseProduct(body.rotation().transpose() * e).squaredNorm();
}

}  // namespace

Bend bend_at(const Ellipsoid& a, const Ellipsoid& b, const Vec3& normal, double h_a,
             double h_b) noexcept {
  Vec3 e = normal.unitOrthogonal(), m = normal.cross(e).normalized();
  Eigen::Matrix<double, 6, 1> root_e, root_m;
  const auto take_roots = [&] {
    root_e << hessian_root(a, h_a, m), hessian_root(b, h_b, m);
    root_m << hessian_root(a, h_a, -e), hessian_root(b, h_b, -e);
  };
  // A Jacobi rotation of the tangents makes their roots orthogonal but for rounding, so that a
  // small curvature beside a large one is not lost; a second one takes what rounding left.
  for (int sweep = 0; sweep < 2; ++sweep) {
    take_roots();
    const double difference = 0.5 * (root_e.squaredNorm() - root_m.squaredNorm());
    const double angle = 0.5 * std::atan2(root_e.dot(root_m), difference);
    const Vec3 turned = std::cos(angle) * e + std::sin(angle) * m;
    e = (turned - turned.dot(normal) * normal).normalized();
    m = normal.cross(e).normalized();
  }
  take_roots();
  const auto side = [&](const Ellipsoid& body, double h, const Vec3& re, const Vec3& rm) {
    return SideBend{h, {re.squaredNorm(), rm.squaredNorm()}, {stretch(body, e), stretch(body, m)}};
  };
  return {{e, m},
          {root_e.squaredNorm(), root_m.squaredNorm()},
          std::abs(root_e.dot(root_m)) / (root_e.norm() * root_m.norm()),
          side(a, h_a, root_e.head<3>(), root_m.head<3>()),
          side(b, h_b, root_e.tail<3>(), root_m.tail<3>())};
}

double hessian_along(const Ellipsoid& body, double h, const Vec3& m) noexcept {
  return hessian_root(body, h, m).squaredNorm();
}

Cap cap_around(const Bend& bend, const Slope& slope, double widest) noexcept {
  const double f = slope.value;
  // A tangent is off by rounding, of which the larger curvature shows in the smaller.
  const double mixed = 0x1p-48 * std::sqrt(std::max(bend.curvature[0] / bend.curvature[1],
                                                    bend.curvature[1] / bend.curvature[0]));
  const double keep = kLess - bend.skew - mixed;
  const double least = std::min(bend.curvature[0], bend.curvature[1]) * keep;
  Cap cap;
  cap.width = f < 0.0 ? std::min(widest, std::sqrt(least / -f) - 1.0) : widest;
  if (!(keep > 0.5) || !(cap.width > 64.0 * kRoundings)) return cap;
  for (int i = 0; i < 2; ++i) {
    cap.least[i] = (bend.curvature[i] * keep + std::max(f, 0.0)) / (1.0 + cap.width) +
                   kMore * std::min(f, 0.0);
    if (!(cap.least[i] > 0.0)) return cap;
  }
  const double r0 = std::abs(slope.rest[0]) + slope.error;
  const double r1 = std::abs(slope.rest[1]) + slope.error;
  const double eta2 = kMore * in_inverse_norm(cap, r0 * r0, r1 * r1);
  cap.eta = std::sqrt(eta2);
  cap.height = 0.5 * kMore * eta2;
  const auto holds = [&](const SideBend& side) {
    const double spread = in_inverse_norm(cap, side.stretch[0], side.stretch[1]);
    const double width = cap.width * side.h;
    return 4.0 * kMore * eta2 * spread <= width * width;
  };
  const double tilt = in_inverse_norm(cap, 1.0, 1.0);
  cap.proven = holds(bend.a) && holds(bend.b) && (f <= 0.0 || kMore * eta2 * tilt <= cap.width);
  return cap;
}

}  // namespace tangency::methods
