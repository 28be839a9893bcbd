// SPDX-License-Identifier: GPL-3.0-or-later
// gap_error of lanes has in it what the last step of Newton's method may do to the value: the terms
// (V'), (T), (E) and (L) of docs/derivations/gap-batch.md, recomputed here from the bodies, the
// normal that was followed and the answer. Each family makes other terms the largest. Lanes in
// double alone have larger errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include <tangency/geometry/batch/gap_lanes.hpp>
#include <tangency/geometry/batch/pair_task.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>
#include <tangency/tests/geometry/followed_pairs.hpp>

namespace tangency {
namespace {

using testing::at_every_level;
using testing::Columns;
using testing::Draw;
using testing::FollowedPairs;
using testing::Indexed;
using testing::kSeed;
using testing::same_bits;

using Wide = long double;
constexpr Wide kU = kUnitRoundoff;

/// What is derived of a lane that evaluates at `n` and steps to the answer's normal.
struct Derived {
  Wide turn, turn_of_body;  ///< of the step, in rad, and times the larger a/h
  Wide value;               ///< (V'), or (V) where that is less: of a lane in double
  Wide step;                ///< (T) and (E) of the value
  Wide rest;                ///< half of what the error of the rest may gain: (B)
  Wide ball;                ///< gap + rho, or less
  Wide size;                ///< |f|
  Wide sum() const { return value + step + rest; }
};

Wide reach(const Symmetric3& m) {
  const auto row = [](double x, double y, double z) {
    return Wide(std::abs(x)) + std::abs(y) + std::abs(z);
  };
  return std::max({row(m.xx, m.xy, m.zx), row(m.xy, m.yy, m.yz), row(m.zx, m.yz, m.zz)});
}

/// The Newton system at a unit normal: K = Hess h_A + Hess h_B + gap (I - nn') + nn', and its right
/// hand side, what of p_B - p_A is across the normal.
struct Newton {
  Mat3 k;
  Vec3 rest;
};

Newton newton_at(const Ellipsoid& a, const Ellipsoid& b, const Vec3& n) {
  const Vec3 d = b.centre() - a.centre();
  const double gap = n.dot(d) - a.support(n) - b.support(n);
  Newton at{gap * (Mat3::Identity() - n * n.transpose()) + n * n.transpose(), d - gap * n};
  for (const Ellipsoid* body : {&a, &b}) {
    const Vec3 x = body->support_point(n);
    const Mat3 factor = body->rotation() * body->semi_axes().asDiagonal();
    at.k += (factor * factor.transpose() - x * x.transpose()) / body->support(n);
    at.rest -= x;
  }
  return at;
}

Vec3 stepped(const Ellipsoid& a, const Ellipsoid& b, const Vec3& n) {
  const Newton at = newton_at(a, b, n);
  return (n + at.k.inverse() * at.rest).normalized();
}

/// The last step of a lane that comes to `n` by one from `before`: that step's matrix is taken
/// again.
Vec3 last_step(const Ellipsoid& a, const Ellipsoid& b, const Vec3& before, const Vec3& n) {
  const double size = (b.centre() - a.centre()).cwiseAbs().maxCoeff() + a.largest_semi_axis() +
                      b.largest_semi_axis();
  const Mat3 k = newton_at(a, b, before).k + (size - 1) * before * before.transpose();
  return k.inverse() * newton_at(a, b, n).rest;
}

Derived derived(const Ellipsoid& a, const Ellipsoid& b, const Vec3& n, const Gap& gap,
                bool by_centres, bool by_mixed) {
  Wide over_h = 0, thin = 0, axes = 0, cubes = 0, value = 0;
  const Vec3 d = b.centre() - a.centre();
  for (int k = 0; k < 3; ++k) value += Wide(n[k]) * d[k];
  for (const Ellipsoid* body : {&a, &b}) {
    const Wide h = body->support(n), most = body->largest_semi_axis();
    over_h += reach(body->shape()) / h;
    thin = std::max(thin, most / h);
    axes += most;
    cubes += most * (most / h) * (most / h);
    value -= h;
  }
  const Wide size = std::abs(value), both = over_h + size;
  Wide beyond_a = 0, most_d = 0;
  for (int k = 0; k < 3; ++k) {
    beyond_a = std::max(beyond_a, std::abs(Wide(d[k]) - gap.arm_a[k]));
    most_d = std::max(most_d, std::abs(Wide(d[k])));
  }
  Wide mixed = 3.5L * over_h + 7.5L * axes + 9 * size;
  Wide in_double = 13 * axes + 2 * beyond_a + 10.7L * size;
  if (by_centres) mixed += axes + size, in_double += 1.75L * most_d;
  Wide step2 = 0;
  for (int k = 0; k < 3; ++k) step2 += (Wide(gap.normal[k]) - n[k]) * (Wide(gap.normal[k]) - n[k]);
  const Wide step = std::sqrt(step2);
  const Wide of_step = step2 * (0.54L * step * cubes + 0x1p-19L * both);
  const Wide error =
      0x1p-19L * both * step + 1.2L * cubes * step2 + 8 * kU * (thin * over_h + axes + size);
  const Wide radii = Wide(a.least_radius()) + b.least_radius();
  const Wide ball = gap.gap + radii - 0x1p-21L * (size + radii);
  // A quarter less: the normal at which the lane evaluated is known from a step in double alone.
  const Newton at = newton_at(a, b, n);
  const Vec3 left = at.rest - at.k * (gap.normal - n);
  const Wide left2 = step > 0x1p-16L ? 0.75L * left.squaredNorm() : 0;
  return {step,
          thin * step,
          kU * (by_mixed ? mixed : std::min(mixed, in_double)),
          of_step,
          0.5L * (0.5625L * left2 + 4.5L * error * error) / ball,
          ball,
          size};
}

/// The first tier of a batch: answers that are not its own are `local`.
/// @param stepped  with a step before the last one whatever the tolerance
Columns first_tier(detail::PairTask task, const std::vector<Vec3>& previous,
                   const Accuracy& accuracy, bool stepped) {
  task.previous_normals = previous.data();
  task.tolerance = accuracy.length;
  Columns answers(task.count);
  const auto work = std::make_unique<detail::Workspace>();
  for (std::size_t first = 0; first < task.count; first += detail::kBlock) {
    const std::size_t count = std::min(detail::kBlock, task.count - first);
    detail::gather(task, first, count, *work, nullptr);
    work->take_answers();
    if (stepped) work->block.coarse = std::numeric_limits<double>::infinity();
    const std::uint64_t settled = detail::mixed_gap_lanes(work->block);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = first + i;
      answers.gap[k] = work->gap[i], answers.gap_error[k] = work->gap_error[i];
      answers.normal[k] = work->normal[i];
      answers.arm_a[k] = work->arm_a[i], answers.arm_b[k] = work->arm_b[i];
      answers.status[k] = (settled >> i & 1) != 0 ? GapStatus::ok : GapStatus::local;
    }
  }
  return answers;
}

void expect_bounds(const FollowedPairs& f, const Accuracy& accuracy, bool cold) {
  const Indexed in(f.pairs);
  std::vector<Vec3> axes;
  std::vector<Quaternion> turns;
  for (const Ellipsoid& body : in.bodies)
    axes.push_back(body.semi_axes()), turns.push_back(body.orientation());
  const std::size_t count = f.pairs.a.size();
  std::vector<Gap> single;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3& d = in.separations[i];
    single.push_back(cold ? signed_gap(f.pairs.a[i], f.pairs.b[i], d)
                          : follow_gap(f.pairs.a[i], f.pairs.b[i], d, f.previous[i]));
  }
  const PairList apart{in.pairs, in.separations}, placed{in.pairs, {}};
  at_every_level([&] {
    const BodyArray array(in.bodies);
    const MovingBodies moving(axes, turns);
    const auto check = [&](const Columns& answers, bool by_centres) {
      std::size_t lanes = 0, below = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const Gap gap = answers[i];
        if (gap.status != GapStatus::ok || same_bits(gap, single[i])) continue;
        ++lanes;
        Vec3 n = cold ? gap.normal : f.previous[i].normalized();
        if (!cold) n = stepped(f.pairs.a[i], f.pairs.b[i], n);
        Derived terms = derived(f.pairs.a[i], f.pairs.b[i], n, gap, by_centres, !cold);
        if (!cold && terms.turn > 0x1p-19L) {
          const Vec3 before = f.previous[i].normalized();
          const double along = n.dot(last_step(f.pairs.a[i], f.pairs.b[i], before, n));
          EXPECT_LE(std::abs(along), 0x1.02p-20) << i;
          // A tenth less, for the normal in float.
          terms.step += 0.45L * terms.size * along * along;
        }
        // Inverses are rough to 2^-11.
        if (gap.gap_error < terms.sum() * (1 - 0x1p-10L)) ++below;
        // Of a step this long the normal in float and the length after it are right to 2^-8.
        EXPECT_LE(terms.turn, 0x1.02p-11L) << i;
        EXPECT_LE(terms.turn_of_body, 0x1.02p-8L) << i;
      }
      EXPECT_GE(lanes, count / 3);
      // A lane that takes a step more than is thought here errs by less, and says so.
      EXPECT_LE(below, cold ? 0 : count / 12);
    };
    Columns answers(count);
    if (cold) {
      signed_gaps(array, placed, answers.all(), accuracy);
      check(answers, true);
      signed_gaps(array, apart, answers.all(), accuracy);
      check(answers, false);
      signed_gaps(moving, apart, answers.all(), accuracy);
    } else {
      answers = first_tier({"follow_gaps", array, apart}, f.previous, accuracy, true);
      check(answers, false);
      answers = first_tier({"follow_gaps", moving, apart}, f.previous, accuracy, true);
    }
    check(answers, false);
  });
}

