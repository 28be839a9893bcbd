// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include <tangency/geometry/bodies/classify_coefficients.hpp>
#include <tangency/geometry/bodies/exact_quadric_type.hpp>
#include <tangency/geometry/classify.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>
#include <tangency/tests/geometry/quadric_generators.hpp>

namespace tangency {
namespace {

/// The exact answer another way: Descartes' rule on the characteristic polynomials, where the exact
/// tier eliminates.
Classification by_descartes(const Quadric& q) {
  const auto& c = q.coefficients();
  const auto form = exact::quadric_form(c, exact::common_exponent(c));
  const auto inertia_of = [](const auto& coefficients) {
    std::vector<int> signs;
    signs.reserve(coefficients.size());
    for (const mpz_class& e : coefficients) signs.push_back(sgn(e));
    return exact::inertia_from_signs(signs);
  };
  const auto q4 = inertia_of(exact::characteristic_coefficients(form));
  const auto q3 = inertia_of(exact::characteristic_coefficients(exact::sub_form(form)));
  return {exact::type_of(q4, q3), q4.rank(), q3.rank(), Tier::exact};
}

bool same(const Classification& a, const Classification& b) {
  return a.type == b.type && a.rank4 == b.rank4 && a.rank3 == b.rank3;
}

double power_of_two() { return std::ldexp(1.0, *rc::gen::inRange(-1000, 1001)); }

// geometry/classify.hpp (1) (2)
RC_GTEST_PROP(ClassifyProperty, TheTypeSurvivesAffineMapsScalingAndNegation, ()) {
  const auto& form = testing::kNormalForms[*rc::gen::inRange<std::size_t>(0, 20)];
  testing::IntegerQuadric integers = testing::pulled_back(form.quadric, *testing::integer_map());
  if (*rc::gen::arbitrary<bool>()) {
    integers = testing::pulled_back(integers, *testing::integer_map());
  }
  const Quadric q = testing::to_quadric(integers, power_of_two());
  for (const Quadric& either : {q, q.negated()}) {
    const Classification c = classify(either);
    RC_ASSERT(c.type == form.type);
    RC_ASSERT(c.rank4 == form.rank4);
    RC_ASSERT(c.rank3 == form.rank3);
  }
  RC_ASSERT(classify(q).tier == classify(q.negated()).tier);
  RC_TAG(std::string(to_string(form.type)), std::string(to_string(classify(q).tier)));
}

RC_GTEST_PROP(ClassifyProperty, ALastPlaceBesideEachTypeIsDecidedExactly, ()) {
  const auto& form = testing::kNormalForms[*rc::gen::inRange<std::size_t>(0, 20)];
  const auto integers = testing::pulled_back(form.quadric, *testing::integer_map());
  Quadric::Coefficients c = testing::to_quadric(integers).coefficients();
  const auto steps = *rc::gen::inRange(1, 3);
  for (int i = 0; i < steps; ++i) {
    double& entry = c[*rc::gen::inRange<std::size_t>(0, 10)];
    entry = std::nextafter(entry, *rc::gen::element(-HUGE_VAL, HUGE_VAL));
  }
  const Quadric q(c);
  RC_ASSERT(same(classify(q), by_descartes(q)));
  RC_TAG(std::string(to_string(classify(q).tier)));
}

/// Finite doubles with exponents within a span, zeros now and then.
Quadric mixed_quadric(int span) {
  Quadric::Coefficients c;
  for (double& entry : c) {
    const double mantissa = *rc::gen::element(1.0, -1.0, 1.5, -1.25, 0x1.8p0, 0x1.0000000000001p0);
    const bool zero = *rc::gen::inRange(0, 6) == 0;
    entry = zero ? 0.0 : std::ldexp(mantissa, *rc::gen::inRange(-span, std::min(span, 1023) + 1));
  }
  return Quadric(c);
}

RC_GTEST_PROP(ClassifyProperty, AnyMixtureOfMagnitudesIsDecidedExactlyInEveryEnvironment, ()) {
  const Quadric q = mixed_quadric(*rc::gen::element(2, 30, 200, 1022, 1074));
  const Classification expected = by_descartes(q);
  for (const auto& environment : testing::all_environments()) {
    Classification c;
    {
      const testing::EnvironmentGuard guard(environment);
      c = classify(q);
    }
    if (!same(c, expected)) RC_FAIL(environment.name);
  }
  RC_CLASSIFY(classify(q).tier == Tier::filter, "filter");
}

// geometry/classify.hpp (3)
RC_GTEST_PROP(ClassifyProperty, RanksAreThoseOfSomeQuadric, ()) {
  const Classification c = classify(mixed_quadric(1));
  RC_ASSERT(c.rank3 <= c.rank4);
  RC_ASSERT(c.rank4 <= std::min(4, c.rank3 + 2));
}

/// Quadrics in the filter's range near which its determinants nearly cancel: rounded images of
/// singular ones, and plain random ones.
Quadric::Coefficients hard_coefficients(std::mt19937_64& random) {
  std::uniform_real_distribution<double> entry(-1, 1);
  std::array<std::array<double, 4>, 4> map;
  for (auto& row : map) {
    for (double& value : row) value = entry(random);
  }
  std::array<double, 4> eigenvalues{1, 1, -1, -1};
  const auto zeros = random() % 4;
  for (std::size_t i = 0; i < zeros; ++i) eigenvalues[i] = 0;
  constexpr std::size_t row[] = {0, 1, 2, 0, 1, 2, 0, 1, 2, 3};
  constexpr std::size_t column[] = {0, 1, 2, 1, 2, 0, 3, 3, 3, 3};
  std::array<double, 4> scale;
  for (double& value : scale) value = std::ldexp(1.0, static_cast<int>(random() % 180) - 90);
  Quadric::Coefficients c;
  for (std::size_t i = 0; i < 10; ++i) {
    c[i] = 0;
    for (std::size_t k = 0; k < 4; ++k) c[i] += map[row[i]][k] * eigenvalues[k] * map[column[i]][k];
    c[i] *= scale[row[i]] * scale[column[i]];
  }
  return c;
}

mpq_class true_minor(const exact::IntegerForm<4>& form) {
  return form[0][0] * form[1][1] - form[0][1] * form[0][1];
}

struct WorstRatios {
  double minor2 = 0, t3 = 0, d4 = 0;
};

/// |error| / (2^-52 magnitude), in units that make the proven bounds 3, 6 and 9.
double ratio(const filter::Estimate& computed, const mpq_class& truth) {
  if (computed.magnitude == 0) return computed.value == 0 && truth == 0 ? 0 : HUGE_VAL;
  const mpq_class error = abs(mpq_class(exact::to_rational(computed.value) - truth));
  return mpq_class(error / exact::to_rational(computed.magnitude)).get_d() * 0x1p52;
}

TEST(ClassifyFilter, ErrorsStayBelowTheProvenBoundInEveryEnvironment) {
  for (const auto& environment : testing::all_environments()) {
    std::mt19937_64 random(20261122);
    WorstRatios worst;
    for (int i = 0; i < 8000; ++i) {
      const auto c = filter::in_range(hard_coefficients(random));
      if (!c) continue;
      filter::Determinants computed;
      {
        const testing::EnvironmentGuard guard(environment);
        computed = filter::determinants(*c);
      }
      const int exponent = exact::common_exponent(*c);
      const auto form = exact::quadric_form(*c, exponent);
      const mpq_class unit = exact::to_rational(std::ldexp(1.0, exponent));
      const mpq_class unit2 = unit * unit;
      worst.minor2 = std::max(worst.minor2, ratio(computed.minor2, true_minor(form) * unit2));
      worst.t3 = std::max(
          worst.t3, ratio(computed.t3, exact::determinant(exact::sub_form(form)) * unit2 * unit));
      worst.d4 = std::max(worst.d4, ratio(computed.d4, exact::determinant(form) * unit2 * unit2));
    }
    std::cout << environment.name << ": largest error / (2^-52 magnitude): minor2 " << worst.minor2
              << " (bound 3), T3 " << worst.t3 << " (bound 6), D4 " << worst.d4 << " (bound 9)\n";
    EXPECT_LE(worst.minor2 * 0x1p-52, filter::kMinor2Factor) << environment.name;
    EXPECT_LE(worst.t3 * 0x1p-52, filter::kT3Factor) << environment.name;
    EXPECT_LE(worst.d4 * 0x1p-52, filter::kD4Factor) << environment.name;
    EXPECT_GT(worst.d4, environment.rounding == FE_TONEAREST ? 0.5 : 1.0) << "the inputs are easy";
  }
}

TEST(ClassifyFilter, AnswersAreThoseOfTheExactTierOnRoundedSingularQuadrics) {
  std::mt19937_64 random(7);
  int answered = 0;
  for (int i = 0; i < 20000; ++i) {
    const Quadric q(hard_coefficients(random));
    const auto type = filter::regular_type(q.coefficients());
    if (!type) continue;
    ++answered;
    EXPECT_EQ(to_string(*type), to_string(by_descartes(q).type));
  }
  std::cout << "filter answered " << answered << " of 20000 nearly singular quadrics\n";
  EXPECT_GT(answered, 1000);
}

TEST(ClassifyFilter, RangeIsFoundByBitsAndKeptByScaling) {
  const double smallest = 0x1p-1074;
  const auto with_k = [](double k) { return Quadric::Coefficients{1, 1, 1, 0, 0, 0, 0, 0, 0, k}; };
  EXPECT_FALSE(filter::in_range(with_k(smallest)));
  EXPECT_FALSE(filter::in_range(with_k(0x1p-401)));
  Quadric::Coefficients subnormal = with_k(-1);
  for (double& c : subnormal) c *= 3 * smallest;
  EXPECT_FALSE(filter::in_range(subnormal));
  ASSERT_TRUE(filter::in_range(with_k(0x1p-400)));
  EXPECT_EQ((*filter::in_range(with_k(-0x1p-400)))[9], -0x1p-200);
  EXPECT_EQ((*filter::in_range(with_k(-0x1p-400)))[0], 0x1p200);
  EXPECT_EQ(*filter::in_range(with_k(-0.0)), with_k(-0.0));
}

}  // namespace
}  // namespace tangency
