// SPDX-License-Identifier: GPL-3.0-or-later
//
// Families of an ellipsoid and a point, a wall or a ray.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <tangency/verify/families/exact_contact.hpp>
#include <tangency/verify/families/families.hpp>
#include <tangency/verify/families/placing.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::inline v0::verify {
namespace {

using Triple = std::array<double, 3>;

Triple rounded3(const Real3& v) { return {rounded(v[0]), rounded(v[1]), rounded(v[2])}; }

RawEllipsoid any_body(Draw& draw, double aspect, double scale = 1) {
  const double size = draw.log_uniform(0.3, 3) * scale, ratio = draw.log_uniform(1, aspect);
  RawEllipsoid body = turned_body(draw, triaxial_axes(draw, size, ratio));
  for (double& v : body.centre) v = draw.real(-1, 1) * scale;
  return body;
}

// One long axis, or one short one.
RawEllipsoid needle_or_disc(Draw& draw, double aspect) {
  std::array<double, 3> axes{1, draw.coin() ? 1 : aspect, aspect};
  draw.shuffle(axes);
  RawEllipsoid body = turned_body(draw, axes);
  for (double& v : body.centre) v = draw.real(-1, 1);
  return body;
}

// A spheroid or a sphere.
RawEllipsoid round_body(Draw& draw) {
  std::array<double, 3> axes{1, 1, draw.integer(0, 2) == 0 ? 1 : draw.log_uniform(0.1, 10)};
  draw.shuffle(axes);
  RawEllipsoid body = turned_body(draw, axes);
  for (double& v : body.centre) v = draw.real(-1, 1);
  return body;
}

Shape<Real> shape_of(const RawEllipsoid& body) { return separation(real(body), real(body)).a; }

// centre + share x(n) + height n, x(n) the point of the surface with the outer normal n.
Triple at_normal(const RawEllipsoid& body, const Real3& n, const Real& height,
                 const Real& share = 1) {
  const Real3 arm = ascent::combined(
      ascent::scaled(share, ascent::support_point(shape_of(body), n)), height, n, Real(0), n);
  Triple p;
  for (std::size_t i = 0; i < 3; ++i) p[i] = rounded(Real(body.centre[i]) + arm[i]);
  return p;
}

// Whole numbers: a body whose surface goes through centre + x with the normal n.
struct WholeSurface {
  RawEllipsoid body;
  construction::Vector x, n;
};

WholeSurface whole_surface(Draw& draw) {
  const construction::Quaternion q = construction::small_quaternion(draw);
  const auto [u, radius] = construction::sphere_point(draw);
  const construction::Vector axes = construction::small_axes(draw, 6);
  const auto& [a1, a2, a3] = axes;
  const mpz_class unit = construction::norm(q) * radius;
  construction::ExactBody body{construction::small_vector(draw, 100), {}, q};
  construction::Vector along;
  for (std::size_t k = 0; k < 3; ++k) body.axes[k] = axes[k] * unit, along[k] = axes[k] * u[k];
  return {*construction::raw(body), construction::turned(q, along),
          construction::turned(q, {u[0] * a2 * a3, u[1] * a3 * a1, u[2] * a1 * a2})};
}

double whole(const mpz_class& v) { return v.get_d(); }
Triple whole(const construction::Vector& v) { return {whole(v[0]), whole(v[1]), whole(v[2])}; }

Triple plus(const Triple& a, const Triple& b, double times = 1) {
  return {a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]};
}

// ---- points

BodyAndPoint outside(Draw& draw) {
  const RawEllipsoid body = any_body(draw, 100);
  const double height = draw.log_uniform(1e-6, 1e3);
  return {body, at_normal(body, drawn_direction(draw), height)};
}

BodyAndPoint inside(Draw& draw) {
  const RawEllipsoid body = any_body(draw, 100);
  const double share = draw.real(0, 1);
  return {body, at_normal(body, drawn_direction(draw), 0, share)};
}

BodyAndPoint near_surface(Draw& draw) {
  const RawEllipsoid body = any_body(draw, 10);
  const double height = draw.log_uniform(1e-17, 1e-3), side = draw.coin() ? 1 : -1;
  return {body, at_normal(body, drawn_direction(draw), side * height)};
}