/// Lanes of a coarse tolerance, which answer at the normal that they are given: s = 0, e = r.
void expect_bounds_without_a_step(const FollowedPairs& f, const Accuracy& accuracy) {
  const Indexed in(f.pairs);
  std::vector<Vec3> axes;
  std::vector<Quaternion> turns;
  for (const Ellipsoid& body : in.bodies)
    axes.push_back(body.semi_axes()), turns.push_back(body.orientation());
  const std::size_t count = f.previous.size();
  const PairList apart{in.pairs, in.separations};
  at_every_level([&] {
    const BodyArray array(in.bodies);
    const MovingBodies moving(axes, turns);
    const auto check = [&](const Columns& answers) {
      std::size_t lanes = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const Gap gap = answers[i];
        if (gap.status != GapStatus::ok) continue;
        ++lanes;
        const Ellipsoid &a = f.pairs.a[i], &b = f.pairs.b[i];
        EXPECT_LE((gap.normal - f.previous[i].normalized()).norm(), 0x1p-22) << i;
        const Derived terms = derived(a, b, gap.normal, gap, false, true);
        const Wide r2 = newton_at(a, b, gap.normal).rest.squaredNorm();
        const Wide least = terms.sum() + 0.5L * 0.5625L * r2 / terms.ball;
        EXPECT_GE(gap.gap_error, least * (1 - 0x1p-10L)) << i;
        const Gap single = follow_gap(a, b, in.separations[i], f.previous[i]);
        EXPECT_LE(std::abs(gap.gap - single.gap), gap.gap_error + single.gap_error) << i;
      }
      EXPECT_GE(lanes, count / 3);
    };
    check(first_tier({"follow_gaps", array, apart}, f.previous, accuracy, false));
    check(first_tier({"follow_gaps", moving, apart}, f.previous, accuracy, false));
  });
}

