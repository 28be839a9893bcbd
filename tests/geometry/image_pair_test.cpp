// SPDX-License-Identifier: GPL-3.0-or-later
// Images of bodies, whose centres need not be triples of doubles.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <tangency/geometry/image_gap.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>

namespace tangency {
namespace {

constexpr std::uint64_t kSeed = 20261130;

class Draw {
 public:
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  Vec3 vector(double low, double high) {
    const double x = between(low, high), y = between(low, high);
    return {x, y, between(low, high)};
  }
  std::int32_t whole(int most) {
    return static_cast<std::int32_t>(random_() % static_cast<unsigned>(2 * most + 1)) - most;
  }
  Ellipsoid body(const Vec3& centre) {
    const Vec3 axes = vector(0.3, 1.0);
    const double w = between(0.5, 1.0);
    const Vec3 v = vector(-1.0, 1.0);
    return {centre, axes, Quaternion(w, v[0], v[1], v[2])};
  }

 private:
  std::mt19937_64 random_{kSeed};
};

Mat3 skewed(Draw& draw) {
  Mat3 edges = draw.vector(2.0, 3.0).asDiagonal();
  edges(0, 1) = draw.between(-1.0, 1.0), edges(1, 2) = draw.between(-1.0, 1.0);
  return edges;
}

/// A pair that is near, of bodies that are up to some hundred edges apart.
struct Near {
  explicit Near(Draw& draw)
      : edges(skewed(draw)),
        image{draw.whole(100), draw.whole(3), draw.whole(3)},
        a(draw.body(draw.vector(-1.0, 1.0))),
        b(draw.body(a.centre() + draw.vector(-1.2, 1.2) -
                    edges * Vec3(image[0], image[1], image[2]))) {}
  LatticeImage back() const { return {-image[0], -image[1], -image[2]}; }