BodyAndPoint on_surface(Draw& draw) {
  const WholeSurface s = whole_surface(draw);
  return {s.body, plus(s.body.centre, whole(s.x))};
}

// In the plane of the two longer axes, within the curve that ends where the closest points part:
// a whole number of units of the rotation's denominator, so exactly there.
BodyAndPoint on_medial_set(Draw& draw) {
  const construction::Quaternion q = construction::small_quaternion(draw);
  const int norm = construction::norm(q);
  construction::ExactBody exact{construction::small_vector(draw, 20), {}, q};
  std::array<int, 3> axes{draw.integer(1, 4) * 16, draw.integer(5, 8) * 16,
                          draw.integer(5, 12) * 16};
  if (draw.integer(0, 3) == 0) axes[1] = axes[0];
  if (draw.integer(0, 5) == 0) axes = {axes[0], axes[0], axes[0]};
  construction::Vector place;
  for (std::size_t k = 0; k < 3; ++k) {
    exact.axes[k] = axes[k] * norm;
    // Half of the way to the end of the focal set, a - b^2 / a.
    const int room = (axes[k] * axes[k] - axes[0] * axes[0]) / (2 * axes[k]);
    place[k] = draw.integer(-room, room);
  }
  const construction::Vector x = construction::turned(q, place);
  const RawEllipsoid body = *construction::raw(exact);
  return {body, plus(body.centre, whole(x))};
}

// The same plane, 1e-3 to 1e-12 of the shortest axis beside it.
BodyAndPoint near_medial_set(Draw& draw) {
  RawEllipsoid body = any_body(draw, 10);
  const Shape<Real> shape = shape_of(body);
  const auto least =
      static_cast<std::size_t>(std::ranges::min_element(body.semi_axes) - body.semi_axes.begin());
  const double off = draw.log_uniform(1e-12, 1e-3) * body.semi_axes[least];
  const double side = draw.coin() ? off : -off;
  Real3 arm = ascent::scaled(Real(side), shape.axes[least]);
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == least) continue;
    const double a = body.semi_axes[k], b = body.semi_axes[least];
    const Real along = draw.real(-0.6, 0.6) * (a - b) * (a + b) / a;
    arm = ascent::combined(arm, along, shape.axes[k], Real(0), shape.axes[k]);
  }
  for (std::size_t i = 0; i < 3; ++i) arm[i] += body.centre[i];
  return {body, rounded3(arm)};
}

BodyAndPoint of_round_body(Draw& draw) {
  const RawEllipsoid body = round_body(draw);
  if (draw.integer(0, 5) == 0) return {body, body.centre};
  const double share = draw.real(0.1, 2);
  return {body, at_normal(body, drawn_direction(draw), 0, share)};
}

BodyAndPoint of_needle_or_disc(Draw& draw) {
  const RawEllipsoid body = needle_or_disc(draw, draw.log_uniform(1e2, 1e6));
  const double height = draw.log_uniform(1e-6, 1e3), share = draw.real(0, 1);
  if (draw.coin()) return {body, at_normal(body, drawn_direction(draw), 0, share)};
  return {body, at_normal(body, drawn_direction(draw), height)};
}

BodyAndPoint far_point(Draw& draw) {
  const RawEllipsoid body = any_body(draw, 100);
  const double height = draw.log_uniform(1e4, 1e12);
  return {body, at_normal(body, drawn_direction(draw), height)};
}

BodyAndPoint scaled_point(Draw& draw) {
  const double scale = std::ldexp(1.0, draw.coin() ? 450 : -450);
  const RawEllipsoid body = any_body(draw, 100, scale);
  const double height = draw.log_uniform(1e-3, 10) * scale, share = draw.real(0, 1);
  if (draw.coin()) return {body, at_normal(body, drawn_direction(draw), 0, share)};
  return {body, at_normal(body, drawn_direction(draw), height)};
}

// ---- walls

// A wall against the surface at the normal -n, moved by `gap`.
BodyAndWall against(Draw& draw, const RawEllipsoid& body, double gap) {
  const Real3 n = drawn_direction(draw);
  const double length = draw.log_uniform(1e-3, 1e3);
  const Triple normal = rounded3(ascent::scaled(Real(length), n));
  const Real3 exact{normal[0], normal[1], normal[2]};
  const Real3 foot = ascent::support_point(shape_of(body), ascent::normalised(exact));
  Real offset = 0;
  for (std::size_t i = 0; i < 3; ++i) offset += exact[i] * (Real(body.centre[i]) - foot[i]);
  return {body, normal, rounded(offset - gap * sqrt(ascent::dot(exact, exact)))};
}

