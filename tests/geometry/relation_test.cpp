// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <vector>

#include <tangency/geometry/relation.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>
#include <tangency/verify/families/adversarial.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/extreme.hpp>
#include <tangency/verify/families/manufactured.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency {
namespace {

using Eigen::Quaterniond;

Ellipsoid sphere(const Vec3& centre, double radius) { return {centre, {radius, radius, radius}}; }

void expect_relation(const Ellipsoid& a, const Ellipsoid& b, Relation expected,
                     Inner inner = Inner::none) {
  const RelationAnswer answer = relation(a, b);
  EXPECT_EQ(to_string(answer.relation), to_string(expected));
  EXPECT_EQ(answer.inner, inner);
  const bool meet = expected != Relation::separate && expected != Relation::external_touch;
  EXPECT_EQ(overlaps(a, b), meet);
}

TEST(Relation, OfSpheresByHand) {
  const Ellipsoid unit = sphere({0, 0, 0}, 1);
  expect_relation(unit, sphere({3, 0, 0}, 1), Relation::separate);
  expect_relation(unit, sphere({2, 0, 0}, 1), Relation::external_touch);
  expect_relation(unit, sphere({1, 0, 0}, 1), Relation::overlap);
  expect_relation(unit, sphere({1, 0, 0}, 2), Relation::internal_touch, Inner::a);
  expect_relation(sphere({1, 0, 0}, 2), unit, Relation::internal_touch, Inner::b);
  expect_relation(unit, sphere({0.5, 0, 0}, 2), Relation::a_in_b);
  expect_relation(sphere({0, 0.5, 0}, 2), unit, Relation::b_in_a);
  expect_relation(unit, sphere({0, 0, 0}, 2), Relation::a_in_b);
  expect_relation(unit, unit, Relation::equal);
}

TEST(Relation, TellsTheNeighboursOfATouchApart) {
  const Ellipsoid unit = sphere({0, 0, 0}, 1);
  expect_relation(unit, sphere({std::nextafter(2.0, 3.0), 0, 0}, 1), Relation::separate);
  expect_relation(unit, sphere({std::nextafter(2.0, 1.0), 0, 0}, 1), Relation::overlap);
  expect_relation(unit, sphere({std::nextafter(1.0, 2.0), 0, 0}, 2), Relation::overlap);
  expect_relation(unit, sphere({std::nextafter(1.0, 0.0), 0, 0}, 2), Relation::a_in_b);
}

TEST(Relation, SeesTheSameSetBehindOtherNumbers) {
  const Ellipsoid a({1, 2, 3}, {3, 4, 5}, {1, 0, 0, 0});
  // A quarter turn about z, by a quaternion of length sqrt(2) * 7, exchanges the first two axes.
  expect_relation(a, Ellipsoid({1, 2, 3}, {4, 3, 5}, {7, 0, 0, 7}), Relation::equal);
  expect_relation(a, Ellipsoid({1, 2, 3}, {3, 4, 5}, {0, 0, -1e-200, 0}), Relation::equal);
  expect_relation(a, Ellipsoid({1, 2, 3}, {4, 3, 5}, {7, 0, 0, std::nextafter(7.0, 8.0)}),
                  Relation::overlap);
}

TEST(Relation, ConcentricShellsTouchWhereOneSemiAxisIsShared) {
  const Ellipsoid inner({0, 0, 0}, {1, 2, 3});
  expect_relation(inner, Ellipsoid({0, 0, 0}, {2, 3, 3}), Relation::internal_touch, Inner::a);
  expect_relation(inner, Ellipsoid({0, 0, 0}, {2, 3, 4}), Relation::a_in_b);
  expect_relation(inner, Ellipsoid({0, 0, 0}, {2, 3, 2}), Relation::overlap);
}

TEST(Relation, HoldsAtTheEndsOfTheRangeOfDoubles) {
  for (const double s : {0x1p-1000, 0x1p-500, 0x1p500, 0x1p1000}) {
    expect_relation(sphere({0, 0, 0}, s), sphere({2 * s, 0, 0}, s), Relation::external_touch);
    expect_relation(sphere({0, 0, 0}, s), sphere({3 * s, 0, 0}, s), Relation::separate);
    expect_relation(sphere({0, 0, 0}, s), sphere({s, 0, 0}, s), Relation::overlap);
  }
  const double tiny = std::numeric_limits<double>::denorm_min();
  const double huge = std::numeric_limits<double>::max();
  expect_relation(sphere({0, 0, 0}, tiny), sphere({2 * tiny, 0, 0}, tiny),
                  Relation::external_touch);
  expect_relation(sphere({0, 0, 0}, tiny), sphere({3 * tiny, 0, 0}, tiny), Relation::separate);
  expect_relation(sphere({-huge, 0, 0}, 1), sphere({huge, 0, 0}, 1), Relation::separate);
  expect_relation(sphere({-huge, 0, 0}, huge), sphere({huge, 0, 0}, huge),
                  Relation::external_touch);
  expect_relation(sphere({0, 0, 0}, tiny), sphere({0, 0, 0}, huge), Relation::a_in_b);
}

// Near copies of bodies of extreme numbers: what the exact tier finds hardest.
TEST(Relation, OfTheHeaviestPairsIsTheOracles) {
  std::set<Relation> seen;
  verify::HeaviestPairs pairs({40}, 20261122);  // the oracle needs a second at 1074
  for (int i = 0; i < 36; ++i) {
    const verify::EllipsoidPair p = pairs.next();
    const RelationAnswer answer = relation(verify::to_ellipsoid(p.a), verify::to_ellipsoid(p.b));
    const verify::ExactRelation truth = verify::exact_relation(p.a, p.b);
    ASSERT_EQ(to_string(answer.relation), verify::name(truth.relation)) << i;
    ASSERT_EQ(static_cast<int>(answer.inner), static_cast<int>(truth.inner)) << i;
    seen.insert(answer.relation);
  }
  EXPECT_GE(seen.size(), 5u);
}

TEST(Relation, OfGenericPairsComesFromTheFilter) {
  for (const auto& family : verify::contact_classes()) {
    verify::ManufacturedContacts contacts(family, 20261122);
    for (int i = 0; i < 5000; ++i) {
      const auto c = contacts.next();
      const Ellipsoid a = verify::to_ellipsoid(c.a), b = verify::to_ellipsoid(c.b);
      const OverlapAnswer answer = overlap_answer(a, b);
      ASSERT_EQ(answer.tier, Tier::filter) << family.name << ' ' << i;
      ASSERT_EQ(answer.overlaps, c.gap < 0) << family.name << ' ' << i;
      ASSERT_EQ(overlaps_by_filter(a, b), answer.overlaps) << family.name << ' ' << i;
    }
  }
}

TEST(Relation, OfPairsWithinRoundingOfATouchComesFromTheFilter) {
  for (verify::ContactFamily family : verify::contact_classes()) {
    family.gap_unit = verify::ContactFamily::GapUnit::smallest_semi_axis;
    family.largest_gap = 0x1p-50;
    verify::ManufacturedContacts contacts(family, 20261122);
    for (int i = 0; i < 300; ++i) {
      const auto c = contacts.next();
      const auto answer = overlap_answer(verify::to_ellipsoid(c.a), verify::to_ellipsoid(c.b));
      ASSERT_EQ(answer.tier, Tier::filter) << family.name << ' ' << i << ", gap " << c.gap;
    }
  }
}

TEST(Relation, OfExactTouchesComesFromTheExactTier) {
  int touches = 0;
  verify::for_each_adversarial_pair(1, 4000, [&](const verify::AdversarialPair& p) {
    if (!p.relation || p.relation->relation != verify::Relation::external_touch) return;
    ++touches;
    const auto answer = relation(verify::to_ellipsoid(p.a), verify::to_ellipsoid(p.b));
    ASSERT_EQ(answer.tier, Tier::exact) << p.family;
    ASSERT_EQ(answer.relation, Relation::external_touch) << p.family;
    ASSERT_EQ(overlaps_by_filter(verify::to_ellipsoid(p.a), verify::to_ellipsoid(p.b)),
              std::nullopt)
        << p.family;
  });
  EXPECT_GT(touches, 100);
}

TEST(Relation, IsTheSameInEveryRoundingModeAndWithSubnormalsFlushed) {
  struct Case {
    verify::RawEllipsoid a, b;
    RelationAnswer answer;
  };
  std::vector<Case> cases;
  const auto add = [&](const verify::RawEllipsoid& a, const verify::RawEllipsoid& b) {
    cases.push_back({a, b, relation(verify::to_ellipsoid(a), verify::to_ellipsoid(b))});
  };
  verify::for_each_adversarial_pair(2, 1900,
                                    [&](const verify::AdversarialPair& p) { add(p.a, p.b); });
  for (const auto& family : verify::contact_classes()) {
    verify::ManufacturedContacts contacts(family, 3);
    for (int i = 0; i < 300; ++i) {
      const auto c = contacts.next();
      add(c.a, c.b);
    }
  }
  const double tiny = std::numeric_limits<double>::denorm_min();
  add({{0, 0, 0}, {tiny, tiny, tiny}, {tiny, 0, 0, 0}},
      {{2 * tiny, 0, 0}, {tiny, tiny, tiny}, {0, tiny, 0, tiny}});

  for (const auto& environment : testing::all_environments()) {
    const testing::EnvironmentGuard guard(environment);
    for (const Case& c : cases) {
      const RelationAnswer now = relation(verify::to_ellipsoid(c.a), verify::to_ellipsoid(c.b));
      ASSERT_EQ(now.relation, c.answer.relation) << environment.name;
      ASSERT_EQ(now.inner, c.answer.inner) << environment.name;
    }
  }
}

}  // namespace
}  // namespace tangency
