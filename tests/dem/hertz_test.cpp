// SPDX-License-Identifier: GPL-3.0-or-later
//
// Hertz's and Mindlin's contacts against elliptic integrals and quadrature by GSL.
#include <gsl/gsl_integration.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include <tangency/dem/contact/hertz.hpp>
#include <tangency/dem/samples/sample.hpp>
#include <tangency/verify/oracles/elliptic.hpp>

#include "few_bodies.hpp"
#include "one_contact.hpp"

namespace {

using namespace tangency::dem;
using tangency::PrincipalCurvatures;
using tangency::Vec3;
using namespace tangency::testing;
using std::numbers::pi;
using namespace tangency::verify;

constexpr double kUnit = tangency::kUnitRoundoff;
constexpr Material kGlass{70e9, 0.24};

double relative(double value, double truth) { return std::abs(value / truth - 1.0); }

// dem/contact/hertz.hpp (1)
TEST(Hertz, OfEqualCurvaturesIsASpheres) {  // (1), (3)
  for (const double radius : {0.003, 1.0, 47.0}) {
    const double curvature[2] = {1.0 / radius, 1.0 / radius}, overlap = 0.01 * radius;
    const HertzContact contact = hertz_contact(curvature, overlap, kGlass);
    const double force =
        4.0 / 3.0 * kGlass.contact_modulus() * std::sqrt(radius) * std::pow(overlap, 1.5);
    const double a = std::sqrt(radius * overlap);
    // Some ten roundings on each side.
    EXPECT_LT(relative(contact.force, force), 16 * kUnit);
    EXPECT_LT(relative(contact.stiffness, 2.0 * kGlass.contact_modulus() * a), 16 * kUnit);
    for (const double semi_axis : contact.semi_axes) EXPECT_LT(relative(semi_axis, a), 16 * kUnit);
    for (const double shear : contact.shear_stiffness)
      EXPECT_LT(relative(shear, 4.0 * a * kGlass.shear_modulus() / (2.0 - 0.24)), 16 * kUnit);
  }
}

// dem/contact/hertz.hpp (2)
TEST(Hertz, ForceGoesWithOverlapToThreeHalves) {  // (2)
  const double curvature[2] = {3.7, 0.41};
  const HertzContact one = hertz_contact(curvature, 1e-3, kGlass);
  // A factor of 4 has an exact square root: no rounding differs.
  EXPECT_EQ(hertz_contact(curvature, 4e-3, kGlass).force, 8.0 * one.force);
  EXPECT_EQ(hertz_contact(curvature, 4e-3, kGlass).semi_axes[0], 2.0 * one.semi_axes[0]);
  for (const double factor : {0.3, 7.1, 1e6})
    EXPECT_LT(relative(hertz_contact(curvature, factor * 1e-3, kGlass).force,
                       std::pow(factor, 1.5) * one.force),
              8 * kUnit);
}

TEST(Hertz, StiffnessIsTheSlopeAndEnergyTheIntegralOfTheForce) {
  const double curvature[2] = {3.7, 0.41}, overlap = 1e-3, h = 1e-4 * overlap;
  const HertzContact at = hertz_contact(curvature, overlap, kGlass);
  const HertzContact above = hertz_contact(curvature, overlap + h, kGlass);
  const HertzContact below = hertz_contact(curvature, overlap - h, kGlass);
  // Of x^(3/2) and x^(5/2) central differences are off by h^2 / x^2 / 24 and by 5 h^2 / x^2 / 8,
  // and by the rounding of 1 over 2 h / x.
  EXPECT_LT(relative((above.force - below.force) / (2.0 * h), at.stiffness), 2e-8);
  EXPECT_LT(relative((above.energy - below.energy) / (2.0 * h), at.force), 2e-8);
}

// With k = b/a, e^2 = 1 - k^2 and the pressure p_0 = 3 P / (2 pi a b) in the middle, [Johnson1985,
// eq. 4.26-4.28] in K and E, while the header has D for both.
TEST(Hertz, EllipticContactsSolveJohnsonsEquations) {
  double worst = 0.0;
  for (const double m : {0.1, 0.5, 0.75, 0.96, 0.99, 0.9999}) {
    const double k = std::sqrt(1.0 - m), K = complete_elliptic_k(m), E = complete_elliptic_e(m);
    const double e_star = kGlass.contact_modulus(), a = 0.02, b = k * a, p0 = 1e8;
    // A and B of the gap A x^2 + B y^2 that such an ellipse belongs to.
    const double A = p0 / e_star * b / (m * a * a) * (K - E);
    const double B = p0 / e_star * b / (m * a * a) * (E / (k * k) - K);
    const double curvature[2] = {2.0 * B, 2.0 * A}, overlap = p0 * b * K / e_star;
    const HertzContact contact = hertz_contact(curvature, overlap, kGlass);
    // K - E loses 1 / m of the oracle's 1e-15.
    const double tight = 2e-14 / m;
    for (const double off : {relative(contact.semi_axes[0], a), relative(contact.semi_axes[1], b),
                             relative(contact.force, 2.0 * pi / 3.0 * a * b * p0)}) {
      EXPECT_LT(off, tight) << m;
      worst = std::max(worst, off);
    }
  }
  RecordProperty("worst", std::to_string(worst / kUnit) + " u");
}

TEST(Hertz, AxisRatioInvertsTheOraclesCurvatureRatio) {
  std::mt19937_64 random(20261122);
  for (int i = 0; i < 300; ++i) {
    // 1 - m exact, from near circles to long ellipses.
    const double m = i % 2 == 0 ? uniform(random) : 1.0 - std::exp2(-45.0 * uniform(random));
    const double k = std::sqrt(1.0 - m), K = complete_elliptic_k(m), D = complete_elliptic_d(m);
    const ContactEllipse ellipse = contact_ellipse((1.0 - m) * D / (K - D));
    EXPECT_LT(relative(ellipse.axis_ratio, k), 16 * kUnit * (1.0 - std::log(k))) << m;
    EXPECT_LT(relative(ellipse.K, K), 32 * kUnit) << m;
    EXPECT_LT(relative(ellipse.D, D), 32 * kUnit) << m;
  }
}

TEST(Hertz, NearLineContactsFollowTheLogarithm) {
  // K = ln(4/k) + O(k^2 ln k), D = K - 1: the ratio is k^2 (ln(4/k) - 1).
  for (const double ratio : {1e-18, 1e-40, 1e-100, 1e-200}) {
    const ContactEllipse ellipse = contact_ellipse(ratio);
    const double l = std::log(4.0 / ellipse.axis_ratio);
    EXPECT_LT(relative(ellipse.K, l), 32 * kUnit);
    const double k = ellipse.axis_ratio;
    EXPECT_LT(relative(k / std::sqrt(ratio) * std::sqrt(l - 1.0), 1.0),
              8 * kUnit * (1.0 - std::log(ratio)));
  }
}

/// ln(k^2 D / (K - D)) in long double, by the arithmetic-geometric mean (DLMF, section 19.8): D/K =
/// (1/2) sum over n of 2^n c_n^2 / c_0^2.
long double logarithm_of_ratio(long double k) {
  long double a = (1.0L + k) / 2, b = std::sqrt(k), c = (1.0L - k) / 2;
  long double part = (1.0L - k) / (4.0L * (1.0L + k)), sum = 1.0L, weight = 2.0L;
  while (weight * part > 0x1p-70L) {
    sum += weight * part;
    const long double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
    part *= c * c / (16.0L * a * a);
    c = c * c / (4.0L * a);
    weight *= 2.0L;
  }
  return 2.0L * std::log(k) + std::log(sum / (2.0L - sum));
}

TEST(Hertz, AxisRatioIsRightToAFewRoundingsDownTo1e300) {
  std::mt19937_64 random(20261130);
  double worst = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double depth = i % 2 == 0 ? 690.0 : 10.0;
    const double ratio = std::exp(-depth * std::pow(uniform(random), i % 4 < 2 ? 1 : 8));
    const long double k = contact_ellipse(ratio).axis_ratio;
    // ln(ratio) moves with ln k with a slope of 1.5 at least.
    const auto off = static_cast<double>((logarithm_of_ratio(k) - std::log(1.0L * ratio)) / 1.5L);
    EXPECT_LT(std::abs(off), 8 * kUnit) << ratio;
    worst = std::max(worst, std::abs(off));
  }
  RecordProperty("worst", std::to_string(worst / kUnit) + " u");
  EXPECT_GT(worst, 2 * kUnit);
}

