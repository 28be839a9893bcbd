// SPDX-License-Identifier: GPL-3.0-or-later
// Holds the questions of single bodies, in every form of a body, against exact rational numbers and
// 120 digits: ellipses and points, walls, rays and points of bodies by matrices, and when spheres
// by matrices meet; and bodies inside bodies (containment_questions.cpp). The merge gate runs a
// part of it; docs/testing.md names the whole.
#include <gmpxx.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/closest_point.hpp>
#include <tangency/geometry/ellipse_closest_point.hpp>
#include <tangency/geometry/primitives.hpp>
#include <tangency/geometry/ray.hpp>
#include <tangency/geometry/time_of_contact.hpp>
#include <tangency/tests/verify/agreement.hpp>
#include <tangency/tests/verify/questions.hpp>
#include <tangency/verify/oracles/primitives.hpp>

namespace {

using namespace tangency;
using questions::share_of;
using questions::Source;
using questions::Tally;
using verify::Digits120;
using Rational3 = std::array<mpq_class, 3>;
using RationalMatrix = std::array<Rational3, 3>;

Digits120 digits(const mpq_class& q) {
  Digits120 x;
  mpfr_set_q(x.backend().data(), q.get_mpq_t(), MPFR_RNDN);
  return x;
}
mpq_class dot(const Rational3& a, const Rational3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Rational3 exactly(const Vec3& v) { return {mpq_class(v[0]), mpq_class(v[1]), mpq_class(v[2])}; }
RationalMatrix exactly(const Mat3& m) {
  return {exactly(Vec3(m.row(0))), exactly(Vec3(m.row(1))), exactly(Vec3(m.row(2)))};
}
Rational3 times(const RationalMatrix& m, const Rational3& v) {
  return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}
Rational3 minus(const Rational3& a, const Rational3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// ---- an ellipse and a point

bool check_ellipses(Source& source, long count) {
  Tally tally{"ellipse and point"};
  for (long i = 0; i < count; ++i) {
    const double aspect = source.log_uniform(1, source.below(4) == 0 ? 1e30 : 1e8);
    const double size =
        source.below(8) == 0 ? source.log_uniform(1e-150, 1e150) : source.log_uniform(0.1, 10);
    std::array<double, 2> axes{size, source.below(8) == 0 ? size : size / aspect};
    if (source.below(8) == 0) axes[1] = std::nextafter(size, 0.0);
    if (source.below(2) == 0) std::swap(axes[0], axes[1]);
    const double away = source.below(8) == 0 ? 1e12 : source.below(4) == 0 ? 0 : 1;
    const std::array<double, 2> centre{away * size * source.uniform(-1, 1),
                                       away * size * source.uniform(-1, 1)};
    std::array<double, 2> u{source.uniform(-1, 1), source.uniform(-1, 1)};
    if (source.below(3) == 0)
      u = source.below(2) == 0 ? std::array{1.0, 0.0} : std::array{0.0, -3.0};
    const Ellipse e(Vec2(centre[0], centre[1]), Vec2(axes[0], axes[1]), Vec2(u[0], u[1]));
    const double angle = source.uniform(-4, 4);
    Vec2 p = e.support_point(Vec2(std::cos(angle), std::sin(angle)));
    const int kind = source.below(7);
    if (kind == 0) p *= source.uniform(0, 1);
    if (kind == 1) p *= 1 + source.log_uniform(1e-16, 1e-3) * (source.below(2) == 0 ? 1 : -1);
    if (kind == 2) p += source.log_uniform(1e-12, 1e6) * size * Vec2(source.uniform(-1, 1), 1);
    if (kind == 3) p = source.uniform(-1, 1) * e.semi_axes()[0] * e.axis();
    if (kind == 4) p = source.uniform(-1, 1) * e.semi_axes()[1] * Vec2(-e.axis()[1], e.axis()[0]);
    if (kind == 5) p = Vec2::Zero();
    p += e.centre();
    const PlaneClosestPoint found = closest_point(e, p);
    const Digits120 truth = verify::plane_distance({centre, axes, u}, {p[0], p[1]});
    tally.special += found.distance < 0.0;
    // The point itself: on the ellipse, and as far away as is said, to 8 u L.
    const double length = (p - e.centre()).norm() + size;
    const Vec2 rest = p - e.centre() - found.arm - found.distance * found.normal;
    const Digits120 off = verify::plane_distance({{0, 0}, axes, u}, {found.arm[0], found.arm[1]});
    const double u_length = 8 * kUnitRoundoff * length;
    tally.see(rest.norm() <= u_length && abs(off) <= u_length,
              share_of(found.distance - truth, found.distance_error));
  }
  return tally.print("inside", count / 10);
}

// ---- a wall

struct Wall {
  MatrixEllipsoid body;
  RationalMatrix shape;
  Plane plane;
};

/// M = A A' of whole numbers, with a row of A whose length is a whole number: planes along a
/// coordinate plane touch exactly; and any matrix with planes near its body.
Wall wall(Source& source) {
  if (source.below(2) == 0) {
    static constexpr std::array<std::array<int, 4>, 4> kWhole{
        {{3, 4, 0, 5}, {1, 2, 2, 3}, {2, 3, 6, 7}, {1, 4, 8, 9}}};
    const auto& row = kWhole[static_cast<std::size_t>(source.below(4))];
    for (;;) {
      Mat3 a;
      a << source.wholes(9).transpose(), source.wholes(9).transpose(), row[0], row[1], row[2];
      if (std::abs(a.determinant()) < 0.5) continue;
      const int turn = source.below(3);
      Mat3 turned;
      for (int i = 0; i < 3; ++i) turned.row(i) = a.row((i + turn) % 3);
      const Vec3 centre = source.wholes(20);
      const int last = (2 - turn + 3) % 3, side = source.below(2) == 0 ? 1 : -1;
      const double scale = std::ldexp(1.0, source.whole(3));
      const Vec3 normal = side * scale * Vec3::Unit(last);
      const double nudge = source.below(2) == 0 ? 0.0 : source.whole(2);
      const double reach = source.below(2) == 0 ? row[3] : -row[3];
      const Mat3 shape = turned * turned.transpose();
      return {MatrixEllipsoid::from_shape(centre, shape),
              exactly(shape),
              {normal, normal.dot(centre) + scale * (reach + nudge)}};
    }
  }
  const double size = source.below(8) == 0 ? source.log_uniform(1e-100, 1e100) : 1.0;
  const Mat3 shape = *source.definite(size * size);
  const Vec3 centre = source.below(3) == 0
                          ? Vec3(Vec3::Zero())
                          : Vec3(size * source.log_uniform(0.1, 1e6) * source.direction());
  const Vec3 normal = source.log_uniform(1e-50, 1e50) * source.direction();
  const double reach = std::sqrt(normal.dot(shape * normal));
  const double by = source.below(2) == 0
                        ? source.uniform(-2, 2)
                        : (source.below(2) == 0 ? 1 : -1) *
                              (1 + source.log_uniform(1e-17, 1e-10) * source.whole(1));
  return {MatrixEllipsoid::from_shape(centre, shape),
          exactly(shape),
          {normal, normal.dot(centre) + by * reach}};
}

bool check_walls(Source& source, long count) {
  Tally tally{"wall"};
  for (long i = 0; i < count; ++i) {
    const auto [body, shape, plane] = wall(source);
    const Rational3 n = exactly(plane.normal);
    const mpq_class square = dot(n, times(shape, n));
    // The centre as it was given is that of the nearest body: a double each.
    const mpq_class height = dot(n, exactly(body.ellipsoid().centre())) - mpq_class(plane.offset);
    const int side = sgn(height), outside = sgn(mpq_class(height * height - square));
    const Relation solid = outside < 0 ? Relation::overlap
                           : outside == 0
                               ? (side < 0 ? Relation::internal_touch : Relation::external_touch)
                               : (side < 0 ? Relation::a_in_b : Relation::separate);
    const Relation sheet = outside < 0    ? Relation::overlap
                           : outside == 0 ? Relation::external_touch
                                          : Relation::separate;
    const Digits120 length = sqrt(digits(dot(n, n))), reach = sqrt(digits(square));
    const Digits120 gap = (digits(height) - reach) / length;
    const Digits120 of_sheet = (abs(digits(height)) - reach) / length;
    const Sheet thin{plane.normal, plane.offset};
    const RelationAnswer found = relation(body, plane);
    const WallGap to_wall = signed_gap(body, plane), to_sheet = signed_gap(body, thin);
    const auto sign = [](double x) { return (x > 0) - (x < 0); };
    const int true_sign = solid == Relation::separate         ? 1
                          : solid == Relation::external_touch ? 0
                                                              : -1;
    const bool kept = found.relation == solid && relation(body, thin).relation == sheet &&
                      (found.inner == Inner::a) == (solid == Relation::internal_touch) &&
                      sign(to_wall.gap) == true_sign && sign(to_sheet.gap) == outside;
    tally.special += outside == 0;
    tally.see(kept, std::max(share_of(to_wall.gap - gap, to_wall.gap_error),
                             share_of(to_sheet.gap - of_sheet, to_sheet.gap_error)));
  }
  return tally.print("touches", count / 20);
}

// ---- a ray

struct RayCase {
  Mat3 precision;
  double level;
  Vec3 centre;
  Ray ray;
};

/// P = B' B of whole numbers, and lines that touch at a whole t, or near one; and any matrix.
RayCase ray_case(Source& source) {
  if (source.below(2) == 0) {
    for (;;) {
      Mat3 b;
      b << source.wholes(5), source.wholes(5), source.wholes(5);
      if (std::abs(b.determinant()) < 0.5) continue;
      const Mat3 p = b.transpose() * b;
      const Vec3 d = source.wholes(4), w = (p * d).cross(source.wholes(3));
      if (w == Vec3::Zero()) continue;
      const Vec3 centre = source.wholes(9);
      const double level = w.dot(p * w) + (source.below(3) == 0 ? source.whole(1) : 0);
      if (!(level > 0)) continue;
      return {p, level, centre, {centre + w - source.whole(3) * d, d}};
    }
  }
  const Mat3 p = *source.definite(1.0);
  const Vec3 centre = source.below(2) == 0 ? Vec3(Vec3::Zero()) : Vec3(10 * source.direction());
  const double size = 1 / std::sqrt(p.trace());
  return {p,
          source.log_uniform(0.1, 10),
          centre,
          {centre + source.log_uniform(0.1, 1e6) * size * source.direction(),
           source.log_uniform(1e-20, 1e20) * source.direction()}};
}

bool check_rays(Source& source, long count) {
  Tally tally{"ray"};
  for (long i = 0; i < count; ++i) {
    auto [precision, level, centre, ray] = ray_case(source);
    // Aimed at the body more often than not.
    if (source.below(3) == 0 && i % 2 == 0) ray.direction = centre - ray.origin;
    if (ray.direction == Vec3::Zero()) continue;
    const RationalMatrix p = exactly(precision);
    const Rational3 from = minus(exactly(ray.origin), exactly(centre)), d = exactly(ray.direction);
    const mpq_class a = dot(d, times(p, d)), b = dot(d, times(p, from));
    const mpq_class c = dot(from, times(p, from)) - mpq_class(level), disc = b * b - a * c;
    const RayHit found = intersect(MatrixEllipsoid::from_precision(centre, precision, level), ray);
    // Of the roots (-b -+ sqrt(disc)) / a those at or after 0: by the signs of c and b.
    const int before = sgn(disc) < 0 ? 2 : sgn(c) < 0 ? 1 : sgn(b) <= 0 || sgn(c) == 0 ? 0 : 2;
    int hits = sgn(disc) < 0 ? 0 : sgn(disc) == 0 ? (sgn(b) <= 0) : 2 - before;
    if (sgn(disc) > 0 && sgn(c) == 0) hits = sgn(b) > 0 ? 1 : 2;
    const RayStatus status = hits == 0        ? RayStatus::miss
                             : sgn(disc) == 0 ? RayStatus::grazing
                                              : RayStatus::hit;
    double share = 0.0;
    if (found.count == hits) {
      for (int k = 0; k < hits; ++k) {
        const int side = sgn(disc) == 0 ? 0 : k == hits - 1 ? 1 : -1;
        const Digits120 t = (digits(-b) + side * sqrt(digits(disc))) / digits(a);
        // Exact but for one rounding of t, and 2^-100 of how far away the body is.
        const double reach =
            std::abs(static_cast<double>(digits(-b / a))) + std::abs(found.points[k].t);
        share = std::max(share,
                         share_of(found.points[k].t - t,
                                  kUnitRoundoff * std::abs(found.points[k].t) + 0x1p-90 * reach));
      }
    }
    tally.special += sgn(disc) == 0;
    tally.see(found.count == hits && found.status == status, share);
  }
  return tally.print("tangents", count / 20);
}

// ---- a point and a body by a matrix

/// Signed distance of y from x' P x = level, by bisection of t in x = (I + t P)^-1 y.
std::optional<Digits120> distance(const RationalMatrix& p, double level, const Rational3& from) {
  using Row = std::array<Digits120, 3>;
  std::array<Row, 3> m;
  Row y;
  for (std::size_t i = 0; i < 3; ++i) {
    y[i] = digits(from[i]);
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = digits(p[i][j]);
  }
  const Digits120 trace = m[0][0] + m[1][1] + m[2][2];
  Row x{};
  // Is t below the root: I + t P not definite, or the level of x above the body's?
  const auto below = [&](const Digits120& t) {
    std::array<Row, 3> k;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) k[i][j] = t * m[i][j] + (i == j ? 1 : 0);
    }
    const auto minor = [&](std::size_t i, std::size_t j) {
      const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      return Digits120(k[a][c] * k[b][d] - k[a][d] * k[b][c]);
    };
    const Digits120 det = k[0][0] * minor(0, 0) + k[0][1] * minor(0, 1) + k[0][2] * minor(0, 2);
    if (!(k[0][0] > 0) || !(minor(2, 2) > 0) || !(det > 0)) return true;
    Digits120 found = 0;
    for (std::size_t i = 0; i < 3; ++i)
      x[i] = (minor(0, i) * y[0] + minor(1, i) * y[1] + minor(2, i) * y[2]) / det;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) found += x[i] * m[i][j] * x[j];
    }
    return found > level;
  };
  const bool outside = below(Digits120(0));
  Digits120 low = outside ? Digits120(0) : Digits120(-3 / trace), high = 0;
  if (outside) {
    for (high = 1 / trace; below(high);) high *= 16;
  }
  constexpr int kHalvings = 250;
  for (int i = 0; i < kHalvings; ++i) {
    const Digits120 middle = (low + high) / 2;
    (below(middle) ? low : high) = middle;
  }
  below(high);
  Digits120 square = 0, reached = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    square += (y[i] - x[i]) * (y[i] - x[i]);
    for (std::size_t j = 0; j < 3; ++j) reached += x[i] * m[i][j] * x[j];
  }
  // On the focal set no t reaches the level.
  if (abs(reached - level) > Digits120(1e-40) * level) return std::nullopt;
  return outside ? Digits120(sqrt(square)) : Digits120(-sqrt(square));
}

