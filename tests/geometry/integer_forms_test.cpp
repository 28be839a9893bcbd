// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <tangency/geometry/bodies/ellipsoid_form.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency::exact {
namespace {

/// Any finite double: all bit patterns alike, and often a small integer or a subnormal.
rc::Gen<double> finite_double() {
  const auto any = rc::gen::map(
      rc::gen::suchThat(rc::gen::arbitrary<std::uint64_t>(),
                        [](std::uint64_t bits) { return ((bits >> 52) & 0x7ff) != 0x7ff; }),
      [](std::uint64_t bits) { return std::bit_cast<double>(bits); });
  const auto small =
      rc::gen::map(rc::gen::inRange(-9, 10), [](int i) { return static_cast<double>(i); });
  const auto subnormal = rc::gen::map(rc::gen::inRange<std::uint64_t>(0, 1u << 20),
                                      [](auto bits) { return std::bit_cast<double>(bits); });
  return rc::gen::oneOf(any, small, subnormal);
}

/// Entries in -2..2: often singular, often with a diagonal of zeros.
template <std::size_t N>
IntegerForm<N> small_form() {
  IntegerForm<N> form;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = i; j < N; ++j) form[i][j] = form[j][i] = *rc::gen::inRange(-2, 3);
  }
  return form;
}

template <std::size_t N>
Inertia inertia_by_descartes(const IntegerForm<N>& form) {
  const auto coefficients = characteristic_coefficients(form);
  std::array<int, N + 1> signs;
  for (std::size_t k = 0; k <= N; ++k) signs[k] = sgn(coefficients[k]);
  return inertia_from_signs(signs);
}

template <std::size_t N>
void check_identities() {
  const IntegerForm<N> form = small_form<N>();
  RC_ASSERT(inertia(form) == inertia_by_descartes(form));
  RC_ASSERT(determinant(form) == characteristic_coefficients(form)[N]);
  const Inertia i = inertia(form);
  RC_ASSERT(i.positive + i.negative + i.zero == static_cast<int>(N));
  RC_TAG(i.rank());
}

// geometry/numbers/integer_forms.hpp (2) (3)
RC_GTEST_PROP(IntegerForms, InertiaAgreesWithTheCharacteristicPolynomialOfOrder2, ()) {
  check_identities<2>();
}
// geometry/numbers/integer_forms.hpp (2) (3)
RC_GTEST_PROP(IntegerForms, InertiaAgreesWithTheCharacteristicPolynomialOfOrder3, ()) {
  check_identities<3>();
}
// geometry/numbers/integer_forms.hpp (2) (3)
RC_GTEST_PROP(IntegerForms, InertiaAgreesWithTheCharacteristicPolynomialOfOrder4, ()) {
  check_identities<4>();
}

// geometry/numbers/integer_forms.hpp (1)
RC_GTEST_PROP(IntegerForms, CongruenceKeepsInertia, ()) {
  IntegerForm<4> diagonal;
  Inertia expected;
  for (std::size_t i = 0; i < 4; ++i) {
    const int value = *rc::gen::inRange(-2, 3);
    diagonal[i][i] = value;
    ++(value > 0 ? expected.positive : value < 0 ? expected.negative : expected.zero);
  }
  IntegerForm<4> form = diagonal;
  for (int step = 0; step < 8; ++step) {
    const auto i = *rc::gen::inRange<std::size_t>(0, 4);
    const auto j = (i + *rc::gen::inRange<std::size_t>(1, 4)) % 4;
    const int factor = *rc::gen::inRange(-3, 4);
    for (std::size_t c = 0; c < 4; ++c) form[i][c] += factor * form[j][c];
    for (std::size_t r = 0; r < 4; ++r) form[r][i] += factor * form[r][j];
  }
  RC_ASSERT(inertia(form) == expected);
}

TEST(IntegerForms, AFormWithAZeroDiagonalHasItsInertia) {
  IntegerForm<4> hyperbolic_planes;
  hyperbolic_planes[0][3] = hyperbolic_planes[3][0] = 5;
  hyperbolic_planes[1][2] = hyperbolic_planes[2][1] = -7;
  EXPECT_EQ(inertia(hyperbolic_planes), (Inertia{2, 2, 0}));
  EXPECT_EQ(determinant(hyperbolic_planes), 25 * 49);
}

RC_GTEST_PROP(IntegerForms, ReadingADoubleIsExact, ()) {
  const double value = *finite_double();
  const Dyadic dyadic = decode(value);
  RC_ASSERT(std::ldexp(static_cast<double>(dyadic.mantissa), dyadic.exponent) == value);
  RC_ASSERT(dyadic.mantissa == 0 || dyadic.mantissa % 2 != 0);
  RC_ASSERT(to_rational(value).get_d() == value);
}