constexpr std::size_t kCount = 300;

TEST(MixedBounds, HaveTheRoundingsOfTheValue) {
  FollowedPairs f{{"near and far", {}, {}}, {}};
  Draw draw{std::mt19937_64(kSeed)};
  while (f.previous.size() < kCount) {
    const auto axes = [&] { return Vec3(1, draw.power(0, 2), draw.power(0, 2)); };
    const Ellipsoid a = draw.body(axes()), b = draw.body(axes());
    f.place(draw, a, b, draw.direction(), draw.power(-8, f.previous.size() % 2 == 0 ? 0 : 10), 0);
  }
  expect_bounds(f, Accuracy::standard(), true);
}

TEST(MixedBounds, HaveTheThirdOrderOfAStep) {
  FollowedPairs f{{"wide steps", {}, {}}, {}};
  Draw draw{std::mt19937_64(kSeed + 1)};
  while (f.previous.size() < kCount) {
    const auto axes = [&] { return Vec3(1, draw.power(0, 1), draw.power(0, 1)); };
    const Ellipsoid a = draw.body(axes()), b = draw.body(axes());
    f.place(draw, a, b, draw.direction(), 0.02, draw.power(-8, -6.5));
  }
  expect_bounds(f, Accuracy::within(0x1p-6), false);
}

TEST(MixedBounds, HaveTheErrorOfAStepInFloatFarAway) {
  FollowedPairs f{{"far away", {}, {}}, {}};
  Draw draw{std::mt19937_64(kSeed + 2)};
  while (f.previous.size() < kCount) {
    const auto axes = [&] { return Vec3(1, draw.power(0, 1), draw.power(0, 1)); };
    const Ellipsoid a = draw.body(axes()), b = draw.body(axes());
    f.place(draw, a, b, draw.direction(), draw.power(3, 8), draw.power(-6, -4.2));
  }
  expect_bounds(f, Accuracy::within(0x1p-2), false);
}

TEST(MixedBounds, HaveTheSecondOrderOfTheRestWhereTheBallIsSmall) {
  FollowedPairs f{{"edge", {}, {}}, {}};
  Draw draw{std::mt19937_64(kSeed + 3)};
  while (f.previous.size() < kCount) {
    const auto axes = [&] { return Vec3(1, draw.power(1, 2), draw.power(1, 2)); };
    const Ellipsoid a = draw.body(axes()), b = draw.body(axes());
    const double rho = a.least_radius() + b.least_radius();
    f.place(draw, a, b, draw.direction(), -rho * (1 - draw.power(-10, -7.5)), draw.power(-9, -7.7));
  }
  expect_bounds(f, Accuracy::within(0x1p-6), false);
}

