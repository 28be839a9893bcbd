// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies given by matrices, vectors and quadrics, against bodies by semi-axes that are the same
// solid exactly, and against an oracle of quadrics.
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iostream>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/geometry/bodies/rational_solid.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency {
namespace {

using Precise = boost::multiprecision::cpp_bin_float_100;

/// A solid in every form, all of the same numbers exactly: with an integer quaternion, |q|^2 R is
/// of integers, and so are M = (|q|^2 R) diag(n^2) (|q|^2 R)' and the axis vectors.
struct Forms {
  Ellipsoid ellipsoid;
  MatrixEllipsoid shape, axes;
};

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : random_(seed) {}
  int integer(int low, int high) { return std::uniform_int_distribution<>(low, high)(random_); }
  double uniform() { return std::uniform_real_distribution<>(-1.0, 1.0)(random_); }

  Forms forms(const Vec3& centre) {
    Quaternion q(1, 0, 0, 0);  // half of all: such bodies touch now and then
    if (integer(0, 1) == 1) {
      do {
        q = Quaternion(integer(-2, 2), integer(-2, 2), integer(-2, 2), integer(-2, 2));
      } while (q.squaredNorm() == 0.0);
    }
    const double norm = q.squaredNorm();
    const double w = q.w(), x = q.x(), y = q.y(), z = q.z();
    Mat3 r;
    r << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (z * x + w * y),
        2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),
        2 * (z * x - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
    const Vec3 n(integer(1, 3), integer(1, 3), integer(1, 3));
    const Mat3 u = r * n.asDiagonal();
    return {Ellipsoid(centre, norm * n, q), MatrixEllipsoid::from_shape(centre, u * u.transpose()),
            MatrixEllipsoid::from_axes(centre, u)};
  }
  /// Half of all are on the x axis, where bodies touch now and then.
  Vec3 centre(int reach) {
    Vec3 c(integer(-reach, reach), 0.0, 0.0);
    if (integer(0, 1) == 1) c += Vec3(0.0, integer(-reach, reach), integer(-reach, reach));
    return c;
  }

 private:
  std::mt19937_64 random_;
};

void expect_same(const RelationAnswer& got, const RelationAnswer& wanted, const std::string& of) {
  EXPECT_EQ(to_string(got.relation), to_string(wanted.relation)) << of;
  EXPECT_EQ(got.inner, wanted.inner) << of;
}

// geometry/matrix_ellipsoid.hpp (3)
TEST(MatrixEllipsoid, ExactMatricesLieAsTheirEllipsoidsDoWhateverTheForm) {
  Draws draws(11);
  std::array<int, 7> seen{};
  for (int k = 0; k < 3000; ++k) {
    const Forms a = draws.forms(draws.centre(6)), b = draws.forms(draws.centre(6));
    const RelationAnswer truth = relation(a.ellipsoid, b.ellipsoid);
    ++seen[static_cast<std::size_t>(truth.relation)];
    expect_same(relation(MatrixEllipsoid(a.ellipsoid), MatrixEllipsoid(b.ellipsoid)), truth,
                "axes");
    expect_same(relation(a.shape, b.axes), truth, "shape and vectors");
    expect_same(relation(a.axes, b.shape), truth, "vectors and shape");
    expect_same(relation(MatrixEllipsoid(a.ellipsoid), b.shape), truth, "axes and shape");
  }
  for (const Relation kind : {Relation::separate, Relation::external_touch, Relation::overlap,
                              Relation::internal_touch, Relation::a_in_b, Relation::b_in_a})
    EXPECT_GT(seen[static_cast<std::size_t>(kind)], 0) << to_string(kind);
}

TEST(MatrixEllipsoid, ABodyIsEqualToItselfInEveryFormAndToNoneOfANeighbouringEntry) {
  Draws draws(12);
  for (int k = 0; k < 300; ++k) {
    const Vec3 c(draws.uniform(), draws.uniform(), draws.uniform());
    const Forms forms = draws.forms(c);
    EXPECT_EQ(relation(forms.shape, forms.axes).relation, Relation::equal);
    EXPECT_EQ(relation(forms.shape, forms.ellipsoid).relation, Relation::equal);
    Mat3 m = Mat3::Random();
    m = (m * m.transpose()).eval();
    m = (0.5 * (m + m.transpose())).eval();
    m += 0.25 * Mat3::Identity();
    const MatrixEllipsoid whole = MatrixEllipsoid::from_shape(c, m);
    Mat3 larger = m;
    larger(1, 1) = std::nextafter(m(1, 1), 10.0);
    EXPECT_EQ(relation(whole, MatrixEllipsoid::from_shape(c, larger)).relation,
              Relation::internal_touch);
    EXPECT_EQ(relation(whole, MatrixEllipsoid::from_shape(c, larger)).inner, Inner::a);
  }
}

// geometry/matrix_ellipsoid.hpp (1) (2) (4)
TEST(MatrixEllipsoid, FormsThatAreExactlyTheSameSolidAreEqual) {
  Mat3 m;
  m << 4.0, 0.0, 0.0, 0.0, 0.25, 0.0, 0.0, 0.0, 16.0;
  const Vec3 c(0.1, -3.0, 7.5);
  const MatrixEllipsoid shape = MatrixEllipsoid::from_shape(c, m);
  EXPECT_EQ(relation(shape, MatrixEllipsoid::from_precision(c, m.inverse())).relation,
            Relation::equal);
  EXPECT_EQ(relation(shape, MatrixEllipsoid::from_shape(c, 0.5 * m, 2.0)).relation,
            Relation::equal);
  EXPECT_EQ(relation(shape, MatrixEllipsoid::from_precision(c, 8.0 * m.inverse(), 8.0)).relation,
            Relation::equal);
  const Quadric::Coefficients plain{0.3, 0.7, 1.1, 0.1, 0.2, -0.1, 0.4, -0.3, 0.6, -2.0};
  for (const double factor : {-1.0, 0x1p-30, -0x1p40, 3.0}) {
    Quadric::Coefficients multiple = plain;
    for (double& coefficient : multiple) coefficient *= factor;
    const Relation found = relation(MatrixEllipsoid::from_quadric(Quadric(plain)),
                                    MatrixEllipsoid::from_quadric(Quadric(multiple)))
                               .relation;
    // Three times most of these coefficients is rounded: another solid.
    EXPECT_EQ(found == Relation::equal, factor != 3.0) << factor;
  }
}

TEST(MatrixEllipsoid, QuadricsLieAsTheOracleOfQuadricsSays) {
  Draws draws(13);
  std::array<int, 7> seen{};
  const auto drawn = [&](double spread) {
    Mat3 m = Mat3::NullaryExpr([&] { return draws.uniform(); });
    m = (m * m.transpose()).eval() + 0.05 * Mat3::Identity();
    const Vec3 c = spread * Vec3(draws.uniform(), draws.uniform(), draws.uniform());
    const Vec3 g = -(m * c);
    return Quadric::Coefficients{m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2),
                                 m(2, 0), g[0],    g[1],    g[2],    c.dot(m * c) - 0.3};
  };
  const auto raw = [](const Quadric::Coefficients& c) {
    return verify::RawQuadric{c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], c[9]};
  };
  for (int k = 0; k < 400; ++k) {
    const Quadric::Coefficients a = drawn(1.0);
    Quadric::Coefficients b = k % 2 == 0 ? drawn(1.5) : a;
    if (k % 2 == 1) {  // neighbours of the same body
      for (int step = draws.integer(0, 2); step > 0; --step) {
        double& entry = b[static_cast<std::size_t>(draws.integer(0, 9))];
        entry = std::nextafter(entry, draws.integer(0, 1) == 0 ? -9.0 : 9.0);
      }
    }
    const auto truth = verify::exact_relation_by_pencil(raw(a), raw(b));
    const RelationAnswer found = relation(MatrixEllipsoid::from_quadric(Quadric(a)),
                                          MatrixEllipsoid::from_quadric(Quadric(b)));
    EXPECT_EQ(to_string(found.relation), verify::name(truth.relation)) << k;
    EXPECT_EQ(static_cast<int>(found.inner), static_cast<int>(truth.inner)) << k;
    ++seen[static_cast<std::size_t>(found.relation)];
  }
  EXPECT_GT(seen[static_cast<std::size_t>(Relation::equal)], 0);
  EXPECT_GT(seen[static_cast<std::size_t>(Relation::separate)], 0);
  EXPECT_GT(seen[static_cast<std::size_t>(Relation::internal_touch)] +
                seen[static_cast<std::size_t>(Relation::overlap)],
            50);
}

