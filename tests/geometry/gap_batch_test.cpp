// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>
#include <tangency/verify/families/adversarial.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/extreme.hpp>

namespace tangency {
namespace {

using testing::at_every_level;
using testing::contacts;
using testing::Family;
using testing::Indexed;
using testing::kSeed;
using testing::same_bits;

/// Coinciding centres, nests, spheres, extreme scales and shapes, far origins.
Family extremes() {
  Family f{"extremes", {}, {}};
  std::mt19937_64 random(kSeed);
  const auto draw = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  const auto body = [&](double scale, double aspect, const Vec3& centre) {
    Vec3 axes;
    for (double& r : axes) r = scale * std::pow(aspect, draw(-0.5, 0.5));
    return Ellipsoid(centre, axes, {draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(0.1, 1)});
  };
  for (const double scale : {1.0, 1e-150, 1e150, 0x1p-60, 0x1p60, 1e-18, 1e18}) {
    for (const double aspect : {1.0, 3.0, 1e3, 1e6, 1e8}) {
      for (const double distance : {0.0, 1e-30, 0.1, 1.5, 3.0, 1e6}) {
        for (const double origin : {0.0, 1e12}) {
          const Vec3 centre = origin * scale * Vec3(draw(-1, 1), draw(-1, 1), draw(-1, 1));
          const Vec3 way = Vec3(draw(-1, 1), draw(-1, 1), draw(-1, 1)).normalized();
          f.a.push_back(body(scale, aspect, centre));
          f.b.push_back(body(scale, aspect, centre + distance * scale * way));
        }
      }
    }
  }
  return f;
}

std::vector<Family> make_families() {
  std::vector<Family> all = testing::drawn_families();
  all.push_back(extremes());
  return all;
}

const std::vector<Family>& families_of_pairs() {
  static const std::vector<Family> all = make_families();
  return all;
}

std::vector<Gap> single_answers(const Family& f) {
  std::vector<Gap> gaps;
  for (std::size_t i = 0; i < f.a.size(); ++i) gaps.push_back(signed_gap(f.a[i], f.b[i]));
  return gaps;
}

std::vector<Gap> batch_answers(const Family& f) {
  std::vector<Gap> gaps(f.a.size());
  signed_gaps(f.a, f.b, gaps);
  return gaps;
}

int sign(double x) { return (x > 0) - (x < 0); }

/// Both true within their errors, so no further apart than both together.
void expect_agreement(const Gap& batch, const Gap& single, std::size_t i) {
  ASSERT_EQ(batch.status, single.status) << "pair " << i;
  ASSERT_EQ(sign(batch.gap), sign(single.gap)) << "pair " << i;
  if (batch.status != GapStatus::ok || !std::isfinite(single.gap)) {
    ASSERT_TRUE(same_bits(batch.gap, single.gap)) << "pair " << i;
    return;
  }
  ASSERT_LE(std::abs(batch.gap - single.gap), batch.gap_error + single.gap_error) << "pair " << i;
}

// geometry/gap_batch.hpp (1)
TEST(GapBatch, AgreesWithTheSingleCallWithinBothErrorsOnEveryFamilyAtEveryLevel) {
  for (const Family& f : families_of_pairs()) {
    SCOPED_TRACE(f.name);
    const std::vector<Gap> single = single_answers(f);
    at_every_level([&] {
      const std::vector<Gap> batch = batch_answers(f);
      for (std::size_t i = 0; i < batch.size(); ++i) expect_agreement(batch[i], single[i], i);
    });
  }
}

// geometry/gap_batch.hpp (1)
TEST(GapBatch, ManufacturedGapsAreWithinTheReportedErrorAtEveryLevel) {
  for (const auto& shape : verify::contact_classes()) {
    const Family f = contacts(shape, 1000);
    at_every_level([&] {
      const std::vector<Gap> batch = batch_answers(f);
      verify::ManufacturedContacts source(shape, kSeed);
      for (std::size_t i = 0; i < batch.size(); ++i) {
        const auto c = source.next();
        // The truth is rounded to double and of second order in the rounding of the centre.
        const double truth_error = 0x1p-52 * std::abs(c.gap) + 0x1p-60 * c.size;
        ASSERT_LE(std::abs(batch[i].gap - c.gap), batch[i].gap_error + truth_error) << i;
        ASSERT_LE(std::abs(batch[i].normal.norm() - 1), 8 * 0x1p-53) << i;
        // p_B - p_A = g n.
        const Vec3 d = f.b[i].centre() - f.a[i].centre();
        const double along = (d + batch[i].arm_b - batch[i].arm_a).dot(batch[i].normal);
        ASSERT_LE(std::abs(along - batch[i].gap), 32 * 0x1p-53 * c.size) << i;
      }
    });
  }
}

TEST(GapBatch, OrdinaryContactsAreAnsweredInTheLanes) {
  // What a lane settles differs from the single call in its last bits somewhere; what it hands on
  // does not: so a batch that hands on everything would be noticed here.
  for (std::size_t k = 0; k < 2; ++k) {
    const Family& f = families_of_pairs()[k];
    const std::vector<Gap> single = single_answers(f);
    at_every_level([&] {
      const std::vector<Gap> batch = batch_answers(f);
      std::size_t handed_on = 0;
      for (std::size_t i = 0; i < batch.size(); ++i) {
        if (same_bits(batch[i].gap_error, single[i].gap_error)) ++handed_on;
      }
      EXPECT_LE(handed_on, f.a.size() / 50);
    });
  }
}

// geometry/gap_batch.hpp (2)
TEST(GapBatch, AnswersDoNotDependOnPositionOrderOrNumber) {
  for (const Family& f : families_of_pairs()) {
    SCOPED_TRACE(f.name);
    const Indexed in(f);
    const BodyArray bodies(in.bodies);
    at_every_level([&] {
      std::vector<Gap> whole(in.pairs.size());
      signed_gaps(bodies, {in.pairs, {}}, whole);
      for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{7},
                                      std::size_t{64}, std::size_t{65}, in.pairs.size()}) {
        for (const std::size_t first : {std::size_t{0}, std::size_t{1}, std::size_t{13}}) {
          const std::size_t n = std::min(count, in.pairs.size() - first);
          std::vector<Gap> part(n);
          signed_gaps(bodies, {std::span(in.pairs).subspan(first, n), {}}, part);
          for (std::size_t i = 0; i < n; ++i)
            ASSERT_TRUE(same_bits(part[i], whole[first + i])) << i;
        }
      }
      std::vector<std::size_t> order(in.pairs.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::shuffle(order.begin(), order.end(), std::mt19937_64(kSeed));
      std::vector<IndexedPair> shuffled;
      shuffled.reserve(order.size());
      for (const std::size_t i : order) shuffled.push_back(in.pairs[i]);
      std::vector<Gap> answers(shuffled.size());
      signed_gaps(bodies, {shuffled, {}}, answers);
      for (std::size_t i = 0; i < order.size(); ++i) {
        ASSERT_TRUE(same_bits(answers[i], whole[order[i]])) << i;
      }
    });
  }
}

// geometry/gap_batch.hpp (5)
TEST(GapBatch, IndexedBodiesAndPlainPairsHaveTheSameAnswers) {
  for (const Family& f : families_of_pairs()) {
    SCOPED_TRACE(f.name);
    const Indexed in(f);
    const BodyArray bodies(in.bodies);
    at_every_level([&] {
      std::vector<Gap> indexed(in.pairs.size());
      signed_gaps(bodies, {in.pairs, {}}, indexed);
      const std::vector<Gap> plain = batch_answers(f);
      for (std::size_t i = 0; i < plain.size(); ++i) {
        ASSERT_TRUE(same_bits(indexed[i], plain[i])) << i;
      }
    });
  }
}

TEST(GapBatch, ColumnsHoldWhatWholeAnswersHoldAndOnlyWhatIsAskedFor) {
  const Indexed in(families_of_pairs()[2]);
  const BodyArray bodies(in.bodies);
  const std::size_t count = in.pairs.size();
  at_every_level([&] {
    std::vector<Gap> whole(count);
    signed_gaps(bodies, {in.pairs, {}}, whole);
    std::vector<double> gap(count), gap_error(count);
    std::vector<Vec3> normal(count), arm_a(count), arm_b(count);
    std::vector<GapStatus> status(count);
    std::vector<GapTier> tier(count, GapTier::exact);
    signed_gaps(bodies, {in.pairs, {}}, {gap, gap_error, normal, arm_a, arm_b, status, tier});
    for (std::size_t i = 0; i < count; ++i) {
      const Gap g{gap[i], normal[i], arm_a[i], arm_b[i], gap_error[i], status[i], tier[i]};
      ASSERT_TRUE(same_bits(g, whole[i])) << i;
    }
    std::vector<double> only_gap(count);
    signed_gaps(bodies, {in.pairs, {}}, {.gap = only_gap});
    for (std::size_t i = 0; i < count; ++i) ASSERT_TRUE(same_bits(only_gap[i], gap[i])) << i;
  });
}

TEST(GapBatch, GivenSeparationsTakeThePlaceOfTheCentres) {
  for (const Family& f : families_of_pairs()) {
    SCOPED_TRACE(f.name);
    Indexed in(f);
    std::vector<Gap> single;
    for (std::size_t i = 0; i < f.a.size(); ++i) {
      in.separations[i] *= 1.01;  // not that of the centres
      single.push_back(signed_gap(f.a[i], f.b[i], in.separations[i]));
    }
    const BodyArray bodies(in.bodies);
    at_every_level([&] {
      std::vector<Gap> batch(in.pairs.size());
      signed_gaps(bodies, {in.pairs, in.separations}, batch);
      for (std::size_t i = 0; i < batch.size(); ++i) expect_agreement(batch[i], single[i], i);
    });
  }
}

TEST(GapBatch, FollowingAgreesWithTheSingleCallAndMayWriteOverItsNormals) {
  for (const Family& f : families_of_pairs()) {
    SCOPED_TRACE(f.name);
    const Indexed in(f);
    const BodyArray bodies(in.bodies);
    std::vector<Vec3> previous;
    std::vector<Gap> single;
    for (std::size_t i = 0; i < f.a.size(); ++i) {
      const Gap g = signed_gap(f.a[i], f.b[i]);
      const Vec3 aside = Vec3(0.3, -0.5, 0.8).cross(g.normal);
      previous.push_back(3.0 * (g.normal + 1e-4 * aside));  // of any length
      single.push_back(follow_gap(f.a[i], f.b[i], in.separations[i], previous[i]));
    }
    at_every_level([&] {
      const std::size_t count = in.pairs.size();
      std::vector<Gap> batch(count);
      follow_gaps(bodies, {in.pairs, in.separations}, previous, batch);
      for (std::size_t i = 0; i < count; ++i) expect_agreement(batch[i], single[i], i);
      std::vector<Gap> of_centres(count);
      follow_gaps(bodies, {in.pairs, {}}, previous, of_centres);
      std::vector<Vec3> normal = previous;
      follow_gaps(bodies, {in.pairs, {}}, normal, GapColumns{.normal = normal});
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_TRUE(same_bits(of_centres[i], batch[i])) << i;
        ASSERT_TRUE(same_bits(normal[i], batch[i].normal)) << i;
      }
    });
  }
}