bool check_points(Source& source, long count) {
  Tally tally{"point and precision matrix"};
  for (long i = 0; i < count; ++i) {
    const double unit = source.below(8) == 0 ? source.log_uniform(1e-50, 1e50) : 1.0;
    const Mat3 precision = *source.definite(1 / (unit * unit));
    const double level = source.below(2) == 0 ? 1.0 : source.log_uniform(0.1, 10);
    const Vec3 centre =
        source.below(2) == 0 ? Vec3(Vec3::Zero()) : Vec3(5 * unit * source.direction());
    const MatrixEllipsoid body = MatrixEllipsoid::from_precision(centre, precision, level);
    const Vec3 surface = body.ellipsoid().support_point(source.direction());
    const double by = source.below(3) == 0   ? 1.0
                      : source.below(2) == 0 ? source.uniform(0, 2)
                                             : source.log_uniform(1, 1e3);
    const Vec3 point = centre + by * surface;
    const auto truth = distance(exactly(precision), level, minus(exactly(point), exactly(centre)));
    if (!truth) continue;
    const ClosestPoint found = closest_point(body, point);
    tally.special += found.distance < 0.0;
    tally.see(true, share_of(found.distance - *truth, found.distance_error));
  }
  return tally.print("inside", count / 20);
}

// ---- spheres by matrices that fly

