// SPDX-License-Identifier: MIT
#include <tangency/geometry/normals/newton.hpp>

#include <cmath>

#include <tangency/geometry/normals/perram_wertheim.hpp>
#include <tangency/geometry/numbers/two_lanes.hpp>

namespace tangency::inline v0::detail {
namespace {

constexpr int kNewtonSteps = 12;         // measured: ordinary pairs need 2 or 3
constexpr double kShort = 0x1p-12;       // of |step|^2; chosen: the old Hessian serves once more
constexpr int kOldSteps = 3;             // chosen
constexpr double kClose = 0x1p-39;  // rad; chosen: normals are worth more than the gap alone needs

/// n / |n| for |n| near 1.
Vec3 renormalised(const Vec3& n) noexcept {
  const double x = n.squaredNorm() - 1.0;
  if (!(std::abs(x) < 0x1p-18)) return n.normalized();
  return n * (1.0 - x * (0.5 - 0.375 * x));  // the series of 1 / sqrt(1 + x), to below rounding
}

}  // namespace

Stationary newton_from(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d, const Vec3& normal,
                       Finish finish) noexcept {
  const TwoLanesSymmetric3 shapes(a.shape(), b.shape());
  const TwoLanesSymmetric3 adjugates(a.shape_adjugate(), b.shape_adjugate());
  const Symmetric3 mixed = mixed_adjugate(a.shape_adjugate(), b.shape_adjugate());
  const TwoLanes traces{a.shape_adjugate().trace(), b.shape_adjugate().trace()};
  const TwoLanes determinants{a.shape_determinant(), b.shape_determinant()};
  const double finest =
      kUnitRoundoff * (d.norm() + (a.largest_semi_axis() + b.largest_semi_axis()));
  const bool early = finish == Finish::early;
  Vec3 n = normal;
  for (int step = 0; step < kNewtonSteps; ++step) {
    // The tangent Hessian of -(n.d - h_A - h_B) is H + gap I with adj H = P j P on the tangent
    // plane, j = J_A / h_A^3 + J_B / h_B^3. Its determinant and trace are kappa + gap tau + gap^2
    // and tau + 2 gap, where kappa = n' adj(j) n and adj(J) = det(M) M.
    const TwoLanesVec3 m = shapes * n;
    const TwoLanes h2 = dot(m, n), njn = dot(adjugates * n, n);
    const double mixed_form = mixed.form(n);
    const TwoLanes inverse = 1.0 / sqrt(h2), inverse2 = inverse * inverse, w = inverse * inverse2;
    const Vec3 rest = d - (m * inverse).sum();
    const double gap = n.dot(rest);
    const double tau = sum(w * (traces - njn));
    const double kappa = sum(determinants * (inverse2 * inverse2)) + w[0] * w[1] * mixed_form;
    const double determinant = kappa + gap * (tau + gap);
    if (!(determinant > 0.0) || !(tau + 2.0 * gap > 0.0)) return {n, false};
    const double scale = 1.0 / determinant;
    // (P j r + gap r) / determinant at `at`, near n.
    const auto newton_step = [&](const Vec3& r, const Vec3& at) -> Vec3 {
      const Vec3 jr = (adjugates * r * w).sum();
      return scale * (jr - at.dot(jr) * at + gap * r);
    };
    Vec3 move = newton_step(rest - gap * n, n);
    const double square = move.squaredNorm();
    // A Newton step squares the way that is left.
    if (early ? square <= kClose : rest.dot(move) <= finest) return {renormalised(n + move), true};
    if (square > kShort) {
      n = (n + move).normalized();
      continue;
    }
    // Steps with the old Hessian: each leaves of the way about the length of the first.
    for (int again = 0; again < kOldSteps; ++again) {
      n += move;
      const TwoLanesVec3 there = shapes * n;
      const Vec3 beyond = d - (there * (1.0 / sqrt(dot(there, n)))).sum();
      move = newton_step(beyond - n.dot(beyond) * n, n);
      const bool close = early ? square * move.squaredNorm() <= kClose * kClose
                               : std::abs(beyond.dot(move)) <= finest;
      if (close) return {renormalised(n + move), true};
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

}  // namespace tangency::inline v0::detail
