// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>

#include <tangency/geometry/gap_derivatives.hpp>
#include <tangency/tests/support/gap_gradient.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/manufactured.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace tangency {
namespace {

using testing::changed, testing::gradient_of, testing::is_angle;
using testing::RealPair;
using verify::ContactFamily;
using verify::GapTruth;
using verify::ManufacturedContact;
using verify::Real;
using verify::to_ellipsoid;

constexpr double kU = kUnitRoundoff;
constexpr std::uint64_t kSeed = 20261122;
const Real kStep("1e-40");  // of differences: errors of 1e-80 by truncation, 1e-65 by the oracle's

/// A pair, its derivatives by the kernel, and the scales of their errors.
struct Case {
  explicit Case(const ManufacturedContact& contact)
      : a(to_ellipsoid(contact.a)),
        b(to_ellipsoid(contact.b)),
        pair{real(contact.a), real(contact.b)},
        gap(signed_gap(a, b)),
        derivatives(gap_derivatives(a, b, gap)),
        size((b.centre() - a.centre()).norm() + a.largest_semi_axis() + b.largest_semi_axis()) {
    kappa = 1 + size / derivatives.least_radius;
    deep = 1 + std::max(0.0, -gap.gap / derivatives.least_radius);
    beta = std::max(a.largest_semi_axis() / a.support(gap.normal),
                    b.largest_semi_axis() / b.support(gap.normal));
  }
  GapTruth truth_of(const RealPair& p) const {
    return stationary_gap(p.a, p.b, {gap.normal[0], gap.normal[1], gap.normal[2]});
  }
  /// What a turn by v_j first adds to d2g / dv_i dv_j: exp([w]x) exp([v]x) turns by w + v + w x v
  /// / 2.
  double half_commutator(int i, int j) const {
    if (!is_angle(i) || !is_angle(j) || i / kOfBodyB != j / kOfBodyB) return 0;
    const int first = i - i % 3;
    return 0.5 * derivatives.gradient.segment<3>(first).dot(
                     Vec3::Unit(i - first).cross(Vec3(Vec3::Unit(j - first))));
  }
  /// A support point moves up to beta times as fast as the normal or a semi-axis.
  double scale(int i) const {
    return i % kOfBodyB < kRotation ? 1.0 : is_angle(i) ? beta * size : beta;
  }
  /// What the gradient's errors are relative to, over u and the scale.
  double first_order() const { return deep * (kappa + std::sqrt(kappa * beta)); }

  Ellipsoid a, b;
  RealPair pair;
  Gap gap;
  GapDerivatives derivatives;
  double size, kappa, deep, beta;
};

double distance(double value, const Real& truth) {
  return std::abs(static_cast<double>(value - truth));
}

/// Largest errors: of the gradient in units of the scale, of u deep (kappa + sqrt(kappa beta)) and
/// it; of the Hessian in units of the scales / least radius, and of that times u kappa' beta.
struct Worst {
  double gradient = 0, gradient_conditioned = 0, hessian = 0, hessian_conditioned = 0;
  double kappa = 0, beta = 0;
  int count = 0, overlapping = 0;

