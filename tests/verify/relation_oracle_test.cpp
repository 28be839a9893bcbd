// SPDX-License-Identifier: GPL-3.0-or-later
//
// The relation oracle against pairs worked out by hand, against families whose relation is known by
// construction, and against itself: swapped bodies, and guessed witnesses against the pencil alone.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <tangency/verify/families/adversarial.hpp>
#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::verify {

// For GoogleTest's messages.
void PrintTo(const ExactRelation& r, std::ostream* out) {
  *out << name(r.relation);
  if (r.inner != Inner::none) *out << (r.inner == Inner::a ? " (a inside)" : " (b inside)");
}

namespace {

using enum Relation;

constexpr ExactRelation kInsideA{internal_touch, Inner::b};
constexpr ExactRelation kInsideB{internal_touch, Inner::a};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

RawEllipsoid sphere(double x, double radius) { return {{x, 0, 0}, {radius, radius, radius}}; }

RawEllipsoid ellipsoid(std::array<double, 3> centre, std::array<double, 3> semi_axes,
                       std::array<double, 4> orientation = {1, 0, 0, 0}) {
  return {centre, semi_axes, orientation};
}

ExactRelation swapped(ExactRelation r) {
  if (r.relation == a_in_b || r.relation == b_in_a) {
    r.relation = r.relation == a_in_b ? b_in_a : a_in_b;
  }
  if (r.inner != Inner::none) r.inner = r.inner == Inner::a ? Inner::b : Inner::a;
  return r;
}

// One row of doubles that reads back exactly, for tests/data.
std::string row(const RawEllipsoid& a, const RawEllipsoid& b) {
  std::ostringstream out;
  out << std::hexfloat;
  for (const RawEllipsoid* e : {&a, &b}) {
    for (const double v : e->centre) out << v << ',';
    for (const double v : e->semi_axes) out << v << ',';
    for (const double v : e->orientation) out << v << ',';
  }
  return out.str();
}

// Both ways of deciding, and both with the bodies swapped.
void expect_relation(const RawEllipsoid& a, const RawEllipsoid& b, ExactRelation expected) {
  EXPECT_EQ(exact_relation(a, b), expected) << row(a, b);
  EXPECT_EQ(exact_relation_by_pencil(a, b), expected) << row(a, b);
  EXPECT_EQ(exact_relation(b, a), swapped(expected)) << row(a, b);
  EXPECT_EQ(exact_relation_by_pencil(b, a), swapped(expected)) << row(a, b);
  const bool meet = expected.relation != separate && expected.relation != external_touch;
  EXPECT_EQ(exact_overlaps(a, b), meet) << row(a, b);
  EXPECT_EQ(exact_overlaps(b, a), meet) << row(a, b);
}

TEST(RelationOracle, DecidesSpheresWhoseDiscriminantVanishesIdentically) {
  expect_relation(sphere(0, 1), sphere(4, 2), {separate});
  expect_relation(sphere(0, 1), sphere(3, 2), {external_touch});
  expect_relation(sphere(0, 1), sphere(2, 2), {overlap});
  expect_relation(sphere(0, 1), sphere(1, 2), kInsideB);
  expect_relation(sphere(0, 1), sphere(0.5, 2), {a_in_b});
  expect_relation(sphere(0, 1), sphere(0, 2), {a_in_b});
  expect_relation(sphere(3, 1), sphere(3, 1), {equal});
}

TEST(RelationOracle, SeesTheLastBitOnEitherSideOfATouch) {
  const auto at = [](double x) { return sphere(x, 1); };
  expect_relation(at(0), at(std::nextafter(2, kInfinity)), {separate});
  expect_relation(at(0), at(2), {external_touch});
  expect_relation(at(0), at(std::nextafter(2, 0)), {overlap});
  expect_relation(sphere(1, 2), sphere(std::nextafter(2, kInfinity), 1), {overlap});
  expect_relation(sphere(1, 2), sphere(2, 1), kInsideA);
  expect_relation(sphere(1, 2), sphere(std::nextafter(2, 0), 1), {b_in_a});
  // The smallest radius there is, against a touch: A ends at 1, B at 1 - or + the least double.
  const double least = std::numeric_limits<double>::denorm_min();
  expect_relation(sphere(-1, 1), sphere(least, least), {external_touch});
  expect_relation(sphere(-1, 1), sphere(2 * least, least), {separate});
  expect_relation(sphere(-1, 1), sphere(-least, least), kInsideA);
  expect_relation(sphere(-1, 1), sphere(0, least), {overlap});
}

TEST(RelationOracle, TellsTouchesFromCrossings) {
  const RawEllipsoid a = ellipsoid({0, 0, 0}, {2, 3, 4});
  expect_relation(a, ellipsoid({5, 0, 0}, {3, 1, 7}), {external_touch});
  expect_relation(a, ellipsoid({0, 0, 0}, {2, 2, 3}), kInsideA);   // at two points
  expect_relation(a, ellipsoid({0, 0, 0}, {2, 3, 3}), kInsideA);   // at four points
  expect_relation(a, ellipsoid({0, 0, 0}, {2, 2, 5}), {overlap});  // tangent, crossing elsewhere
  expect_relation(a, ellipsoid({0, 0, 0}, {1, 3, 5}), {overlap});
  expect_relation(ellipsoid({0, 0, 0}, {2, 2, 5}), sphere(0, 2), kInsideA);      // on a circle
  expect_relation(ellipsoid({0, 0, 0}, {25, 20, 20}), sphere(9, 16), kInsideA);  // off the centre
  expect_relation(ellipsoid({0, 0, 0}, {25, 20, 21}), sphere(9, 16), kInsideA);  // at two points
  expect_relation(ellipsoid({0, 0, 0}, {25, 20, 19}), sphere(9, 16), {overlap});
}

// At the vertex x = 4 of (4, 2, 2) both radii of curvature are 1.
TEST(RelationOracle, DecidesOsculatingContacts) {
  const RawEllipsoid a = ellipsoid({0, 0, 0}, {4, 2, 2});
  expect_relation(a, sphere(3, 1), kInsideA);                       // fourth-order contact
  expect_relation(a, ellipsoid({3, 0, 0}, {1, 0.5, 1}), kInsideA);  // in one direction
  expect_relation(a, sphere(2.999, 1.001), {overlap});              // a larger radius
  expect_relation(a, ellipsoid({3, 0, 0}, {1, 1, 1.0000001}), {overlap});
  // Away from the vertices an osculating circle crosses: contact of third order at (1500, 5000),
  // where the ellipse (2500, 6250) has the normal (15, 8)/17 and the radius of curvature 17^3.
  const RawEllipsoid wide = ellipsoid({0, 0, 0}, {2500, 6250, 6250});
  expect_relation(wide, ellipsoid({-2835, 2688, 0}, {4913, 4913, 4913}), {overlap});
  expect_relation(wide, ellipsoid({1485, 4992, 0}, {17, 17, 17}), kInsideA);
  expect_relation(wide, ellipsoid({1515, 5008, 0}, {17, 17, 17}), {external_touch});
}

TEST(RelationOracle, ReadsQuaternionsAsTheExactRotation) {
  // (1, 1, 1, 1) permutes the axes; 90 degrees about x exchanges y and z.
  expect_relation(ellipsoid({1, 2, 3}, {2, 3, 4}), ellipsoid({1, 2, 3}, {3, 4, 2}, {7, 7, 7, 7}),
                  {equal});
  expect_relation(ellipsoid({1, 2, 3}, {2, 3, 4}),
                  ellipsoid({1, 2, 3}, {2, 4, 3}, {-1e-200, -1e-200, 0, 0}), {equal});
  expect_relation(ellipsoid({1, 2, 3}, {2, 3, 4}), ellipsoid({1, 2, 3}, {3, 4, 2}), {overlap});
  // Turned by an angle whose tangent of the half is 2^-52: no longer equal.
  expect_relation(ellipsoid({0, 0, 0}, {2, 3, 4}),
                  ellipsoid({0, 0, 0}, {2, 3, 4}, {1, std::ldexp(1, -52), 0, 0}), {overlap});
  // A spheroid does not feel a turn about its own axis, a sphere none.
  expect_relation(ellipsoid({0, 0, 0}, {3, 3, 4}),
                  ellipsoid({0, 0, 0}, {3, 3, 4}, {0.3, 0, 0, 0.7}), {equal});
  expect_relation(sphere(0, 1), ellipsoid({2, 0, 0}, {1, 1, 1}, {0.1, 0.2, 0.3, 0.4}),
                  {external_touch});
}

TEST(RelationOracle, DecidesAtTheEndsOfTheExponentRange) {
  for (const double s : {1e-300, std::ldexp(1, -1070), std::ldexp(1, 1020)}) {
    expect_relation(sphere(0, s), sphere(2 * s, s), {external_touch});
    expect_relation(sphere(0, s), sphere(std::nextafter(2 * s, kInfinity), s), {separate});
  }
  expect_relation(sphere(0, 1e-300), sphere(0, 1e300), {a_in_b});
  expect_relation(sphere(1e300, 1e-300), sphere(0, 1e300), {overlap});  // its centre is on B
  expect_relation(sphere(-1e300, 1e-300), sphere(1e300, 1e-300), {separate});
  expect_relation(ellipsoid({0, 0, 0}, {1e-300, 1, 1e300}),
                  ellipsoid({0, 2, 0}, {1e300, 1, 1e-300}), {external_touch});
}

// det = c m(f)^2 with m irreducible: the forms are traces of h and (3 +- sqrt 2) h for
// h = x^2 + sqrt(2) y^2 over Q(sqrt 2), in coordinates in which both are ellipsoids. Over the
// reals: a sphere and a spheroid with the other two squares scaled by (3 + sqrt 2)/(3 - sqrt 2)
// > 1.
TEST(RelationOracle, DecidesAtIrrationalDoubleRoots) {
  const RawQuadric a{2, 4, 8, 0, 0, 0, 0, 0, 0, -8};
  const RawQuadric smaller{6, 12, 36, 4, 0, 0, 0, 0, -4, -12};
  const RawQuadric larger{6, 12, 12, -4, 0, 0, 0, 0, 4, -36};
  EXPECT_EQ(exact_relation_by_pencil(a, smaller), kInsideA);
  EXPECT_EQ(exact_relation_by_pencil(smaller, a), kInsideB);
  EXPECT_EQ(exact_relation_by_pencil(a, larger), kInsideB);
  EXPECT_EQ(exact_relation_by_pencil(larger, a), kInsideA);
  RawQuadric shrunk = smaller;  // by less than 1e-15 of its size: now strictly inside
  shrunk.K = std::nextafter(shrunk.K, 0);
  EXPECT_EQ(exact_relation_by_pencil(a, shrunk), ExactRelation{b_in_a});
  RawQuadric grown = smaller;
  grown.K = std::nextafter(grown.K, -kInfinity);
  EXPECT_EQ(exact_relation_by_pencil(a, grown), ExactRelation{overlap});
}

TEST(RelationOracle, TakesQuadricsOfEitherSign) {
  const RawQuadric unit{1, 1, 1, 0, 0, 0, 0, 0, 0, -1};
  const RawQuadric at_two{-1, -1, -1, 0, 0, 0, 2, 0, 0, -3};
  EXPECT_EQ(exact_relation_by_pencil(unit, at_two), ExactRelation{external_touch});
  const RawQuadric twice{-2, -2, -2, 0, 0, 0, 0, 0, 0, 2};
  EXPECT_EQ(exact_relation_by_pencil(unit, twice), ExactRelation{equal});
}

TEST(RelationOracle, RefusesWhatIsNoEllipsoid) {
  const RawEllipsoid good = sphere(0, 1);
  EXPECT_THROW(exact_relation(good, sphere(kInfinity, 1)), std::invalid_argument);
  EXPECT_THROW(exact_relation(good, sphere(0, 0)), std::invalid_argument);
  EXPECT_THROW(exact_relation(good, sphere(0, std::nan(""))), std::invalid_argument);
  EXPECT_THROW(exact_relation(good, ellipsoid({0, 0, 0}, {1, 1, 1}, {0, 0, 0, 0})),
               std::invalid_argument);
  const RawQuadric ball{1, 1, 1, 0, 0, 0, 0, 0, 0, -1}, cone{1, 1, -1, 0, 0, 0, 0, 0, 0, 0},
      empty{1, 1, 1, 0, 0, 0, 0, 0, 0, 1};
  EXPECT_THROW(exact_relation_by_pencil(ball, cone), std::invalid_argument);
  EXPECT_THROW(exact_relation_by_pencil(empty, ball), std::invalid_argument);
}

TEST(RelationOracle, AgreesWithEveryRelationKnownByConstruction) {
  constexpr std::uint64_t kSeed = 20261122;
  constexpr std::size_t kPairs = 5700;
  std::map<std::string, std::size_t> known;
  std::set<Relation> seen;
  std::size_t wrong = 0;
  for_each_adversarial_pair(kSeed, kPairs, [&](const AdversarialPair& p) {
    const ExactRelation r = exact_relation(p.a, p.b);
    seen.insert(r.relation);
    const bool sound = exact_relation(p.b, p.a) == swapped(r) &&
                       exact_relation_by_pencil(p.a, p.b) == r && (!p.relation || *p.relation == r);
    if (p.relation) ++known[std::string(p.family)];
    if (sound || ++wrong > 5) return;
    ADD_FAILURE() << p.family << ": " << testing::PrintToString(r) << ", known "
                  << (p.relation ? testing::PrintToString(*p.relation) : "not") << ": "
                  << row(p.a, p.b);
  });
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(seen.size(), 7U) << "some relation never came up";
  for (const std::string_view family : adversarial_family_names()) {
    if (family == "concentric_turned") continue;  // the one whose relations are not known
    EXPECT_GT(known[std::string(family)], 30U) << family;
  }
}

TEST(RelationOracle, WitnessesAgreeWithThePencilOnGenericPairs) {
  std::mt19937_64 bits(7);
  const auto real = [&](double from, double to) {
    return from + (to - from) * std::ldexp(static_cast<double>(bits() >> 11), -53);
  };
  const auto draw = [&](double aspect) {
    RawEllipsoid e{};
    for (double& v : e.centre) v = real(-1, 1);
    for (double& v : e.semi_axes) v = std::pow(aspect, real(-0.5, 0.5));
    for (double& v : e.orientation) v = real(-1, 1);
    return e;
  };
  std::map<Relation, int> seen;
  for (int i = 0; i < 4000; ++i) {
    const double aspect = i % 2 == 0 ? 5 : 1000;
    const RawEllipsoid a = draw(aspect), b = draw(aspect);
    const ExactRelation r = exact_relation(a, b);
    ++seen[r.relation];
    ASSERT_EQ(r, exact_relation_by_pencil(a, b)) << row(a, b);
    ASSERT_EQ(swapped(r), exact_relation(b, a)) << row(a, b);
  }
  for (const Relation r : {separate, overlap, a_in_b, b_in_a}) EXPECT_GT(seen[r], 20) << name(r);
}

// Of small numbers, so that axes are equal and every relation that concentric bodies can have
// comes.
TEST(RelationOracle, ConcentricPairsAgreeWithThePencil) {
  constexpr std::array<std::array<double, 4>, 5> kTurns{
      {{1, 0, 0, 0}, {1, 0, 0, 1}, {-2, 0, 0, 0}, {1, 1, 0, 0}, {2, 1, 0, -1}}};
  Draw draw(20261201);
  const auto body = [&] {
    RawEllipsoid e{{3, -2, 0.1}, {}, draw.one_of(kTurns)};
    for (double& v : e.semi_axes) v = draw.integer(2, 4);
    return e;
  };
  std::map<Relation, int> seen;
  for (int i = 0; i < 3000; ++i) {
    const RawEllipsoid a = body();
    RawEllipsoid b = body();
    if (i % 4 == 0) {
      const double shorter = std::ldexp(draw.integer(1, 15), -4);
      for (double& v : b.semi_axes) v *= shorter;
    }
    const ExactRelation r = exact_relation(a, b);
    ++seen[r.relation];
    ASSERT_EQ(r, exact_relation_by_pencil(a, b)) << row(a, b);
    ASSERT_EQ(swapped(r), exact_relation(b, a)) << row(a, b);
  }
  for (const Relation r : {overlap, internal_touch, a_in_b, b_in_a, equal}) {
    EXPECT_GT(seen[r], 20) << name(r);
  }
}

TEST(AdversarialPairs, DependOnTheSeedAndTheIndexAlone) {
  const auto rows = [](std::uint64_t seed, std::size_t count) {
    std::string all;
    for_each_adversarial_pair(seed, count,
                              [&](const AdversarialPair& p) { all += row(p.a, p.b) + '\n'; });
    return all;
  };
  const std::string longer = rows(1, 200);
  EXPECT_TRUE(longer.starts_with(rows(1, 100)));
  EXPECT_EQ(longer, rows(1, 200));
  EXPECT_NE(longer, rows(2, 200));
}

}  // namespace
}  // namespace tangency::verify