  Mat3 edges;
  LatticeImage image;
  Ellipsoid a, b;
};

Relation exchanged(Relation relation) {
  if (relation == Relation::a_in_b) return Relation::b_in_a;
  return relation == Relation::b_in_a ? Relation::a_in_b : relation;
}

/// Unit balls, the second at 3 L - 2 + step: its image is moved back by 3 L, which is no double.
struct Balls {
  Balls(double length, double step)
      : edges(Vec3(length, 1.0, 1.0).asDiagonal()),
        a(Vec3::Zero(), Vec3::Ones()),
        b(Vec3(length + (2.0 * length - 2.0) + step, 0.0, 0.0), Vec3::Ones()) {}
  Mat3 edges;
  Ellipsoid a, b;
};

// For L in [1.5, 5/3) that is an odd multiple of 2^-51, 3 L - 2 is a double, as is every sum on the
// way to it, and 3 L has one bit too many.
// geometry/relation.hpp (8)
TEST(ImagePair, RelationIsExactWhereTheCentreOfTheImageIsNoDouble) {
  Draw draw;
  int touches = 0;
  for (int k = 0; k < 50; ++k) {
    const double length = 1.5 + 0x1p-50 * std::floor(draw.between(0.0, 0x1p46)) + 0x1p-51;
    const mpq_class moved = 3 * mpq_class(length);
    ASSERT_NE(mpq_class(3.0 * length), moved);
    for (const double step : {-0x1p-51, 0.0, 0x1p-51}) {
      const Balls balls(length, step);
      const mpq_class distance = abs(mpq_class(balls.b.centre()[0]) - moved);
      const Relation expected = distance > 2   ? Relation::separate
                                : distance < 2 ? Relation::overlap
                                               : Relation::external_touch;
      EXPECT_EQ(relation(balls.a, balls.b, balls.edges, {-3, 0, 0}).relation, expected) << length;
      touches += expected == Relation::external_touch;
    }
  }
  EXPECT_EQ(touches, 50);
  const Balls here(3.0, 0.0);
  EXPECT_EQ(relation(here.a, here.b, here.edges, {0, 0, 0}).relation, Relation::separate);
  EXPECT_EQ(relation(here.a, here.a, here.edges, {0, 0, 0}).relation, Relation::equal);
}

// geometry/relation.hpp (9)
TEST(ImagePair, ExchangesItsBodies) {
  Draw draw;
  int meet = 0;
  for (int k = 0; k < 200; ++k) {
    const Near near(draw);
    const RelationAnswer there = relation(near.a, near.b, near.edges, near.image);
    const RelationAnswer back = relation(near.b, near.a, near.edges, near.back());
    EXPECT_EQ(back.relation, exchanged(there.relation));
    meet += there.relation == Relation::overlap;
  }
  EXPECT_GT(meet, 20);
  EXPECT_LT(meet, 180);
}

// geometry/image_gap.hpp (1)
TEST(ImagePair, GapsHaveTheSignOfTheRelationAndCountWhatIsRounded) {
  Draw draw;
  int rounds = 0;
  for (int k = 0; k < 200; ++k) {
    const Near near(draw);
    const ImageSeparation d = separation(near.a.centre(), near.b.centre(), near.edges, near.image);
    const Gap gap = signed_gap(near.a, near.b, near.edges, near.image);
    const Gap rounded = signed_gap(near.a, near.b, d.vector);
    rounds += d.error > 0.0;
    EXPECT_GE(gap.gap_error, rounded.gap_error + d.error);
    EXPECT_LE(std::abs(gap.gap - rounded.gap), gap.gap_error);
    const bool apart =
        relation(near.a, near.b, near.edges, near.image).relation == Relation::separate;
    EXPECT_EQ(gap.gap > 0.0, apart);
  }
  EXPECT_GT(rounds, 150);
  for (const double step : {-0x1p-51, 0.0, 0x1p-51}) {
    const Balls balls(1.5 + 0x1p-51, step);
    const Relation exact = relation(balls.a, balls.b, balls.edges, {-3, 0, 0}).relation;
    const Gap gap = signed_gap(balls.a, balls.b, balls.edges, {-3, 0, 0});
    EXPECT_EQ(gap.gap == 0.0, exact == Relation::external_touch);
    EXPECT_EQ(gap.gap > 0.0, exact == Relation::separate);
  }
}

mpq_class component(const Near& near, int i) {
  mpq_class d = mpq_class(near.b.centre()[i]) - mpq_class(near.a.centre()[i]);
  for (int k = 0; k < 3; ++k)
    d += mpq_class(near.edges(i, k)) * near.image[static_cast<std::size_t>(k)];
  return d;
}

// geometry/lattice.hpp (1)
TEST(ImagePair, SeparationIsWithinItsErrorOfTheTrueOne) {
  Draw draw;
  for (int k = 0; k < 500; ++k) {
    const Near near(draw);
    const ImageSeparation d = separation(near.a.centre(), near.b.centre(), near.edges, near.image);
    mpq_class square = 0;
    for (int i = 0; i < 3; ++i) {
      const mpq_class off = component(near, i) - mpq_class(d.vector[i]);
      square += off * off;
    }
    ASSERT_LE(square, mpq_class(d.error) * mpq_class(d.error));
    ASSERT_LE(d.error, 1e-12);
  }
  const Mat3 edges = Vec3(0.1, 0.25, 1.0).asDiagonal();
  const ImageSeparation exact = separation(Vec3::Ones(), Vec3::Zero(), edges, {0, 3, -4});
  EXPECT_EQ(exact.vector, Vec3(-1.0, -0.25, -5.0));
  EXPECT_EQ(separation(Vec3::Zero(), Vec3::Zero(), edges, {4, 0, 0}).error, 0.0);
}

TEST(ImagePair, SeparationIsFiniteWhereTermsOverflowOnTheWay) {
  const Mat3 edges = Vec3(0x1p1023, 1.0, 1.0).asDiagonal();
  const Vec3 far(0x1.8p1023, 0.0, 0.0);
  const ImageSeparation d = separation(-far, far, edges, {-2, 0, 0});
  EXPECT_EQ(d.vector, Vec3(0x1p1023, 0.0, 0.0));
  EXPECT_LE(d.error, 0x1p980);
  const ImageSeparation beyond = separation(-far, far, edges, {2, 0, 0});
  EXPECT_TRUE(beyond.vector.allFinite());
  EXPECT_FALSE(std::isfinite(beyond.error));
}

TEST(ImagePair, OfBodiesByMatricesIsThatOfTheBodiesMeant) {
  Draw draw;
  for (int k = 0; k < 30; ++k) {
    const Vec3 axes = 0x1p-3 * Vec3(3 + k % 5, 5, 7 + k % 3), other(0.75, 1.0, 0.5);
    const Mat3 edges = skewed(draw);
    const LatticeImage image{draw.whole(5), draw.whole(5), 0};
    const Vec3 at = draw.vector(-1.0, 1.0) - edges * Vec3(image[0], image[1], 0.0);
    const auto matrix = [](const Vec3& centre, const Vec3& a) {
      return MatrixEllipsoid::from_shape(centre, a.cwiseAbs2().asDiagonal());
    };
    const Ellipsoid a(Vec3::Zero(), axes), b(at, other);
    const MatrixEllipsoid ma = matrix(Vec3::Zero(), axes), mb = matrix(at, other);
    const RelationAnswer expected = relation(a, b, edges, image);
    const RelationAnswer found = relation(ma, mb, edges, image);
    EXPECT_EQ(found.relation, expected.relation);
    EXPECT_EQ(found.inner, expected.inner);
    EXPECT_EQ(signed_gap(ma, mb, edges, image).gap > 0.0, expected.relation == Relation::separate);
  }
  // Balls of radius sqrt(2), which touch along a diagonal.
  const Mat3 shape = 2.0 * Mat3::Identity(), edges = 0.1 * Mat3::Identity();
  const MatrixEllipsoid ball = MatrixEllipsoid::from_shape(Vec3::Zero(), shape);
  for (const double off : {-0x1p-40, 0.0, 0x1p-40}) {
    const double at = -5.0 * 0.1;  // rounds to -1/2, and 5 times the double 0.1 is above 1/2
    const MatrixEllipsoid other = MatrixEllipsoid::from_shape(Vec3(2.0 + off, 1.5, 0.0), shape);
    const Relation found = relation(ball, other, edges, {0, 5, 0}).relation;
    EXPECT_EQ(at, -0.5);
    EXPECT_EQ(found, off < 0.0 ? Relation::overlap : Relation::separate) << off;
  }
}

TEST(ImagePair, AnswersAreTheSameInEveryEnvironment) {
  Draw draw;
  for (int k = 0; k < 20; ++k) {
    const Near near(draw);
    const Gap expected = signed_gap(near.a, near.b, near.edges, near.image);
    const ImageSeparation d = separation(near.a.centre(), near.b.centre(), near.edges, near.image);
    for (const auto& environment : testing::all_environments()) {
      SCOPED_TRACE(environment.name);
      Gap found;
      ImageSeparation there;
      {
        const testing::EnvironmentGuard guard(environment);
        found = signed_gap(near.a, near.b, near.edges, near.image);
        there = separation(near.a.centre(), near.b.centre(), near.edges, near.image);
      }
      EXPECT_EQ(found.gap, expected.gap);
      EXPECT_EQ(found.gap_error, expected.gap_error);
      EXPECT_EQ(there.vector, d.vector);
      EXPECT_EQ(there.error, d.error);
    }
  }
}

}  // namespace
}  // namespace tangency
