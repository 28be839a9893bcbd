// SPDX-License-Identifier: GPL-3.0-or-later
// Holds rays against exact rational numbers: which hits lie in the interval, and how far hit points
// are from surface and line, of bodies as thin as doubles allow and of origins exactly on the
// surface. The merge gate runs a part of it; docs/testing.md names the whole.
#include <gmpxx.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <utility>

#include <tangency/geometry/ray.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/verify/oracles/primitives.hpp>

namespace {

using tangency::Ellipsoid, tangency::Ray, tangency::RayHit, tangency::RayStatus, tangency::Vec3;
using tangency::verify::Digits120;
using Rational3 = std::array<mpq_class, 3>;

constexpr double kU = tangency::kUnitRoundoff;
constexpr double kPromise = 8.0;  // u L
constexpr double kEver = std::numeric_limits<double>::infinity();

Digits120 digits(const mpq_class& q) {
  Digits120 x;
  mpfr_set_q(x.backend().data(), q.get_mpq_t(), MPFR_RNDN);
  return x;
}
mpq_class dot(const Rational3& a, const Rational3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Rational3 exactly(const Vec3& v) { return {mpq_class(v[0]), mpq_class(v[1]), mpq_class(v[2])}; }

/// A body's own frame, exactly: the rotation is that of the stored quaternion over its length.
class Frame {
 public:
  explicit Frame(const Ellipsoid& e) : axes_(exactly(e.semi_axes())) {
    const auto& q = e.orientation();
    const mpq_class w(q.w()), x(q.x()), y(q.y()), z(q.z());
    const mpq_class s = 2 / (w * w + x * x + y * y + z * z);
    columns_[0] = {1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)};
    columns_[1] = {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)};
    columns_[2] = {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)};
  }
  Rational3 to_body(const Rational3& v) const {
    return {dot(columns_[0], v), dot(columns_[1], v), dot(columns_[2], v)};
  }
  Rational3 over_axes(const Rational3& v) const {
    return {v[0] / axes_[0], v[1] / axes_[1], v[2] / axes_[2]};
  }

 private:
  Rational3 axes_;
  std::array<Rational3, 3> columns_;
};

/// A t^2 + 2 B t + C, the level along the line, and what follows from it.
struct Truth {
  mpq_class a, b, c, discriminant;

  Truth(const Ellipsoid& e, const Frame& frame, const Ray& ray) {
    Rational3 from = exactly(ray.origin);
    for (int i = 0; i < 3; ++i) from[static_cast<std::size_t>(i)] -= mpq_class(e.centre()[i]);
    const Rational3 z = frame.over_axes(frame.to_body(from));
    const Rational3 v = frame.over_axes(frame.to_body(exactly(ray.direction)));
    a = dot(v, v), b = dot(z, v), c = dot(z, z) - 1;
    discriminant = b * b - a * c;
  }
  int level(double t) const {
    const mpq_class x(t);
    return sgn(mpq_class((a * x + 2 * b) * x + c));
  }
  int slope(double t) const { return sgn(mpq_class(a * mpq_class(t) + b)); }
  /// Is the first (-1), the second (1) hit, or a touch (0), at or after t?
  bool at_or_after(double t, int side) const {
    if (std::isinf(t)) return t < 0;
    if (side == 0) return slope(t) <= 0;
    return side < 0 ? level(t) >= 0 && slope(t) < 0 : level(t) <= 0 || slope(t) < 0;
  }
  bool at_or_before(double t, int side) const {
    if (std::isinf(t)) return t > 0;
    if (side == 0) return slope(t) >= 0;
    return side < 0 ? level(t) <= 0 || slope(t) > 0 : level(t) >= 0 && slope(t) > 0;
  }
  int count(double begin, double end) const {
    const int sign = sgn(discriminant);
    const auto in = [&](int side) { return at_or_after(begin, side) && at_or_before(end, side); };
    return sign < 0 ? 0 : sign == 0 ? in(0) : in(-1) + in(1);
  }
  /// The hit's t.
  Digits120 time(int side) const {
    return (digits(-b) + side * sqrt(digits(discriminant))) / digits(a);
  }
};

