// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/geometry/gap_derivatives.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include <tangency/bench/families/manufactured.hpp>
#include <tangency/tests/support/conversions.hpp>
#include <tangency/verify/oracles/gap.hpp>

namespace tangency {
namespace {

using families::ContactFamily;
using families::ManufacturedContact;
using testing::to_ellipsoid;
using verify::GapTruth;
using verify::Real;
using verify::Real3;
using verify::RealEllipsoid;

constexpr double kU = 0x1p-53;
constexpr std::uint64_t kSeed = 20261122;
const Real kStep("1e-40");  // of differences: errors of 1e-80 by truncation, 1e-65 by the oracle's

using Gradient = std::array<Real, 18>;

bool is_angle(int i) { return i % kOfBodyB / 3 == kRotation / 3; }

struct RealPair {
  RealEllipsoid a, b;
};

/// The pair with parameter i changed by a step. A turn of 2 atan(step / 2) is one of step +
/// O(step^3).
RealPair changed(RealPair pair, int i, const Real& step) {
  RealEllipsoid& body = i < kOfBodyB ? pair.a : pair.b;
  const auto k = static_cast<std::size_t>(i % 3);
  const int kind = i % kOfBodyB - i % 3;
  if (kind == kCentre) body.centre[k] += step;
  if (kind == kSemiAxes) body.semi_axes[k] += step;
  if (kind == kRotation) {
    // (1, v/2) times q
    const auto q = body.orientation;
    const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
    const Real half = step / 2;
    body.orientation[0] -= half * q[k + 1];
    body.orientation[k + 1] += half * q[0];
    body.orientation[l + 1] -= half * q[m + 1];
    body.orientation[m + 1] += half * q[l + 1];
  }
  return pair;
}

/// The first derivatives by the identities of gap_derivatives.hpp, in 200 digits.
Gradient gradient_of(const RealPair& pair, const GapTruth& truth) {
  const verify::Separation<Real> shapes = separation(pair.a, pair.b);
  Gradient g;
  const auto body = [&](const verify::Shape<Real>& shape, const Real3& arm, int sign,
                        std::size_t first) {
    const Real3& n = truth.normal;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      g[first + k] = sign * n[k];
      g[first + 3 + k] = sign * (arm[l] * n[m] - arm[m] * n[l]);
      Real along_n = 0, along_x = 0;  // a_k^2 (R'n)_k / h is (R'x)_k, x = -sign arm
      for (std::size_t j = 0; j < 3; ++j) {
        along_n += shape.axes[k][j] * n[j];
        along_x -= sign * shape.axes[k][j] * arm[j];
      }
      g[first + 6 + k] = -along_n * along_x / shape.semi_axes[k];
    }
  };
  body(shapes.a, truth.arm_a, -1, 0);
  body(shapes.b, truth.arm_b, 1, kOfBodyB);
  return g;
}

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
  double scale(int i) const { return is_angle(i) ? size : 1.0; }
  /// A support point moves up to beta times as fast as the normal or a semi-axis.
  double hessian_scale(int i) const {
    return i % kOfBodyB >= kRotation ? beta * scale(i) : scale(i);
  }

  Ellipsoid a, b;
  RealPair pair;
  Gap gap;
  GapDerivatives derivatives;
  double size, kappa, deep, beta;
};

double distance(double value, const Real& truth) {
  return std::abs(static_cast<double>(value - truth));
}

/// Largest errors: of the gradient in units of the scale, of u kappa and the scale; of the Hessian
/// in units of the scales / least radius, and of that times u kappa' beta.
struct Worst {
  double gradient = 0, gradient_conditioned = 0, hessian = 0, hessian_conditioned = 0;
  double kappa = 0, beta = 0;
  int count = 0, overlapping = 0;

  void add_gradient(const Case& c, int i, const Real& truth) {
    const double error = distance(c.derivatives.gradient[i], truth) / c.scale(i);
    gradient = std::max(gradient, error);
    gradient_conditioned = std::max(gradient_conditioned, error / (kU * c.kappa));
  }
  void add_hessian(const Case& c, int i, int j, const Real& truth) {
    const double error = distance(c.derivatives.hessian(i, j), truth) * c.derivatives.least_radius /
                         (c.hessian_scale(i) * c.hessian_scale(j));
    hessian = std::max(hessian, error);
    hessian_conditioned = std::max(hessian_conditioned, error / (kU * c.kappa * c.deep * c.beta));
  }
  void count_pair(const Case& c) {
    ++count;
    overlapping += c.gap.gap < 0;
    kappa = std::max(kappa, c.kappa);
    beta = std::max(beta, c.beta);
  }
  void print(const char* name) const {
    std::printf(
        "%s: %d pairs, %d overlapping, kappa to %.2g, beta to %.2g: gradient %.2g (%.3g u "
        "kappa), Hessian %.2g (%.3g u kappa' beta)\n",
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
  families::ManufacturedContacts contacts(family, kSeed);
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
    worst.count_pair(c);
    const Gradient at = gradient_of(c.pair, c.truth_of(c.pair));
    const int j = i % 18;
    const RealPair more = changed(c.pair, j, kStep), less = changed(c.pair, j, -kStep);
    const Gradient above = gradient_of(more, c.truth_of(more));
    const Gradient below = gradient_of(less, c.truth_of(less));
    for (int k = 0; k < 18; ++k) {
      const auto row = static_cast<std::size_t>(k);
      worst.add_gradient(c, k, at[row]);
      const Real difference = (above[row] - below[row]) / (2 * kStep);
      // Of the oracle's derivatives this is one triangle as often as the other; the kernel's
      // entries on both sides of the diagonal are held to it.
      worst.add_hessian(c, k, j, difference - c.half_commutator(k, j));
      worst.add_hessian(c, j, k, difference - c.half_commutator(k, j));
    }
  }
  char name[64];
  std::snprintf(name, sizeof name, "%s, aspect to %g", family.name.c_str(), family.aspect);
  worst.print(name);
  return worst;
}

TEST(GapDerivatives, GradientIsThatOfDifferencesOfTheGap) {
  for (const ContactFamily& family : {touching(5, 3), apart(5, 3)}) {
    families::ManufacturedContacts contacts(family, kSeed);
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
  families::ManufacturedContacts contacts(touching(5, 3), kSeed + 1);
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