// A body below 2^-40 L is left to the next tier, whatever its neighbours are.
TEST(MixedLanes, LeaveBodiesFarSmallerThanTheirPairToTheDoubles) {
  FollowedPairs f{{"small", {}, {}}, {}};
  Draw draw{std::mt19937_64(kSeed + 8)};
  const Ellipsoid large(Vec3::Zero(), Vec3(1, 0.9, 0.8));
  for (std::size_t i = 0; i < 64; ++i) {
    // L is 2.5.
    const double size = 2.5 * 0x1p-40 * (i % 2 == 0 ? draw.real(0.55, 0.95) : draw.real(1.05, 1.9));
    f.place(draw, large, Ellipsoid(Vec3::Zero(), size * Vec3(1, 0.9, 0.8)), Vec3(1, 0, 0), 0.5, 0);
  }
  const Indexed in(f.pairs);
  at_every_level([&] {
    const BodyArray array(in.bodies);
    const PairList apart{in.pairs, in.separations};
    const Columns answers =
        first_tier({"follow_gaps", array, apart}, f.previous, Accuracy::standard(), true);
    for (std::size_t i = 0; i < 64; ++i)
      EXPECT_EQ(answers.status[i] == GapStatus::ok, i % 2 == 1) << i;
  });
}

// (R'): plates that lie on each other along axes, where the step is exactly 0, about as deep as the
// ball allows.
TEST(MixedBounds, HaveTheRoundingsOfTheRestOfPlatesWhereTheBallIsSmall) {
  FollowedPairs f{{"plates", {}, {}}, {}};
  Draw draw{std::mt19937_64(kSeed + 5)};
  while (f.previous.size() < kCount) {
    const auto plate = [&] {
      const Quaternion turn(1, 0, 0, 0);
      return Ellipsoid(Vec3::Zero(), Vec3(1, draw.power(5, 5.4), draw.power(5, 5.4)), turn);
    };
    const Ellipsoid a = plate(), b = plate();
    const double rho = a.least_radius() + b.least_radius();
    f.place(draw, a, b, Vec3(1, 0, 0), -rho * (1 - draw.power(-18.8, -18)), 0);
  }
  expect_bounds(f, Accuracy::within(0x1p-6), false);
}

// (T): each step here is beyond one of its limits, or near it.
TEST(MixedBounds, HoldForNoStepThatIsLongerThanTheyAreDerivedFor) {
  FollowedPairs f{{"longest steps", {}, {}}, {}};
  Draw draw{std::mt19937_64(kSeed + 6)};
  while (f.previous.size() < kCount) {
    const auto axes = [&] { return Vec3(1, draw.power(0, 2), draw.power(0, 2)); };
    const Ellipsoid a = draw.body(axes()), b = draw.body(axes());
    f.place(draw, a, b, draw.direction(), draw.power(-2, 2), draw.power(-9, -4.5));
  }
  expect_bounds(f, Accuracy::within(0x1p-2), false);
}

// (F): of what the ball is the difference of, 2^-21.
TEST(MixedBounds, HaveTheRoundingsOfTheBallWhereItIsSmallest) {
  FollowedPairs f{{"smallest balls", {}, {}}, {}};
  Draw draw{std::mt19937_64(kSeed + 4)};
  while (f.previous.size() < kCount) {
    const auto axes = [&] { return Vec3(1, draw.power(0, 1), draw.power(0, 1)); };
    const Ellipsoid a = draw.body(axes()), b = draw.body(axes());
    const double rho = a.least_radius() + b.least_radius();
    f.place(draw, a, b, draw.direction(), -rho * (1 - draw.power(-18.9, -18.2)),
            draw.power(-10, -7.5));
  }
  expect_bounds(f, Accuracy::within(0x1p-6), false);
}

// (L): every second pair is far away, the others are about as deep as the ball allows.
TEST(MixedBounds, HaveAllOfTheRestWhereNoStepIsTaken) {
  FollowedPairs f{{"no step", {}, {}}, {}};
  Draw draw{std::mt19937_64(kSeed + 7)};
  while (f.previous.size() < kCount) {
    const auto axes = [&] { return Vec3(1, draw.power(0, 2), draw.power(0, 2)); };
    const Ellipsoid a = draw.body(axes()), b = draw.body(axes());
    const double rho = a.least_radius() + b.least_radius();
    const double gap =
        f.previous.size() % 2 == 0 ? draw.power(-4, 8) : -rho * (1 - draw.power(-10, -4));
    f.place(draw, a, b, draw.direction(), gap, draw.power(-12, -8));
  }
  expect_bounds_without_a_step(f, Accuracy::within(0x1p-4));
}

}  // namespace
}  // namespace tangency
