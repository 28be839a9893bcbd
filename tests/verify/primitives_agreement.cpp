// SPDX-License-Identifier: GPL-3.0-or-later
// Holds the closest point, the ray, the wall and the sphere against the oracle's 120 digits on as
// many inputs of each as asked for, and prints the largest errors. The merge gate runs a part of
// it; docs/testing.md names the whole.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>

#include <tangency/geometry/closest_point.hpp>
#include <tangency/geometry/primitives.hpp>
#include <tangency/geometry/ray.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/oracles/primitives.hpp>

namespace {

using tangency::Vec3;
using tangency::verify::Digits120;
using tangency::verify::dot, tangency::verify::from_centre, tangency::verify::length;
using tangency::verify::minus, tangency::verify::nearest;
using tangency::verify::RawEllipsoid;
using tangency::verify::Vector120;
using Triple = std::array<double, 3>;

constexpr double kU = tangency::kUnitRoundoff;
constexpr double kPromise = 8.0;  // u L

Vec3 vec(const Triple& v) { return {v[0], v[1], v[2]}; }
Triple triple(const Vec3& v) { return {v[0], v[1], v[2]}; }
Vector120 digits(const Vec3& v) { return tangency::verify::exact(triple(v)); }

/// Hostile inputs, reproducible across standard libraries.
class Source {
 public:
  explicit Source(std::uint64_t seed) : random_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * kU);
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }

  Vec3 direction() {
    for (;;) {
      Vec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (below(6) == 0) v[below(3)] = 0;
      if (below(8) == 0) v = Vec3::Unit(below(3)) * (below(2) == 0 ? 1 : -1);
      if (v.norm() > 0.01 && v.norm() <= 1) return v.normalized();
    }
  }

  /// Aspect ratios to 1e8, equal and nearly equal axes; sizes to 1e+-150; far origins.
  RawEllipsoid body() {
    RawEllipsoid e;
    const double aspect = log_uniform(1, 1e8);
    const double size = below(8) == 0 ? log_uniform(1e-150, 1e150) : log_uniform(0.1, 10);
    e.semi_axes = {size, size * log_uniform(1 / aspect, 1), size / aspect};
    switch (below(8)) {
      case 0:
        e.semi_axes[1] = e.semi_axes[0];
        break;
      case 1:
        e.semi_axes[1] = e.semi_axes[2];
        break;
      case 2:
        e.semi_axes[1] = std::nextafter(e.semi_axes[2], 2 * size);
        break;
      case 3:
        if (below(3) == 0) e.semi_axes = {size, size, size};
        break;
      default:
        break;
    }
    std::swap(e.semi_axes[2], e.semi_axes[static_cast<std::size_t>(below(3))]);
    const double away = below(8) == 0 ? 1e12 : below(8) == 0 ? 0 : 1;
    for (double& c : e.centre) c = away * size * uniform(-1, 1);
    e.orientation = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    for (double& q : e.orientation) {
      if (below(8) == 0) q = 0;
    }
    if (below(4) == 0 || e.orientation == std::array<double, 4>{}) e.orientation = {1, 0, 0, 0};
    if (below(8) == 0) {
      for (double& q : e.orientation) q *= 0x1p300;
    }
    return e;
  }

  /// A point on, near, inside, outside or far from the body, or on one of its symmetry planes.
  Vec3 point(const RawEllipsoid& raw) {
    const auto e = tangency::verify::to_ellipsoid(raw);
    const Vec3 surface = e.support_point(direction());
    const double size = e.largest_semi_axis();
    Vec3 y = e.rotation().transpose() * surface;
    switch (below(9)) {
      case 0:
        return e.centre();
      case 1:
        return e.centre() + surface;
      case 2:
        return e.centre() + surface * (1 + log_uniform(1e-16, 1e-3) * (below(2) == 0 ? 1 : -1));
      case 3:
        return e.centre() + surface * uniform(0, 1);
      case 4:
        return e.centre() + log_uniform(1e-8, 1) * size * direction();
      case 5:
        return e.centre() + surface + log_uniform(1e-12, 10) * size * direction();
      case 6:
        return e.centre() + log_uniform(1, 1e6) * size * direction();
      case 7:
        y[below(3)] = 0;
        return e.centre() + uniform(0, 1) * (e.rotation() * y);
      default:
        y[below(3)] = 0, y[below(3)] = 0;
        return e.centre() + e.rotation() * y;
    }
  }

 private:
  std::mt19937_64 random_;
};

/// The largest error of one number, in units of what is allowed of it.
struct Worst {
  const char* what;
  double error = 0;
  RawEllipsoid body{};
  Triple with{}, and_with{};

  void see(const Digits120& value, const RawEllipsoid& e, const Triple& v, const Triple& w = {}) {
    const double x = static_cast<double>(value);
    if (x <= error || std::isnan(error)) return;  // a NaN is kept
    error = x, body = e, with = v, and_with = w;
  }
  void print(const char* unit) const {
    std::printf("  %-44s %9.3g %s\n", what, error, unit);
    if (error <= kPromise) return;
    std::printf("    worst row: ");
    const auto all = [](const auto& numbers) {
      for (const double x : numbers) std::printf("%a,", x);
    };
    all(body.centre), all(body.semi_axes), all(body.orientation), all(with), all(and_with);
    std::printf("\n");
  }
  bool kept() const { return error <= kPromise; }
};

