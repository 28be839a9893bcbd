// SPDX-License-Identifier: MIT
#include <tangency/geometry/methods/gap_newton.hpp>

#include <cmath>

#include <tangency/geometry/methods/both.hpp>
#include <tangency/geometry/methods/perram_wertheim.hpp>

namespace tangency::methods {
namespace {

constexpr int kPerramWertheimSteps = 2;  // measured: more do not shorten what follows
constexpr int kNewtonSteps = 12;         // measured: ordinary pairs need 2 or 3
constexpr double kShort = 0x1p-12;       // of |step|^2; chosen: the old Hessian serves once more
constexpr int kOldSteps = 3;             // chosen
// Of the size, twice a gain; measured: after a Newton step that gained so little the next would
// gain less than rounding, for ordinary shapes.
constexpr double kSquared = 0x1p-27;

/// d - x_A - x_B at a normal of any length, and the support functions.
struct Rest {
  Both h;
  Vec3 rest;
};

Rest rest_at(const BothSymmetric3& shapes, const Vec3& d, const Vec3& n) noexcept {
  const BothVec3 m = shapes * n;
  const Both h = sqrt(dot(m, n));
  return {h, d - (m * (1.0 / h)).sum()};
}

/// n / |n| for |n| near 1.
Vec3 renormalised(const Vec3& n) noexcept {
  const double x = n.squaredNorm() - 1.0;
  if (!(std::abs(x) < 0x1p-10)) return n.normalized();
  // 1 / sqrt(1 + x) by its series, to below rounding.
  return n * (1.0 - x * (0.5 - x * (0.375 - x * (0.3125 - x * (0.2734375 - x * 0.24609375)))));
}

}  // namespace

Stationary newton_from(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, const Vec3& normal,
                       Finish finish) noexcept {
  const BothSymmetric3 shapes(a.shape(), b.shape());
  const double size = d.norm() + a.largest_semi_axis() + b.largest_semi_axis();
  const double finest = 0x1p-53 * size;
  const double enough = finish == Finish::early ? kSquared * size : finest;
  Vec3 n = normal;
  for (int step = 0; step < kNewtonSteps; ++step) {
    const auto [h, rest] = rest_at(shapes, d, n);
    // The tangent Hessian of -(n.d - h_A - h_B) is H + gap I with adj H = P j P on the tangent
    // plane; its determinant and trace are kappa + gap tau + gap^2 and tau + 2 gap.
    const Both w = 1.0 / (h * h * h);
    const Symmetric3 j = a.shape_adjugate() * w[0] + b.shape_adjugate() * w[1];
    const Vec3 jn = j * n;
    const double njn = n.dot(jn), gap = n.dot(rest);
    const double tau = j.trace() - njn;
    const double kappa = 0.5 * (tau * tau - trace_of_product(j, j) - njn * njn) + jn.squaredNorm();
    const double determinant = kappa + gap * (tau + gap);
    if (!(determinant > 0.0) || !(tau + 2.0 * gap > 0.0)) return {n, false};
    const double scale = 1.0 / determinant;
    // (P j r + gap r) / determinant
    const auto newton_step = [&, n = n](const Vec3& r) -> Vec3 {
      const Vec3 jr = j * r;
      return scale * (jr - n.dot(jr) * n + gap * r);
    };
    Vec3 move = newton_step(rest - gap * n);
    const double square = move.squaredNorm();
    if (rest.dot(move) <= enough) return {renormalised(n + move), true};
    if (square > kShort) {
      n = (n + move).normalized();
      continue;
    }
    // Steps with the old Hessian: each leaves of the way about the length of the first.
    for (int again = 0; again < kOldSteps; ++again) {
      n += move;
      const Vec3 beyond = rest_at(shapes, d, n).rest;
      move = newton_step(beyond - n.dot(beyond) / n.squaredNorm() * n);
      if (std::abs(beyond.dot(move)) * (finish == Finish::early ? square : 1.0) <= finest)
        return {renormalised(n + move), true};
    }
    n = renormalised(n + move);
  }
  return {n, false};
}

Stationary newton(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, Finish finish) noexcept {
  const PerramWertheimForm form(a, b, d);
  const double l = form.maximise(kPerramWertheimSteps);
  return newton_from(a, b, d, form.normal_direction(l).normalized(), finish);
}

}  // namespace tangency::methods
