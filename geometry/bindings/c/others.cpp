// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <vector>

#include <tangency/geometry/bindings/c/ask.hpp>
#include <tangency/geometry/closest_point.hpp>
#include <tangency/geometry/primitives.hpp>
#include <tangency/geometry/question_batch.hpp>
#include <tangency/geometry/ray.hpp>

namespace tangency::inline v0::c {
namespace {

constexpr std::array<const char*, 4> kWall{"nx", "ny", "nz", "offset"};
constexpr std::array<const char*, 4> kBall{"x", "y", "z", "r"};
constexpr std::array<const char*, 8> kRay{"ox", "oy", "oz", "dx", "dy", "dz", "t0", "t1"};

/// Plane or Sheet.
template <class Wall>
std::vector<Wall> walls_of(const double* rows, std::size_t count) {
  require_finite_rows("walls", rows, 4, count, kWall.data());
  std::vector<Wall> walls;
  walls.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 normal(rows[4 * i], rows[4 * i + 1], rows[4 * i + 2]);
    if ((normal.array() == 0.0).all()) {
      refuse_row("walls", i, "nx", 0.0, "a normal must not be 0");
    }
    walls.push_back({normal, rows[4 * i + 3]});
  }
  return walls;
}

template <class Wall>
void ask_walls(const tangency_bodies& bodies, const double* rows, const Pairs& pairs,
               std::size_t walls_count, const tangency_wall_columns& to, int threads) {
  const std::vector<Wall> walls = walls_of<Wall>(rows, walls_count);
  const std::size_t count = pairs.size();
  if (!bodies.by_matrices()) {
    signed_gaps(bodies.moving(), walls, pairs.list(),
                WallColumns{.gap = numbers(to.gap, count),
                            .gap_error = numbers(to.gap_error, count),
                            .normal = vectors(to.normal, count),
                            .arm_body = vectors(to.arm_body, count),
                            .arm_wall = vectors(to.arm_wall, count),
                            .status = values<GapStatus>(to.status, count)},
                threads);
  } else {
    each(count, threads, [&](std::size_t k) {
      const WallGap found = signed_gap(bodies.matrix(pairs[k].a), walls[pairs[k].b]);
      put(to.gap, k, found.gap);
      put(to.gap_error, k, found.gap_error);
      put(to.normal, k, found.normal);
      put(to.arm_body, k, found.arm_body);
      put(to.arm_wall, k, found.arm_wall);
      put(to.status, k, found.status);
    });
  }
  if (to.relation == nullptr && to.inner == nullptr) return;
  const auto body = [&](std::size_t i) {
    return bodies.by_matrices() ? bodies.matrix(i)
                                : MatrixEllipsoid(bodies.prepared().ellipsoids[i]);
  };
  each(count, threads, [&](std::size_t k) {
    const RelationAnswer found = relation(body(pairs[k].a), walls[pairs[k].b]);
    put(to.relation, k, found.relation);
    put(to.inner, k, found.inner);
  });
}

std::vector<Sphere> balls_of(const double* rows, std::size_t count) {
  require_finite_rows("balls", rows, 4, count, kBall.data());
  std::vector<Sphere> balls;
  balls.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = rows[4 * i + 3];
    if (!(radius >= 0.0)) refuse_row("balls", i, "r", radius, "a radius must be >= 0");
    balls.push_back({{rows[4 * i], rows[4 * i + 1], rows[4 * i + 2]}, radius});
  }
  return balls;
}

void require_rays(const double* rows, std::size_t count) {
  if (rows == nullptr && count > 0) refuse("rays", "must not be NULL");
  for (std::size_t i = 0; i < count; ++i) {
    const double* const row = rows + 8 * i;
    for (std::size_t k = 0; k < 6; ++k) {
      if (!std::isfinite(row[k])) refuse_row("rays", i, kRay[k], row[k], "must be finite");
    }
    if (row[3] == 0.0 && row[4] == 0.0 && row[5] == 0.0) {
      refuse_row("rays", i, "dx", 0.0, "a direction must not be 0");
    }
    if (std::isnan(row[6])) refuse_row("rays", i, "t0", row[6], "must be a number");
    if (!(row[7] >= row[6])) refuse_row("rays", i, "t1", row[7], "must not be below t0");
  }
}

