// SPDX-License-Identifier: GPL-3.0-or-later
// Ellipses given by matrices and conics, against ellipses by semi-axes that are the same solid
// exactly.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>

#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/matrix_ellipse.hpp>

namespace tangency {
namespace {

/// An ellipse in every form, all of the same numbers exactly: with an integer direction u,
/// N = |u|^2 and semi-axes N n, M = N (n1^2 uu' + n2^2 vv') and its adjugate are of integers.
struct Forms {
  Ellipse ellipse;
  MatrixEllipse shape, conic;
};

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : random_(seed) {}
  int integer(int low, int high) { return std::uniform_int_distribution<>(low, high)(random_); }
  double uniform() { return std::uniform_real_distribution<>(-1.0, 1.0)(random_); }

  /// Half of all lie along the x axis, where they touch now and then.
  Forms forms() {
    Vec2 c(integer(-8, 8), 0.0), u(1.0, 0.0);
    if (integer(0, 1) == 1) {
      c[1] = integer(-8, 8);
      u = Vec2(integer(1, 2), integer(-1, 2));
    }
    const Vec2 n(integer(1, 3), integer(1, 3)), v(-u[1], u[0]);
    const double norm = u.squaredNorm();
    const MatrixEllipse::Symmetric2 m{
        norm * (n[0] * n[0] * u[0] * u[0] + n[1] * n[1] * v[0] * v[0]),
        norm * (n[0] * n[0] * u[1] * u[1] + n[1] * n[1] * v[1] * v[1]),
        norm * (n[0] * n[0] * u[0] * u[1] + n[1] * n[1] * v[0] * v[1])};
    // (x - c)' adj(M) (x - c) - det M
    const double a = m.yy, b = -2.0 * m.xy, k = m.xx, det = m.xx * m.yy - m.xy * m.xy;
    const double d = -(2.0 * a * c[0] + b * c[1]), e = -(b * c[0] + 2.0 * k * c[1]);
    const double f = a * c[0] * c[0] + b * c[0] * c[1] + k * c[1] * c[1] - det;
    return {Ellipse(c, norm * n, u), MatrixEllipse::from_shape(c, m),
            MatrixEllipse::from_conic({a, b, k, d, e, f})};
  }

