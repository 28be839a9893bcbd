// SPDX-License-Identifier: GPL-3.0-or-later
// The exact tiers against oracles that decide by other theorems (verify/oracles).
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include <tangency/geometry/plane/ellipse_meeting.hpp>
#include <tangency/geometry/relation/exact_pair.hpp>
#include <tangency/tests/support/ellipse_generators.hpp>
#include <tangency/tests/support/generators.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/oracles/ellipse.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::exact {
namespace {

using tangency::testing::EllipsePair;
using tangency::testing::Pair;

/// Positive roots, counted with multiplicity: those of p, of gcd(p, p'), and so on.
int positive_roots(IntegerPolynomial p) {
  int count = 0;
  while (p.degree() > 0) {
    count += SturmSequence(p).roots_above(0);
    p = gcd(p, p.derivative());
  }
  return count;
}

// geometry/relation/exact_pair.hpp (1) (2)
RC_GTEST_PROP(PairQuarticProperty, EndsAreNegativeAndTwoRootsAtLeast, ()) {
  const Pair p = *tangency::testing::any_pair();
  const IntegerPolynomial quartic = ExactPair(p.a, p.b).quartic();
  RC_ASSERT(quartic.degree() == 4);
  RC_ASSERT(quartic.leading() < 0);
  RC_ASSERT(quartic.sign_at(0) < 0);
  RC_ASSERT(positive_roots(quartic.reflected()) >= 2);
}

// geometry/relation/exact_pair.hpp (3)
RC_GTEST_PROP(PairQuarticProperty, PositiveRootsTellThePosition, ()) {
  const Pair p = *tangency::testing::any_pair();
  const ExactPair pair(p.a, p.b);
  const IntegerPolynomial& quartic = pair.quartic();
  const int distinct = SturmSequence(quartic).roots_above(0);
  switch (verify::exact_relation(tangency::verify::to_raw(p.a), tangency::verify::to_raw(p.b))
              .relation) {
    case verify::Relation::separate:
      RC_ASSERT(distinct == 2 && pair.position() == Position::apart);
      break;
    case verify::Relation::external_touch:
      RC_ASSERT(distinct == 1 && positive_roots(quartic) == 2);
      RC_ASSERT(pair.position() == Position::touching);
      RC_TAG("touch");
      break;
    default:
      RC_ASSERT(distinct == 0 && pair.position() == Position::interiors_meet);
  }
}

// geometry/relation/exact_pair.hpp (4)
RC_GTEST_PROP(PairQuarticProperty, ExchangingTheBodiesReversesThePolynomials, ()) {
  const Pair p = *tangency::testing::any_pair();
  const ExactPair forth(p.a, p.b), back(p.b, p.a);
  RC_ASSERT(back.quartic() == forth.exchanged().quartic());
  RC_ASSERT(back.shapes() == forth.exchanged().shapes());
}

std::vector<int> multiplicities(Meeting meeting) {
  switch (meeting) {
    case Meeting::equal:
    case Meeting::nowhere:
      break;
    case Meeting::two_simple:
      return {1, 1};
    case Meeting::four_simple:
      return {1, 1, 1, 1};
    case Meeting::one_double:
      return {2};
    case Meeting::double_and_two_simple:
      return {1, 1, 2};
    case Meeting::two_double:
      return {2, 2};
    case Meeting::triple_and_simple:
      return {1, 3};
    case Meeting::quadruple:
      return {4};
  }
  return {};
}

verify::RawEllipse raw(const Ellipse& e) {
  const Vec2 &c = e.centre(), &r = e.semi_axes(), &u = e.direction();
  return {{c[0], c[1]}, {r[0], r[1]}, {u[0], u[1]}};
}

/// Pairs that meet in a multiple point or two, which are rare among others: the vertices of two
/// ellipses on one axis, circles within an ellipse through the ends of its axes, circles of
/// curvature where (cos, sin) is a Pythagorean (3, 4) / 5.
rc::Gen<EllipsePair> touching_ellipses() {
  return rc::gen::map(
      rc::gen::tuple(rc::gen::inRange(1, 9), rc::gen::inRange(1, 9), rc::gen::inRange(1, 9),
                     rc::gen::inRange(1, 9), rc::gen::inRange(0, 4)),
      [](const std::tuple<int, int, int, int, int>& t) {
        const auto [p, q, r, s, kind] = t;
        const Ellipse a(Vec2::Zero(), Vec2(p, q));
        if (kind == 0) return EllipsePair{a, Ellipse(Vec2(p - r, 0), Vec2(r, s))};
        if (kind == 1) return EllipsePair{a, Ellipse(Vec2::Zero(), Vec2(p, p))};
        // The radius of curvature at the vertex: a fourfold point.
        if (kind == 2)
          return EllipsePair{Ellipse(Vec2::Zero(), Vec2(p * p, p * q)),
                             Ellipse(Vec2(p * p - q * q, 0), Vec2(q * q, q * q))};
        // Centre (a^2 - b^2) (cos^3 / a, -sin^3 / b), radius (a^2 sin^2 + b^2 cos^2)^(3/2) / (a b),
        // rational for the semi-axes 45 and 80 of a's unit.
        const double unit = std::exp2(p - q);
        return EllipsePair{Ellipse(Vec2::Zero(), unit * Vec2(45, 80)),
                           Ellipse(unit * Vec2(r % 2 == 0 ? -21 : 21, s % 2 == 0 ? 28 : -28),
                                   unit * Vec2(60, 60))};
      });
}

// geometry/plane/ellipse_meeting.hpp (1) (2) (3) (4)
RC_GTEST_PROP(ConicPairProperty, RelationAndMultiplicitiesAreTheOracles, ()) {
  const EllipsePair p = *rc::gen::oneOf(tangency::testing::any_ellipse_pair(), touching_ellipses());
  const ConicAnswer found = conic_relation(p.a, p.b);
  const verify::EllipseTruth truth = verify::exact_ellipse_relation(raw(p.a), raw(p.b));
  RC_ASSERT(to_string(found.relation) == verify::name(truth.relation.relation));
  RC_ASSERT(static_cast<int>(found.inner) == static_cast<int>(truth.relation.inner));
  RC_ASSERT((found.meeting == Meeting::equal) == (truth.crossings == -1));
  RC_ASSERT(multiplicities(found.meeting) == truth.multiplicities);
  RC_TAG(std::string(to_string(found.relation)), static_cast<int>(found.meeting));
}

}  // namespace
}  // namespace tangency::exact
