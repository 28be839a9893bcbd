// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/tests/support/generators.hpp>

namespace tangency {
namespace {

using testing::Pair;

RelationAnswer exchanged(RelationAnswer r) {
  if (r.relation == Relation::a_in_b) {
    r.relation = Relation::b_in_a;
  } else if (r.relation == Relation::b_in_a) {
    r.relation = Relation::a_in_b;
  }
  if (r.inner != Inner::none) r.inner = r.inner == Inner::a ? Inner::b : Inner::a;
  return r;
}

bool same(const RelationAnswer& x, const RelationAnswer& y) {
  return x.relation == y.relation && x.inner == y.inner;
}

bool interiors_meet(Relation r) { return r != Relation::separate && r != Relation::external_touch; }

// geometry/relation.hpp (1)
RC_GTEST_PROP(RelationProperty, ExchangingTheBodiesExchangesTheAnswer, ()) {
  const Pair p = *testing::any_pair();
  RC_ASSERT(same(relation(p.b, p.a), exchanged(relation(p.a, p.b))));
}

// geometry/relation.hpp (2)
RC_GTEST_PROP(RelationProperty, OverlapsIsTheRelationsYesOrNo, ()) {
  const Pair p = *testing::any_pair();
  const RelationAnswer r = relation(p.a, p.b);
  RC_ASSERT(overlaps(p.a, p.b) == interiors_meet(r.relation));
  RC_TAG(std::string(to_string(r.relation)));
}

// geometry/relation.hpp (6)
RC_GTEST_PROP(RelationProperty, WhatTheFilterAnswersIsTheAnswer, ()) {
  const Pair p = *testing::any_pair();
  const std::optional<bool> known = overlaps_by_filter(p.a, p.b);
  const OverlapAnswer answer = overlap_answer(p.a, p.b);
  RC_ASSERT(known.has_value() == (answer.tier == Tier::filter));
  if (known) RC_ASSERT(*known == answer.overlaps);
  RC_TAG(known.has_value());
}

// geometry/relation.hpp (3)
RC_GTEST_PROP(RelationProperty, ScalingBothByAPowerOfTwoLeavesIt, ()) {
  const Pair p = *testing::any_pair();
  const double s = std::ldexp(1.0, *rc::gen::inRange(-900, 900));
  const auto scaled = [&](const Ellipsoid& e) {
    return Ellipsoid(s * e.centre(), s * e.semi_axes(), e.orientation());
  };
  RC_ASSERT(same(relation(scaled(p.a), scaled(p.b)), relation(p.a, p.b)));
}

// geometry/relation.hpp (3)
RC_GTEST_PROP(RelationProperty, PermutingAndReflectingCoordinatesLeavesIt, ()) {
  const Pair p = *testing::any_pair();
  // A cyclic permutation of the coordinates, which is a rotation, then the reflection x -> -x,
  // which takes the rotation of (w, x, y, z) to that of (w, x, -y, -z) up to the body's own
  // symmetry.
  const auto moved = [](const Ellipsoid& e) {
    const Vec3& c = e.centre();
    const Eigen::Quaterniond& q = e.orientation();
    return Ellipsoid(Vec3(-c[1], c[2], c[0]), e.semi_axes()({1, 2, 0}),
                     Eigen::Quaterniond(q.w(), q.y(), -q.z(), -q.x()));
  };
  RC_ASSERT(same(relation(moved(p.a), moved(p.b)), relation(p.a, p.b)));
}

// geometry/relation.hpp (3)
RC_GTEST_PROP(RelationProperty, SignAndLengthOfTheQuaternionAndOrderOfAxesLeaveIt, ()) {
  const Pair p = *testing::any_pair();
  const Vec3& r = p.b.semi_axes();
  const Eigen::Quaterniond& q = p.b.orientation();
  const Ellipsoid longer(p.b.centre(), r, Eigen::Quaterniond(-0x1p40 * q.coeffs()));
  RC_ASSERT(same(relation(p.a, longer), relation(p.a, p.b)));
  // Times (1, 1, 1, 1), a third of a turn, exactly: each component is a sum of four.
  const Eigen::Quaterniond turned = q * Eigen::Quaterniond(1, 1, 1, 1);
  const Eigen::Quaterniond back = turned * Eigen::Quaterniond(1, -1, -1, -1);
  if (back.coeffs() == 4 * q.coeffs()) {
    const Ellipsoid cycled(p.b.centre(), {r[1], r[2], r[0]}, turned);
    RC_ASSERT(same(relation(p.a, cycled), relation(p.a, p.b)));
    RC_TAG("axes permuted");
  }
}

// geometry/relation.hpp (4)
RC_GTEST_PROP(RelationProperty, GrowingABodyNeverTurnsOverlapsOff, ()) {
  const Pair p = *testing::any_pair();
  const Ellipsoid grown(p.b.centre(), p.b.semi_axes() * *testing::uniform(1, 2), p.b.orientation());
  Vec3 axes = p.b.semi_axes();
  axes[*rc::gen::inRange(0, 3)] *= *testing::uniform(1, 2);
  const Ellipsoid stretched(p.b.centre(), axes, p.b.orientation());
  if (overlaps(p.a, p.b)) {
    RC_ASSERT(overlaps(p.a, grown));
    RC_ASSERT(overlaps(p.a, stretched));
  }
}

// geometry/relation.hpp (5)
RC_GTEST_PROP(RelationProperty, AgreesWithTheSignOfTheGap, ()) {
  const Pair p = *testing::any_pair();
  const Gap gap = signed_gap(p.a, p.b);
  const double size =
      (p.b.centre() - p.a.centre()).norm() + p.a.largest_semi_axis() + p.b.largest_semi_axis();
  const bool meet = interiors_meet(relation(p.a, p.b).relation);
  // Within the error that gap.hpp states the sign of the gap is not known.
  if (gap.gap < -0x1p-49 * size) RC_ASSERT(meet);
  if (gap.gap > 0x1p-49 * size) RC_ASSERT(!meet);
}

}  // namespace
}  // namespace tangency
