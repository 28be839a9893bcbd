// SPDX-License-Identifier: GPL-3.0-or-later
//
// Elliptic integrals and functions against values worked out by hand and against their identities.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include <tangency/verify/oracles/elliptic.hpp>
#include <tangency/verify/oracles/quadrature.hpp>

namespace tangency::verify {
namespace {

using std::numbers::pi;

// Of values about 1 and of what is computed from a few of them.
constexpr double kTight = 4e-15;

double relative(double value, double truth) { return std::abs(value / truth - 1); }

// Parameters of [0, 1), half of them with a small m or 1 - m.
class Parameters {
 public:
  double operator()() {
    const double m = uniform_(random_), small = std::exp2(-50 * m);
    switch (turn_++ % 4) {
      case 0:
        return small;
      case 1:
        return 1 - small;
      default:
        return m;
    }
  }
  double uniform() { return uniform_(random_); }

 private:
  std::mt19937_64 random_{20261122};
  std::uniform_real_distribution<double> uniform_{0x1p-50, 1};
  int turn_ = 0;
};

TEST(Elliptic, CompleteIntegralsAreThoseKnownByGammaFunctions) {
  const double gamma = std::tgamma(0.25), k = gamma * gamma / (4 * std::sqrt(pi));
  EXPECT_LT(relative(complete_elliptic_k(0), pi / 2), kTight);
  EXPECT_LT(relative(complete_elliptic_e(0), pi / 2), kTight);
  EXPECT_LT(relative(complete_elliptic_d(0), pi / 4), kTight);
  EXPECT_LT(relative(complete_elliptic_k(0.5), k), kTight);
  EXPECT_LT(relative(complete_elliptic_e(0.5), k / 2 + pi / (4 * k)), kTight);
  EXPECT_LT(relative(complete_elliptic_k(-1), k / std::sqrt(2.0)), kTight);
  // Where K(1-m) / K(m) is sqrt 3: m = (2 - sqrt 3) / 4.
  const double m = (2 - std::sqrt(3.0)) / 4;
  EXPECT_LT(relative(complete_elliptic_k(1 - m), std::sqrt(3.0) * complete_elliptic_k(m)), kTight);
  EXPECT_EQ(complete_elliptic_e(1), 1);
}

TEST(Elliptic, NearTheSingularityKIsALogarithmAndDAtNoneSmall) {
  // K = ln(4/k') + (ln(4/k') - 1) k'^2 / 4 + ..., D = pi/4 (1 + 3/8 m + ...).
  const double l = std::log(4 / 0x1p-20);
  EXPECT_LT(relative(complete_elliptic_k(1 - 0x1p-40), l + (l - 1) * 0x1p-42), kTight);
  EXPECT_LT(relative(complete_elliptic_d(0x1p-30), pi / 4 * (1 + 0.375 * 0x1p-30)), kTight);
}

TEST(Elliptic, CompleteIntegralsKeepLegendresRelation) {  // (1), (2)
  Parameters draw;
  for (int i = 0; i < 400; ++i) {
    const double m = draw(), k = complete_elliptic_k(m), e = complete_elliptic_e(m);
    if (1 - (1 - m) == m) {
      const double k1 = complete_elliptic_k(1 - m), e1 = complete_elliptic_e(1 - m);
      EXPECT_NEAR(e * k1 + e1 * k - k * k1, pi / 2, kTight * k * k1) << m;
    }
    EXPECT_NEAR(k - e, m * complete_elliptic_d(m), kTight * k) << m;
  }
}

TEST(Elliptic, JacobisFunctionsAreTrigonometricAndHyperbolicAtTheEnds) {
  for (const double u : {-3.0, -0.5, 0.0, 0.7, 2.5, 40.0}) {
    const JacobiElliptic circle = jacobi_elliptic(u, 0), line = jacobi_elliptic(u, 1);
    EXPECT_NEAR(circle.sn, std::sin(u), kTight * (1 + std::abs(u)));
    EXPECT_NEAR(circle.cn, std::cos(u), kTight * (1 + std::abs(u)));
    EXPECT_EQ(circle.dn, 1);
    EXPECT_NEAR(line.sn, std::tanh(u), kTight);
    EXPECT_NEAR(line.cn, 1 / std::cosh(u), kTight);
    EXPECT_NEAR(line.dn, 1 / std::cosh(u), kTight);
  }
}

TEST(Elliptic, JacobisFunctionsAtQuarterAndHalfTheQuarterPeriod) {  // (3)
  Parameters draw;
  for (int i = 0; i < 400; ++i) {
    const double m = draw(), k = complete_elliptic_k(m), root = std::sqrt(1 - m);
    const JacobiElliptic quarter = jacobi_elliptic(k, m), half = jacobi_elliptic(k / 2, m);
    const double tight = kTight * k;
    EXPECT_NEAR(quarter.sn, 1, tight);
    EXPECT_NEAR(quarter.cn, 0, tight);
    EXPECT_NEAR(quarter.dn, root, tight);
    EXPECT_NEAR(half.sn, 1 / std::sqrt(1 + root), tight);
    EXPECT_NEAR(half.dn, std::sqrt(root), tight);
    const double u = 4 * draw.uniform() - 2;
    const JacobiElliptic here = jacobi_elliptic(u, m), later = jacobi_elliptic(u + 4 * k, m);
    EXPECT_NEAR(later.sn, here.sn, 8 * tight);
    EXPECT_NEAR(later.cn, here.cn, 8 * tight);
    EXPECT_NEAR(jacobi_elliptic(u + 2 * k, m).dn, here.dn, 8 * tight);
    EXPECT_NEAR(here.sn * here.sn + here.cn * here.cn, 1, kTight);
    EXPECT_NEAR(here.dn * here.dn + m * here.sn * here.sn, 1, kTight);
  }
}

TEST(Elliptic, JacobisFunctionsInvertTheIncompleteIntegral) {  // (4)
  Parameters draw;
  for (int i = 0; i < 400; ++i) {
    const double m = draw(), phi = pi * (draw.uniform() - 0.5), u = incomplete_elliptic_f(phi, m);
    const double tight = kTight * (1 + std::abs(u));
    const JacobiElliptic at = jacobi_elliptic(u, m);
    EXPECT_NEAR(at.sn, std::sin(phi), tight) << m << ' ' << phi;
    EXPECT_NEAR(at.cn, std::cos(phi), tight) << m << ' ' << phi;
    // The double next to pi/2 is 6.2e-17 below it, where F has the slope (1 - m)^(-1/2).
    const double short_of = 6.2e-17 / std::sqrt(1 - m);
    EXPECT_NEAR(incomplete_elliptic_f(pi / 2, m), complete_elliptic_k(m),
                kTight * complete_elliptic_k(m) + short_of)
        << m;
    EXPECT_NEAR(incomplete_elliptic_e(pi / 2, m), complete_elliptic_e(m),
                kTight * complete_elliptic_k(m));
  }
  EXPECT_NEAR(incomplete_elliptic_e(0.6, 0), 0.6, kTight);
  EXPECT_NEAR(incomplete_elliptic_e(-0.6, 0.99999999999), -std::sin(0.6), 1e-11);
}

TEST(Elliptic, PerimetersAreThoseOfACircleASegmentAndALemniscate) {  // (5)
  EXPECT_LT(relative(ellipse_perimeter({3, 3}), 6 * pi), kTight);
  EXPECT_LT(relative(ellipse_perimeter({1e-9, 5}), 20), kTight);
  // Semi-axes 1 and sqrt 2: with the lemniscate's length w = G(1/4)^2 / sqrt(2 pi), w + 4 pi / w.
  const double gamma = std::tgamma(0.25), w = gamma * gamma / std::sqrt(2 * pi);
  EXPECT_LT(relative(ellipse_perimeter({1, std::sqrt(2.0)}), w + 4 * pi / w), kTight);
  EXPECT_EQ(ellipse_perimeter({1, 7}), ellipse_perimeter({7, 1}));
  EXPECT_EQ(ellipse_perimeter({4, 28}), 4 * ellipse_perimeter({7, 1}));
}

TEST(Elliptic, SurfacesAreThoseOfSpheresSpheroidsAndDiscs) {  // (5)
  EXPECT_LT(relative(ellipsoid_surface({2, 2, 2}), 16 * pi), kTight);
  EXPECT_LT(relative(ellipsoid_surface({1e-9, 2, 3}), 12 * pi), kTight);
  // Of eccentricity e: oblate 2 pi a^2 (1 + (1-e^2)/e artanh e), prolate 2 pi a^2 (1 + c/(a e)
  // asin e).
  for (const double e : {0.6, 0.8}) {
    const double c = std::sqrt(1 - e * e);
    EXPECT_LT(relative(ellipsoid_surface({1, c, 1}), 2 * pi * (1 + c * c / e * std::atanh(e))),
              kTight);
    EXPECT_LT(relative(ellipsoid_surface({c, 1, c}), 2 * pi * c * (c + std::asin(e) / e)), kTight);
  }
  const double surface = ellipsoid_surface({1, 2, 5});
  EXPECT_EQ(ellipsoid_surface({5, 1, 2}), surface);
  EXPECT_EQ(ellipsoid_surface({4, 20, 8}), 16 * surface);
}

// Both oracles to what quadrature promises.
TEST(Elliptic, IntegralsAreWhatQuadratureMakesOfTheirDefinitions) {
  for (const double m : {-3.0, 0.1, 0.7, 0.99}) {
    const auto root = [m](double t) { return std::sqrt(1 - m * std::sin(t) * std::sin(t)); };
    const auto f = [&](double t) { return 1 / root(t); };
    const auto d = [&](double t) { return std::sin(t) * std::sin(t) / root(t); };
    EXPECT_LT(relative(integral(f, 0, pi / 2), complete_elliptic_k(m)), 1e-11) << m;
    EXPECT_LT(relative(integral(root, 0, pi / 2), complete_elliptic_e(m)), 1e-11) << m;
    EXPECT_LT(relative(integral(d, 0, pi / 2), complete_elliptic_d(m)), 1e-11) << m;
    EXPECT_LT(relative(integral(f, 0, -1.2), incomplete_elliptic_f(-1.2, m)), 1e-11) << m;
    EXPECT_LT(relative(integral(root, 0, 0.4), incomplete_elliptic_e(0.4, m)), 1e-11) << m;
  }
}

TEST(Elliptic, MeasuresAreWhatQuadratureMakesOfTheParametrisation) {
  const auto speed = [](double t) { return std::hypot(3 * std::sin(t), 0.5 * std::cos(t)); };
  EXPECT_LT(relative(integral(speed, 0, 2 * pi), ellipse_perimeter({3, 0.5})), 1e-11);
  // An element is abc |x/a^2, y/b^2, z/c^2| sin t dt dp.
  const double a = 1, b = 2, c = 5;
  const auto ring = [&](double t) {
    const auto element = [&](double p) {
      return std::hypot(b * c * std::sin(t) * std::cos(p), c * a * std::sin(t) * std::sin(p),
                        a * b * std::cos(t)) *
             std::sin(t);
    };
    return integral(element, 0, pi / 2);
  };
  EXPECT_LT(relative(8 * integral(ring, 0, pi / 2), ellipsoid_surface({b, c, a})), 1e-10);
}

TEST(Quadrature, TakesSingularEndsAndSaysWhereItFails) {
  EXPECT_NEAR(integral([](double x) { return 1 / std::sqrt(x); }, 0, 1), 2, 1e-10);
  EXPECT_NEAR(integral([](double x) { return std::sqrt(1 - x * x); }, -1, 1), pi / 2, 1e-11);
  EXPECT_THROW(integral([](double x) { return 1 / (x - 0.3); }, 0, 1), std::runtime_error);
}

TEST(Elliptic, RefusesWhatHasNoValue) {
  EXPECT_THROW(complete_elliptic_k(1), std::invalid_argument);
  EXPECT_THROW(complete_elliptic_e(1.5), std::invalid_argument);
  EXPECT_THROW(complete_elliptic_d(NAN), std::invalid_argument);
  EXPECT_THROW(incomplete_elliptic_f(1.6, 0.5), std::invalid_argument);
  EXPECT_THROW(jacobi_elliptic(1, -0.1), std::invalid_argument);
  EXPECT_THROW(jacobi_elliptic(INFINITY, 0.5), std::invalid_argument);
  EXPECT_THROW(ellipse_perimeter({0, 1}), std::invalid_argument);
  EXPECT_THROW(ellipsoid_surface({1, 1, -2}), std::invalid_argument);
}

}  // namespace
}  // namespace tangency::verify
