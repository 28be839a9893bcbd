// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies by columns: their answers are those of the ellipsoids that the columns mean.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <tangency/geometry/batch/lane_block.hpp>
#include <tangency/geometry/batch/shape_rows.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>
#include <tangency/verify/families/adversarial.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/extreme.hpp>

namespace tangency {
namespace {

using testing::at_every_level;
using testing::Columns;
using testing::Family;
using testing::Indexed;
using testing::kSeed;
using testing::same_bits;

/// In u L, what gap_batch.hpp (4) promises of moving bodies.
constexpr double kMovingBound = 26.0;

/// The bodies of a family by columns, and those columns as ellipsoids about the origin.
struct Moving {
  explicit Moving(const Family& f) : in(f) {
    for (Ellipsoid& body : in.bodies) {
      semi_axes.push_back(body.semi_axes());
      orientations.push_back(body.orientation());
      body = body.moved_to(Vec3::Zero());
    }
    bodies = MovingBodies(semi_axes, orientations);
  }
  PairList list() const { return {in.pairs, in.separations}; }
  const Ellipsoid& a(std::size_t i) const { return in.bodies[2 * i]; }
  const Ellipsoid& b(std::size_t i) const { return in.bodies[2 * i + 1]; }
  double size(std::size_t i) const {
    return in.separations[i].norm() + a(i).largest_semi_axis() + b(i).largest_semi_axis();
  }

  Indexed in;
  std::vector<Vec3> semi_axes;
  std::vector<Quaternion> orientations;
  MovingBodies bodies;
};

/// Those that have a separation: it is given.
std::vector<Family> families() {
  std::vector<Family> all = testing::drawn_families();
  for (Family& f : all) {
    Family kept{f.name, {}, {}};
    for (std::size_t i = 0; i < f.a.size(); ++i) {
      if (!(f.b[i].centre() - f.a[i].centre()).allFinite()) continue;
      kept.a.push_back(f.a[i]);
      kept.b.push_back(f.b[i]);
    }
    f = std::move(kept);
  }
  return all;
}

int sign(double x) { return (x > 0) - (x < 0); }

void expect_agreement(const Gap& moving, const Gap& single, double size, std::size_t i) {
  ASSERT_EQ(moving.status, single.status) << i;
  ASSERT_EQ(sign(moving.gap), sign(single.gap)) << i;
  if (single.status != GapStatus::ok || !std::isfinite(single.gap)) {
    ASSERT_TRUE(same_bits(moving.gap, single.gap)) << i;
    return;
  }
  ASSERT_LE(std::abs(moving.gap - single.gap), moving.gap_error + single.gap_error) << i;
  if (moving.gap_error != single.gap_error) {
    ASSERT_LE(moving.gap_error, kMovingBound * kUnitRoundoff * size * (1 + 4 * kUnitRoundoff)) << i;
  }
}

// geometry/gap_batch.hpp (1) (4)
TEST(MovingBodies, AgreeWithTheSingleCallOfTheBodiesMeantOnEveryFamilyAtEveryLevel) {
  for (const Family& f : families()) {
    SCOPED_TRACE(f.name);
    Moving m(f);
    std::vector<Gap> single;
    for (std::size_t i = 0; i < f.a.size(); ++i)
      single.push_back(signed_gap(m.a(i), m.b(i), m.in.separations[i]));
    at_every_level([&] {
      m.bodies.refresh(0, m.bodies.size());
      Columns answers(f.a.size());
      signed_gaps(m.bodies, m.list(), answers.all());
      for (std::size_t i = 0; i < single.size(); ++i)
        expect_agreement(answers[i], single[i], m.size(i), i);
    });
  }
}

// docs/derivations/gap-batch.md (Q), entry by entry: a factor that all have in common, and the
// rest.
TEST(MovingBodies, HaveRowsWithinTheBoundOfTheirRotation) {
  constexpr double u = kUnitRoundoff;
  const Family f = testing::contacts(verify::contact_classes()[1], 4000);
  Moving m(f);
  std::mt19937_64 random(kSeed);
  const auto draw = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1.0; };
  for (Quaternion& q : m.orientations) q = Quaternion(draw(), draw(), draw(), draw());
  at_every_level([&] {
    m.bodies.refresh(0, m.bodies.size());
    double worst = 0.0;
    for (std::size_t b = 0; b < m.bodies.size(); ++b) {
      const Ellipsoid meant = m.bodies[b];
      const detail::LaneBody& row = m.bodies.lanes()[b];
      ASSERT_EQ(row.largest, meant.largest_semi_axis());
      ASSERT_LT(row.least_radius, meant.least_radius());
      ASSERT_GT(row.least_radius, (1.0 - 0x1p-39) * meant.least_radius());
      for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 3; ++i) {
          const double r = meant.rotation()(i, k), stored = row.factor[3 * k + i];
          // 4 in common, 2 and the product with the semi-axis; this rotation's own rounding.
          const double bound = u * ((i == k ? 2.0 : 1.0) + 8.0 * std::abs(r));
          const double off = std::abs(std::fma(-meant.semi_axes()[k], r, stored));
          ASSERT_LE(off, meant.semi_axes()[k] * bound) << b;
          worst = std::max(worst, off / (meant.semi_axes()[k] * u));
        }
      }
    }
    std::printf("largest error of an entry: %.2f u of the semi-axis\n", worst);
    EXPECT_GT(worst, 1.5);  // as rounded once it would not be above 1: this is the quick rotation
  });
}