BodyAndWall any_wall(Draw& draw) {
  const RawEllipsoid body = any_body(draw, 100);
  const double gap = draw.real(-3, 1) * most_axis(body);
  return against(draw, body, gap);
}

BodyAndWall near_wall(Draw& draw) {
  const RawEllipsoid body = any_body(draw, 10);
  const double gap = draw.log_uniform(1e-17, 1e-3);
  return against(draw, body, draw.coin() ? gap : -gap);
}

// From outside, from inside, and a unit of the last place beside both.
BodyAndWall touching_wall(Draw& draw) {
  const WholeSurface s = whole_surface(draw);
  const mpz_class toward = s.x[0] * s.n[0] + s.x[1] * s.n[1] + s.x[2] * s.n[2];
  const double level = s.body.centre[0] * whole(s.n[0]) + s.body.centre[1] * whole(s.n[1]) +
                       s.body.centre[2] * whole(s.n[2]);
  const double reach = draw.coin() ? whole(toward) : -whole(toward);
  const double offset = level + reach;
  const int beside = draw.integer(-1, 1);
  return {s.body, whole(s.n), beside == 0 ? offset : std::nextafter(offset, beside * HUGE_VAL)};
}

BodyAndWall wall_of_needle_or_disc(Draw& draw) {
  const RawEllipsoid body = needle_or_disc(draw, draw.log_uniform(1e2, 1e8));
  const double gap = draw.real(-1, 1) * least_axis(body);
  return against(draw, body, gap);
}

BodyAndWall scaled_wall(Draw& draw) {
  const double scale = std::ldexp(1.0, draw.coin() ? 300 : -300);
  const RawEllipsoid body = any_body(draw, 100, scale);
  const double gap = draw.real(-2, 1) * most_axis(body);
  return against(draw, body, gap);
}

BodyAndWall far_wall(Draw& draw) {
  RawEllipsoid body = any_body(draw, 10);
  for (double& v : body.centre) v = draw.real(-1, 1) * 1e12;
  const double gap = draw.real(-2, 1) * most_axis(body);
  return against(draw, body, gap);
}

// ---- rays

// From `back` before the point of the line that is `height` above the surface at a drawn normal,
// along a tangent there, turned by `off` towards the body.
BodyAndRay along_surface(Draw& draw, const RawEllipsoid& body, double height, double back) {
  const Real3 n = drawn_direction(draw), other = drawn_direction(draw);
  const Real3 along = ascent::normalised(ascent::cross(n, other));
  const double length = draw.log_uniform(1e-2, 1e2);
  const Triple direction = rounded3(ascent::scaled(Real(length), along));
  const Triple point = at_normal(body, n, height);
  return {body, plus(point, direction, -back / length), direction};
}

BodyAndRay any_ray(Draw& draw) {
  const RawEllipsoid body = any_body(draw, 100);
  const double away = draw.log_uniform(0.1, 100) * most_axis(body), share = draw.real(0, 1.2);
  const Triple origin = at_normal(body, drawn_direction(draw), away);
  const Triple aim = at_normal(body, drawn_direction(draw), 0, share);
  const double length = draw.log_uniform(1e-2, 1e2);
  Triple direction = plus(aim, origin, -1);
  for (double& v : direction) v *= length;
  return {body, origin, direction};
}

BodyAndRay ray_from_inside(Draw& draw) {
  const RawEllipsoid body = any_body(draw, 100);
  const double share = draw.real(0, 0.999);
  const Triple origin = at_normal(body, drawn_direction(draw), 0, share);
  return {body, origin, rounded3(drawn_direction(draw))};
}

BodyAndRay ray_beside_surface(Draw& draw) {
  const RawEllipsoid body = any_body(draw, 10);
  const double height = draw.log_uniform(1e-12, 1e-2);
  const double side = draw.coin() ? height : -height, back = draw.log_uniform(0.1, 10);
  return along_surface(draw, body, side, back);
}

