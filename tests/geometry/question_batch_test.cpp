// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/question_batch.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>

namespace tangency {
namespace {

using testing::at_every_level;
using testing::same_bits;

constexpr double kU = kUnitRoundoff;

int sign(double x) { return (x > 0) - (x < 0); }

/// Bodies, thin and tiny ones among them, with walls, balls and points near, far and touching.
struct Scene {
  Scene() {
    for (std::uint32_t i = 0; i < 300; ++i) add(i);
    // What lanes cannot hold, and touches.
    bodies.emplace_back(Vec3(0, 0, 0), Vec3(1e200, 1e190, 1e199));
    bodies.emplace_back(Vec3(0, 0, 0), Vec3(1, 2, 3));
    const auto last = static_cast<std::uint32_t>(bodies.size() - 1);
    const auto also = [&](const Vec3& normal, double offset, const Vec3& point, double radius) {
      walls.push_back({normal, offset});
      sheets.push_back({normal, offset});
      points.push_back(point);
      balls.push_back({point, radius});
      for (const std::uint32_t body : {last - 1, last})
        pairs.push_back({body, static_cast<std::uint32_t>(walls.size() - 1)});
    };
    also({0, 0, 2}, -6, {0, 0, -3}, 0.0);          // the plane and the point of a pole
    also({0, 0, 1}, 0, {0, 0, 0}, 1e-30);          // through the centre, at the centre
    also({1e-200, 0, 0}, 2e-200, {4, 0, 0}, 3.0);  // a tiny normal; a ball that touches
    also({0, 1, 0}, 1e308, {0, 1e300, 0}, 1e299);
    for (const auto [a, b] : pairs) {
      separations.push_back(points[b] - bodies[a].centre());
      axes_of.push_back(bodies[a].semi_axes());
    }
    for (const Ellipsoid& body : bodies) {
      semi_axes.push_back(body.semi_axes());
      orientations.push_back(body.orientation());
    }
  }
  void add(std::uint32_t i) {
    const Vec3 turn = in_cube(1.0), somewhere = in_cube(i % 10 == 0 ? 1e6 : 3.0);
    // What is tiny has to be near the origin to have neighbours that doubles can name.
    const Vec3 centre = i % 11 == 0 ? Vec3(Vec3::Zero()) : somewhere;
    const double aspect = i % 7 == 0 ? 1e5 : 5.0, scale = i % 11 == 0 ? 1e-17 : 1.0;
    Vec3 axes;
    for (double& r : axes) r = scale * std::pow(aspect, -uniform(0.0, 1.0));
    bodies.emplace_back(centre, axes, Quaternion(uniform(0.1, 1.0), turn.x(), turn.y(), turn.z()));
    const double length = uniform(0.1, 3.0);
    const Vec3 normal = length * in_cube(1.0), point = centre + scale * in_cube(2.0);
    walls.push_back({normal, normal.dot(centre) + scale * uniform(-2.0, 2.0)});
    sheets.push_back({normal, normal.dot(centre) + scale * uniform(-2.0, 2.0)});
    points.push_back(point);
    const double radius = scale * uniform(0.0, 1.0);
    // Balls below the range of lanes, 2^-60, of bodies just within it.
    balls.push_back({point, i % 3 == 0 ? 0.0 : i % 11 == 0 ? 5e-19 : radius});
    pairs.push_back({i, i});
  }
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  }
  Vec3 in_cube(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half);
    return {x, y, uniform(-half, half)};
  }
  double size(std::size_t i) const {
    return axes_of[i].maxCoeff() + separations[i].stableNorm() + balls[pairs[i].b].radius;
  }

  std::mt19937_64 random{20261130};
  std::vector<Ellipsoid> bodies;
  std::vector<Plane> walls;
  std::vector<Sheet> sheets;
  std::vector<Sphere> balls;
  std::vector<Vec3> points, separations, axes_of, semi_axes;
  std::vector<Quaternion> orientations;
  std::vector<IndexedPair> pairs;
};

struct Walls {
  explicit Walls(std::size_t n) : gap(n), error(n), normal(n), body(n), wall(n), status(n) {}
  WallColumns columns() { return {gap, error, normal, body, wall, status}; }
  std::vector<double> gap, error;
  std::vector<Vec3> normal, body, wall;
  std::vector<GapStatus> status;
};
struct Points {
  explicit Points(std::size_t n) : distance(n), error(n), normal(n), arm(n), status(n) {}
  PointColumns columns() { return {distance, error, normal, arm, status}; }
  std::vector<double> distance, error;
  std::vector<Vec3> normal, arm;
  std::vector<GapStatus> status;
};

