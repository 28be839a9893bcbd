// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include <tangency/geometry/numbers/integer_polynomial.hpp>
#include <tangency/geometry/numbers/largest_root.hpp>

namespace tangency::exact {
namespace {

IntegerPolynomial polynomial(std::initializer_list<int> coefficients) {
  return IntegerPolynomial(std::vector<mpz_class>(coefficients.begin(), coefficients.end()));
}

/// A polynomial made of known factors: real rational roots n/d, and pairs of complex ones.
struct Factored {
  IntegerPolynomial polynomial;
  std::vector<mpq_class> roots;  ///< with multiplicity
  bool repeated_pair;
};

Factored factored(int most_real, int most_pairs) {
  Factored result{IntegerPolynomial({mpz_class(*rc::gen::element(-6, -1, 1, 4))}), {}, false};
  const int real = *rc::gen::inRange(0, most_real + 1);
  for (int i = 0; i < real; ++i) {
    const int n = *rc::gen::inRange(-5, 6);
    const int d = *rc::gen::inRange(1, 4);
    result.polynomial = result.polynomial * polynomial({-n, d});
    result.roots.emplace_back(n, d);
    result.roots.back().canonicalize();
  }
  const int pairs = *rc::gen::inRange(0, most_pairs + 1);
  std::set<std::pair<int, int>> seen;
  for (int i = 0; i < pairs; ++i) {
    const int centre = *rc::gen::inRange(-2, 3);
    const int square = *rc::gen::inRange(1, 3);
    result.polynomial = result.polynomial * polynomial({centre * centre + square, -2 * centre, 1});
    if (!seen.insert({centre, square}).second) result.repeated_pair = true;
  }
  return result;
}

std::set<mpq_class> distinct(const Factored& f) { return {f.roots.begin(), f.roots.end()}; }

mpq_class rational() {
  mpq_class value(*rc::gen::inRange(-20, 21), *rc::gen::inRange(1, 5));
  value.canonicalize();
  return value;
}

// geometry/numbers/integer_polynomial.hpp (1)
RC_GTEST_PROP(IntegerPolynomialProperty, TheSignIsThatOfTheFactors, ()) {
  const Factored f = factored(5, 2);
  const mpq_class x = rational();
  int expected = sgn(f.polynomial.leading());
  for (const mpq_class& root : f.roots) expected *= cmp(x, root);
  RC_ASSERT(f.polynomial.sign_at(x) == (expected > 0) - (expected < 0));
}

// geometry/numbers/integer_polynomial.hpp (4)
RC_GTEST_PROP(IntegerPolynomialProperty, SturmCountsDistinctRootsAlsoWhereEndsAreRoots, ()) {
  const Factored f = factored(6, 2);
  const SturmSequence sturm(f.polynomial);
  const auto roots = distinct(f);
  RC_ASSERT(sturm.roots() == static_cast<int>(roots.size()));
  mpq_class low = rational(), high = rational();
  if (!f.roots.empty() && *rc::gen::arbitrary<bool>()) low = *rc::gen::elementOf(f.roots);
  if (!f.roots.empty() && *rc::gen::arbitrary<bool>()) high = *rc::gen::elementOf(f.roots);
  if (high < low) std::swap(low, high);
  const auto within = std::count_if(roots.begin(), roots.end(),
                                    [&](const mpq_class& r) { return low < r && r <= high; });
  const auto above =
      std::count_if(roots.begin(), roots.end(), [&](const mpq_class& r) { return r > low; });
  RC_ASSERT(sturm.roots_between(low, high) == static_cast<int>(within));
  RC_ASSERT(sturm.roots_above(low) == static_cast<int>(above));
}

// geometry/numbers/integer_polynomial.hpp (3)
RC_GTEST_PROP(IntegerPolynomialProperty, TheSquareFreePartHasEachRootOnce, ()) {
  const Factored f = factored(6, 1);
  const IntegerPolynomial part = square_free_part(f.polynomial);
  const auto roots = distinct(f);
  IntegerPolynomial expected = polynomial({sgn(f.polynomial.leading())});
  for (const mpq_class& root : roots) {
    expected = expected * IntegerPolynomial({-root.get_num(), root.get_den()});
  }
  const int pairs = (f.polynomial.degree() - static_cast<int>(f.roots.size())) / 2;
  RC_ASSERT(part.degree() == static_cast<int>(roots.size()) + 2 * pairs);
  if (pairs == 0) RC_ASSERT(part == expected);
}

// geometry/numbers/integer_polynomial.hpp (2)
RC_GTEST_PROP(IntegerPolynomialProperty, TheGreatestCommonDivisorIsThatOfTheFactors, ()) {
  const Factored f = factored(4, 1);
  const Factored g = factored(4, 0);
  const Factored common = factored(3, 1);
  const IntegerPolynomial a = f.polynomial * common.polynomial;
  const IntegerPolynomial b = g.polynomial * common.polynomial;
  const IntegerPolynomial divisor = gcd(a, b);
  RC_ASSERT(divisor.sign_at_plus_infinity() == 1);
  RC_ASSERT(positive_pseudo_remainder(a, divisor).is_zero());
  RC_ASSERT(positive_pseudo_remainder(b, divisor).is_zero());
  std::vector<mpq_class> expected = common.roots;  // roots counted as often as in both
  std::vector<mpq_class> in_f = f.roots, in_g = g.roots, shared;
  std::sort(in_f.begin(), in_f.end());
  std::sort(in_g.begin(), in_g.end());
  std::set_intersection(in_f.begin(), in_f.end(), in_g.begin(), in_g.end(),
                        std::back_inserter(shared));
  const int pairs = (common.polynomial.degree() - static_cast<int>(common.roots.size())) / 2;
  RC_ASSERT(divisor.degree() == static_cast<int>(expected.size() + shared.size()) + 2 * pairs);
  RC_ASSERT(exact_quotient(a, divisor) * divisor == a);
}

// geometry/numbers/integer_polynomial.hpp (5)
RC_GTEST_PROP(IntegerPolynomialProperty, TheDiscriminantIsPositiveForRealRootsZeroForRepeatedOnes,
              ()) {
  const Factored f = factored(4, 2);
  if (f.polynomial.degree() < 1 || f.polynomial.degree() > 4) RC_SUCCEED("no discriminant");
  const bool repeated = distinct(f).size() < f.roots.size() || f.repeated_pair;
  const int pairs = (f.polynomial.degree() - static_cast<int>(f.roots.size())) / 2;
  const int expected = repeated ? 0 : pairs % 2 == 0 ? 1 : -1;
  RC_ASSERT(discriminant_sign(f.polynomial) == expected);
  RC_TAG(f.polynomial.degree(), expected);
}

// geometry/numbers/integer_polynomial.hpp (6)
RC_GTEST_PROP(IntegerPolynomialProperty, CoprimeIsWhatHasAConstantDivisor, ()) {
  const Factored f = factored(3, 1), g = factored(3, 1);
  const bool expected = gcd(f.polynomial, g.polynomial).degree() < 1;
  RC_ASSERT(coprime(f.polynomial, g.polynomial) == expected);
  RC_TAG(expected);
}

TEST(IntegerPolynomial, IsCoprimeAlsoWhereAPrimeDividesItsLeadingCoefficients) {
  const mpz_class prime = (mpz_class(1) << 61) - 1;
  const IntegerPolynomial f({mpz_class(-1), prime}), g({mpz_class(-2), prime});
  EXPECT_TRUE(coprime(f, g));
  EXPECT_FALSE(coprime(f * g, f));
}

/// A polynomial all of whose roots are positive, over binary places that doubles do not have, some
/// so close together that only hundreds of binary digits tell them apart; and its greatest root.
struct Positive {
  IntegerPolynomial polynomial = IntegerPolynomial({mpz_class(1)});
  std::vector<mpq_class> roots;