/// How near the surface is proven to be, in 3^(1/2)/2 of what is returned at most: coordinates in
/// the body's frame that are shrunk, or stretched, by half of that put the point on its other side.
double distance_from_surface(const Ellipsoid& e, const Frame& frame, const Vec3& arm, double unit) {
  const Rational3 y = frame.to_body(exactly(arm));
  std::array<Digits120, 3> at;
  for (std::size_t i = 0; i < 3; ++i) at[i] = abs(digits(y[i]));
  const auto level = [&](double by) {
    Digits120 sum = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const Digits120 x = std::max(Digits120(0), Digits120(at[i] + by));
      const Digits120 w = x / e.semi_axes()[static_cast<int>(i)];
      sum += w * w;
    }
    return sum;
  };
  const bool outside = level(0) > 0;
  double low = 0, high = unit;
  while ((level(outside ? -high / 2 : high / 2) > 0) == outside) low = high, high *= 2;
  for (int i = 0; i < 6; ++i) {
    const double middle = (low + high) / 2;
    ((level(outside ? -middle / 2 : middle / 2) > 0) == outside ? low : high) = middle;
  }
  return high;
}

double distance_from_line(const Ellipsoid& e, const Ray& ray, const Vec3& arm) {
  Rational3 r = exactly(arm);
  const Rational3 d = exactly(ray.direction);
  for (int i = 0; i < 3; ++i) {
    r[static_cast<std::size_t>(i)] += mpq_class(e.centre()[i]) - mpq_class(ray.origin[i]);
  }
  const mpq_class along = dot(r, d), square = dot(d, d);
  return static_cast<double>(sqrt(abs(digits(dot(r, r) - along * along / square))));
}

struct Case {
  Ellipsoid body;
  Ray ray;
  double begin, end;
};

struct Tally {
  long rays = 0, hits = 0, grazing = 0, at_an_end = 0, wrong = 0;
  double surface = 0, line = 0, time = 0;  // u L, u L, 2u |t direction| + 2^-80 L / k
};

bool holds(const Case& c, Tally& tally) {
  const RayHit found = intersect(c.body, c.ray, c.begin, c.end);
  const Frame frame(c.body);
  const Truth truth(c.body, frame, c.ray);
  const int sign = sgn(truth.discriminant), count = truth.count(c.begin, c.end);
  ++tally.rays;
  tally.hits += count > 0, tally.grazing += count > 0 && sign == 0;
  for (const double t : {c.begin, c.end}) {
    tally.at_an_end += std::isfinite(t) && truth.level(t) == 0 && sign >= 0;
  }
  const RayStatus status = count == 0  ? RayStatus::miss
                           : sign == 0 ? RayStatus::grazing
                                       : RayStatus::hit;
  if (found.count != count || found.status != status) return false;
  const double size = (c.ray.origin - c.body.centre()).norm() + c.body.largest_semi_axis();
  const double speed = c.ray.direction.norm();
  bool kept = true;
  for (int k = 0; k < count; ++k) {
    const auto& [t, arm, normal] = found.points[k];
    kept = kept && c.begin <= t && t <= c.end;
    const double surface =
        distance_from_surface(c.body, frame, arm, 0x1p-10 * kU * size) / (kU * size);
    const double line = distance_from_line(c.body, c.ray, arm) / (kU * size);
    tally.surface = std::max(tally.surface, surface), tally.line = std::max(tally.line, line);
    const double cosine = std::abs(normal.dot(c.ray.direction)) / speed;
    if (sign > 0 && cosine > 0x1p-30) {
      const Digits120 error =
          std::min(abs(Digits120(t - truth.time(-1))), abs(Digits120(t - truth.time(1))));
      const Digits120 room = 2 * kU * std::abs(t) + 0x1p-80 * size / (cosine * speed);
      const double time = static_cast<double>(Digits120(error / room));
      tally.time = std::max(tally.time, time);
      kept = kept && time <= 1;
    }
    kept = kept && surface <= kPromise && line <= kPromise;
  }
  return kept;
}

/// Reproducible across standard libraries.
class Source {
 public:
  explicit Source(std::uint64_t seed) : random_(seed) {}

  Case next(int kind) {
    switch (kind) {
      case 0:
        return thin(1e16, 1e50);
      case 1:
        return thin(1e50, 1e300);
      case 2:
        return from_the_surface();
      case 3:
        return from_the_last_hit();
      default:
        return tangent();
    }
  }