Precise precise_support(const Mat3& m, const Vec3& n) {
  Precise sum = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) sum += Precise(n[i]) * m(i, j) * n[j];
  }
  return sqrt(sum);
}

Precise precise_support(const Ellipsoid& e, const Vec3& n) {
  const Quaternion q = e.orientation();
  const Precise w = q.w(), x = q.x(), y = q.y(), z = q.z(), norm = w * w + x * x + y * y + z * z;
  const Precise r[3][3] = {
      {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (z * x + w * y)},
      {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
      {2 * (z * x - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
  Precise sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Precise along = (r[0][k] * n[0] + r[1][k] * n[1] + r[2][k] * n[2]) / norm;
    sum += along * along * e.semi_axes()[k] * e.semi_axes()[k];
  }
  return sqrt(sum);
}

// geometry/bodies/rational_solid.hpp (2)
TEST(MatrixEllipsoid, SupportFunctionsDifferByNoMoreThanTheRoundingSays) {
  Draws draws(14);
  double largest = 0.0;
  for (int k = 0; k < 300; ++k) {
    Mat3 u = Mat3::NullaryExpr([&] { return draws.uniform(); });
    for (int j = 0; j < 3; ++j) u.col(j) *= std::exp2(draws.integer(-20, 3));
    Mat3 m = u * u.transpose();
    m = (0.5 * (m + m.transpose())).eval();
    // Its own rounding may leave a matrix that is not definite.
    if (m.ldlt().vectorD().minCoeff() <= 0x1p-45 * m.trace()) continue;
    const MatrixEllipsoid body = MatrixEllipsoid::from_shape(Vec3::Zero(), m);
    const double size = body.ellipsoid().largest_semi_axis();
    EXPECT_LE(body.rounding(), 8.0 * kUnitRoundoff * size);
    for (int i = 0; i < 30; ++i) {
      Vec3 n(draws.uniform(), draws.uniform(), draws.uniform());
      if (i < 3) n = body.ellipsoid().rotation().col(i);
      const Precise length =
          sqrt(Precise(n[0]) * n[0] + Precise(n[1]) * n[1] + Precise(n[2]) * n[2]);
      const Precise truth = precise_support(m, n), rounded = precise_support(body.ellipsoid(), n);
      const double off = static_cast<double>(abs(truth - rounded) / length);
      EXPECT_LE(off, body.rounding());
      EXPECT_LE(static_cast<double>(abs(truth / rounded - 1)), body.relative_rounding());
      largest = std::max(largest, off / body.rounding());
    }
  }
  EXPECT_GT(largest, 0.2) << "a bound that is this loose says little";
  std::cout << "largest difference over its bound: " << largest << '\n';
}

TEST(MatrixEllipsoid, GapsOfTheSameSolidAgreeWithinTheirErrors) {
  Draws draws(15);
  for (int k = 0; k < 2000; ++k) {
    const Forms a = draws.forms(draws.centre(9)), b = draws.forms(draws.centre(9));
    const Gap by_axes = signed_gap(a.ellipsoid, b.ellipsoid),
              by_shape = signed_gap(a.shape, b.shape);
    EXPECT_LE(std::abs(by_axes.gap - by_shape.gap), by_axes.gap_error + by_shape.gap_error);
    EXPECT_EQ(by_shape.gap > 0.0, by_axes.gap > 0.0);
    EXPECT_EQ(by_shape.gap == 0.0, by_axes.gap == 0.0);
  }
}

// geometry/bodies/rational_solid.hpp (1)
TEST(MatrixEllipsoid, IntegerFormIsMinusOneAtTheCentreAndZeroAtTheEndsOfTheAxes) {
  using exact::to_rational;
  Draws draws(16);
  for (int k = 0; k < 50; ++k) {
    const Vec3 c(draws.uniform(), draws.uniform(), draws.uniform());
    Mat3 u = Mat3::NullaryExpr([&] { return draws.uniform(); });
    exact::RationalSolid<3> solid;
    for (std::size_t i = 0; i < 3; ++i) {
      solid.centre[i] = to_rational(c[static_cast<int>(i)]);
      for (std::size_t j = 0; j < 3; ++j) {
        for (int n = 0; n < 3; ++n)
          solid.shape[i][j] +=
              to_rational(u(static_cast<int>(i), n)) * to_rational(u(static_cast<int>(j), n));
      }
    }
    const exact::SolidForm<4> form = exact::integer_form(solid);
    const auto value = [&](int axis) {  // at the centre, or c + that column of U
      std::array<mpq_class, 4> x{solid.centre[0], solid.centre[1], solid.centre[2], 1};
      for (std::size_t i = 0; axis >= 0 && i < 3; ++i)
        x[i] += to_rational(u(static_cast<int>(i), axis));
      mpq_class sum;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) sum += x[i] * form.form[i][j] * x[j];
      }
      return mpq_class(sum / form.denominator);
    };
    EXPECT_EQ(value(-1), -1);
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(value(axis), 0);
  }
}

std::string fault_of(const std::function<void()>& make) {
  try {
    make();
  } catch (const InvalidEllipsoid& invalid) {
    return invalid.what();
  }
  return "no fault";
}

TEST(MatrixEllipsoid, FaultsNameTheEntryOrTheSmallestEigenvalue) {
  const Vec3 c = Vec3::Zero();
  Mat3 m = Mat3::Identity();
  m(0, 1) = 0.5;
  EXPECT_EQ(fault_of([&] { (void)MatrixEllipsoid::from_shape(c, m); }),
            "m.xy = 0: the matrix must be symmetric, and its other entry is not equal");
  m(0, 1) = m(1, 0) = 1.5;
  EXPECT_EQ(fault_of([&] { (void)MatrixEllipsoid::from_shape(c, m); }),
            "m = -0.5: the smallest eigenvalue must be > 0");
  EXPECT_EQ(fault_of([&] { (void)MatrixEllipsoid::from_precision(c, m); }),
            "p = -0.5: the smallest eigenvalue must be > 0");
  m(0, 1) = m(1, 0) = 1.0;
  EXPECT_EQ(fault_of([&] { (void)MatrixEllipsoid::from_shape(c, m); }).substr(0, 4), "m = ");
  m(2, 2) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(fault_of([&] { (void)MatrixEllipsoid::from_shape(c, m); }),
            "m.zz = inf: an entry of a matrix must be finite");
  EXPECT_EQ(fault_of([&] { (void)MatrixEllipsoid::from_shape(c, Mat3::Identity(), 0.0); }),
            "level = 0: a level must be finite and > 0");
  EXPECT_EQ(fault_of([&] { (void)MatrixEllipsoid::from_axes(c, Mat3::Zero()); }),
            "u1 = 0: a semi-axis must be longer than 0");
  Mat3 oblique = Mat3::Identity();
  oblique(0, 1) = 0.75;
  oblique(1, 1) = 1.0;
  EXPECT_EQ(
      fault_of([&] { (void)MatrixEllipsoid::from_axes(c, oblique); }),
      "u1 = 0.6: the cosine between this semi-axis and the next must be at most 2^-40 in size");
  EXPECT_EQ(
      fault_of([&] {
        (void)MatrixEllipsoid::from_quadric(Quadric({1, 1, -1, 0, 0, 0, 0, 0, 0, -1}));
      }),
      "quadric = -1: the quadric must be a real ellipsoid; this is the smallest eigenvalue of "
      "its block");
  EXPECT_EQ(fault_of([&] { (void)MatrixEllipsoid::from_shape(Vec3(NAN, 0, 0), m); }),
            "x = nan: a centre must be finite");
}

TEST(MatrixEllipsoid, ASingularOrAHugeMatrixIsRefusedAndAnExtremeOneServed) {
  const Vec3 c = Vec3::Zero();
  Mat3 m = Mat3::Identity();
  m(0, 0) = 0x1p-1060;
  const MatrixEllipsoid disc = MatrixEllipsoid::from_shape(c, m);
  EXPECT_EQ(disc.ellipsoid().smallest_semi_axis(), 0x1p-530);
  EXPECT_EQ(disc.rounding(), 0.0);
  m(0, 0) = 0.0;
  EXPECT_THROW((void)MatrixEllipsoid::from_shape(c, m), InvalidEllipsoid);
  m(0, 0) = 0x1p1000;
  EXPECT_THROW((void)MatrixEllipsoid::from_precision(c, m * 0x1p-1070, 0x1p1000), InvalidEllipsoid);
}

TEST(LevelOfConfidence, IsTheQuantileOfChiSquaredToTheLastPlace) {
  using boost::math::chi_squared_distribution;
  using boost::math::complement;
  using boost::math::quantile;
  for (const int n : {2, 3}) {
    const chi_squared_distribution<long double> exact(n);
    for (const double p :
         {0x1p-1074, 0x1p-1022, 1e-300, 0x1p-600, 0x1p-450, 0x1p-200, 1e-30, 1e-9, 0.001, 0.1,
          0.3935, 0.5, 0.6827, 0.9, 0.95, 0.99, 0.999999, 1 - 0x1p-40, 1 - 0x1p-53}) {
      const long double q = 1.0L - static_cast<long double>(p);
      const double truth = static_cast<double>(
          p < 0.5 ? quantile(exact, static_cast<long double>(p)) : quantile(complement(exact, q)));
      EXPECT_LE(std::abs(level_of_confidence(p, n) - truth), 0x1p-52 * truth) << p << ", " << n;
    }
  }
  EXPECT_THROW((void)level_of_confidence(0.0, 3), std::invalid_argument);
  EXPECT_THROW((void)level_of_confidence(1.0, 3), std::invalid_argument);
  EXPECT_THROW((void)level_of_confidence(0.5, 4), std::invalid_argument);
}

}  // namespace
}  // namespace tangency