TEST(MovingBodies, OfAnyLengthOfTheQuaternionMeanTheRotationExactly) {
  const Family f = testing::contacts(verify::contact_classes()[1], 2000);
  for (const double length : {1.0, 0.75, 1.9, 0x1p-20, 0x1p+25, 0x1p-40, 0x1p500}) {
    SCOPED_TRACE(length);
    Moving m(f);
    for (Quaternion& q : m.orientations) q.coeffs() *= length;
    std::vector<Ellipsoid> meant;
    for (std::size_t i = 0; i < m.semi_axes.size(); ++i)
      meant.emplace_back(Vec3::Zero(), m.semi_axes[i], m.orientations[i]);
    at_every_level([&] {
      m.bodies.refresh(0, m.bodies.size());
      Columns answers(f.a.size());
      signed_gaps(m.bodies, m.list(), answers.all());
      std::size_t from_lanes = 0;
      for (std::size_t i = 0; i < f.a.size(); ++i) {
        const Gap single = signed_gap(meant[2 * i], meant[2 * i + 1], m.in.separations[i]);
        expect_agreement(answers[i], single, m.size(i), i);
        if (answers[i].gap_error != single.gap_error) ++from_lanes;
      }
      const bool in_range = length * length >= 0x1p-60 && length * length <= 0x1p60;
      if (in_range)
        EXPECT_GE(from_lanes, f.a.size() - f.a.size() / 50);
      else
        EXPECT_EQ(from_lanes, 0u);
    });
  }
}

// docs/derivations/gap-batch.md: F = 10 of each body's largest semi-axis, in u.
TEST(MovingBodies, HaveTheErrorOfTheirRotationInTheirGapError) {
  const Moving m(testing::contacts(verify::contact_classes()[0], 1000));
  const BodyArray exact(m.in.bodies);
  const std::size_t count = m.in.pairs.size();
  at_every_level([&] {
    Columns moving(count), array(count);
    signed_gaps(m.bodies, m.list(), moving.all());
    signed_gaps(exact, m.list(), array.all());
    std::size_t larger = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const double axes = m.a(i).largest_semi_axis() + m.b(i).largest_semi_axis();
      if (moving.gap_error[i] >= array.gap_error[i] + 9.0 * kUnitRoundoff * axes) ++larger;
    }
    // The others were single calls, or took a step more.
    EXPECT_GE(larger, count - count / 50);
  });
}

