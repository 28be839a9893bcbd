// SPDX-License-Identifier: MIT
#include <tangency/dem/contact/contact_law.hpp>

#include <cmath>
#include <numbers>

#include <tangency/dem/lanes/elementary.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Steps of a bisection after which its bounds are neighbours: 53 and those of the first exponent.
constexpr int kBisections = 60;

/// The place in [low, high] where a function that grows reaches `wanted`.
template <class F>
double bisected(double low, double high, double wanted, const F& f) {
  for (int step = 0; step < kBisections; ++step) {
    const double middle = 0.5 * (low + high);
    (f(middle) < wanted ? low : high) = middle;
  }
  return low;
}

/// -ln e of a law with zeta = (w + 1/w) / 2, w > 1: 2 h / tanh h with w = exp h.
double lost_by_creep(double w) {
  return 2.0 * logarithm(w) * (w * w + 1.0) / ((w - 1.0) * (w + 1.0));
}

}  // namespace

double damping_ratio_of(double restitution) {
  if (!(restitution < 1.0)) return 0.0;
  // -ln e is 2 t / tan t with zeta = cos t, from 0 at a right angle to 2 at 0; beyond it goes on as
  // 2 h / tanh h with zeta = cosh h, here by w = exp h.
  const double lost = -logarithm(restitution);
  if (lost < 2.0) {
    const double right = 0.5 * std::numbers::pi;
    const double t = bisected(0.0, right, lost, [&](double complement) {
      const CosineSine of = cosine_sine(right - complement);
      return 2.0 * (right - complement) * of.cosine / of.sine;
    });
    return cosine_sine(right - t).cosine;
  }
  constexpr double largest = 16.0;  // -ln e is 5.6 there
  const double w = bisected(1.0, largest, lost, lost_by_creep);
  return 0.5 * (w + 1.0 / w);
}

double ContactLaw::restitution() const {
  if (!dissipates()) return 1.0;
  const double z = damping_ratio, root = std::sqrt(std::abs((1.0 - z) * (1.0 + z)));
  double lost = 2.0;  // -ln e, as damping_ratio_of() has it
  if (z < 1.0) {
    const double right = 0.5 * std::numbers::pi;
    const double t = right - bisected(0.0, right, z, [](double x) { return cosine_sine(x).sine; });
    lost = 2.0 * z * t / root;
  } else if (z > 1.0) {
    lost = lost_by_creep(z + root);
  }
  return bisected(0.0, 1.0, -lost, logarithm);
}

NormalResponse ContactLaw::hertz_response(double overlap,
                                          const PrincipalCurvatures& relative) const {
  const HertzContact contact = hertz_contact(relative.curvature, overlap, *hertz);
  return {contact.force,
          contact.stiffness,
          contact.energy,
          {contact.shear_stiffness[0], contact.shear_stiffness[1], relative.direction[1]}};
}

}  // namespace tangency::inline v0::dem