TEST(GapBatch, FollowingStaysOnItsBranchWhereAnotherWayOutIsShorter) {
  // Along z, the shortest axis: up is the shorter way out, down the one that was followed.
  const Ellipsoid a({0, 0, 0}, {4, 2, 1}), b({0, 0, 0.125}, {4, 2, 1});
  const std::vector<Ellipsoid> two{a, b};
  const BodyArray bodies(two);
  const std::vector<IndexedPair> pairs(20, IndexedPair{0, 1});
  const std::vector<Vec3> previous(pairs.size(), Vec3(0.01, 0, -1));
  ASSERT_EQ(signed_gap(a, b).gap, -1.875);
  at_every_level([&] {
    std::vector<Gap> followed(pairs.size());
    follow_gaps(bodies, {pairs, {}}, previous, followed);
    for (const Gap& gap : followed) {
      EXPECT_NEAR(gap.gap, -2.125, 1e-14);
      EXPECT_EQ(gap.status, GapStatus::local);
    }
  });
}

// Against differences of the gap and the normal of each pair itself, along and across.
TEST(GapBatch, DerivativesAreThoseOfEachPairsOwnGap) {
  // Chosen, of the smallest semi-axis: for gaps, whose error is u; and for normals, which an answer
  // has to sqrt(u kappa), 1e-8 here. A difference of another pair would be off by its whole size.
  constexpr double kStep = 1e-5, kTurnStep = 1e-4;
  const Family f = contacts(verify::contact_classes()[1], 200);
  const Indexed in(f);
  const BodyArray bodies(in.bodies);
  std::vector<Gap> gaps(in.pairs.size());
  signed_gaps(bodies, {in.pairs, {}}, gaps);
  std::vector<GapDerivatives> of_centres(gaps.size()), of_separations(gaps.size());
  gap_derivatives(bodies, {in.pairs, {}}, gaps, of_centres);
  gap_derivatives(bodies, {in.pairs, in.separations}, gaps, of_separations);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const Ellipsoid &a = f.a[i], &b = f.b[i];
    const double step = kStep * std::min(a.smallest_semi_axis(), b.smallest_semi_axis());
    const double turn = kTurnStep / kStep;
    const auto moved = [&](const Vec3& move) {
      return signed_gap(a, b.moved_to(b.centre() + move));
    };
    for (int k = 0; k < 3; ++k) {
      const Vec3 move = step * Vec3::Unit(k);
      const double slope = (moved(move).gap - moved(-move).gap) / (2 * step);
      const Vec3 bend =
          (moved(turn * move).normal - moved(-turn * move).normal) / (2 * turn * step);
      const Ellipsoid wide(b.centre(), b.semi_axes() + move, b.orientation()),
          narrow(b.centre(), b.semi_axes() - move, b.orientation());
      const double widening = (signed_gap(a, wide).gap - signed_gap(a, narrow).gap) / (2 * step);
      for (const GapDerivatives* d : {&of_centres[i], &of_separations[i]}) {
        ASSERT_EQ(d->status, DerivativeStatus::ok) << i;
        ASSERT_NEAR(d->gradient[kOfBodyB + kCentre + k], slope, 1e-8) << i;
        ASSERT_NEAR(d->gradient[kOfBodyB + kSemiAxes + k], widening, 1e-8) << i;
        const Vec3 column = d->hessian.block<3, 1>(kOfBodyB + kCentre, kOfBodyB + kCentre + k);
        ASSERT_LE((column - bend).norm() * d->least_radius, 1e-4) << i;
      }
    }
  }
}