  void add_gradient(const Case& c, int i, const Real& truth) {
    const double error = distance(c.derivatives.gradient[i], truth) / c.scale(i);
    gradient = std::max(gradient, error);
    gradient_conditioned = std::max(gradient_conditioned, error / (kU * c.first_order()));
  }
  void add_hessian(const Case& c, int i, int j, const Real& truth) {
    const double error = distance(c.derivatives.hessian(i, j), truth) * c.derivatives.least_radius /
                         (c.scale(i) * c.scale(j));
    hessian = std::max(hessian, error);
    hessian_conditioned = std::max(hessian_conditioned, error / (kU * c.kappa * c.deep * c.beta));
  }
  void count_pair(const Case& c) {
    ++count;
    overlapping += c.gap.gap < 0;
    kappa = std::max(kappa, c.kappa);
    beta = std::max(beta, c.beta);
  }
  /// The gradient and column j mod 18 of the Hessian against 100 digits.
  void add(const Case& c, int j) {
    count_pair(c);
    const auto at = gradient_of(c.pair, c.truth_of(c.pair));
    const RealPair more = changed(c.pair, j % 18, kStep), less = changed(c.pair, j % 18, -kStep);
    const auto above = gradient_of(more, c.truth_of(more));
    const auto below = gradient_of(less, c.truth_of(less));
    for (int k = 0; k < 18; ++k) {
      const auto row = static_cast<std::size_t>(k);
      add_gradient(c, k, at[row]);
      const Real difference = (above[row] - below[row]) / (2 * kStep);
      // Of the oracle's derivatives this is one triangle as often as the other; the kernel's
      // entries on both sides of the diagonal are held to it.
      add_hessian(c, k, j % 18, difference - c.half_commutator(k, j % 18));
      add_hessian(c, j % 18, k, difference - c.half_commutator(k, j % 18));
    }
  }
  void print(const char* name) const {
    std::printf(
        "%s: %d pairs, %d overlapping, kappa to %.2g, beta to %.2g: gradient %.2g (%.3g u "
        "deep (kappa + sqrt(kappa beta))), Hessian %.2g (%.3g u kappa' beta)\n",
        name, count, overlapping, kappa, beta, gradient, gradient_conditioned, hessian,
        hessian_conditioned);
  }
};

ContactFamily touching(double aspect, double size_ratio) {
  return {"touching", ContactFamily::Shape::drawn, aspect,
          size_ratio, ContactFamily::GapUnit::rho, 0.9};
}
ContactFamily apart(double aspect, double size_ratio) {
  return {"apart",
          ContactFamily::Shape::drawn,
          aspect,
          size_ratio,
          ContactFamily::GapUnit::smallest_semi_axis,
          5};
}

/// The gradient and, for every pair, one column of the Hessian (all 18 in turn) against 100 digits.
/// @param closer  if not 1, the centres are brought that much closer: deep pairs, of any status
Worst compare(const ContactFamily& family, int count, double closer = 1) {
  verify::ManufacturedContacts contacts(family, kSeed);
  Worst worst;
  for (int i = 0; i < count; ++i) {
    ManufacturedContact contact = contacts.next();
    for (std::size_t k = 0; k < 3; ++k) {
      const double at = contact.a.centre[k];
      contact.b.centre[k] = at + closer * (contact.b.centre[k] - at);
    }
    const Case c(contact);
    if (closer == 1) {
      EXPECT_EQ(c.derivatives.status, DerivativeStatus::ok) << i;
    }
    if (c.derivatives.least_radius == 0) continue;
    worst.add(c, i);
  }
  char name[64];
  std::snprintf(name, sizeof name, "%s, aspect to %g", family.name.c_str(), family.aspect);
  worst.print(name);
  return worst;
}

TEST(GapDerivatives, GradientIsThatOfDifferencesOfTheGap) {
  for (const ContactFamily& family : {touching(5, 3), apart(5, 3)}) {
    verify::ManufacturedContacts contacts(family, kSeed);
    Worst worst;
    for (int i = 0; i < 40; ++i) {
      const Case c(contacts.next());
      ASSERT_EQ(c.derivatives.status, DerivativeStatus::ok);
      worst.count_pair(c);
      for (int j = 0; j < 18; ++j) {
        const Real above = c.truth_of(changed(c.pair, j, kStep)).gap;
        const Real below = c.truth_of(changed(c.pair, j, -kStep)).gap;
        worst.add_gradient(c, j, (above - below) / (2 * kStep));
      }
    }
    worst.print((family.name + ", differences of the gap").c_str());
    EXPECT_LT(worst.gradient, 1e-12);
  }
}

TEST(GapDerivatives, HessianIsThatOfSecondDifferencesOfTheGap) {
  verify::ManufacturedContacts contacts(touching(5, 3), kSeed + 1);
  Worst worst;
  for (int i = 0; i < 3; ++i) {
    const Case c(contacts.next());
    ASSERT_EQ(c.derivatives.status, DerivativeStatus::ok);
    worst.count_pair(c);
    for (int j = 0; j < 18; ++j) {
      for (int k = 0; k <= j; ++k) {
        const auto at = [&](const Real& s, const Real& t) {
          return c.truth_of(changed(changed(c.pair, j, s), k, t)).gap;
        };
        const Real difference =
            at(kStep, kStep) - at(kStep, -kStep) - at(-kStep, kStep) + at(-kStep, -kStep);
        worst.add_hessian(c, k, j, difference / (4 * kStep * kStep) - c.half_commutator(k, j));
      }
    }
  }
  worst.print("touching, second differences of the gap");
  EXPECT_LT(worst.hessian, 1e-10);
}

// geometry/gap_derivatives.hpp (5)
TEST(GapDerivatives, AreWithin1e12And1e10AtOrdinaryAspects) {
  for (const ContactFamily& family : {touching(5, 3), apart(5, 3)}) {
    const Worst worst = compare(family, 1008);
    EXPECT_LT(worst.gradient, 1e-12) << family.name;
    EXPECT_LT(worst.hessian, 1e-10) << family.name;
  }
}

TEST(GapDerivatives, AreWithinTheirPublishedBoundsAtEveryAspectTo1000) {
  for (const double aspect : {5.0, 100.0, 1000.0}) {
    for (const ContactFamily& family : {touching(aspect, 10), apart(aspect, 10)}) {
      const Worst worst = compare(family, 360);
      EXPECT_LT(worst.gradient_conditioned, 16) << family.name << aspect;
      EXPECT_LT(worst.hessian_conditioned, 16) << family.name << aspect;
    }
  }
}

/// A disc of that aspect ratio touched by a sphere or by a disc on its face, near its middle or
/// anywhere: kappa is about 1 and beta the aspect ratio.
ManufacturedContact on_a_face(std::mt19937_64& random, double aspect) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any = [&] { return Eigen::Quaterniond(unit(random), unit(random), unit(random), 1); };
  const Ellipsoid disc({0, 0, 0}, {1, 0.6 + 0.4 * unit(random), 1 / aspect}, any());
  const Vec3 aside = Vec3(unit(random), unit(random), unit(random)) / aspect;
  const Vec3 n = (disc.rotation().col(2) + (unit(random) > 0) * aside).normalized();
  const double r = 0.3 + 0.2 * unit(random);
  const Ellipsoid other({0, 0, 0}, {r, r, unit(random) > 0 ? r : r / aspect}, any());
  const double gap = 0.5 * (disc.least_radius() + other.least_radius()) * unit(random);
  const Vec3 d = disc.support_point(n) + other.support_point(n) + gap * n;
  return {{verify::to_raw(disc), verify::to_raw(other.moved_to(d))}, {n[0], n[1], n[2]}, gap, 0, 0};
}

