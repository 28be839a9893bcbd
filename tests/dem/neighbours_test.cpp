// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <ostream>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/parallel.hpp>
#include <tangency/geometry/ellipse_gap.hpp>

#include "assembly.hpp"

namespace {

using namespace tangency::dem;
using tangency::Ellipse;
using tangency::Ellipsoid;
using tangency::Mat3;
using tangency::Quaternion;
using tangency::Vec2;
using tangency::Vec3;
using namespace tangency::testing;

Cell cell_of(const Vec3& edges) { return Cell::box(edges); }

bool lists_all(const NeighbourList& list, const std::vector<Pair>& pairs) {
  return std::includes(list.pairs().begin(), list.pairs().end(), pairs.begin(), pairs.end());
}

double skins_of(const Pair& pair, const Particles& particles, double ratio) {
  return ratio * (mean_radius(particles.semi_axes[static_cast<std::size_t>(pair.a)]) +
                  mean_radius(particles.semi_axes[static_cast<std::size_t>(pair.b)]));
}

// dem/neighbours.hpp (1)
TEST(NeighbourList, HoldsEveryTouchingPairOfALargeCell) {
  const Cell cell = cell_of({9.0, 12.0, 10.0});
  const Particles particles = crowd(200, cell, 1);
  NeighbourList list;
  list.build(particles, cell, 0.1);
  const auto touching = touching_pairs(particles, cell);
  ASSERT_GT(touching.size(), 200u);
  EXPECT_TRUE(lists_all(list, touching));
}

// dem/neighbours.hpp (3)
TEST(NeighbourList, HoldsEveryTouchingImageOfACellSmallerThanAParticle) {
  const Cell cell = cell_of({0.8, 1.1, 5.0});
  const Particles particles = crowd(6, cell, 2);
  NeighbourList list;
  list.build(particles, cell, 0.1);
  const auto touching = touching_pairs(particles, cell);
  ASSERT_TRUE(std::any_of(touching.begin(), touching.end(),
                          [](const Pair& pair) { return pair.a == pair.b; }));
  EXPECT_TRUE(lists_all(list, touching));
}

// dem/neighbours.hpp (2)
TEST(NeighbourList, ListsNoPairTwiceAndInAscendingOrder) {
  const Cell cell = cell_of({1.5, 3.0, 2.0});
  NeighbourList list;
  list.build(crowd(40, cell, 3), cell, 0.2);
  EXPECT_EQ(std::adjacent_find(list.pairs().begin(), list.pairs().end(), std::greater_equal<>()),
            list.pairs().end());
}

/// A crowd of one shape, or of sizes from 1 to `ratio`, that moves and turns at random.
struct Kind {
  const char* name;
  Vec3 axes;  ///< in mean radii
  double ratio;
  std::size_t count;
};

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

const Kind kKinds[] = {
    {"Spheres", {1.0, 1.0, 1.0}, 1.0, 60},      {"Spheroids143", {1.43, 1.0, 1.0}, 1.0, 60},
    {"Spheroids3", {3.0, 1.0, 1.0}, 1.0, 50},   {"Spheroids5", {5.0, 1.0, 1.0}, 1.0, 40},
    {"Spheroids10", {10.0, 1.0, 1.0}, 1.0, 30}, {"Flat10", {1.0, 1.0, 0.1}, 1.0, 40},
    {"Triaxial321", {3.0, 2.0, 1.0}, 1.0, 50},  {"Sizes5", {1.43, 1.0, 1.0}, 5.0, 50},
    {"Sizes20", {1.0, 1.0, 1.0}, 20.0, 50},     {"Sizes50", {3.0, 2.0, 1.0}, 50.0, 50},
};

class NeighbourListOf : public testing::TestWithParam<Kind> {
 protected:
  /// Mean radius of the largest is 1.
  Particles particles_in(const Cell& cell, std::uint64_t seed) const {
    const Kind& kind = GetParam();
    std::mt19937_64 random(seed);
    RecordProperty("seed", std::to_string(seed));
    const auto uniform3 = [&] {
      const double x = uniform(random), y = uniform(random);
      return Vec3(x, y, uniform(random));
    };
    Particles particles;
    for (std::size_t i = 0; i < kind.count; ++i) {
      const double size = i == 0 ? 1.0 : std::pow(kind.ratio, -uniform(random));
      const Vec3 centre = cell.edges * (3.0 * uniform3() - Vec3::Ones());
      particles.add(centre, uniform_rotation(random), size / mean_radius(kind.axes) * kind.axes,
                    1.0, 0);
      particles.velocity.back() = size * (2.0 * uniform3() - Vec3::Ones());
      particles.angular_velocity.back() = 2.0 * uniform3() - Vec3::Ones();
    }
    return particles;
  }