bool check_times(Source& source, long count) {
  Tally tally{"spheres by matrices, in time"};
  for (long i = 0; i < count; ++i) {
    const double ma = source.log_uniform(0.01, 10), mb = source.log_uniform(0.01, 10);
    const auto ball = [](const Vec3& centre, double square) {
      return MatrixEllipsoid::from_shape(centre, square * Mat3::Identity());
    };
    const Vec3 d = source.uniform(1, 20) * source.direction();
    const Vec3 v =
        source.log_uniform(0.1, 10) * (-d.normalized() + source.uniform(0, 1) * source.direction());
    const double horizon = 20, tolerance = source.log_uniform(1e-12, 1e-3);
    const Vec3 spin = source.uniform(0, 5) * source.direction();
    const TimeOfContact found = time_of_contact(ball(Vec3::Zero(), ma), Motion{Vec3::Zero(), spin},
                                                ball(d, mb), Motion{v, -spin}, horizon, tolerance);
    const Rational3 from = exactly(d), way = exactly(v);
    const Digits120 reach = sqrt(Digits120(ma)) + sqrt(Digits120(mb));
    const Digits120 a = digits(dot(way, way)), b = digits(dot(from, way));
    const Digits120 c = digits(dot(from, from)) - reach * reach, disc = b * b - a * c;
    const bool meets = c > 0 && disc >= 0 && b < 0;
    const Digits120 first = meets ? Digits120((-b - sqrt(disc)) / a) : Digits120(-1);
    bool kept = false;
    switch (found.status) {
      case ContactTimeStatus::touching_at_start:
        kept = c <= 0;
        break;
      case ContactTimeStatus::none:
        kept = c > 0 && !(meets && first <= horizon);
        break;
      case ContactTimeStatus::contact:
        // `latest` is of smaller balls, whose own search ends up to a tolerance after the first.
        kept = meets && found.time <= first && first <= found.latest &&
               found.latest - found.time <= 1e-12 + 2.0 * tolerance;
        break;
      case ContactTimeStatus::grazing:
        kept = c > 0 && (!meets || found.time <= first);
        break;
      case ContactTimeStatus::not_converged:
        break;
    }
    tally.special += found.status == ContactTimeStatus::contact;
    tally.see(kept, 0.0);
  }
  return tally.print("contacts", count / 8);
}