 private:
  std::mt19937_64 random_;
};

void expect_same(const EllipseRelation& got, const EllipseRelation& wanted, const char* of) {
  EXPECT_EQ(to_string(got.relation), to_string(wanted.relation)) << of;
  EXPECT_EQ(got.inner, wanted.inner) << of;
  EXPECT_EQ(got.crossings, wanted.crossings) << of;
}

// geometry/matrix_ellipse.hpp (3)
TEST(MatrixEllipse, ExactMatricesLieAndCrossAsTheirEllipsesDoWhateverTheForm) {
  Draws draws(21);
  std::array<int, 7> seen{};
  for (int k = 0; k < 3000; ++k) {
    const Forms a = draws.forms(), b = draws.forms();
    const EllipseRelation truth = relation(a.ellipse, b.ellipse);
    ++seen[static_cast<std::size_t>(truth.relation)];
    expect_same(relation(MatrixEllipse(a.ellipse), MatrixEllipse(b.ellipse)), truth, "axes");
    expect_same(relation(a.shape, b.conic), truth, "shape and conic");
    expect_same(relation(a.conic, b.shape), truth, "conic and shape");
    expect_same(relation(a.shape, MatrixEllipse(b.ellipse)), truth, "shape and axes");
    const PlaneGap by_axes = signed_gap(a.ellipse, b.ellipse), given = signed_gap(a.shape, b.conic);
    EXPECT_LE(std::abs(by_axes.gap - given.gap), by_axes.gap_error + given.gap_error);
    EXPECT_EQ(by_axes.gap == 0.0, given.gap == 0.0);
    EXPECT_EQ(by_axes.gap > 0.0, given.gap > 0.0);
  }
  for (std::size_t kind = 0; kind < seen.size(); ++kind)
    EXPECT_GT(seen[kind], 0) << to_string(static_cast<Relation>(kind));
}

// geometry/matrix_ellipse.hpp (1) (2)
// geometry/matrix_ellipse.hpp (4)
TEST(MatrixEllipse, FormsThatAreExactlyTheSameSolidAreEqual) {
  const Vec2 c(0.1, -3.0);
  const MatrixEllipse shape = MatrixEllipse::from_shape(c, {4.0, 0.25, 0.0});
  const auto equal = [&](const MatrixEllipse& a, const MatrixEllipse& b) {
    return relation(a, b).relation == Relation::equal;
  };
  EXPECT_TRUE(equal(shape, MatrixEllipse::from_precision(c, {0.25, 4.0, 0.0})));
  EXPECT_TRUE(equal(shape, MatrixEllipse::from_shape(c, {2.0, 0.125, 0.0}, 2.0)));
  EXPECT_TRUE(equal(shape, MatrixEllipse::from_precision(c, {2.0, 32.0, 0.0}, 8.0)));
  const std::array<double, 6> plain{0.3, 0.1, 0.7, 0.4, -0.3, -2.0};
  for (const double factor : {-1.0, 0x1p-30, -0x1p40, 3.0}) {
    std::array<double, 6> multiple = plain;
    for (double& coefficient : multiple) coefficient *= factor;
    // Three times most of these coefficients is rounded: another solid.
    EXPECT_EQ(equal(MatrixEllipse::from_conic(plain), MatrixEllipse::from_conic(multiple)),
              factor != 3.0)
        << factor;
  }
}

TEST(MatrixEllipse, ANeighbouringEntryIsSeen) {
  Draws draws(22);
  for (int k = 0; k < 300; ++k) {
    const Vec2 c(draws.uniform(), draws.uniform());
    const double xy = 0.5 * draws.uniform(), xx = 1.5 + draws.uniform(), yy = 1.5 + draws.uniform();
    const MatrixEllipse body = MatrixEllipse::from_shape(c, {xx, yy, xy});
    const MatrixEllipse larger = MatrixEllipse::from_shape(c, {xx, std::nextafter(yy, 10.0), xy});
    EXPECT_EQ(relation(body, larger).relation, Relation::internal_touch);
    EXPECT_EQ(relation(body, larger).inner, Inner::a);
    EXPECT_LE(body.rounding(), 8.0 * kUnitRoundoff * body.ellipse().largest_semi_axis());
  }
}

std::string fault_of(const std::function<void()>& make) {
  try {
    make();
  } catch (const InvalidEllipse& invalid) {
    return invalid.what();
  }
  return "no fault";
}

TEST(MatrixEllipse, FaultsNameTheEntryOrTheSmallestEigenvalue) {
  const Vec2 c = Vec2::Zero();
  EXPECT_EQ(fault_of([&] {
              (void)MatrixEllipse::from_shape(c, {1.0, 1.0, 1.5});
            }),
            "m = -0.5: the smallest eigenvalue must be > 0");
  EXPECT_EQ(fault_of([&] {
              (void)MatrixEllipse::from_precision(c, {1.0, 1.0, 1.5});
            }),
            "p = -0.5: the smallest eigenvalue must be > 0");
  EXPECT_EQ(fault_of([&] {
              (void)MatrixEllipse::from_shape(c, {1.0, NAN, 0.5});
            }),
            "m.yy = nan: an entry of a matrix must be finite");
  EXPECT_EQ(fault_of([&] {
              (void)MatrixEllipse::from_shape(c, {1.0, 1.0, 0.5}, -1.0);
            }),
            "level = -1: a level must be finite and > 0");
  EXPECT_EQ(fault_of([&] {
              (void)MatrixEllipse::from_conic({1.0, 0.0, -1.0, 0.0, 0.0, 1.0});
            }),
            "conic = -1: the conic must be a real ellipse; this is the smallest eigenvalue of its "
            "block");
  EXPECT_EQ(fault_of([&] {
              (void)MatrixEllipse::from_conic({1.0, 0.0, 1.0, 0.0, 0.0, 1.0});
            }),
            "F = 1: the conic must be a real ellipse; this one has no inside");
}

}  // namespace
}  // namespace tangency