  /// Moves particles and cell until the list was renewed `renewals` times, and looks each time it
  /// is still current for touching pairs that it misses. Returns how many pairs came to touch after
  /// the list was built, and steps a list.
  std::pair<std::size_t, double> run(Cell cell, const Mat3& rate, double speed, double growth,
                                     std::uint64_t seed) const {
    constexpr double kRatio = 0.1, dt = 1.0;
    constexpr int renewals = 3;
    Particles particles = particles_in(cell, seed);
    cell.rate = rate;
    NeighbourList list;
    std::size_t came = 0;
    int steps = 0;
    for (int k = 0; k < renewals; ++k) {
      list.build(particles, cell, kRatio);
      const auto apart = [&](const Pair& pair) { return gap_of(pair, particles, cell) > 0.0; };
      std::vector<Pair> waiting;
      std::copy_if(list.pairs().begin(), list.pairs().end(), std::back_inserter(waiting), apart);
      const double full = list.least_slack(particles, cell, 0, particles.size());
      EXPECT_GT(full, 0.0);
      for (; steps < 1000; ++steps) {
        for (std::size_t i = 0; i < particles.size(); ++i) {
          particles.position[i] +=
              dt * (speed * particles.velocity[i] + cell.rate * particles.position[i]);
          const Vec3 turn = 0.5 * dt * speed * particles.angular_velocity[i];
          const Quaternion by(1.0, turn[0], turn[1], turn[2]);
          particles.orientation[i] = (by * particles.orientation[i]).normalized();
          particles.semi_axes[i] *= 1.0 + growth * dt;
        }
        cell.strain(dt);
        if (!list.is_current(particles, cell)) break;
        // Each time when it is about to go out of date, else now and then.
        const double slack = list.least_slack(particles, cell, 0, particles.size());
        if (slack > 0.1 * full && steps % 8 != 0) continue;
        if (!lists_all(list, touching_pairs(particles, cell))) {
          ADD_FAILURE() << "a touching pair is missed in step " << steps;
          return {came, 0.0};
        }
      }
      came += waiting.size() -
              static_cast<std::size_t>(std::count_if(waiting.begin(), waiting.end(), apart));
    }
    return {came, steps / double{renewals}};
  }