// The energy is the least that any pressure gives: its slope by a curvature at a given overlap is
// what the pressure has where the surfaces part, the integral of p x^2 / 2 with its sign turned.
TEST(Hertz, EnergyFallsWithACurvatureAsThePressureSaysThereIs) {
  for (const double ratio : {0.9, 0.3, 0.01, 1e-5}) {
    const double overlap = 1e-3;
    const double curvature[2] = {2.0, 2.0 * ratio};
    const HertzContact at = hertz_contact(curvature, overlap, kGlass);
    for (const int j : {0, 1}) {
      double above[2] = {curvature[0], curvature[1]}, below[2] = {curvature[0], curvature[1]};
      const double h = 1e-5 * curvature[j];
      above[j] += h;
      below[j] -= h;
      const double slope = (hertz_contact(above, overlap, kGlass).energy -
                            hertz_contact(below, overlap, kGlass).energy) /
                           (2.0 * h);
      // curvature[1] is that along the longer axis; p of an ellipse has a mean x^2 of a^2/5.
      const double semi_axis = at.semi_axes[1 - j];
      // Of the third derivative, and of 1e-5 roundings.
      EXPECT_LT(relative(slope, -at.force * semi_axis * semi_axis / 10.0), 1e-8) << ratio;
    }
  }
}