Digits120 distance(const Vector120& a, const Vector120& b) { return length(minus(a, b)); }

Digits120 longest(const RawEllipsoid& e) {
  return *std::max_element(e.semi_axes.begin(), e.semi_axes.end());
}
Digits120 least_radius(const RawEllipsoid& e) {
  const Digits120 a = *std::min_element(e.semi_axes.begin(), e.semi_axes.end());
  return a * a / longest(e);
}

bool check_points(Source& source, long count) {
  Worst value{"distance"}, tight{"distance, in 2u |distance| + 2^-80 L"};
  Worst on_surface{"closest point from the surface"}, reach{"|point - closest point| - |distance|"};
  Worst outside{"closest point from the true one, outside"};
  Worst normal{"normal, outside, over L / (rho + distance)"};
  for (long i = 0; i < count; ++i) {
    const RawEllipsoid e = source.body();
    const Triple p = triple(source.point(e));
    const auto found = tangency::closest_point(tangency::verify::to_ellipsoid(e), vec(p));
    const Vector120 from = from_centre(e, p);
    const auto truth = nearest(e, from);
    const Digits120 size = length(from) + longest(e), unit = kU * size;
    const Digits120 error = abs(found.distance - truth.distance);
    const Vector120 arm = digits(found.arm);
    value.see(error / unit, e, p);
    tight.see(error / (2 * kU * abs(truth.distance) + 0x1p-80 * size), e, p);
    on_surface.see(abs(nearest(e, arm).distance) / unit, e, p);
    reach.see(abs(distance(from, arm) - abs(truth.distance)) / unit, e, p);
    if (truth.distance >= 0) {
      outside.see(distance(arm, truth.point) / unit, e, p);
      const Digits120 turn = distance(digits(found.normal), truth.normal);
      normal.see(turn / (kU + unit / (least_radius(e) + truth.distance)), e, p);
    }
  }
  std::printf("closest point, %ld inputs\n", count);
  for (const Worst* w : {&value, &on_surface, &reach, &outside}) w->print("u L");
  tight.print("of it");
  normal.print("u");
  return value.kept() && tight.error <= 1 && on_surface.kept() && reach.kept() && outside.kept() &&
         normal.kept();
}

bool check_spheres(Source& source, long count) {
  Worst value{"gap of sphere and ellipsoid"}, spheres{"gap of two spheres"};
  for (long i = 0; i < count; ++i) {
    const RawEllipsoid e = source.body();
    const Triple p = triple(source.point(e));
    const double r = source.below(4) == 0 ? 0 : e.semi_axes[0] * source.log_uniform(1e-8, 1e8);
    const tangency::Sphere sphere{vec(p), r};
    const Vector120 from = from_centre(e, p);
    const Digits120 size = length(from) + longest(e) + r;
    const Digits120 truth = nearest(e, from).distance - r;
    value.see(abs(signed_gap(sphere, tangency::verify::to_ellipsoid(e)).gap - truth) / (kU * size),
              e, p, {r, 0, 0});
    const double other = e.semi_axes[0];
    const Digits120 between = length(from);
    spheres.see(abs(signed_gap(sphere, tangency::Sphere{vec(e.centre), other}).gap -
                    (between - r - other)) /
                    (kU * (between + r + other)),
                e, p, {r, 0, 0});
  }
  std::printf("spheres, %ld inputs\n", count);
  value.print("u L");
  spheres.print("u L");
  return value.kept() && spheres.kept();
}

bool check_walls(Source& source, long count) {
  Worst value{"gap"}, body_point{"point of the body"},
      wall_point{"point of the wall, from the plane"};
  for (long i = 0; i < count; ++i) {
    const RawEllipsoid e = source.body();
    const Triple through = triple(source.point(e));
    const Vec3 n = source.direction() * source.log_uniform(1e-100, 1e100);
    const double offset = source.below(8) == 0 ? 0 : n.dot(vec(through));
    const auto found = signed_gap(tangency::verify::to_ellipsoid(e), tangency::Plane{n, offset});
    const auto truth = tangency::verify::wall(e, triple(n), offset);
    const Digits120 unit = kU * (abs(truth.centre_distance) + longest(e));
    value.see(abs(found.gap - truth.gap) / unit, e, triple(n), {offset, 0, 0});
    body_point.see(distance(digits(found.arm_body), truth.point) / unit, e, triple(n),
                   {offset, 0, 0});
    const Vector120 normal = digits(n);
    const Digits120 off =
        dot(normal, digits(found.arm_wall)) / length(normal) + truth.centre_distance;
    wall_point.see(abs(off) / unit, e, triple(n), {offset, 0, 0});
  }
  std::printf("walls, %ld inputs\n", count);
  for (const Worst* w : {&value, &body_point, &wall_point}) w->print("u L");
  return value.kept() && body_point.kept() && wall_point.kept();
}