// geometry/gap_batch.hpp (2)
TEST(MovingBodies, AreAskedAfreshWhereThePreviousNormalIsNothingWhateverTheirNeighboursAre) {
  for (const Family& f : families()) {
    SCOPED_TRACE(f.name);
    Moving m(f);
    const std::size_t count = f.a.size();
    std::vector<Vec3> previous(count);
    std::mt19937_64 random(kSeed);
    at_every_level([&] {
      m.bodies.refresh(0, m.bodies.size());
      Columns afresh(count), followed(count), mixed(count);
      signed_gaps(m.bodies, m.list(), afresh.all());
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3 n = afresh.normal[i];
        previous[i] = n + 1e-4 * Vec3(0.3, -0.5, 0.8).cross(n);
      }
      follow_gaps(m.bodies, m.list(), previous, followed.all());
      for (const unsigned one_in : {2u, 20u}) {
        std::vector<Vec3> some = previous;
        std::vector<bool> fresh(count);
        for (std::size_t i = 0; i < count; ++i) {
          fresh[i] = random() % one_in == 0;
          if (fresh[i]) some[i] = Vec3(0.0, -0.0, 0.0);
        }
        follow_gaps(m.bodies, m.list(), some, mixed.all());
        for (std::size_t i = 0; i < count; ++i)
          ASSERT_TRUE(same_bits(mixed[i], fresh[i] ? afresh[i] : followed[i])) << i;
        GapColumns in_place = mixed.all();
        in_place.normal = some;
        follow_gaps(m.bodies, m.list(), some, in_place);
        for (std::size_t i = 0; i < count; ++i) {
          ASSERT_TRUE(same_bits(some[i], mixed.normal[i])) << i;
          ASSERT_TRUE(same_bits(mixed[i], fresh[i] ? afresh[i] : followed[i])) << i;
        }
      }
    });
  }
}

TEST(MovingBodies, AskedAfreshAreAnsweredInTheLanes) {
  const Moving m(testing::contacts(verify::contact_classes()[0], 1000));
  const std::size_t count = m.in.pairs.size();
  const std::vector<Vec3> nothing(count, Vec3::Zero());
  at_every_level([&] {
    Columns answers(count);
    follow_gaps(m.bodies, m.list(), nothing, answers.all());
    std::size_t of_lanes = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Gap single = signed_gap(m.a(i), m.b(i), m.in.separations[i]);
      if (answers.gap_error[i] != single.gap_error) ++of_lanes;
    }
    EXPECT_GE(of_lanes, count - count / 50);
  });
}

TEST(MovingBodies, RowsDoNotDependOnTheRangesThatAreRefreshed) {
  const Family f = testing::contacts(verify::contact_classes()[1], 101);
  Moving m(f);
  at_every_level([&] {
    m.bodies.refresh(0, m.bodies.size());
    Columns whole(f.a.size()), parts(f.a.size());
    signed_gaps(m.bodies, m.list(), whole.all());
    for (const std::size_t step : {1u, 3u, 8u, 17u, 64u}) {
      std::vector<Vec3> axes(m.semi_axes.size(), Vec3(1, 2, 3));
      MovingBodies bodies(axes, m.orientations);
      std::copy(m.semi_axes.begin(), m.semi_axes.end(), axes.begin());
      for (std::size_t i = 0; i < bodies.size(); i += step)
        bodies.refresh(i, std::min(bodies.size(), i + step));
      signed_gaps(bodies, m.list(), parts.all());
      for (std::size_t i = 0; i < f.a.size(); ++i) ASSERT_TRUE(same_bits(parts[i], whole[i])) << i;
    }
  });
}

/// All but what is unused.
std::vector<double> numbers(const detail::ShapeRow& row) {
  std::vector<double> all(row.centre, row.centre + 3);
  all.insert(all.end(), {row.largest, row.least_radius, row.reach});
  all.insert(all.end(), row.shape, row.shape + 6);
  return all;
}
std::vector<double> numbers(const detail::FloatRow& row) {
  std::vector<double> all(row.centre, row.centre + 3);
  all.insert(all.end(), {row.largest, row.least_radius, row.widest});
  all.insert(all.end(), row.shape, row.shape + 6);
  return all;
}
template <class Row>
bool same(const Row& a, const Row& b) {
  const std::vector<double> p = numbers(a), q = numbers(b);
  return std::equal(p.begin(), p.end(), q.begin(),
                    [](double x, double y) { return std::isnan(x) ? std::isnan(y) : x == y; });
}