// geometry/gap_batch.hpp (3)
TEST(OverlapBatch, IsTheSingleAnswerOnEveryFamilyAtEveryLevel) {
  for (const Family& f : families_of_pairs()) {
    SCOPED_TRACE(f.name);
    const Indexed in(f);
    const BodyArray bodies(in.bodies);
    at_every_level([&] {
      // Not std::vector<bool>, which has no span.
      const std::unique_ptr<bool[]> batch(new bool[in.pairs.size()]);
      const std::span<bool> answers(batch.get(), in.pairs.size());
      overlaps(bodies, {in.pairs, {}}, answers);
      for (std::size_t i = 0; i < f.a.size(); ++i) {
        ASSERT_EQ(answers[i], overlaps(f.a[i], f.b[i])) << i;
      }
      overlaps(bodies, {in.pairs, in.separations}, answers);
      for (std::size_t i = 0; i < f.a.size(); ++i) {
        const Ellipsoid a = f.a[i].moved_to(Vec3::Zero());
        ASSERT_EQ(answers[i], overlaps(a, f.b[i].moved_to(in.separations[i]))) << i;
      }
    });
  }
}

TEST(GapBatch, BodiesBeyondTheRangeOfTheBoundsAreAnsweredOneByOne) {
  // Far apart, so that a lane would find nothing wrong: one semi-axis is below 2^-60.
  const double small = 0x1p-61;
  const std::vector<Ellipsoid> a(20, Ellipsoid(Vec3::Zero(), {small, 2 * small, 3 * small}));
  const std::vector<Ellipsoid> b(20, Ellipsoid({0x1p-50, 0x1p-51, 0}, {small, small, 2 * small}));
  std::vector<Gap> gaps(a.size());
  at_every_level([&] {
    signed_gaps(a, b, gaps);
    for (const Gap& g : gaps) ASSERT_TRUE(same_bits(g, signed_gap(a[0], b[0])));
  });
}