void put_hit(const tangency_ray_columns& to, std::size_t k, const RayHit& hit) {
  put(to.status, k, hit.status);
  put(to.count, k, hit.count);
  for (std::size_t i = 0; i < 2; ++i) {
    put(to.t, 2 * k + i, hit.points[i].t);
    put(to.arm, 2 * k + i, hit.points[i].arm);
    put(to.normal, 2 * k + i, hit.points[i].normal);
  }
}

}  // namespace
}  // namespace tangency::inline v0::c

using namespace tangency;     // NOLINT(google-build-using-namespace): this file is the border
using namespace tangency::c;  // NOLINT(google-build-using-namespace)

extern "C" {

int tangency_walls(const tangency_bodies* bodies, const double* walls, size_t walls_count,
                   int sheets, const unsigned* pairs, size_t count,
                   const tangency_wall_columns* answers, int threads) {
  return guarded([&] {
    const tangency_wall_columns to = known(answers, "answers");
    const Pairs list(required(bodies).size(), walls_count, "walls", pairs, count);
    const auto& ask = sheets != 0 ? ask_walls<Sheet> : ask_walls<Plane>;
    ask(*bodies, walls, list, walls_count, to, threads);
  });
}

int tangency_points(const tangency_bodies* bodies, const double* points, size_t points_count,
                    const unsigned* pairs, size_t count, const tangency_point_columns* answers,
                    int threads) {
  return guarded([&] {
    const tangency_point_columns to = known(answers, "answers");
    const Pairs list(required(bodies).size(), points_count, "points", pairs, count);
    require_finite_rows("points", points, 3, points_count, kBall.data());
    if (!bodies->by_matrices()) {
      return closest_points(bodies->moving(), {vectors(points), points_count}, list.list(),
                            {.distance = numbers(to.distance, count),
                             .distance_error = numbers(to.distance_error, count),
                             .normal = vectors(to.normal, count),
                             .arm = vectors(to.arm, count),
                             .status = values<GapStatus>(to.status, count)},
                            threads);
    }
    each(count, threads, [&](std::size_t k) {
      const ClosestPoint found =
          closest_point(bodies->matrix(list[k].a), vectors(points)[list[k].b]);
      put(to.distance, k, found.distance);
      put(to.distance_error, k, found.distance_error);
      put(to.normal, k, found.normal);
      put(to.arm, k, found.arm);
      put(to.status, k, found.status);
    });
  });
}

int tangency_balls(const tangency_bodies* bodies, const double* balls, size_t balls_count,
                   const unsigned* pairs, size_t count, const tangency_contact_columns* answers,
                   int threads) {
  return guarded([&] {
    const tangency_contact_columns to = known(answers, "answers");
    if (to.normal_bound || to.arm_a_bound || to.arm_b_bound) {
      refuse("answers", "normal_bound, arm_a_bound and arm_b_bound are of tangency_contacts()");
    }
    const Pairs list(required(bodies).size(), balls_count, "balls", pairs, count);
    const std::vector<Sphere> spheres = balls_of(balls, balls_count);
    if (!bodies->by_matrices()) {
      return signed_gaps(bodies->moving(), spheres, list.list(), gap_columns(to, count), threads);
    }
    each(count, threads, [&](std::size_t k) {
      const MatrixEllipsoid& body = bodies->matrix(list[k].a);
      const Sphere& ball = spheres[list[k].b];
      put_contact(to, k, signed_gap(body, ball), ball.centre - body.ellipsoid().centre());
    });
  });
}

int tangency_rays(const tangency_bodies* bodies, const double* rays, size_t rays_count,
                  const unsigned* pairs, size_t count, const tangency_ray_columns* answers,
                  int threads) {
  return guarded([&] {
    const tangency_ray_columns to = known(answers, "answers");
    const Pairs list(required(bodies).size(), rays_count, "rays", pairs, count);
    require_rays(rays, rays_count);
    const auto ask = [&](const auto& body, std::size_t k) {
      const double* const r = rays + 8 * list[k].b;
      const Ray ray{{r[0], r[1], r[2]}, {r[3], r[4], r[5]}};
      put_hit(to, k, intersect(body, ray, r[6], r[7]));
    };
    if (bodies->by_matrices()) {
      return each(count, threads, [&](std::size_t k) { ask(bodies->matrix(list[k].a), k); });
    }
    const std::vector<Ellipsoid>& all = bodies->prepared().ellipsoids;
    each(count, threads, [&](std::size_t k) { ask(all[list[k].a], k); });
  });
}

}  // extern "C"