void expect_same(double value, double error, double single, double single_error, std::size_t i) {
  if (!std::isfinite(single)) return;
  ASSERT_LE(std::abs(value - single), (error + single_error) * (1 + 1e-12)) << i;
  ASSERT_EQ(sign(value), sign(single)) << i;
}

void expect_walls(const Walls& found, std::size_t i, const WallGap& single, double size) {
  expect_same(found.gap[i], found.error[i], single.gap, single.gap_error, i);
  ASSERT_EQ(found.status[i], GapStatus::ok);
  ASSERT_LE((found.normal[i] - single.normal).norm(), 16 * kU) << i;
  // The body's point reaches the wall's along the normal.
  const Vec3 between = found.wall[i] - found.body[i];
  ASSERT_LE((between - found.gap[i] * found.normal[i]).stableNorm(), 16 * kU * size) << i;
}

// geometry/question_batch.hpp (1)
TEST(QuestionBatch, WallsAreWithinTheirErrorsAndOnTheRightSide) {
  const Scene s;
  const BodyArray array{std::span<const Ellipsoid>(s.bodies)};
  const MovingBodies moving(s.semi_axes, s.orientations);
  const std::size_t n = s.pairs.size();
  Walls solid(n), sheet(n), across(n), moved(n);
  signed_gaps(array, std::span(s.walls), {s.pairs, {}}, solid.columns());
  signed_gaps(array, std::span(s.sheets), {s.pairs, {}}, sheet.columns());
  signed_gaps(array, std::span(s.walls), {s.pairs, s.separations}, across.columns());
  signed_gaps(moving, std::span(s.sheets), {s.pairs, s.separations}, moved.columns());
  for (std::size_t i = 0; i < n; ++i) {
    const auto [a, b] = s.pairs[i];
    const Vec3& d = s.separations[i];
    const double size = s.size(i) + s.bodies[a].centre().norm() +
                        std::abs(s.walls[b].offset / s.walls[b].normal.norm());
    expect_walls(solid, i, signed_gap(s.bodies[a], s.walls[b]), size);
    expect_walls(sheet, i, signed_gap(s.bodies[a], s.sheets[b]), size);
    expect_walls(across, i, signed_gap(s.bodies[a], s.walls[b], d), size);
    expect_walls(moved, i, signed_gap(s.bodies[a], s.sheets[b], d), size);
  }
}

// geometry/question_batch.hpp (1)
TEST(QuestionBatch, BallsAndPointsAreWithinTheirErrorsAtEveryLevel) {
  const Scene s;
  const BodyArray array{std::span<const Ellipsoid>(s.bodies)};
  const MovingBodies moving(s.semi_axes, s.orientations);
  const std::size_t n = s.pairs.size();
  at_every_level([&] {
    testing::Columns balls(n), apart(n), moved(n);
    Points points(n), across(n), turned(n);
    std::vector<Vec3> middle(n);
    GapColumns with_point = balls.all();
    with_point.point = middle;
    signed_gaps(array, std::span(s.balls), {s.pairs, {}}, with_point);
    signed_gaps(array, std::span(s.balls), {s.pairs, s.separations}, apart.all());
    signed_gaps(moving, std::span(s.balls), {s.pairs, s.separations}, moved.all());
    closest_points(array, s.points, {s.pairs, {}}, points.columns());
    closest_points(array, s.points, {s.pairs, s.separations}, across.columns());
    closest_points(moving, s.points, {s.pairs, s.separations}, turned.columns());
    for (std::size_t i = 0; i < n; ++i) {
      const auto [a, b] = s.pairs[i];
      const Vec3& d = s.separations[i];
      const Gap one = signed_gap(s.bodies[a], s.balls[b]);
      const Gap other = signed_gap(s.bodies[a], s.balls[b], d);
      expect_same(balls.gap[i], balls.gap_error[i], one.gap, one.gap_error, i);
      expect_same(apart.gap[i], apart.gap_error[i], other.gap, other.gap_error, i);
      expect_same(moved.gap[i], moved.gap_error[i], other.gap, other.gap_error, i);
      const Vec3 half = balls.arm_a[i] + 0.5 * (d + balls.arm_b[i] - balls.arm_a[i]);
      ASSERT_LE((middle[i] - half).stableNorm(), 8 * kU * s.size(i)) << i;
      const ClosestPoint point = closest_point(s.bodies[a], s.points[b]);
      const ClosestPoint there = closest_point_from_centre(s.bodies[a], d);
      expect_same(points.distance[i], points.error[i], point.distance, point.distance_error, i);
      expect_same(across.distance[i], across.error[i], there.distance, there.distance_error, i);
      expect_same(turned.distance[i], turned.error[i], there.distance, there.distance_error, i);
      ASSERT_EQ(points.status[i], GapStatus::ok);
    }
  });
}

