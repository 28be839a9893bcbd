// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmpxx.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/geometry/numbers/real_roots.hpp>
#include <tangency/geometry/polynomial.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using Coefficients = std::array<double, 5>;

/// a[0] + ... + a[4] x^4 exactly.
mpq_class value(const Coefficients& a, const mpq_class& x) {
  mpq_class sum = 0;
  for (std::size_t k = 5; k-- > 0;) sum = sum * x + mpq_class(a[k]);
  return sum;
}

/// 32 u sum |a_k x^k|
mpq_class allowance(const Coefficients& a, const mpq_class& x) {
  mpq_class sum = 0;
  for (std::size_t k = 5; k-- > 0;) sum = sum * abs(x) + mpq_class(std::abs(a[k]));
  return sum * mpq_class(32 * 0x1p-53);
}

/// The product of x - root[i], rounded.
Coefficients product(const std::vector<double>& root, double leading) {
  std::vector<double> p{leading};
  for (const double r : root) {
    std::vector<double> q(p.size() + 1, 0.0);
    for (std::size_t k = 0; k < p.size(); ++k) {
      q[k + 1] += p[k];
      q[k] -= r * p[k];
    }
    p = q;
  }
  Coefficients a{};
  for (std::size_t k = 0; k < p.size(); ++k) a[k] = p[k];
  return a;
}

/// Any coefficients, coefficients of any size with zeros among them, and products of few factors
/// whose roots are close together.
rc::Gen<Coefficients> coefficients() {
  return rc::gen::exec([] {
    Coefficients a{};
    const int kind = *rc::gen::inRange(0, 4);
    const auto number = testing::uniform(-2, 2);
    if (kind < 2) {
      for (double& c : a) {
        c = *number;
        if (kind == 1) c *= *testing::log_uniform(1e-12, 1e12);
        if (*rc::gen::inRange(0, 6) == 0) c = 0;
      }
      return a;
    }
    std::vector<double> root{*number};
    while (root.size() < 4 && *rc::gen::inRange(0, 6) != 0) {
      const bool close = *rc::gen::arbitrary<bool>();
      root.push_back(close ? root.back() + *testing::log_uniform(1e-18, 1) : *number);
    }
    if (kind == 3) {
      for (double& r : root) r = std::round(r * 4) / 4;
    }
    return product(root, *number);
  });
}

bool is_zero(const Coefficients& a) {
  return std::ranges::all_of(a, [](double c) { return c == 0; });
}

/// The exact roots where p changes sign, as doubles next to them.
std::vector<double> exact_crossings(const Coefficients& a) {
  std::vector<mpz_class> integers;
  // Of coefficients of at least 2^-160 every one is an integer multiple of 2^-220.
  for (const double c : a) integers.emplace_back(mpq_class(c) * (mpz_class(1) << 220));
  const exact::IntegerPolynomial p(integers);
  const exact::SturmSequence sturm(p);
  auto roots = exact::isolate_real_roots(sturm);
  std::vector<double> crossings;
  int sign = p.sign_at_minus_infinity();
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const int after = i + 1 < roots.size()
                          ? p.sign_at(exact::sample_between(roots[i], roots[i + 1]))
                          : p.sign_at_plus_infinity();
    if (after != sign) crossings.push_back(roots[i].nearest());
    sign = after;
  }
  return crossings;
}

bool is_near(const QuarticRoot& root, double exact) {
  return std::abs(root.x - exact) <= root.error + 0x1p-52 * std::abs(exact);
}

// geometry/polynomial.hpp (1)
RC_GTEST_PROP(PolynomialProperty, QuarticChangesItsSignWithinTheErrorOfARootThatCrosses, ()) {
  const Coefficients a = *coefficients();
  const QuarticRoots roots = quartic_roots(a);
  RC_ASSERT(roots.vanishes == is_zero(a));
  if (roots.vanishes) return;
  const std::vector<double> exact = exact_crossings(a);
  for (int i = 0; i < roots.count; ++i) {
    const QuarticRoot& root = roots.root[static_cast<std::size_t>(i)];
    RC_ASSERT(root.error >= 0);
    if (!root.crosses) continue;
    RC_ASSERT(std::ranges::any_of(exact, [&](double r) { return is_near(root, r); }));
  }
}