struct Kind {
  const char* name;
  bool (*check)(Source&, long);
};
constexpr std::array<Kind, 9> kKinds{{{"ellipses", check_ellipses},
                                      {"walls", check_walls},
                                      {"rays", check_rays},
                                      {"points", check_points},
                                      {"times", check_times},
                                      {"clearances", questions::check_clearances},
                                      {"margins", questions::check_margins},
                                      {"plane-clearances", questions::check_plane_clearances},
                                      {"plane-margins", questions::check_plane_margins}}};

bool agree(std::uint64_t seed, long count, const std::string& only) {
  bool kept = true;
  for (const auto& [name, check] : kKinds) {
    if (!only.empty() && only != name) continue;
    Source source(seed);
    kept = check(source, count) && kept;
    std::fflush(stdout);
  }
  return kept;
}

std::vector<std::string> kinds() {
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  return names;
}

}  // namespace

int main(int argc, char** argv) {
  tangency::testing::AgreementProgram program(
      "question_agreement",
      "Hold points, walls, rays and moments, of bodies in every form, and bodies inside bodies "
      "against exact numbers");
  long count = 100'000;
  std::string only;
  program.option("--count", count, "inputs of each");
  program.option("--only", only, "one kind; else all").one_of(kinds());
  return program.run(argc, argv, [&](std::uint64_t seed) { return agree(seed, count, only); });
}
