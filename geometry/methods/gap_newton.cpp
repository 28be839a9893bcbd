// SPDX-License-Identifier: MIT
#include <tangency/geometry/methods/gap_newton.hpp>

#include <cmath>

#include <tangency/geometry/methods/perram_wertheim.hpp>

namespace tangency::methods {
namespace {

constexpr int kPerramWertheimSteps = 4;  // measured: more do not shorten what follows
constexpr int kNewtonSteps = 12;         // measured: ordinary pairs need 2 to 4

/// n' adj(S) n
double adjugate_form(const Symmetric3& s, const Vec3& n) { return adjugate(s).form(n); }

}  // namespace

Stationary newton_from(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d,
                       const Vec3& normal) noexcept {
  Vec3 n = normal;
  const double size = d.norm() + a.largest_semi_axis() + b.largest_semi_axis();
  const double enough = 0x1p-54 * size;  // a gain below half an ulp of the lengths that are added
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Vec3 ma = a.shape() * n, mb = b.shape() * n;
    const double ha = std::sqrt(n.dot(ma)), hb = std::sqrt(n.dot(mb));
    const Vec3 rest = d - ma / ha - mb / hb;
    const double gap = n.dot(rest);
    const Vec3 r = rest - gap * n;
    // The tangent Hessian of -(n.d - h_A - h_B) is H + gap I with adj H = P jc P on the tangent
    // plane; its determinant and trace are kappa + gap tau + gap^2 and tau + 2 gap.
    const Symmetric3 jc =
        a.shape_adjugate() * (1.0 / (ha * ha * ha)) + b.shape_adjugate() * (1.0 / (hb * hb * hb));
    const double tau = jc.trace() - jc.form(n);
    const double determinant = adjugate_form(jc, n) + gap * (tau + gap);
    if (!(determinant > 0.0) || !(tau + 2.0 * gap > 0.0)) return {n, false};
    const Vec3 jr = jc * r;
    const Vec3 delta = (jr - n.dot(jr) * n + gap * r) / determinant;
    n = (n + delta).normalized();
    if (0.5 * r.dot(delta) <= enough) return {n, n.allFinite()};
  }
  return {n, false};
}

Stationary newton(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept {
  const PerramWertheimForm form(a, b, d);
  const double l = form.maximise(kPerramWertheimSteps);
  return newton_from(a, b, d, form.normal_direction(l).normalized());
}

}  // namespace tangency::methods