  Cell cell() const {
    const Kind& kind = GetParam();
    return cell_of((kind.ratio > 1.0 ? Vec3(4.5, 5.0, 4.0) : Vec3(6.0, 7.0, 6.5)));
  }
};

// A list that is renewed all the time would be no use: it must last a few steps too.

// dem/neighbours.hpp (1)
TEST_P(NeighbourListOf, MissesNoTouchingPairInAShear) {
  Mat3 rate = Vec3(-0.001, 0.0005, 0.0005).asDiagonal();
  const auto [box_came, box_steps] = run(cell(), rate, 0.0005, 0.0, 11);
  EXPECT_GT(box_steps, 5.0);
  rate(0, 1) = 0.002;
  rate(2, 1) = -0.001;
  const auto [came, steps] = run(cell(), rate, 0.0005, 0.0, 12);
  EXPECT_GT(steps, 4.0);
  EXPECT_GT(box_came + came, 0u);
}

TEST_P(NeighbourListOf, MissesNoTouchingPairInAGrowth) {
  const auto [came, steps] = run(cell(), Mat3::Zero(), 0.0002, 0.0005, 13);
  EXPECT_GT(steps, 5.0);
  EXPECT_GT(came, 0u);
}

TEST_P(NeighbourListOf, MissesNoTouchingPairAsParticlesMoveAlone) {
  const auto [came, steps] = run(cell(), Mat3::Zero(), 0.002, 0.0, 14);
  EXPECT_GT(steps, 5.0);
  EXPECT_GT(came, 0u);
}

// dem/neighbours.hpp (6)
TEST_P(NeighbourListOf, HoldsNoPairBeyondItsSkins) {
  const Cell in = cell();
  const Particles particles = particles_in(in, 15);
  NeighbourList list;
  list.build(particles, in, 0.1);
  ASSERT_GT(list.pairs().size(), 20u);
  for (const Pair& pair : list.pairs())
    EXPECT_LE(gap_of(pair, particles, in), skins_of(pair, particles, 0.1) + 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Kinds, NeighbourListOf, testing::ValuesIn(kKinds),
                         [](const auto& one) { return one.param.name; });

/// Two bodies that nearly are within their skins come nearer until they touch: the list, which does
/// not hold them, must be out of date by then, and not long before.
/// @param approach  brings both to what they are at `progress`; at 1 they touch
void expect_out_of_date_at_the_touch(
    Particles particles, Cell cell, double ratio,
    const std::function<void(Particles&, Cell&, double)>& approach) {
  NeighbourList list;
  list.build(particles, cell, ratio);
  ASSERT_TRUE(list.pairs().empty());
  const auto is_current_at = [&](double progress) {
    Particles moved = particles;
    Cell strained = cell;
    approach(moved, strained, progress);
    if (progress == 1.0) {
      const double gap = gap_of({0, 1, {}}, moved, strained);
      EXPECT_LT(gap, 1e-3 * mean_radius(particles.semi_axes[0])) << "they meet";
    }
    return list.is_current(moved, strained);
  };
  EXPECT_TRUE(is_current_at(0.0));
  EXPECT_TRUE(is_current_at(0.9));
  EXPECT_FALSE(is_current_at(1.0));
}

Particles two(const Ellipsoid& a, const Ellipsoid& b) {
  Particles particles;
  for (const Ellipsoid* one : {&a, &b})
    particles.add(one->centre(), one->orientation(), one->semi_axes(), 1.0, 0);
  return particles;
}

TEST(NeighbourListLasts, UntilTwoThatWereNotListedMeetHeadOn) {
  const Particles spheres = two(Ellipsoid({8.0, 5.0, 5.0}, Vec3::Ones()),
                                Ellipsoid({10.2 + 1e-6, 5.0, 5.0}, Vec3::Ones()));
  expect_out_of_date_at_the_touch(spheres, cell_of({20.0, 20.0, 20.0}), 0.1,
                                  [](Particles& p, Cell&, double progress) {
                                    p.position[0][0] += progress * 0.1000005;
                                    p.position[1][0] -= progress * 0.1000005;
                                  });
}

const Vec3 kRod(10.0, 1.0, 1.0);

TEST(NeighbourListLasts, UntilTwoRodsMeetThatTheStrainBringsTogetherEndToEnd) {
  const double skin = 0.1 * mean_radius(kRod), gap = 2.0 * skin + 1e-6;
  const Particles rods =
      two(Ellipsoid({15.0, 5.0, 5.0}, kRod), Ellipsoid({35.0 + gap, 5.0, 5.0}, kRod));
  expect_out_of_date_at_the_touch(rods, cell_of({60.0, 60.0, 60.0}), 0.1,
                                  [&](Particles& p, Cell& cell, double progress) {
                                    const double stretch = 1.0 - progress * gap / (20.0 + gap);
                                    cell.edges(0, 0) *= stretch;
                                    for (Vec3& x : p.position) x[0] *= stretch;
                                  });
}

TEST(NeighbourListLasts, UntilTwoRodsMeetThatGrowAlongTheirAxesAlone) {
  const double gap = 0.2 * mean_radius(kRod) + 1e-6;
  const Particles rods =
      two(Ellipsoid({15.0, 5.0, 5.0}, kRod), Ellipsoid({35.0 + gap, 5.0, 5.0}, kRod));
  expect_out_of_date_at_the_touch(rods, cell_of({60.0, 60.0, 60.0}), 0.1,
                                  [&](Particles& p, Cell&, double progress) {
                                    for (Vec3& axes : p.semi_axes) axes[0] += progress * 0.5 * gap;
                                  });
}

// Each bulges towards the other as fast as a turn can make it: a - c, at the angle whose squared
// tangent is a / c.
TEST(NeighbourListLasts, UntilTwoRodsMeetThatTurnTowardsEachOther) {
  const double gap = 0.2 * mean_radius(kRod) + 1e-6, angle = std::atan(std::sqrt(10.0));
  const auto turned_by = [&](double turn) {
    const auto rod = [&](const Vec3& at, double phi) {
      return Ellipsoid(at, kRod, Quaternion(std::cos(0.5 * phi), 0.0, 0.0, std::sin(0.5 * phi)));
    };
    const Ellipsoid a = rod({20.0, 20.0, 20.0}, angle - turn);
    // The mirror image, across the middle of the gap.
    const Ellipsoid start = rod({20.0, 20.0, 20.0}, angle);
    const Vec3 to_middle = start.support_point(Vec3::UnitX()) + 0.5 * gap * Vec3::UnitX();
    return std::pair(
        a, rod(Vec3(20.0, 20.0, 20.0) + Vec3(2.0 * to_middle[0], 0.0, 0.0), turn - angle));
  };
  const auto [a, b] = turned_by(0.0);
  ASSERT_NEAR(signed_gap(a, b).gap, gap, 1e-12);
  // By the turn that makes up for half the gap: (a - c) turn to the first order.
  const double turn = 0.5 * gap / 9.0;
  expect_out_of_date_at_the_touch(
      two(a, b), cell_of({90.0, 90.0, 90.0}), 0.1, [&](Particles& p, Cell&, double progress) {
        const auto [one, other] = turned_by(progress * turn);
        p.orientation[0] = one.orientation();
        // The same turn by the other sign.
        p.orientation[1] = Quaternion((-other.orientation().coeffs()).eval());
      });
}

TEST(NeighbourListLasts, LongerForThoseThatTurnAlthoughTheyAreRound) {
  const Cell cell = cell_of({8.0, 8.0, 8.0});
  Particles particles =
      two(Ellipsoid({1.0, 1.0, 1.0}, Vec3::Ones()), Ellipsoid({4.0, 4.0, 4.0}, Vec3::Ones()));
  NeighbourList list;
  list.build(particles, cell, 0.05);
  for (Quaternion& q : particles.orientation) q = Quaternion(0.0, 1.0, 0.0, 0.0);
  EXPECT_TRUE(list.is_current(particles, cell));
}

TEST(NeighbourList, IsOutOfDateForOtherParticles) {
  const Cell cell = cell_of({8.0, 8.0, 8.0});
  NeighbourList list;
  EXPECT_FALSE(list.is_current(crowd(3, cell, 5), cell));
  list.build(crowd(3, cell, 5), cell, 0.1);
  EXPECT_TRUE(list.is_current(crowd(3, cell, 5), cell));
  EXPECT_FALSE(list.is_current(crowd(4, cell, 5), cell));
  EXPECT_FALSE(list.is_current(crowd(2, cell, 5), cell));
}

// A list of skins in proportion alone would not outlast a step of these.
TEST(NeighbourList, OfParticlesThatMoveFastOutlastsStepsOfTheirMotion) {
  constexpr double kStep = 0.1;
  const Cell cell = cell_of({12.0, 13.0, 12.5});
  Particles particles = crowd(60, cell, 17);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles.velocity[i] = 0.01 * Vec3(1.0, -2.0, 0.5);
    particles.angular_velocity[i] = 0.05 * Vec3(0.3, 1.0, -0.2);
  }
  NeighbourList resting, moving;
  resting.build(particles, cell, 1e-4);
  moving.build(particles, cell, 1e-4, kStep);
  const auto step = [&] {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Vec3 turn = kStep * particles.angular_velocity[i];
      particles.position[i] += kStep * particles.velocity[i];
      particles.orientation[i] =
          (Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())) *
           Eigen::Quaterniond(particles.orientation[i]))
              .normalized();
    }
  };
  for (int k = 0; k < 9; ++k) {
    step();
    EXPECT_TRUE(moving.is_current(particles, cell)) << "after step " << k + 1;
    EXPECT_FALSE(resting.is_current(particles, cell));
  }
  for (int k = 0; k < 3; ++k) step();
  EXPECT_FALSE(moving.is_current(particles, cell)) << "and it does end";
}