/// Integral of f from a to b, singular at the ends at most like an inverse square root.
double integral(const std::function<double(double)>& f, double a, double b) {
  gsl_integration_workspace* const space = gsl_integration_workspace_alloc(200);
  const gsl_function wrapped{
      [](double x, void* at) { return (*static_cast<std::function<double(double)>*>(at))(x); },
      const_cast<std::function<double(double)>*>(&f)};
  double value = 0.0, error = 0.0;
  gsl_integration_qags(&wrapped, a, b, 0.0, 1e-9, 200, space, &value, &error);
  gsl_integration_workspace_free(space);
  return value;
}

/// How far a half-space of shear modulus 1 gives way along x at (x, y), under a unit force along
/// (c, s) spread over the ellipse a, b like (1 - x^2/a^2 - y^2/b^2)^(-1/2): Cerruti's solution
/// [Johnson1985, eq. 3.75a], of force and displacement along (c, s), in polar coordinates about
/// the point.
double give_way(double a, double b, double nu, double c, double s, double x, double y) {
  const auto along_ray = [&](double angle) {
    const double u = std::cos(angle), v = std::sin(angle);
    // 1 - (x + r u)^2/a^2 - (y + r v)^2/b^2 = alpha - 2 beta r - gamma r^2
    const double alpha = 1.0 - x * x / (a * a) - y * y / (b * b);
    const double beta = x * u / (a * a) + y * v / (b * b);
    const double gamma = u * u / (a * a) + v * v / (b * b);
    const double root = std::sqrt(beta * beta + alpha * gamma);
    const double edge = (root - beta) / gamma;
    // r = edge - t^2 takes the singularity at the edge away.
    const auto traction = [&](double t) {
      const double r = edge - t * t;
      return 2.0 / std::sqrt(gamma * (r + (root + beta) / gamma));
    };
    const double across = c * u + s * v;
    return (1.0 - nu + nu * across * across) * integral(traction, 0.0, std::sqrt(edge));
  };
  return integral(along_ray, 0.0, 2.0 * pi) / (2.0 * pi * a * b) / (2.0 * pi);
}

// dem/contact/hertz.hpp (3)
TEST(Mindlin, ShearStiffnessIsThatOfTheStampsTractionByQuadrature) {
  for (const double nu : {0.0, 0.24, 0.5})
    for (const double k : {1.0, 0.6, 0.1}) {
      const Material material{2.0 * (1.0 + nu), nu};  // G = 1
      // Curvatures whose ellipse has the ratio k.
      const double m = 1.0 - k * k, K = complete_elliptic_k(m), D = complete_elliptic_d(m);
      const double curvature[2] = {1.0, k * k * D / (K - D)};
      const HertzContact contact = hertz_contact(curvature, 1e-3, material);
      const auto [a, b] = contact.semi_axes;
      // The same all over the ellipse, both bodies give way, and the two axes differ.
      for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(0.5 * a, -0.3 * b)}) {
        EXPECT_LT(
            relative(2.0 * give_way(a, b, nu, 1.0, 0.0, x, y), 1.0 / contact.shear_stiffness[0]),
            1e-7);
        EXPECT_LT(
            relative(2.0 * give_way(a, b, nu, 0.0, 1.0, x, y), 1.0 / contact.shear_stiffness[1]),
            1e-7);
      }
    }
}