// geometry/polynomial.hpp (2)
RC_GTEST_PROP(PolynomialProperty, QuarticRootIsMissedOnlyWhereRoundingCannotTellItFromTheNext, ()) {
  const Coefficients a = *coefficients();
  if (is_zero(a)) RC_SUCCEED("zero");
  const QuarticRoots found = quartic_roots(a);
  const std::vector<double> exact = exact_crossings(a);
  std::vector<double> missed;
  for (const double r : exact) {
    const auto end = found.root.begin() + found.count;
    const auto near = [&](const QuarticRoot& root) { return is_near(root, r); };
    if (std::find_if(found.root.begin(), end, near) == end) missed.push_back(r);
  }
  RC_CLASSIFY(!missed.empty());
  RC_ASSERT(missed.size() % 2 == 0);
  for (std::size_t i = 0; i + 1 < missed.size(); i += 2) {
    for (const double part : {0.25, 0.5, 0.75}) {
      const mpq_class x(missed[i] + part * (missed[i + 1] - missed[i]));
      RC_ASSERT(abs(value(a, x)) <= allowance(a, x));
    }
  }
}

RC_GTEST_PROP(PolynomialProperty, QuarticRootsComeInOrderAndFewerThanFiveCross, ()) {
  const Coefficients a = *coefficients();
  const QuarticRoots roots = quartic_roots(a);
  int crossing = 0;
  for (int i = 0; i < roots.count; ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    RC_ASSERT(i == 0 || roots.root[k - 1].x <= roots.root[k].x);
    crossing += roots.root[k].crosses ? 1 : 0;
  }
  RC_ASSERT(crossing <= 4);
}

// geometry/polynomial.hpp (3)
RC_GTEST_PROP(PolynomialProperty, QuarticRootsFollowAPowerOfTwoAndAReflectionBitForBit, ()) {
  const Coefficients a = *coefficients();
  const double s = std::exp2(*rc::gen::inRange(-900, 900));
  Coefficients scaled = a, reflected = a;
  for (double& c : scaled) c *= -s;
  for (const std::size_t k : {1u, 3u}) reflected[k] = -reflected[k];
  const QuarticRoots before = quartic_roots(a), after = quartic_roots(scaled),
                     mirrored = quartic_roots(reflected);
  RC_ASSERT(before.count == after.count);
  RC_ASSERT(before.count == mirrored.count);
  for (int i = 0; i < before.count; ++i) {
    const QuarticRoot& root = before.root[static_cast<std::size_t>(i)];
    const QuarticRoot& same = after.root[static_cast<std::size_t>(i)];
    const QuarticRoot& other = mirrored.root[static_cast<std::size_t>(before.count - 1 - i)];
    RC_ASSERT(root.x == same.x && root.error == same.error && root.crosses == same.crosses);
    RC_ASSERT(root.x == -other.x && root.error == other.error && root.crosses == other.crosses);
  }
}

// geometry/polynomial.hpp (4)
RC_GTEST_PROP(PolynomialProperty, QuarticRootsFollowTheUnitBitForBit, ()) {
  const Coefficients a = *coefficients();
  const int unit = *rc::gen::inRange(-180, 180);
  Coefficients longer = a;
  for (std::size_t k = 0; k < 5; ++k) longer[k] = std::ldexp(a[k], unit * static_cast<int>(k));
  const QuarticRoots before = quartic_roots(a), after = quartic_roots(longer);
  RC_ASSERT(before.count == after.count);
  for (int i = 0; i < before.count; ++i) {
    const QuarticRoot& root = before.root[static_cast<std::size_t>(i)];
    const QuarticRoot& other = after.root[static_cast<std::size_t>(i)];
    RC_ASSERT(std::ldexp(root.x, -unit) == other.x);
    RC_ASSERT(std::ldexp(root.error, -unit) == other.error && root.crosses == other.crosses);
  }
}