TEST(NeighbourList, ThatCannotBeBuiltIsAsItWas) {
  const Cell cell = cell_of({12.0, 13.0, 12.5});
  Particles particles = crowd(60, cell, 17);
  NeighbourList list;
  list.build(particles, cell, 0.1);
  const std::vector<Pair> before = list.pairs();
  ASSERT_GT(before.size(), 0u);
  Particles far = particles;
  far.position[7] = Vec3::Constant(1e30);
  EXPECT_THROW(list.build(far, cell, 0.1), std::invalid_argument);
  EXPECT_FALSE(list.is_current(far, cell));
  EXPECT_TRUE(list.is_current(particles, cell));
  EXPECT_EQ(list.pairs(), before);
}

// Small particles beside a large one have small skins: it does not fill the list with pairs.
TEST(NeighbourList, OfSmallParticlesBesideALargeOneIsThatOfTheSmallOnesAlone) {
  const Cell cell = cell_of({30.0, 30.0, 30.0});
  Particles particles;
  std::mt19937_64 random(8);
  for (int i = 0; i < 500; ++i) {
    const double x = uniform(random), y = uniform(random);
    particles.add(Vec3(30.0 * x, 30.0 * y, 12.0 * uniform(random)), Quaternion::Identity(),
                  0.3 * Vec3::Ones(), 1.0, 0);
  }
  NeighbourList alone, mixed;
  alone.build(particles, cell, 0.1);
  particles.add({15.0, 15.0, 21.0}, Quaternion::Identity(), 6.0 * Vec3::Ones(), 1.0, 0);
  mixed.build(particles, cell, 0.1);
  std::vector<Pair> small = mixed.pairs();
  std::erase_if(small, [](const Pair& pair) { return pair.b == 500; });
  ASSERT_GT(alone.pairs().size(), 10u);
  EXPECT_EQ(small, alone.pairs());
}

