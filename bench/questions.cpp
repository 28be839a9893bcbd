// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies against walls, balls and points: batches beside single calls, by turns, in ns a pair.
// Answers are held against the single calls before anything is timed.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tangency/bench/timing.hpp>
#include <tangency/geometry/question_batch.hpp>

namespace {

using namespace tangency;
using bench::kInCache;

/// Bodies of aspect to 5 with something near the surface of each: half of it inside.
struct Scene {
  Scene() {
    std::mt19937_64 random(20261130);
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
    };
    const auto in_cube = [&](double half) {
      const double x = uniform(-half, half), y = uniform(-half, half);
      return Vec3(x, y, uniform(-half, half));
    };
    for (std::uint32_t i = 0; i < kInCache; ++i) {
      Vec3 axes;
      for (double& r : axes) r = std::pow(5.0, -uniform(0.0, 1.0));
      const Vec3 centre = in_cube(10), turn = in_cube(1), n = in_cube(1).normalized();
      bodies.emplace_back(centre, axes,
                          Quaternion(uniform(0.1, 1.0), turn.x(), turn.y(), turn.z()));
      const double above = bodies.back().smallest_semi_axis() * uniform(-0.1, 0.1);
      const Vec3 point = centre + bodies.back().support_point(n) + above * n;
      walls.push_back({-n, -n.dot(point)});
      points.push_back(point);
      balls.push_back({point + 0.5 * n, 0.5});
      pairs.push_back({i, i});
    }
  }

  std::vector<Ellipsoid> bodies;
  std::vector<Plane> walls;
  std::vector<Sphere> balls;
  std::vector<Vec3> points;
  std::vector<IndexedPair> pairs;
};

void require_right(const char* what, const std::vector<double>& value,
                   const std::vector<double>& error,
                   const std::function<std::pair<double, double>(std::size_t)>& single) {
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto [one, off] = single(i);
    if (std::abs(value[i] - one) <= (error[i] + off) * (1 + 1e-12)) continue;
    std::fprintf(stderr, "%s: pair %zu: %.17g, by the single call %.17g: no timing\n", what, i,
                 value[i], one);
    std::exit(1);
  }
}

}  // namespace

int main() {
  const Scene s;
  const BodyArray array{std::span<const Ellipsoid>(s.bodies)};
  const PairList list{s.pairs, {}};
  std::vector<double> value(kInCache), error(kInCache);
  std::vector<Vec3> normal(kInCache);
  const std::span<const Plane> planes(s.walls);
  const std::span<const Sphere> balls(s.balls);
  const auto walls_at_once = [&] {
    signed_gaps(array, planes, list, {.gap = value, .gap_error = error, .normal = normal});
  };
  const auto balls_at_once = [&] {
    signed_gaps(array, balls, list, GapColumns{.gap = value, .gap_error = error, .normal = normal});
  };
  const auto points_at_once = [&] {
    closest_points(array, s.points, list,
                   {.distance = value, .distance_error = error, .normal = normal});
  };
  const auto wall = [&](std::size_t i) { return signed_gap(s.bodies[i], s.walls[i]); };
  const auto ball = [&](std::size_t i) { return signed_gap(s.bodies[i], s.balls[i]); };
  const auto point = [&](std::size_t i) { return closest_point(s.bodies[i], s.points[i]); };
  walls_at_once();
  require_right("walls", value, error,
                [&](std::size_t i) { return std::pair(wall(i).gap, wall(i).gap_error); });
  balls_at_once();
  require_right("balls", value, error,
                [&](std::size_t i) { return std::pair(ball(i).gap, ball(i).gap_error); });
  points_at_once();
  require_right("points", value, error, [&](std::size_t i) {
    return std::pair(point(i).distance, point(i).distance_error);
  });
  const auto each = [](const auto& call) {
    return [call] {
      for (std::size_t i = 0; i < kInCache; ++i) benchmark::DoNotOptimize(call(i));
    };
  };
  std::vector<bench::Job> jobs{{walls_at_once, kInCache},  {each(wall), kInCache},
                               {balls_at_once, kInCache},  {each(ball), kInCache},
                               {points_at_once, kInCache}, {each(point), kInCache}};
  bench::time_by_turns(jobs, {.rounds = 15, .shortest = 0.01, .enough = 2.0});
  const char* const names[] = {"walls", "balls", "points"};
  for (std::size_t k = 0; k < 3; ++k) {
    std::printf("%-8s batch %7.1f ns   single calls %7.1f ns   ratio %5.1f\n", names[k],
                jobs[2 * k].least, jobs[2 * k + 1].least,
                jobs[2 * k + 1].least / jobs[2 * k].least);
  }
  return 0;
}