// Exactly along the surface, or a unit of the last place beside; also from behind, and from the
// point itself.
BodyAndRay grazing_ray(Draw& draw) {
  const WholeSurface s = whole_surface(draw);
  construction::Vector w = construction::small_vector(draw, 3);
  const construction::Vector& n = s.n;
  construction::Vector d{n[1] * w[2] - n[2] * w[1], n[2] * w[0] - n[0] * w[2],
                         n[0] * w[1] - n[1] * w[0]};
  if (d[0] == 0 && d[1] == 0 && d[2] == 0) d = {n[1], -n[0], 0};
  const Triple direction = whole(d);
  Triple origin = plus(plus(s.body.centre, whole(s.x)), direction, draw.integer(-5, 1));
  if (draw.integer(0, 2) == 0) {
    double& v = origin[static_cast<std::size_t>(draw.integer(0, 2))];
    v = std::nextafter(v, draw.coin() ? HUGE_VAL : -HUGE_VAL);
  }
  return {s.body, origin, direction};
}

BodyAndRay ray_from_surface(Draw& draw) {
  const WholeSurface s = whole_surface(draw);
  const Triple direction = whole(construction::small_vector(draw, 9));
  const bool none = direction == Triple{};
  return {s.body, plus(s.body.centre, whole(s.x)), none ? whole(s.n) : direction};
}

BodyAndRay ray_at_needle_or_disc(Draw& draw) {
  const RawEllipsoid body = needle_or_disc(draw, draw.log_uniform(1e2, 1e6));
  const double away = draw.log_uniform(1, 1e3), share = draw.real(0, 1.01);
  const Triple origin = at_normal(body, drawn_direction(draw), away);
  const Triple aim = at_normal(body, drawn_direction(draw), 0, share);
  return {body, origin, plus(aim, origin, -1)};
}

BodyAndRay ray_from_far(Draw& draw) {
  const RawEllipsoid body = any_body(draw, 10);
  const double away = draw.log_uniform(1e4, 1e12), share = draw.real(0, 1.2);
  const Triple origin = at_normal(body, drawn_direction(draw), away);
  const Triple aim = at_normal(body, drawn_direction(draw), 0, share);
  return {body, origin, plus(aim, origin, -1)};
}

BodyAndRay scaled_ray(Draw& draw) {
  const double scale = std::ldexp(1.0, draw.coin() ? 300 : -300);
  const RawEllipsoid body = any_body(draw, 100, scale);
  const double away = draw.log_uniform(0.1, 10) * scale, share = draw.real(0, 1.2);
  const Triple origin = at_normal(body, drawn_direction(draw), away);
  const Triple aim = at_normal(body, drawn_direction(draw), 0, share);
  return {body, origin, plus(aim, origin, -1)};
}

}  // namespace

std::vector<InputFamily<BodyAndPoint>> point_families() {
  return {drawn_family("outside", 40, outside),
          drawn_family("inside", 40, inside),
          drawn_family("near the surface", 40, near_surface),
          drawn_family("on the surface", 40, on_surface),
          drawn_family("on the medial set", 40, on_medial_set),
          drawn_family("near the medial set", 40, near_medial_set),
          drawn_family("round bodies", 30, of_round_body),
          drawn_family("needles and discs", 40, of_needle_or_disc),
          drawn_family("far", 20, far_point),
          drawn_family("scale 2^+-450", 20, scaled_point)};
}

std::vector<InputFamily<BodyAndWall>> wall_families() {
  return {drawn_family("anywhere", 60, any_wall),
          drawn_family("near", 50, near_wall),
          drawn_family("touching", 80, touching_wall),
          drawn_family("needles and discs", 50, wall_of_needle_or_disc),
          drawn_family("scale 2^+-300", 30, scaled_wall),
          drawn_family("origin 1e12", 30, far_wall)};
}

std::vector<InputFamily<BodyAndRay>> ray_families() {
  return {drawn_family("anywhere", 50, any_ray),
          drawn_family("from inside", 40, ray_from_inside),
          drawn_family("beside the surface", 60, ray_beside_surface),
          drawn_family("grazing", 60, grazing_ray),
          drawn_family("from the surface", 40, ray_from_surface),
          drawn_family("needles and discs", 40, ray_at_needle_or_disc),
          drawn_family("from far away", 30, ray_from_far),
          drawn_family("scale 2^+-300", 30, scaled_ray)};
}

}  // namespace tangency::inline v0::verify