// geometry/batch/moving_lanes.hpp: several bodies at once are written as one is, thick and flat
// ones, far too large and small ones, whole registers and what is left over.
TEST(MovingBodies, HaveTheRowsThatEachBodyHasByItself) {
  Moving m(testing::contacts(verify::contact_classes()[1], 101));
  std::vector<Vec3> centres;
  for (std::size_t i = 0; i < m.semi_axes.size(); ++i) {
    if (i % 7 == 0) m.semi_axes[i][static_cast<Eigen::Index>(i % 3)] *= 0x1p-6;
    if (i % 11 == 0) m.semi_axes[i] *= i % 2 == 0 ? 0x1p70 : 0x1p-70;
    centres.emplace_back(0.5, -static_cast<double>(i), 1.0);
  }
  at_every_level([&] {
    for (const bool placed : {false, true}) {
      const MovingBodies bodies(m.semi_axes,
                                {m.orientations, placed ? VectorColumn(centres) : VectorColumn()});
      std::size_t thick = 0;
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        const Vec3 centre = placed ? centres[i] : Vec3(Vec3::Zero());
        const detail::LaneBody& lane = bodies.lanes()[i];
        ASSERT_EQ(Vec3(Vec3::Map(lane.centre)), centre) << i;
        detail::ShapeRow row;
        detail::FloatRow floats;
        detail::fill_shape_rows(&lane, 1, &row);
        detail::fill_float_rows(&lane, &row, 1, &floats);
        ASSERT_TRUE(same(bodies.rows()[i], row)) << i;
        ASSERT_TRUE(same(bodies.floats()[i], floats)) << i;
        if (!std::isnan(row.largest)) ++thick;
      }
      EXPECT_GT(thick, bodies.size() / 2);
      EXPECT_LT(thick, bodies.size() * 9 / 10);
    }
  });
}

TEST(MovingBodies, LookedAtInDoubleAloneHaveTheSameAnswersToTheBit) {
  const Family f = testing::contacts(verify::contact_classes()[1], 101);
  Moving m(f);
  MovingBodies bodies;
  bodies.look_at(m.semi_axes, m.orientations, Questions::in_double);
  at_every_level([&] {
    m.bodies.refresh(0, m.bodies.size());
    bodies.refresh(0, bodies.size());
    Columns with(f.a.size()), without(f.a.size());
    signed_gaps(m.bodies, m.list(), with.all());
    signed_gaps(bodies, m.list(), without.all());
    for (std::size_t i = 0; i < f.a.size(); ++i) ASSERT_TRUE(same_bits(with[i], without[i])) << i;
  });
  // What owns its numbers answers anything again.
  bodies.set_semi_axes(0, std::span<const Vec3>(m.semi_axes).first(1));
  m.bodies.refresh(0, m.bodies.size());
  Columns with(f.a.size()), without(f.a.size());
  signed_gaps(m.bodies, m.list(), with.all(), Accuracy::fast());
  signed_gaps(bodies, m.list(), without.all(), Accuracy::fast());
  for (std::size_t i = 0; i < f.a.size(); ++i) ASSERT_TRUE(same_bits(with[i], without[i])) << i;
}

/// Two bodies, and one pair more than fits into a block.
struct Few {
  std::vector<Vec3> axes{Vec3(1, 2, 3), Vec3(1, 2, 1)};
  std::vector<Quaternion> turns{Quaternion(1, 0, 0, 0), Quaternion(0.8, 0.6, 0, 0)};
  MovingBodies bodies{axes, turns};
  std::vector<IndexedPair> pairs{65, IndexedPair{0, 1}};
  std::vector<Vec3> separations{65, Vec3(2.5, 0, 0)}, normals{65, Vec3(1, 0, 0)};
  std::vector<double> gaps = std::vector<double>(65);
};