// geometry/question_batch.hpp (2)
TEST(QuestionBatch, ErrorsOfModerateBodiesAreSomeRoundingsOfTheSize) {
  const Scene s;
  const BodyArray array{std::span<const Ellipsoid>(s.bodies)};
  const std::size_t n = s.pairs.size();
  Walls walls(n);
  testing::Columns balls(n);
  Points points(n);
  const PairList list{s.pairs, s.separations};
  signed_gaps(array, std::span(s.walls), list, walls.columns());
  signed_gaps(array, std::span(s.balls), list, balls.all());
  closest_points(array, s.points, list, points.columns());
  std::size_t quick = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto [a, b] = s.pairs[i];
    const double size = s.size(i);
    ASSERT_LE(walls.error[i], 26 * kU * (size + std::abs(walls.gap[i]))) << i;
    ASSERT_LE(balls.gap_error[i], 40 * kU * size) << i;
    ASSERT_LE(points.error[i], 40 * kU * size) << i;
    const ClosestPoint one = closest_point_from_centre(s.bodies[a], s.separations[i]);
    if (points.error[i] != one.distance_error) {
      ++quick;  // not by the single call; bodies of aspect to 5, or thin ones from afar
      const double axis = s.bodies[a].largest_semi_axis();
      const double bend = axis * axis / s.bodies[a].smallest_semi_axis();
      ASSERT_LE((points.arm[i] - one.arm).norm(), 1e-13 * (size + bend * bend / axis)) << i;
    }
  }
  EXPECT_GE(quick, n / 2);
}

// geometry/question_batch.hpp (3)
TEST(QuestionBatch, AnswersDoNotDependOnPlaceOrderNumberOrThreads) {
  const Scene s;
  const BodyArray array{std::span<const Ellipsoid>(s.bodies)};
  std::vector<IndexedPair> many;
  for (int k = 0; k < 12; ++k) many.insert(many.end(), s.pairs.begin() + 7 * k, s.pairs.end());
  std::shuffle(many.begin(), many.end(), std::mt19937_64(3));
  const auto ask = [&](std::span<const IndexedPair> pairs, int threads, Walls& walls,
                       testing::Columns& balls, Points& points) {
    signed_gaps(array, std::span(s.walls), {pairs, {}}, walls.columns(), threads);
    signed_gaps(array, std::span(s.balls), {pairs, {}}, balls.all(), threads);
    closest_points(array, s.points, {pairs, {}}, points.columns(), threads);
  };
  const std::size_t n = many.size();
  ASSERT_GE(n, 3000u);
  Walls walls(n);
  testing::Columns balls(n);
  Points points(n);
  ask(many, 3, walls, balls, points);
  for (std::size_t i = 0; i < n; i += 5) {
    Walls one_wall(1);
    testing::Columns one_ball(1);
    Points one_point(1);
    ask(std::span(many).subspan(i, 1), 1, one_wall, one_ball, one_point);
    ASSERT_TRUE(same_bits(walls.gap[i], one_wall.gap[0]) &&
                same_bits(walls.wall[i], one_wall.wall[0]))
        << i;
    ASSERT_TRUE(same_bits(balls[i], one_ball[0])) << i;
    ASSERT_TRUE(same_bits(points.distance[i], one_point.distance[0]) &&
                same_bits(points.arm[i], one_point.arm[0]))
        << i;
  }
}

TEST(QuestionBatchDeathTest, WrongQuestionsEndTheProcessWithALine) {
  const Scene s;
  const BodyArray array{std::span<const Ellipsoid>(s.bodies)};
  const std::vector<IndexedPair> wrong{{0, 0}, {0, 5000}};
  Walls walls(2);
  Points points(1);
  EXPECT_DEATH(signed_gaps(array, std::span(s.walls), {wrong, {}}, walls.columns()),
               "signed_gaps: pairs\\[1\\].b = 5000, and there are 304 walls");
  EXPECT_DEATH(signed_gaps(array, std::span(s.balls), {wrong, {}}, GapColumns{}),
               "signed_gaps: pairs\\[1\\].b = 5000, and there are [0-9]+ balls");
  EXPECT_DEATH(closest_points(array, s.points, {wrong, {}}, PointColumns{}),
               "closest_points: pairs\\[1\\].b = 5000, and there are [0-9]+ points");
  const std::vector<IndexedPair> no_body{{5000, 0}};
  EXPECT_DEATH(signed_gaps(array, std::span(s.walls), {no_body, {}}, WallColumns{}),
               "signed_gaps: pairs\\[0\\].a = 5000, and there are [0-9]+ bodies");
  EXPECT_DEATH(closest_points(array, s.points, {wrong, {}}, points.columns()),
               "closest_points: distance: 1 entries, and there are 2 pairs");
}

}  // namespace
}  // namespace tangency
