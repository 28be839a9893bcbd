// SPDX-License-Identifier: MIT
#include <tangency/geometry/normals/newton.hpp>

#include <cmath>

#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/normals/perram_wertheim.hpp>
#include <tangency/geometry/numbers/two_lanes.hpp>

namespace tangency::inline v0::detail {
namespace {

constexpr int kNewtonSteps = 12;    // measured: ordinary pairs need 2 or 3
constexpr double kShort = 0x1p-12;  // of |step|^2; chosen: the old Hessian serves once more
constexpr int kOldSteps = 3;        // chosen
// One more step is left. Of |step|^2 with the Hessian at the normal, and of |first|^4 |step|^2 with
// an old one, where the next will be a few times |step|^2 and |first| |step|. Measured: what
// prove_gap_and_step() then calls close, but for one pair of five to thirty.
constexpr double kLastButOne = 0x1p-27, kLastButOneOld = 0x1p-76;

/// 1 / sqrt(h2), within 4 u: the root and the reciprocal do not wait for each other.
TwoLanes inverse_root(const TwoLanes& h2, const TwoLanes& inverse2) noexcept {
  return sqrt(h2) * inverse2;
}

/// The steps of both searches. Inlined in each, whose `nearly` the compiler knows.
[[gnu::always_inline]] inline NearlyStationary search(const Ellipsoid& a, const Ellipsoid& b,
                                                      const Vec3& d, const Vec3& normal,
                                                      bool nearly) noexcept {
  const TwoLanesSymmetric3 shapes(a.shape(), b.shape());
  const TwoLanesSymmetric3 adjugates(a.shape_adjugate(), b.shape_adjugate());
  const Symmetric3 mixed = mixed_adjugate(a.shape_adjugate(), b.shape_adjugate());
  const TwoLanes determinants{a.shape_determinant(), b.shape_determinant()};
  const double finest =
      nearly ? 0.0 : kUnitRoundoff * (d.norm() + (a.largest_semi_axis() + b.largest_semi_axis()));
  Vec3 n = normal;
  for (int round = 0; round < kNewtonSteps; ++round) {
    // The tangent Hessian K = H + gap I has adj H = P j P on the tangent plane. Its determinant and
    // trace are kappa + gap tau + gap^2 and tau + 2 gap, where kappa = n' adj(j) n and adj(J) =
    // det(M) M.
    const TwoLanesVec3 m = shapes * n;
    const TwoLanes h2 = dot(m, n);
    const double mixed_form = mixed.form(n);
    const TwoLanes inverse2 = 1.0 / h2, inverse = inverse_root(h2, inverse2);
    const TwoLanes w = inverse * inverse2;
    const Vec3 rest = d - (m * inverse).sum();
    const double gap = n.dot(rest);
    const Symmetric3 j = weighted_sum(adjugates, w);
    const Vec3 jn = j * n;
    const double tau = j.trace() - n.dot(jn);
    const double kappa = sum(determinants * (inverse2 * inverse2)) + w[0] * w[1] * mixed_form;
    const double determinant = kappa + gap * (tau + gap);
    if (!(determinant > 0.0) || !(tau + 2.0 * gap > 0.0)) return {{n, false}, NewtonStep()};
    NewtonStep step{j, jn, gap, 1.0 / determinant, 0.0};
    Vec3 move = step(rest - gap * n, n);
    const double square = move.squaredNorm();
    step.turned = square;
    // A Newton step squares the way that is left.
    if (nearly ? square <= kLastButOne : rest.dot(move) <= finest)
      return {{renormalised(n + move), true}, step};
    if (square > kShort) {
      n = (n + move).normalized();
      continue;
    }
    // Steps with the old Hessian: each leaves of the way about the length of the first.
    for (int again = 0; again < kOldSteps; ++again) {
      n += move;
      const TwoLanesVec3 there = shapes * n;
      const TwoLanes there2 = dot(there, n);
      const Vec3 beyond = d - (there * inverse_root(there2, 1.0 / there2)).sum();
      move = step(beyond - n.dot(beyond) * n, n);
      const bool close = nearly ? square * square * move.squaredNorm() <= kLastButOneOld
                                : std::abs(beyond.dot(move)) <= finest;
      if (close) return {{renormalised(n + move), true}, step};
    }
    n = renormalised(n + move);
  }
  return {{n, false}, NewtonStep()};
}

}  // namespace

Stationary newton_from(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                       const Vec3& normal) noexcept {
  return search(a, b, d, normal, false);
}

NearlyStationary newton_near(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                             const Vec3& normal) noexcept {
  return search(a, b, d, normal, true);
}

Vec3 newton_start(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept {
  const PerramWertheimForm form(a, b, d);
  const Vec3 n = form.normal_direction(form.maximise(kPerramWertheimSteps));
  const double square = n.squaredNorm();
  return n * (std::sqrt(square) * (1.0 / square));  // neither waits for the other
}

}  // namespace tangency::inline v0::detail