TEST(MovingBodies, AreEmptyAsACopyAndWhenMovedFrom) {
  Few f;
  MovingBodies copy(f.bodies);
  EXPECT_EQ(copy.size(), 0u);
  EXPECT_EQ(f.bodies.size(), 2u);
  MovingBodies moved(std::move(f.bodies));
  EXPECT_EQ(moved.size(), 2u);
  EXPECT_EQ(f.bodies.size(), 0u);  // NOLINT: what is left of it is promised
  EXPECT_DEATH(signed_gaps(f.bodies, {f.pairs, f.separations}, {.gap = f.gaps}),
               "and there are 0 bodies");
  copy.look_at(f.axes, f.turns);
  copy.refresh(0, 2);
  std::vector<double> expected(65);
  signed_gaps(moved, {f.pairs, f.separations}, {.gap = expected});
  signed_gaps(copy, {f.pairs, f.separations}, {.gap = f.gaps});
  EXPECT_EQ(f.gaps, expected);
  EXPECT_LT(f.gaps[0], 0.5 + 1e-14);
  moved = copy;
  EXPECT_EQ(moved.size(), 0u);
  moved = std::move(copy);
  EXPECT_EQ(moved.size(), 2u);
  EXPECT_EQ(moved[1].semi_axes(), f.axes[1]);
  EXPECT_EQ(moved[1].orientation().coeffs(), f.turns[1].coeffs());
  EXPECT_EQ(moved[1].centre(), Vec3::Zero());
}

TEST(MovingBodies, AssignedToThemselvesStayWhatTheyAre) {
  Few f;
  const MovingBodies& same = f.bodies;
  f.bodies = same;
  ASSERT_EQ(f.bodies.size(), 2u);
  EXPECT_EQ(f.bodies[1].semi_axes(), f.axes[1]);
}

TEST(BrokenContract, OfMovingBodiesEndsTheProcessAndNamesIt) {
  Few f;
  EXPECT_DEATH(MovingBodies(f.axes, std::span(f.turns).first(1)),
               "tangency: MovingBodies: orientations: 1 entries, and there are 2 bodies");
  EXPECT_DEATH(f.bodies.refresh(0, 3), "MovingBodies::refresh: body 2, and there are 2 bodies");
  EXPECT_DEATH(f.bodies.refresh(2, 1), "MovingBodies::refresh: from body 2 to before body 1");
  EXPECT_DEATH(signed_gaps(f.bodies, {f.pairs, {}}, {.gap = f.gaps}), "separations: 0 entries");
  EXPECT_DEATH(follow_gaps(f.bodies, {f.pairs, f.separations}, std::span(f.normals).first(3), {}),
               "previous_normals: 3");
  f.pairs[64].b = 2;
  EXPECT_DEATH(signed_gaps(f.bodies, {f.pairs, f.separations}, {.gap = f.gaps}),
               "pairs.64..b = 2, and there are 2 bodies");
  f.pairs[64].b = 1;
  for (const double bad : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity()}) {
    for (int k = 0; k < 3; ++k) {
      Few broken;
      broken.axes[1][k] = bad;
      broken.bodies.refresh(0, 2);
      EXPECT_DEATH(
          signed_gaps(broken.bodies, {broken.pairs, broken.separations}, {.gap = broken.gaps}),
          "signed_gaps: body 1: r. = .*: a semi-axis must be finite and > 0");
    }
  }
  f.bodies.look_at(f.axes, f.turns, Questions::in_double);
  f.bodies.refresh(0, 2);
  for (const Accuracy& accuracy : {Accuracy::fast(), Accuracy::standard().up_to(1.0)})
    EXPECT_DEATH(
        follow_gaps(f.bodies, {f.pairs, f.separations}, f.normals, {.gap = f.gaps}, accuracy),
        "follow_gaps: accuracy: single precision or a cutoff, and the bodies are looked at in "
        "double alone");
  f.turns[0].coeffs().setZero();
  f.bodies.refresh(0, 2);
  EXPECT_DEATH(follow_gaps(f.bodies, {f.pairs, f.separations}, f.normals, {}),
               "follow_gaps: body 0: qw = 0: an orientation must be finite and not all 0");
}

}  // namespace
}  // namespace tangency