TEST(Polynomial, SimpleRootsOfAQuarticAreGoodToTheLastPlaces) {
  const QuarticRoots roots = quartic_roots(product({-3, -0.125, 2, 7}, 5));
  ASSERT_EQ(roots.count, 4);
  const std::array<double, 4> expected{-3, -0.125, 2, 7};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(roots.root[i].x, expected[i], roots.root[i].error);
    EXPECT_LE(roots.root[i].error, 1e-14 * std::abs(expected[i])) << i;
    EXPECT_TRUE(roots.root[i].crosses);
  }
}

TEST(Polynomial, DoubleRootOfAQuarticDoesNotCrossAndATripleOneDoes) {
  const QuarticRoots twice = quartic_roots(product({-2, -2, 0.5, 0.5}, 1));
  ASSERT_EQ(twice.count, 2);
  EXPECT_FALSE(twice.root[0].crosses || twice.root[1].crosses);
  EXPECT_NEAR(twice.root[0].x, -2, twice.root[0].error);
  EXPECT_NEAR(twice.root[1].x, 0.5, twice.root[1].error);
  const QuarticRoots thrice = quartic_roots(product({1, 1, 1, -3}, 1));
  ASSERT_EQ(thrice.count, 2);
  EXPECT_TRUE(thrice.root[0].crosses && thrice.root[1].crosses);
  EXPECT_NEAR(thrice.root[1].x, 1, thrice.root[1].error);
  EXPECT_LE(thrice.root[1].error, 1e-4);
}

TEST(Polynomial, MultipleRootsAreAsWideAsRoundingMakesThemInEveryUnit) {
  // The guess of the error from a slope that is rounding once went to the next root, or infinity.
  for (const double unit : {0.25, 0.5, 1.0, 2.0, 4.0}) {
    const QuarticRoots thrice = quartic_roots(product({unit, unit, unit, -3 * unit}, 1));
    ASSERT_EQ(thrice.count, 2) << unit;
    EXPECT_LE(thrice.root[1].error, 1e-4 * unit) << unit;
    const QuarticRoots twice = quartic_roots(product({unit, unit, -2 * unit, -2 * unit}, 1));
    ASSERT_EQ(twice.count, 2) << unit;
    for (int i = 0; i < 2; ++i) {
      EXPECT_LE(twice.root[static_cast<std::size_t>(i)].error, 1e-6 * unit) << unit;
    }
  }
  // A double root at 2^-154 to 2e-15 of itself: the error was 5e14 times the root.
  const QuarticRoots close =
      quartic_roots({-0x1.e098520f799b8p+35, 0x1.0b80d8cbcfda9p+191, -0x1.dae36b287ba4dp+343,
                     -0x1.51e20afee0872p+497, 0x1.beb4ca0f2cba6p+650});
  ASSERT_EQ(close.count, 3);
  EXPECT_FALSE(close.root[1].crosses);
  EXPECT_LE(close.root[1].error, 1e-6 * close.root[1].x);
}

TEST(Polynomial, DegreeOfAQuarticMayFall) {
  EXPECT_TRUE(quartic_roots({0, 0, 0, 0, 0}).vanishes);
  EXPECT_EQ(quartic_roots({3, 0, 0, 0, 0}).count, 0);
  const QuarticRoots linear = quartic_roots({-3, 2, 0, 0, 0});
  ASSERT_EQ(linear.count, 1);
  EXPECT_NEAR(linear.root[0].x, 1.5, linear.root[0].error);
  EXPECT_LE(linear.root[0].error, 1e-14);
  const QuarticRoots quadratic = quartic_roots({-2, 0, 1, 0, 0});
  ASSERT_EQ(quadratic.count, 2);
  EXPECT_NEAR(quadratic.root[1].x, std::sqrt(2.0), 4e-16);
}