ContactLaw hertz_law(double mu) {
  ContactLaw law{1.0, 1.0, mu, 0.0};
  law.hertz = Material{1e6, 0.3};
  return law;
}

// Random ways in overlap and shear that come back to where they began: the work done on the contact
// is never less than what it stores more than before.
TEST(Mindlin, ShearNeverGainsEnergyInAClosedCycle) {
  std::mt19937_64 random(7);
  const Vec3 n = Vec3::UnitZ(), t = Vec3(0.6, 0.8, 0.0);
  const PrincipalCurvatures curvatures{{3.0, 0.5}, {Vec3::UnitX(), Vec3::UnitY()}};
  double least = 1e300, most = 0.0;
  for (int cycle = 0; cycle < 200; ++cycle) {
    const ContactLaw law = hertz_law(cycle % 2 == 0 ? 1e9 : 0.3);
    const double deep = 1e-3 * (1.0 + uniform(random)), shallow = deep * uniform(random);
    const double shear = 3e-4 * uniform(random);
    ShearState state;
    double overlap = shallow, work = 0.0, lost = 0.0;
    const auto go = [&](double to, double moved) {
      constexpr int steps = 50;
      const double from = overlap;
      for (int k = 1; k <= steps; ++k) {
        overlap = from + (to - from) * k / steps;
        const Vec3 step = moved / steps * t, before = state.force;
        lost += shear_step(law, state, {n, n, step}, law.hertz_response(overlap, curvatures));
        work -= 0.5 * (before + state.force).dot(step);
      }
    };
    go(deep, 0.0);
    go(deep, shear);  // out where it is stiff, and back where it is soft
    go(shallow, 0.0);
    go(shallow, -shear);
    EXPECT_NEAR(lost, work - state.energy, 200 * 16 * kUnit * std::abs(work));
    EXPECT_GT(lost, 0.0);
    EXPECT_GT(work, 0.0) << "the cycle gave work away";
    least = std::min(least, work);
    most = std::max(most, work);
  }
  EXPECT_GT(most, 10.0 * least);
}

TEST(Mindlin, UnloadingTakesShearForceDownWithItsStiffness) {
  const PrincipalCurvatures curvatures{{2.0, 2.0}, {Vec3::UnitX(), Vec3::UnitY()}};
  const ContactLaw law = hertz_law(1e9);
  const Vec3 n = Vec3::UnitZ();
  ShearState state;
  shear_step(law, state, {n, n, Vec3(1e-5, 0.0, 0.0)}, law.hertz_response(4e-3, curvatures));
  const Vec3 sheared = state.force;
  ASSERT_GT(sheared.norm(), 0.0);
  // Half the radius of contact, half the stiffness, half the force; loading leaves it.
  const double lost =
      shear_step(law, state, {n, n, Vec3::Zero()}, law.hertz_response(1e-3, curvatures));
  EXPECT_LT((state.force - 0.5 * sheared).norm(), 8 * kUnit * sheared.norm());
  EXPECT_GT(lost, 0.0);
  shear_step(law, state, {n, n, Vec3::Zero()}, law.hertz_response(4e-3, curvatures));
  EXPECT_LT((state.force - 0.5 * sheared).norm(), 8 * kUnit * sheared.norm());
}

const Vec3 kAxes(1.5, 1.0, 0.7);