/// Two bodies, and one pair more than fits into a block.
struct Few {
  Few() : bodies(two), pairs(65, IndexedPair{0, 1}), gaps(65), separations(65, Vec3(3, 0, 0)) {}
  std::vector<Ellipsoid> two{Ellipsoid(Vec3(0, 0, 0), Vec3(1, 2, 3)),
                             Ellipsoid(Vec3(3, 0, 0), Vec3(1, 2, 1))};
  BodyArray bodies;
  std::vector<IndexedPair> pairs;
  std::vector<Gap> gaps;
  std::vector<Vec3> separations;
  std::array<bool, 65> yes{};
  std::array<std::optional<bool>, 65> known{};
};

TEST(BrokenContract, OfLengthsEndsTheProcessAndNamesThem) {
  Few f;
  std::vector<Gap> few(64);
  std::vector<double> numbers(64);
  std::vector<Vec3> vectors(64);
  std::vector<GapDerivatives> derivatives(65);
  EXPECT_DEATH(signed_gaps(f.bodies, {f.pairs, {}}, few),
               "tangency: signed_gaps: answers: 64 entries, and there are 65 pairs");
  EXPECT_DEATH(signed_gaps(f.bodies, {f.pairs, vectors}, f.gaps), "signed_gaps: separations: 64");
  EXPECT_DEATH(signed_gaps(f.bodies, {f.pairs, {}}, {.gap_error = numbers}),
               "signed_gaps: gap_error: 64");
  EXPECT_DEATH(signed_gaps(f.two, std::span(f.two).first(1), few), "signed_gaps: b: 1");
  EXPECT_DEATH(follow_gaps(f.bodies, {f.pairs, {}}, vectors, f.gaps),
               "follow_gaps: previous_normals: 64");
  EXPECT_DEATH(follow_gaps(f.bodies, {f.pairs, {}}, f.separations, {.normal = vectors}),
               "follow_gaps: normal: 64");
  EXPECT_DEATH(gap_derivatives(f.bodies, {f.pairs, {}}, few, derivatives),
               "gap_derivatives: gaps: 64");
  EXPECT_DEATH(overlaps(f.bodies, {f.pairs, {}}, std::span(f.yes).first(3)),
               "overlaps: answers: 3");
}