TEST(GapDerivatives, OnTheFacesOfDiscsAreWithinTheirPublishedBounds) {
  for (const double aspect : {30.0, 100.0, 1000.0, 1e6}) {
    std::mt19937_64 random(kSeed);
    Worst worst;
    for (int i = 0; i < 180; ++i) {
      const Case c(on_a_face(random, aspect));
      ASSERT_EQ(c.derivatives.status, DerivativeStatus::ok) << i;
      worst.add(c, i);
    }
    char name[64];
    std::snprintf(name, sizeof name, "on a face, aspect %g", aspect);
    worst.print(name);
    EXPECT_LT(worst.gradient_conditioned, 16) << aspect;
    EXPECT_LT(worst.hessian_conditioned, 16) << aspect;
    EXPECT_GT(worst.beta, 0.5 * aspect);
  }
}

TEST(GapDerivatives, OfADiscTouchedOnItsFaceWhichBrokeABoundWithoutItsSharpnessKeepThePromise) {
  const ManufacturedContact contact{
      {{{0, 0, 0},
        {1, 0x1.4f799fd6ee6d1p-1, 0x1.47ae147ae147bp-7},
        {0x1.e9569ce93dcf2p-2, 0x1.188dfb42b525ep-2, -0x1.086878443a99ep+0, 0x1.589a0efac340bp-10}},
       {{-0x1.baa775702437ap-1, -0x1.1d0d790d8ce72p-2, -0x1.295c5e15c781cp-1},
        {0x1.38e45be54dd44p-2, 0x1.38e45be54dd44p-2, 0x1.38e45be54dd44p-2},
        {-0x1.5fd99dd3d8fddp+0, -0x1.5f594744ee6d6p+0, 0x1.9c3281fbeb54bp-4,
         0x1.8f51932a60fe2p-1}}},
      {},
      0,
      0,
      0};
  const Case c(contact);
  ASSERT_EQ(c.derivatives.status, DerivativeStatus::ok);
  Worst worst;
  for (int j = 0; j < 18; ++j) worst.add(c, j);
  worst.print("a disc of aspect 100 touched on its face");
  EXPECT_LT(worst.gradient_conditioned, 16);
  EXPECT_LT(worst.hessian_conditioned, 16);
  // d/dv_A,y in 100 digits.
  EXPECT_NEAR(c.derivatives.gradient[kRotation + 1], 0.15657676489168298,
              16 * kU * c.first_order() * c.scale(kRotation));
}

TEST(GapDerivatives, OfDeepPairsAreThoseOfTheirBranchWithinTheSameBounds) {
  for (const double closer : {0.5, 0.1, 0.01}) {
    const Worst worst = compare(touching(20, 3), 270, closer);
    EXPECT_GT(worst.count, 260) << closer;
    EXPECT_EQ(worst.overlapping, worst.count) << closer;
    EXPECT_LT(worst.gradient_conditioned, 16) << closer;
    EXPECT_LT(worst.hessian_conditioned, 16) << closer;
  }
}

}  // namespace
}  // namespace tangency