/// A pair of equal ellipsoids (or one on a wall), overlapping along the body axis `along`, the
/// second turned about it; sheared along `direction` by 1e-6.
struct TwoOfGlass : FewBodies {
  TwoOfGlass(int along, double turn, const Vec3& direction) : FewBodies(hertz_law(1e9)) {
    const Vec3 centre = Vec3::Constant(50.0), n = Vec3::Unit(along);
    add(centre, Eigen::Quaterniond::Identity(), kAxes);
    add(centre + (2.0 * kAxes[along] - 1e-3) * n, Eigen::Quaterniond(Eigen::AngleAxisd(turn, n)),
        kAxes, direction);
    update(1e-6);
  }
  HertzContact theory(double larger, double smaller) const {
    const double curvature[2] = {larger, smaller};
    return hertz_contact(curvature, contact().overlap, *laws.law[0].hertz);
  }
  double shear_stiffness() const { return contact().shear.force.norm() / 1e-6; }
};

// At the end of axis k the curvature along axis j is a_k / a_j^2.
TEST(HertzContact, OfEllipsoidsEndToEndHasTheCurvaturesOfTheirEnds) {
  const double along_y = 2.0 * 1.5 / (1.0 * 1.0), along_z = 2.0 * 1.5 / (0.7 * 0.7);
  const TwoOfGlass y(0, 0.0, Vec3::UnitY()), z(0, 0.0, Vec3::UnitZ());
  const HertzContact theory = y.theory(along_z, along_y);
  EXPECT_LT(relative(y.contact().overlap, 1e-3), 100.0 * kUnit / 1e-3);  // of places at 50
  EXPECT_LT(relative(y.contact().normal_force, theory.force), 1e-13);
  EXPECT_LT(relative(y.contact().normal_stiffness, theory.stiffness), 1e-13);
  // The ellipse is long where the curvature is small.
  EXPECT_LT(relative(y.shear_stiffness(), theory.shear_stiffness[0]), 1e-12);
  EXPECT_LT(relative(z.shear_stiffness(), theory.shear_stiffness[1]), 1e-12);
  EXPECT_GT(theory.shear_stiffness[1], 1.02 * theory.shear_stiffness[0]);
}

TEST(HertzContact, OfEllipsoidsSideToSideHasTheCurvaturesOfTheirSides) {
  const double along_x = 0.7 / (1.5 * 1.5), along_y = 0.7 / (1.0 * 1.0);
  const TwoOfGlass parallel(2, 0.0, Vec3::UnitX()), crossed(2, 0.5 * pi, Vec3::UnitX());
  EXPECT_LT(relative(parallel.contact().normal_force,
                     parallel.theory(2.0 * along_y, 2.0 * along_x).force),
            1e-13);
  // Crossed, they touch in a circle.
  const HertzContact circle = crossed.theory(along_x + along_y, along_x + along_y);
  EXPECT_LT(relative(crossed.contact().normal_force, circle.force), 1e-13);
  EXPECT_LT(relative(crossed.shear_stiffness(), circle.shear_stiffness[0]), 1e-12);
}

TEST(HertzContact, OfAnEllipsoidOnAWallHasItsOwnCurvature) {
  FewBodies body(hertz_law(0.0));
  body.cell = Cell::box(Vec3::Constant(100.0), 3, {false, false, true});
  body.add({50.0, 50.0, 0.7 - 1e-3}, Eigen::Quaterniond::Identity(), kAxes);
  body.update();
  ASSERT_EQ(body.touching(), 1u);
  const double curvature[2] = {0.7, 0.7 / 2.25};
  const HertzContact theory =
      hertz_contact(curvature, body.contact().overlap, *body.laws.law[0].hertz);
  EXPECT_LT(relative(body.contact().normal_force, theory.force), 1e-13);
}

TEST(HertzContact, OfSpheresOfTwoSizesHasTheHarmonicRadius) {
  FewBodies pair(hertz_law(0.0));
  pair.add({50.0, 50.0, 50.0}, Eigen::Quaterniond::Identity(), Vec3::Constant(1.0));
  pair.add({52.999, 50.0, 50.0}, Eigen::Quaterniond::Identity(), Vec3::Constant(2.0));
  pair.update();
  const double force = 4.0 / 3.0 * pair.laws.law[0].hertz->contact_modulus() *
                       std::sqrt(2.0 / 3.0) * std::pow(pair.contact().overlap, 1.5);
  EXPECT_LT(relative(pair.contact().normal_force, force), 16 * kUnit);
}

}  // namespace