TEST(BrokenContract, OfAnIndexEndsTheProcessAndNamesThePair) {
  for (const std::uint32_t bad : {2u, 0x7fffffffu, 0x80000000u, 0x80000002u, 0xffffffffu}) {
    Few f;
    f.pairs[64].b = bad;
    EXPECT_DEATH(
        signed_gaps(f.bodies, {f.pairs, {}}, f.gaps),
        "tangency: signed_gaps: pairs.64..b = " + std::to_string(bad) + ", and there are 2 bodies");
    f.pairs[64].b = 1;
    f.pairs[3].a = bad;
    EXPECT_DEATH(overlaps(f.bodies, {f.pairs, {}}, f.yes), "overlaps: pairs.3..a = ");
  }
  Few f;
  std::vector<GapDerivatives> derivatives(65);
  f.pairs[7] = {0, 2};
  EXPECT_DEATH(follow_gaps(f.bodies, {f.pairs, {}}, f.separations, f.gaps),
               "follow_gaps: pairs.7.");
  EXPECT_DEATH(gap_derivatives(f.bodies, {f.pairs, {}}, f.gaps, derivatives),
               "gap_derivatives: pairs.7.");
  EXPECT_DEATH(overlaps_by_filter(f.bodies, {f.pairs, {}}, f.known),
               "overlaps_by_filter: pairs.7.");
  EXPECT_DEATH(f.bodies.refresh(2), "BodyArray::refresh: body 2, and there are 2 bodies");
}

TEST(BrokenContract, OfASeparationThatIsNotFiniteEndsTheProcess) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    for (const double bad : {nan, infinity, -infinity}) {
      Few f;
      f.separations[5][axis] = bad;
      const PairList list{f.pairs, f.separations};
      EXPECT_DEATH(signed_gaps(f.bodies, list, f.gaps),
                   "signed_gaps: separation = .*: must be finite");
      EXPECT_DEATH(follow_gaps(f.bodies, list, f.separations, f.gaps), "follow_gaps: separation");
      EXPECT_DEATH(overlaps(f.bodies, list, f.yes), "overlaps: separation");
      EXPECT_DEATH(signed_gap(f.two[0], f.two[1], f.separations[5]), "signed_gap: separation");
    }
  }
}