TEST(Polynomial, QuarticRootsMayBeFarApart) {
  const QuarticRoots roots = quartic_roots(product({1e-70, 1, 1e70}, 1));
  ASSERT_EQ(roots.count, 3);
  const std::array<double, 3> expected{1e-70, 1, 1e70};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(roots.root[i].x, expected[i], 1e-14 * expected[i]);
    EXPECT_LE(roots.root[i].error, 1e-14 * expected[i]);
  }
}

// Lost once, or far off: the form underflowed in the charts near a root this large.
TEST(Polynomial, QuarticRootsBeyondTwoToThe255AreFound) {
  struct Row {
    Coefficients a;
    double root;  // and its negative
  };
  for (const auto& [a, root] :
       {Row{{1, 0, -0x1p-900, 0, 0}, 0x1p450}, Row{{0x1p900, 0, 0, 0, -0x1p-300}, 0x1p300},
        Row{{1, 0, 0, 0, -0x1p-1021}, 0x1.306fe0a31b715p255},
        Row{{1, 0, 0, 0, -0x1p-1000}, 0x1p250}, Row{{0x1p1023, 0, -0x1p-1074, 0, 0}, 0},
        Row{{0x1p-1074, 0, 0, 0, -0x1p1020}, 0x1.6a09e667f3bcdp-524}}) {
    const QuarticRoots roots = quartic_roots(a);
    if (root == 0) {
      EXPECT_EQ(roots.count, 0);
      EXPECT_EQ(roots.beyond, 2);
      continue;
    }
    ASSERT_EQ(roots.count, 2) << root;
    EXPECT_EQ(roots.beyond, 0);
    for (int i = 0; i < 2; ++i) {
      const QuarticRoot& found = roots.root[static_cast<std::size_t>(i)];
      EXPECT_TRUE(found.crosses);
      EXPECT_NEAR(found.x, i == 0 ? -root : root, found.error);
      EXPECT_LE(found.error, 64 * 0x1p-53 * root);  // 48 u, rounded up to powers of two
    }
  }
}

TEST(Polynomial, QuarticRootsOfEveryMagnitudeInOnePolynomialAreFound) {
  // (x - 2^-300) (x + 2^-100) (x - 2^100) (x + 2^300), up to far less than rounding.
  const QuarticRoots roots = quartic_roots({0x1p0, -0x1p300, -0x1p400, 0x1p300, 0x1p0});
  ASSERT_EQ(roots.count, 4);
  const std::array<double, 4> expected{-0x1p300, -0x1p-100, 0x1p-300, 0x1p100};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(roots.root[i].x, expected[i], roots.root[i].error) << i;
    EXPECT_LE(roots.root[i].error, 64 * 0x1p-53 * std::abs(expected[i])) << i;
  }
}

TEST(Polynomial, QuarticRootBelowTheLeastDoubleIsRoundedAndEnclosed) {
  const QuarticRoots roots = quartic_roots({0x1p-1074, -0x1p1000, 0, 0, 0});
  ASSERT_EQ(roots.count, 1);
  EXPECT_TRUE(roots.root[0].crosses);
  EXPECT_LE(std::abs(roots.root[0].x), 0x1p-1074);
  EXPECT_GT(roots.root[0].error, std::abs(roots.root[0].x));
  EXPECT_LE(roots.root[0].error, 0x1p-1072);
}

TEST(Polynomial, QuarticRootZeroIsExactAndCrossesWhereItsMultiplicityIsOdd) {
  for (int power = 1; power < 5; ++power) {
    Coefficients a{};
    a[static_cast<std::size_t>(power)] = -3;
    if (power < 3) a[4] = 3;
    const QuarticRoots roots = quartic_roots(a);
    const auto end = roots.root.begin() + roots.count;
    const auto zero = std::find_if(roots.root.begin(), end, [](auto& r) { return r.x == 0; });
    ASSERT_NE(zero, end) << power;
    EXPECT_EQ(zero->error, 0);
    EXPECT_EQ(zero->crosses, power % 2 == 1);
  }
}

}  // namespace
}  // namespace tangency