// Of so many particles that several threads have something to do.
TEST(NeighbourList, IsTheSameAtEveryThreadCount) {
  const Cell cell = cell_of({20.0, 22.0, 21.0});
  const Particles particles = crowd(5000, cell, 31);
  std::vector<NeighbourList> lists(3);
  for (std::size_t k = 0; k < 3; ++k) {
    set_threads(k == 0 ? 1 : k == 1 ? 2 : 5);
    lists[k].build(particles, cell, 0.1);
  }
  set_threads(0);
  ASSERT_GT(lists[0].pairs().size(), 5000u);
  EXPECT_EQ(lists[1].pairs(), lists[0].pairs());
  EXPECT_EQ(lists[2].pairs(), lists[0].pairs());
}

TEST(NeighbourList, SlackOfPartsIsThatOfTheWhole) {
  const Cell cell = cell_of({8.0, 8.0, 8.0});
  Particles particles = crowd(30, cell, 7);
  NeighbourList list;
  list.build(particles, cell, 0.2);
  for (std::size_t i = 0; i < particles.size(); ++i)
    particles.position[i] += 0.1 * particles.velocity[i];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first < 30; first += 7)
    least = std::min(
        least, list.least_slack(particles, cell, first, std::min<std::size_t>(30, first + 7)));
  EXPECT_EQ(least, list.least_slack(particles, cell, 0, 30));
  EXPECT_LT(least, 0.2);
}