TEST(BodyArray, ThatWasMovedFromIsEmptyAndRefusesEveryIndex) {
  Few f;
  BodyArray moved(std::move(f.bodies));
  EXPECT_EQ(moved.size(), 2u);
  EXPECT_EQ(f.bodies.size(), 0u);  // NOLINT: what is left of it is promised
  EXPECT_DEATH(signed_gaps(f.bodies, {f.pairs, {}}, f.gaps), "and there are 0 bodies");
  signed_gaps(moved, {f.pairs, {}}, f.gaps);
  expect_agreement(f.gaps[64], signed_gap(f.two[0], f.two[1]), 64);
  BodyArray assigned{{}};
  assigned = std::move(moved);
  EXPECT_EQ(assigned.size(), 2u);
  EXPECT_EQ(moved.size(), 0u);  // NOLINT: what is left of it is promised
}

TEST(BodyArray, TakesTheEllipsoidsOfATemporary) {
  const Few f;
  std::optional<BodyArray> of_vector(std::vector<Ellipsoid>{f.two});
  const BodyArray of_array(std::array<Ellipsoid, 2>{f.two[0], f.two[1]});
  const BodyArray moved(std::move(*of_vector));
  of_vector.reset();
  const BodyArray of_lvalue(f.two), of_span((std::span<const Ellipsoid>(f.two)));
  EXPECT_EQ(&of_lvalue[0], f.two.data());
  EXPECT_EQ(&of_span[0], f.two.data());
  for (const BodyArray* bodies : {&moved, &of_array}) {
    ASSERT_EQ(bodies->size(), 2u);
    EXPECT_NE(&(*bodies)[0], f.two.data());
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ((*bodies)[i].centre(), f.two[i].centre());  // kept, and by no one else
      EXPECT_EQ((*bodies)[i].semi_axes(), f.two[i].semi_axes());
    }
    std::vector<Gap> gaps(65);
    signed_gaps(*bodies, {f.pairs, {}}, gaps);
    expect_agreement(gaps[0], signed_gap(f.two[0], f.two[1]), 0);
  }
}

TEST(GapBatch, FollowingAnswersWhereTheDifferenceOfTheCentresOverflows) {
  const Few f;
  for (const double size : {1.0, 0x1p1023}) {
    const Vec3 axes(size, 0.75 * size, 0.5 * size);
    const std::vector<Ellipsoid> two{Ellipsoid({0x1.8p1023, 0, 0}, axes),
                                     Ellipsoid({-0x1.8p1023, 1, 0}, axes)};
    const BodyArray bodies(two);
    const std::vector<Vec3> normals(f.pairs.size(), Vec3(-1, 0, 0));
    std::vector<Gap> gaps(f.pairs.size());
    follow_gaps(bodies, {f.pairs, {}}, normals, gaps);
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      const Gap expected = signed_gap(two[f.pairs[i].a], two[f.pairs[i].b]);
      EXPECT_EQ(gaps[i].gap, expected.gap) << size << ' ' << i;
      EXPECT_EQ(gaps[i].normal, expected.normal) << size << ' ' << i;
    }
  }
}

TEST(GapBatch, ARefreshedBodyIsTheChangedOne) {
  Family f = contacts(verify::contact_classes()[1], 20);
  Indexed in(f);
  BodyArray bodies(in.bodies);
  const Vec3 shift(0.01, -0.02, 0.005);
  for (std::size_t i = 0; i < in.bodies.size(); i += 2) {
    in.bodies[i] = in.bodies[i].moved_to(in.bodies[i].centre() + shift);
    bodies.refresh(i);
    f.a[i / 2] = in.bodies[i];
  }
  std::vector<Gap> batch(in.pairs.size());
  signed_gaps(bodies, {in.pairs, {}}, batch);
  const std::vector<Gap> single = single_answers(f);
  for (std::size_t i = 0; i < batch.size(); ++i) expect_agreement(batch[i], single[i], i);
}

}  // namespace
}  // namespace tangency
