// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/geometry/numbers/real_roots.hpp>

namespace tangency::exact {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = std::numeric_limits<double>::max();
constexpr double kSmallest = std::numeric_limits<double>::denorm_min();

IntegerPolynomial polynomial(std::initializer_list<mpz_class> coefficients) {
  return IntegerPolynomial(std::vector<mpz_class>(coefficients));
}

mpz_class power_of_two(unsigned exponent) { return mpz_class(1) << exponent; }

TEST(RealRoots, AnIrrationalRootLiesBetweenNeighbouringDoubles) {
  const SturmSequence sturm(polynomial({-2, 0, 1}));
  const auto roots = isolate_real_roots(sturm);
  ASSERT_EQ(roots.size(), 2u);
  EXPECT_EQ(roots[1].below(), 0x1.6a09e667f3bccp+0);
  EXPECT_EQ(roots[1].above(), 0x1.6a09e667f3bcdp+0);
  EXPECT_EQ(roots[1].nearest(), std::sqrt(2.0));
  EXPECT_EQ(roots[0].nearest(), -std::sqrt(2.0));
}

TEST(RealRoots, ARootThatIsADoubleIsFoundExactly) {
  const SturmSequence sturm(polynomial({-3, 8}) * polynomial({0, 1}) * polynomial({7, 1}));
  const auto roots = isolate_real_roots(sturm);
  ASSERT_EQ(roots.size(), 3u);
  for (const RealRoot& root : roots) EXPECT_TRUE(root.is_exact());
  EXPECT_EQ(roots[0].low(), -7);
  EXPECT_EQ(roots[1].low(), 0);
  EXPECT_EQ(roots[2].low(), mpq_class(3, 8));
}

TEST(RealRoots, RootsCloserThanDoublesAreTwo) {
  const mpz_class large = power_of_two(60);
  const SturmSequence sturm(polynomial({-1, 1}) * polynomial({-large - 1, large}));
  auto roots = isolate_real_roots(sturm);
  ASSERT_EQ(roots.size(), 2u);
  EXPECT_EQ(roots[0].above(), 1.0);
  EXPECT_EQ(roots[1].below(), 1.0);
  EXPECT_EQ(roots[1].above(), std::nextafter(1.0, 2.0));
  const mpq_class sample = sample_between(roots[0], roots[1]);
  EXPECT_GT(sample, 1);
  EXPECT_LT(sample, mpq_class(large + 1, large));
}

TEST(RealRoots, RootsBeyondTheRangeOfDoublesAreEnclosed) {
  const mpz_class huge = power_of_two(3000);
  const SturmSequence sturm(polynomial({-huge, 1}) * polynomial({huge, 1}) *
                            polynomial({-1, huge}) * polynomial({1, huge}));
  const auto roots = isolate_real_roots(sturm);
  ASSERT_EQ(roots.size(), 4u);
  EXPECT_EQ(roots[0].below(), -kInfinity);
  EXPECT_EQ(roots[0].above(), -kLargest);
  EXPECT_EQ(roots[0].nearest(), -kLargest);
  EXPECT_EQ(roots[1].below(), -kSmallest);
  EXPECT_EQ(roots[1].above(), 0.0);
  EXPECT_EQ(roots[2].below(), 0.0);
  EXPECT_EQ(roots[2].above(), kSmallest);
  EXPECT_EQ(roots[3].below(), kLargest);
  EXPECT_EQ(roots[3].above(), kInfinity);
}

TEST(RealRoots, CommonRootsOfTwoPolynomialsCompareEqualAndNearOnesDoNot) {
  const SturmSequence a(polynomial({-2, 0, 1}) * polynomial({-1, 3}));
  const SturmSequence b(polynomial({-2, 0, 1}) * polynomial({5, 1}));
  const mpz_class large = power_of_two(200);
  const SturmSequence c(polynomial({-2 * large - 1, 0, large}));
  auto of_a = isolate_real_roots(a), of_b = isolate_real_roots(b), of_c = isolate_real_roots(c);
  EXPECT_EQ(compare(of_a[2], of_b[2]), 0);
  EXPECT_EQ(compare(of_a[0], of_b[1]), 0);
  EXPECT_EQ(compare(of_a[1], of_b[2]), -1);
  EXPECT_EQ(compare(of_a[2], of_c[1]), -1);
  EXPECT_EQ(compare(of_c[1], of_b[2]), 1);
  EXPECT_EQ(compare(of_c[0], of_a[0]), -1);
}

// Steps that halve an interval would need thousands each; no time is measured, a search that did
// not converge would not end.
TEST(RealRoots, RootsThousandsOfBinaryPlacesApartOrAlikeAreCompared) {
  const mpz_class far = power_of_two(12000);
  for (const auto& scale : {mpq_class(far), mpq_class(1, far)}) {
    const mpz_class &n = scale.get_num(), &d = scale.get_den();
    const SturmSequence a(polynomial({-2 * n * n, 0, d * d}));
    const SturmSequence b(polynomial({-2 * n * n * far - 1, 0, d * d * far}));
    const SturmSequence c(polynomial({-n * n, 0, d * d * far}));
    auto of_a = isolate_real_roots(a), of_b = isolate_real_roots(b), of_c = isolate_real_roots(c);
    EXPECT_EQ(compare(of_a[1], of_b[1]), -1);
    EXPECT_EQ(compare(of_b[1], of_c[1]), 1);
    EXPECT_EQ(compare(of_a[0], of_b[0]), 1);
  }
}

/// Polynomials with small rational roots, which meet each other's roots and dyadic cuts often.
IntegerPolynomial random_polynomial(std::set<mpq_class>& roots) {
  IntegerPolynomial p = polynomial({*rc::gen::element(1, -3)});
  const int count = *rc::gen::inRange(1, 6);
  for (int i = 0; i < count; ++i) {
    mpq_class root(*rc::gen::inRange(-6, 7), *rc::gen::element(1, 2, 3, 7));
    root.canonicalize();
    p = p * polynomial({-root.get_num(), root.get_den()});
    roots.insert(root);
  }
  return *rc::gen::arbitrary<bool>() ? p * polynomial({1, 1, 1}) : p;
}

// geometry/numbers/real_roots.hpp (1)
RC_GTEST_PROP(RealRootsProperty, IsolationFindsEveryRootOnceInOrder, ()) {
  std::set<mpq_class> expected;
  const SturmSequence sturm(random_polynomial(expected));
  const auto roots = isolate_real_roots(sturm);
  RC_ASSERT(roots.size() == expected.size());
  auto root = roots.begin();
  for (const mpq_class& value : expected) {
    RC_ASSERT(root->low() <= value);
    RC_ASSERT(value <= root->high());
    RC_ASSERT(to_rational(root->below()) <= value);
    RC_ASSERT(to_rational(root->above()) >= value);
    const double nearest = root->nearest();
    const mpq_class error = abs(mpq_class(to_rational(nearest) - value));
    for (const double other : {root->below(), root->above()}) {
      RC_ASSERT(error <= abs(mpq_class(to_rational(other) - value)));
    }
    ++root;
  }
}

// geometry/numbers/real_roots.hpp (3) (4)
RC_GTEST_PROP(RealRootsProperty, ComparisonIsThatOfTheNumbers, ()) {
  std::set<mpq_class> expected_a, expected_b;
  const SturmSequence a(random_polynomial(expected_a)), b(random_polynomial(expected_b));
  auto roots_a = isolate_real_roots(a), roots_b = isolate_real_roots(b);
  auto value_a = expected_a.begin();
  for (RealRoot& root_a : roots_a) {
    auto value_b = expected_b.begin();
    for (RealRoot& root_b : roots_b) {
      const int order = compare(root_a, root_b);
      RC_ASSERT(order == (*value_a > *value_b) - (*value_a < *value_b));
      if (order < 0) {
        const mpq_class sample = sample_between(root_a, root_b);
        RC_ASSERT(*value_a < sample);
        RC_ASSERT(sample < *value_b);
      }
      ++value_b;
    }
    ++value_a;
  }
}

// geometry/numbers/real_roots.hpp (2)
RC_GTEST_PROP(RealRootsProperty, DoublesAroundARationalAreTheNearest, ()) {
  const auto bits = *rc::gen::arbitrary<std::uint64_t>();
  const double x = std::bit_cast<double>(bits);
  RC_PRE(std::isfinite(x));
  const mpq_class value = to_rational(x);
  RC_ASSERT(double_below(value) == x);
  RC_ASSERT(double_above(value) == x);
  mpq_class more = value;
  const mpq_class step = (mpq_class(1) >> 1200);
  more += step;
  RC_ASSERT(double_below(more) == x);
  RC_ASSERT(double_above(more) == std::nextafter(x, kInfinity));
  more -= 2 * step;
  RC_ASSERT(double_above(more) == x);
  RC_ASSERT(double_below(more) == std::nextafter(x, -kInfinity));
}

}  // namespace
}  // namespace tangency::exact