 private:
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * kU);
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  double whole(int most) { return below(2 * most + 1) - most; }
  Vec3 direction() {
    for (;;) {
      Vec3 v(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      if (below(6) == 0) v[below(3)] = 0;
      if (v.norm() > 1e-3) return v;
    }
  }
  Eigen::Quaterniond orientation() {
    if (below(4) == 0) return Eigen::Quaterniond(1, 0, 0, 0);
    return {uniform(0.1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
  }
  Ellipsoid body(double least, double most) {
    const double aspect = log_uniform(least, most), size = log_uniform(0.1, 10);
    Vec3 a(size, size * log_uniform(1 / aspect, 1), size / aspect);
    if (below(4) == 0) a[1] = a[2 * below(2)];
    std::swap(a[2], a[below(3)]);
    const Vec3 centre = below(2) == 0 ? Vec3(Vec3::Zero()) : direction();
    return {centre, a, orientation()};
  }
  /// With a point to go through that is in the solid, and now and then a direction along a face.
  Case thin(double least, double most) {
    const Ellipsoid e = body(least, most);
    Vec3 through = uniform(0, 1.1) * e.support_point(direction().normalized()), along = direction();
    if (below(3) == 0) {
      through = through.cwiseProduct(direction());
    }
    if (below(3) == 0) {
      // Nearly in the plane of the two longer axes.
      Vec3 y = e.rotation().transpose() * along;
      int thinnest = 0;
      e.semi_axes().minCoeff(&thinnest);
      y[thinnest] *= log_uniform(1e-40, 1);
      along = e.rotation() * y;
    }
    const double back = below(4) == 0 ? 0 : log_uniform(1e-3, below(4) == 0 ? 1e10 : 10);
    return interval({e, {e.centre() + through - back * along, along}, 0, kEver});
  }
  Case interval(Case c) {
    if (below(2) == 0) c.begin = -kEver;
    if (below(4) == 0) c.end = std::max(c.begin, uniform(-1, 5));
    return c;
  }

  /// Semi-axes N f_i H, a quaternion of whole numbers with square N, and the point that R takes
  /// from N f_i W_i, W^2 = H^2: all whole numbers times powers of two.
  Case from_the_surface() {
    static constexpr int kTuples[][4] = {{1, 0, 0, 1}, {3, 4, 0, 5}, {5, 12, 0, 13}, {1, 2, 2, 3},
                                         {2, 3, 6, 7}, {1, 4, 8, 9}, {4, 4, 7, 9},   {2, 6, 9, 11}};
    const auto& tuple = kTuples[below(8)];
    double q[4] = {};
    while (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] == 0) {
      for (double& x : q) x = below(2) == 0 ? 0 : whole(5);
    }
    const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
    const double square = turn.squaredNorm();
    Vec3 scale, point, gradient;
    const int spread = below(3) == 0 ? 20 : 3;
    for (int i = 0; i < 3; ++i) {
      const double w = tuple[i] * (below(2) == 0 ? 1 : -1);
      scale[i] = std::exp2(below(spread) + 1);
      point[i] = w * scale[i], gradient[i] = w * std::exp2(21) / scale[i];
    }
    const int first = below(3), second = below(3);
    for (Vec3* v : {&scale, &point, &gradient}) std::swap((*v)[first], (*v)[second]);
    const Vec3 centre(whole(100), whole(100), whole(100));
    const Ellipsoid e(centre, square * tuple[3] * scale, turn);
    const auto turned = [&](const Vec3& v) -> Vec3 {  // |q|^2 R v, exactly
      const Vec3 u(q[1], q[2], q[3]);
      return (q[0] * q[0] - u.dot(u)) * v + 2 * u.dot(v) * u + 2 * q[0] * u.cross(v);
    };
    const Vec3 x = turned(point), g = turned(gradient);
    Vec3 along = Vec3(whole(9), whole(9), whole(9));
    if (below(4) == 0) along = x * (below(2) == 0 ? 1 : -1);
    if (below(4) == 0) along = g.cross(along);
    if (below(4) == 0) along = direction();
    if (along == Vec3::Zero()) along = Vec3(1, 0, 0);
    // On the surface at t = steps.
    const double steps = below(2) == 0 ? 0 : whole(8);
    Case c{e, {centre + x - steps * along, along}, steps, kEver};
    if (below(4) == 0) c.begin = -kEver, c.end = steps;
    if (below(8) == 0) c.end = steps + uniform(0, 4);
    const double unit = std::exp2(below(2) == 0 ? 0 : below(400) - 200);
    c.body = Ellipsoid(unit * e.centre(), unit * e.semi_axes(), turn);
    c.ray.origin *= unit, c.ray.direction *= unit;
    return c;
  }

  Case from_the_last_hit() {
    const Ellipsoid e = body(1, below(4) == 0 ? 1e8 : 10);
    const Vec3 along = direction(), to = e.centre() + 0.9 * e.support_point(direction());
    const RayHit hit = intersect(e, {to - 3 * along, along});
    if (hit.count == 0) return {e, {to, along}, 0, kEver};
    const auto& [t, arm, normal] = hit.points[below(hit.count)];
    Vec3 on = along;
    if (below(3) == 0) on = -along;
    if (below(3) == 0) on = along - 2 * along.dot(normal) * normal;
    if (below(3) == 0) on = along - along.dot(normal) * normal;
    if (on == Vec3::Zero()) on = along;
    if (below(3) == 0) return {e, {to - 3 * along, along}, t, kEver};
    return {e, {e.centre() + arm, on}, 0, kEver};
  }

  /// Within 1e-25 to 1e-10 of the size of a tangent, now and then of thin bodies.
  Case tangent() {
    const Ellipsoid e = body(1, below(4) == 0 ? 1e30 : 100);
    const Vec3 n = direction().normalized();
    Vec3 along = direction();
    along -= along.dot(n) * n;
    if (along.norm() < 1e-3) along = n;
    const double off = (below(2) == 0 ? 1 : -1) * log_uniform(1e-25, 1e-10);
    const Vec3 through = e.centre() + e.support_point(n) + off * e.largest_semi_axis() * n;
    return interval({e, {through - uniform(0, 3) * along, along}, 0, kEver});
  }

  std::mt19937_64 random_;
};

constexpr const char* kKinds[] = {"aspect 1e16 to 1e50", "aspect 1e50 to 1e300",
                                  "from the surface, exactly", "from the last hit",
                                  "near a tangent"};

void print_row(const Case& c) {
  std::printf("  broken: ");
  const auto& q = c.body.orientation();
  for (const Vec3& v : {c.body.centre(), c.body.semi_axes(), Vec3(q.w(), q.x(), q.y())}) {
    std::printf("%a,%a,%a,", v[0], v[1], v[2]);
  }
  std::printf("%a,", q.z());
  for (const Vec3& v : {c.ray.origin, c.ray.direction}) std::printf("%a,%a,%a,", v[0], v[1], v[2]);
  std::printf("%a,%a\n", c.begin, c.end);
}

bool agree(std::uint64_t seed, long count) {
  std::printf("%-26s %8s %8s %8s %9s %6s %14s %11s %12s\n", "kind", "rays", "hits", "grazing",
              "at an end", "wrong", "surface, in uL", "line, in uL", "t, of room");
  bool kept = true;
  for (int kind = 0; kind < 5; ++kind) {
    Source source(seed + static_cast<std::uint64_t>(kind));
    Tally t;
    for (long i = 0; i < count / 5; ++i) {
      const Case c = source.next(kind);
      if (holds(c, t)) continue;
      if (++t.wrong <= 5) print_row(c);
    }
    std::printf("%-26s %8ld %8ld %8ld %9ld %6ld %14.3g %11.3g %12.3g\n", kKinds[kind], t.rays,
                t.hits, t.grazing, t.at_an_end, t.wrong, t.surface, t.line, t.time);
    std::fflush(stdout);
    kept = kept && t.wrong == 0 && t.hits > t.rays / 10;
  }
  return kept;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::testing::AgreementProgram program("ray_agreement",
                                              "Hold rays against exact rational numbers");
  long count = 2'500'000;
  program.option("--count", count, "rays in all");
  return program.run(argc, argv, [&](std::uint64_t seed) { return agree(seed, count); });
}