  int times_largest() const {
    const mpq_class largest = *std::max_element(roots.begin(), roots.end());
    return static_cast<int>(std::count(roots.begin(), roots.end(), largest));
  }
};

mpq_class scaled(const mpq_class& x, int exponent) {
  mpq_class result = x;
  if (exponent >= 0) result <<= static_cast<mp_bitcnt_t>(exponent);
  if (exponent < 0) result >>= static_cast<mp_bitcnt_t>(-exponent);
  return result;
}

Positive positive(const std::vector<mpq_class>& choice, int most, bool repeated) {
  Positive p;
  const int degree = *rc::gen::inRange(1, most + 1);
  while (static_cast<int>(p.roots.size()) < degree) {
    const mpq_class root = choice[*rc::gen::inRange<std::size_t>(0, choice.size())];
    if (!repeated && std::count(p.roots.begin(), p.roots.end(), root) != 0) continue;
    p.roots.push_back(root);
    p.polynomial = p.polynomial * IntegerPolynomial({-root.get_num(), root.get_den()});
  }
  return p;
}

std::vector<mpq_class> clustered_roots() {
  std::vector<mpq_class> roots;
  for (int i = 0; i < 3; ++i) {
    mpq_class base(*rc::gen::inRange(1, 9), *rc::gen::inRange(1, 4));
    base.canonicalize();
    base = scaled(base, *rc::gen::inRange(-300, 300));
    roots.push_back(base);
    for (int k = 0; k < 2; ++k) {
      roots.push_back(base + scaled(base, -*rc::gen::inRange(1, 700)));
    }
  }
  return roots;
}

// geometry/numbers/largest_root.hpp (1)
RC_GTEST_PROP(LargestRootProperty, ComparisonIsThatOfTheNumbersHoweverCloseTheyAre, ()) {
  const std::vector<mpq_class> choice = clustered_roots();
  const Positive f = positive(choice, 4, false), g = positive(choice, 4, false);
  const mpq_class most_f = *std::max_element(f.roots.begin(), f.roots.end());
  const mpq_class most_g = *std::max_element(g.roots.begin(), g.roots.end());
  const int expected = cmp(most_f, most_g);
  RC_ASSERT(compare_largest_roots(f.polynomial, -g.polynomial) == (expected > 0) - (expected < 0));
  RC_TAG((expected > 0) - (expected < 0));
}

// geometry/numbers/largest_root.hpp (2)
RC_GTEST_PROP(LargestRootProperty, MultiplicityIsHowOftenItOccurs, ()) {
  const Positive f = positive(clustered_roots(), 4, true);
  RC_ASSERT(multiplicity_of_largest_root(f.polynomial) == f.times_largest());
  RC_ASSERT(multiplicity_of_largest_root(f.polynomial * f.polynomial) == 2 * f.times_largest());
  RC_TAG(f.times_largest());
}

// geometry/numbers/largest_root.hpp (3)
RC_GTEST_PROP(LargestRootProperty, ExceedsOneWhereSomeRootDoes, ()) {
  const std::vector<mpq_class> choice{1, scaled(1, -3) + 1, mpq_class(1) - scaled(1, -900),
                                      scaled(1, -900) + 1, scaled(7, -20)};
  const Positive f = positive(choice, 4, true);
  const bool expected = *std::max_element(f.roots.begin(), f.roots.end()) > 1;
  RC_ASSERT(largest_root_exceeds_one(f.polynomial) == expected);
}

TEST(IntegerPolynomial, ZeroHasNoDegreeAndNoSign) {
  const IntegerPolynomial zero = polynomial({0, 0, 0});
  EXPECT_TRUE(zero.is_zero());
  EXPECT_EQ(zero.degree(), -1);
  EXPECT_EQ(zero.sign_at(mpq_class(3)), 0);
  EXPECT_EQ(zero.sign_at_plus_infinity(), 0);
  EXPECT_TRUE((zero * polynomial({1, 2})).is_zero());
  EXPECT_EQ(gcd(zero, polynomial({-2, -4})), polynomial({1, 2}));
}

TEST(IntegerPolynomial, TheRootsOfWilkinsonsPolynomialAreCountedOneByOne) {
  IntegerPolynomial p = polynomial({1});
  for (int root = 1; root <= 20; ++root) p = p * polynomial({-root, 1});
  const SturmSequence sturm(p);
  EXPECT_EQ(sturm.roots(), 20);
  for (int root = 1; root <= 20; ++root) {
    EXPECT_EQ(sturm.roots_between(mpq_class(2 * root - 1, 2), mpq_class(2 * root + 1, 2)), 1);
  }
  EXPECT_EQ(p.reflected().sign_at(mpq_class(-7)), 0);
  EXPECT_EQ(SturmSequence(p.reflected()).roots_above(mpq_class(0)), 0);
}

TEST(IntegerPolynomial, SignsAtTheTwoInfinitiesFollowTheDegree) {
  EXPECT_EQ(polynomial({0, 0, 0, -2}).sign_at_minus_infinity(), 1);
  EXPECT_EQ(polynomial({5, 0, -2}).sign_at_minus_infinity(), -1);
}

}  // namespace
}  // namespace tangency::exact