struct Line {
  Triple origin, direction;
};

/// Lines through, past and along the surface: grazing within 1e-3 to 1e-25 of it, from inside, from
/// 1e12 times the size away, with directions of any length.
Line any_line(Source& source, const RawEllipsoid& raw) {
  const auto e = tangency::verify::to_ellipsoid(raw);
  Vec3 n = source.direction(), at = e.support_point(n), along = source.direction();
  const double size = e.largest_semi_axis();
  switch (source.below(4)) {
    case 0:
      at *= source.uniform(0, 1);
      break;
    case 1:
      along -= along.dot(n) * n,
          at += n * size * source.uniform(-1, 1) * source.log_uniform(1e-25, 1e-3);
      break;
    case 2:
      at = source.point(raw) - e.centre();
      break;
    default:
      break;
  }
  if (along.norm() == 0) along = n;
  const double back =
      source.below(3) == 0 ? 0 : size * source.log_uniform(1e-3, source.below(3) == 0 ? 1e12 : 10);
  const double stretch = source.below(3) == 0 ? source.log_uniform(1e-100, 1e100) : 1;
  return {triple(e.centre() + at - back * along), triple(stretch * along)};
}

bool check_rays(Source& source, long count) {
  Worst on_surface{"hit point from the surface"}, on_line{"hit point from the line"};
  Worst time{"t |direction|, where k > 2^-30"},
      tight{"t |direction|, in 2u |t direction| + 2^-80 L / k"};
  Worst near_miss{"grazing: least level - 1, in 2^-90 L / a"};
  long hits = 0, grazing = 0, wrong = 0;
  for (long i = 0; i < count; ++i) {
    const RawEllipsoid e = source.body();
    const auto [origin, direction] = any_line(source, e);
    constexpr double kEver = std::numeric_limits<double>::infinity();
    const double begin = source.below(2) == 0 ? 0 : -kEver;
    const auto found =
        intersect(tangency::verify::to_ellipsoid(e), {vec(origin), vec(direction)}, begin, kEver);
    const Vector120 from = from_centre(e, origin), along = digits(vec(direction));
    const auto truth = tangency::verify::line(e, from, along);
    const Digits120 speed = length(along), size = length(from) + longest(e), unit = kU * size;
    if (found.status == tangency::RayStatus::grazing) {
      ++grazing;
      const Digits120 room =
          Digits120(0x1p-90) * size / *std::min_element(e.semi_axes.begin(), e.semi_axes.end());
      near_miss.see(abs(truth.discriminant) / room, e, origin, direction);
    } else {
      // The truth's hits in the interval, but for those whose t rounds across its end.
      int least = 0, most = 0;
      for (const Digits120& t : truth.t) {
        if (!(truth.discriminant > 0)) break;
        const Digits120 slack = 0x1p-80 * size / speed;
        least += t >= begin + (begin == 0 ? slack : Digits120(0));
        most += t >= begin - (begin == 0 ? slack : Digits120(0));
      }
      wrong += found.count < least || found.count > most;
      hits += found.count > 0;
    }
    for (int k = 0; k < found.count; ++k) {
      const auto& [t, arm, normal] = found.points[k];
      on_surface.see(abs(nearest(e, digits(arm)).distance) / unit, e, origin, direction);
      const Vector120 rest = minus(digits(arm), from);
      const Digits120 there = dot(rest, along) / (speed * speed);
      const Vector120 foot = {there * along[0], there * along[1], there * along[2]};
      on_line.see(distance(rest, foot) / unit, e, origin, direction);
      if (found.status == tangency::RayStatus::grazing) continue;
      const Digits120 cosine = abs(dot(digits(normal), along)) / speed;
      const Digits120 nearer =
          std::min(Digits120(abs(t - truth.t[0])), Digits120(abs(t - truth.t[1])));
      const Digits120 error = nearer * speed;
      if (cosine < 0x1p-30) continue;
      time.see(error / unit, e, origin, direction);
      tight.see(error / (2 * kU * abs(t) * speed + 0x1p-80 * size / cosine), e, origin, direction);
    }
  }
  std::printf("rays, %ld inputs: %ld hit, %ld grazing, %ld wrong\n", count, hits, grazing, wrong);
  for (const Worst* w : {&on_surface, &on_line, &time}) w->print("u L");
  tight.print("of it");
  near_miss.print("of it");
  return wrong == 0 && on_surface.kept() && on_line.kept() && time.kept() && tight.error <= 1 &&
         near_miss.error <= 1 && hits > count / 4;
}

bool agree(std::uint64_t seed, long count) {
  Source source(seed);
  std::puts("largest errors seen");
  bool kept = true;
  for (const auto check : {check_points, check_spheres, check_walls, check_rays}) {
    kept = check(source, count) && kept;
    std::fflush(stdout);
  }
  return kept;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::testing::AgreementProgram program(
      "primitives_agreement", "Hold points, spheres, walls and rays against 120 digits");
  long count = 100'000;
  program.option("--count", count, "inputs of each");
  return program.run(argc, argv, [&](std::uint64_t seed) { return agree(seed, count); });
}