TEST(NeighbourList, RestoredIsTheSameList) {
  const Cell cell = cell_of({8.0, 8.0, 8.0});
  Particles particles = crowd(30, cell, 9);
  NeighbourList list, again;
  list.build(particles, cell, 0.2);
  again.restore(list.reference(), list.pairs());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles.position[i] += 0.01 * particles.velocity[i];
    particles.orientation[i] =
        Quaternion(1.0, 0.01, 0.0, 0.02).normalized() * particles.orientation[i];
    particles.semi_axes[i] *= 1.001;
  }
  EXPECT_EQ(again.least_slack(particles, cell, 0, 30), list.least_slack(particles, cell, 0, 30));
  EXPECT_TRUE(std::ranges::equal(again.pairs_as_b(3), list.pairs_as_b(3)));
}

TEST(NeighbourList, PairsOfEachParticleAreThoseThatNameIt) {
  const Cell cell = cell_of({2.0, 2.0, 2.0});
  const Particles particles = crowd(12, cell, 6);
  NeighbourList list;
  list.build(particles, cell, 0.2);
  ASSERT_TRUE(std::any_of(list.pairs().begin(), list.pairs().end(),
                          [](const Pair& pair) { return pair.a == pair.b; }));
  std::size_t found = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
    list.for_each_pair_of(i, [&](std::size_t index, bool as_b) {
      const Pair& pair = list.pairs()[index];
      EXPECT_EQ(static_cast<std::size_t>(as_b ? pair.b : pair.a), i);
      ++found;
    });
  EXPECT_EQ(found, 2 * list.pairs().size());
}

// dem/neighbours.hpp (1) (6)
TEST(NeighbourListOfEllipses, HoldsThoseWithinTheirSkinsAndNoOthers) {
  const Cell cell = Cell::box({9.0, 10.0, 1.0}, 2);
  std::mt19937_64 random(10);
  Particles particles;
  particles.dimensions = 2;
  for (int i = 0; i < 60; ++i) {
    const double x = uniform(random), y = uniform(random);
    particles.add({9.0 * x, 10.0 * y, 0.0}, uniform_rotation(random, 2), {1.5, 0.3, 0.3}, 1.0, 0);
  }
  NeighbourList list;
  list.build(particles, cell, 0.1);
  const auto ellipse = [&](std::int32_t i) {
    const Mat3 turn = particles.orientation[static_cast<std::size_t>(i)].toRotationMatrix();
    return Ellipse(Vec2::Zero(), Vec2(1.5, 0.3), Vec2(turn(0, 0), turn(1, 0)));
  };
  const double skins = 0.2 * std::sqrt(1.5 * 0.3);  // the plane has two semi-axes
  std::vector<Pair> certain = meeting_pairs(particles, cell, 1), possible;
  std::erase_if(certain, [](const Pair& pair) { return pair.image[2] != 0; });
  const auto gap = [&](const Pair& pair) {
    return signed_gap(ellipse(pair.a), ellipse(pair.b),
                      Vec2(branch_vector(pair, particles, cell).head<2>()))
        .gap;
  };
  std::erase_if(certain, [&](const Pair& pair) { return gap(pair) > skins - 1e-9; });
  ASSERT_GT(certain.size(), 100u);
  EXPECT_TRUE(lists_all(list, certain));
  for (const Pair& pair : list.pairs()) EXPECT_LT(gap(pair), skins + 1e-9);
}

}  // namespace