// geometry/numbers/integer_forms.hpp (4)
RC_GTEST_PROP(IntegerForms, TheCommonExponentIsTheLargest, ()) {
  const std::array<double, 2> values{*finite_double(), *finite_double()};
  const int largest = common_exponent(values);
  const mpz_class a = to_integer(values[0], largest);
  const mpz_class b = to_integer(values[1], largest);
  if (a == 0 && b == 0) {
    RC_ASSERT(largest == 0);
  } else {
    RC_ASSERT(mpz_odd_p(a.get_mpz_t()) || mpz_odd_p(b.get_mpz_t()));
  }
  for (const int exponent : {largest, largest - *rc::gen::inRange(1, 200)}) {
    const auto value_of = [&](double number) {
      mpq_class value = to_integer(number, exponent);
      if (exponent >= 0) value <<= static_cast<mp_bitcnt_t>(exponent);
      if (exponent < 0) value >>= static_cast<mp_bitcnt_t>(-exponent);
      return value;
    };
    RC_ASSERT(value_of(values[0]) == to_rational(values[0]));
    RC_ASSERT(value_of(values[1]) == to_rational(values[1]));
  }
}

TEST(IntegerForms, IntegersOf64BitsAreReadWhateverTheSizeOfALong) {
  for (const std::int64_t value :
       {std::int64_t{0}, std::int64_t{-1}, (std::int64_t{1} << 31) - 1, std::int64_t{1} << 31,
        -(std::int64_t{1} << 31) - 1, (std::int64_t{1} << 53) - 1, -(std::int64_t{1} << 53) + 1,
        INT64_MAX, INT64_MIN}) {
    EXPECT_EQ(exact::to_integer(value).get_str(), std::to_string(value));
  }
  EXPECT_EQ(exact::to_integer(-0x1.fffffffffffffp+52, 0).get_str(), "-9007199254740991");
  EXPECT_EQ(exact::to_rational(0x1.0000000000001p-52).get_num().get_str(), "4503599627370497");
}

TEST(IntegerForms, SubnormalsAreReadInEveryEnvironment) {
  const double smallest = std::numeric_limits<double>::denorm_min();
  for (const auto& environment : tangency::testing::all_environments()) {
    const tangency::testing::EnvironmentGuard guard(environment);
    const Dyadic dyadic = decode(-smallest);
    EXPECT_EQ(dyadic.mantissa, -1) << environment.name;
    EXPECT_EQ(dyadic.exponent, -1074) << environment.name;
  }
}

/// The quadric at the point x, with 1 as its fourth coordinate.
mpq_class value_of(const EllipsoidForm& e, const std::array<mpq_class, 4>& x) {
  mpq_class sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) sum += x[i] * e.form[i][j] * x[j];
  }
  return sum / e.denominator;
}

// geometry/bodies/ellipsoid_form.hpp (1) (2)
RC_GTEST_PROP(EllipsoidFormProperty, IsMinusOneAtTheCentreAndZeroAtTheEndsOfTheAxes, ()) {
  const Ellipsoid e = *tangency::testing::ellipsoid(1000);
  const EllipsoidForm form = ellipsoid_form(e);
  const auto& stored = e.orientation();
  const std::array<mpq_class, 4> q{to_rational(stored.w()), to_rational(stored.x()),
                                   to_rational(stored.y()), to_rational(stored.z())};
  const mpq_class length2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  const std::array<mpq_class, 4> centre{to_rational(e.centre().x()), to_rational(e.centre().y()),
                                        to_rational(e.centre().z()), 1};
  RC_ASSERT(value_of(form, centre) == -1);
  // R(q) e_k = e_k + 2 v x (v x e_k + w e_k) / |q|^2, v the vector part of q: another way than the
  // matrix that the form is made from.
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<mpq_class, 3> unit{0, 0, 0};
    unit[k] = 1;
    const std::array<mpq_class, 3> v{q[1], q[2], q[3]};
    const auto cross = [](const auto& a, const auto& b) {
      return std::array<mpq_class, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                      a[0] * b[1] - a[1] * b[0]};
    };
    std::array<mpq_class, 3> inner = cross(v, unit);
    for (std::size_t i = 0; i < 3; ++i) inner[i] += q[0] * unit[i];
    const std::array<mpq_class, 3> turn = cross(v, inner);
    std::array<mpq_class, 4> end = centre;
    const mpq_class axis = to_rational(e.semi_axes()[static_cast<Eigen::Index>(k)]);
    for (std::size_t i = 0; i < 3; ++i) end[i] += axis * (unit[i] + 2 * turn[i] / length2);
    RC_ASSERT(value_of(form, end) == 0);
  }
  RC_ASSERT(inertia(form.form) == (Inertia{3, 1, 0}));
  RC_ASSERT(inertia(sub_form(form.form)) == (Inertia{3, 0, 0}));
}

TEST(EllipsoidForm, TheTrueUnitAndAPowerOfTwoUnitDescribeTheSameSolid) {
  for (const double size : {0x1p-30, 1.0, 0x1p+30}) {
    const Ellipsoid e({3 * size, -5 * size, size}, {size, 2 * size, 3 * size},
                      Eigen::Quaterniond(1, 2, -3, 4));
    const int exponent = length_exponent(e) - 3;
    const EllipsoidForm unit = ellipsoid_form(e, exponent);
    const EllipsoidForm plain = ellipsoid_form(e);
    const mpq_class step = to_rational(std::ldexp(1.0, exponent));
    const std::array<mpq_class, 4> units{7, -4, 9, 1};
    std::array<mpq_class, 4> x = units;
    for (std::size_t i = 0; i < 3; ++i) x[i] *= step;
    EXPECT_EQ(value_of(unit, units), value_of(plain, x)) << size;
  }
}

}  // namespace
}  // namespace tangency::exact
