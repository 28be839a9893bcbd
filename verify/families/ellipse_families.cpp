// SPDX-License-Identifier: GPL-3.0-or-later
//
// Families of plane ellipses.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/families.hpp>
#include <tangency/verify/families/placing.hpp>

namespace tangency::inline v0::verify {
namespace {

std::array<double, 2> any_direction(Draw& draw) {
  const Real3 n = drawn_direction(draw);
  const double length = draw.log_uniform(0.1, 10);
  return {rounded(n[0] * length), rounded(n[1] * length)};
}

RawEllipse body(Draw& draw, double aspect, double size = 1) {
  std::array<double, 2> axes{size, size * draw.log_uniform(1, aspect)};
  draw.shuffle(axes);
  return {{draw.real(-1, 1), draw.real(-1, 1)}, axes, any_direction(draw)};
}

// R diag(a^2) R' n / h for n of any length.
std::array<Real, 2> support_point(const RawEllipse& e, const std::array<Real, 2>& n) {
  const Real ux = e.direction[0], uy = e.direction[1], norm = sqrt(ux * ux + uy * uy);
  const Real x = e.semi_axes[0] * (n[0] * ux + n[1] * uy) / norm;
  const Real y = e.semi_axes[1] * (n[1] * ux - n[0] * uy) / norm;
  const Real per = 1 / (sqrt(x * x + y * y) * norm);
  return {per * (e.semi_axes[0] * x * ux - e.semi_axes[1] * y * uy),
          per * (e.semi_axes[0] * x * uy + e.semi_axes[1] * y * ux)};
}

// Centres `share` times as far apart as where the pair touches at a drawn normal.
EllipsePair apart(Draw& draw, const RawEllipse& a, RawEllipse b, double share) {
  const auto direction = any_direction(draw);
  const std::array<Real, 2> n{direction[0], direction[1]};
  const auto x_a = support_point(a, n), x_b = support_point(b, n);
  for (std::size_t i = 0; i < 2; ++i) {
    b.centre[i] = rounded(Real(a.centre[i]) + share * (x_a[i] + x_b[i]));
  }
  return {a, b};
}

EllipsePair random_pair(Draw& draw) {
  const double aspect = draw.log_uniform(1, 100);
  const RawEllipse a = body(draw, aspect), b = body(draw, aspect, draw.log_uniform(0.3, 3));
  return apart(draw, a, b, draw.real(0, 1.5));
}

// About one line of direction (3, 4), sizes multiples of 5, so that vertices are exact: outer and
// inner touches of every order, and touches beside two crossings.
EllipsePair vertex_touches(Draw& draw) {
  const double m = draw.integer(1, 6), p = draw.integer(1, 6);
  const double scale = std::ldexp(1.0, draw.integer(-3, 3));
  // Every fourth time the radius of curvature at the vertex is 5, whatever the length.
  const auto width = [&](double along) -> double {
    if (draw.integer(0, 3) == 0 && along == 1) return 5;
    if (draw.integer(0, 3) == 0 && along == 4) return 10;
    return draw.integer(1, 30);
  };
  EllipsePair pair{{{0, 0}, {5 * m, width(m)}, {3, 4}}, {{0, 0}, {5 * p, width(p)}, {-0.75, -1}}};
  const double distance = draw.coin() ? m + p : m - p;
  pair.b.centre = {3 * distance, 4 * distance};
  for (RawEllipse* e : {&pair.a, &pair.b}) {
    for (double& v : e->centre) v *= scale;
    for (double& v : e->semi_axes) v *= scale;
  }
  return exchanged_by_chance(draw, pair);
}

// The circle of curvature where (cos, sin) = (3, 4) / 5 on the ellipse of 45 and 80: a crossing of
// multiplicity 3 and one more.
EllipsePair osculating(Draw& draw) {
  const int exponent = draw.integer(-20, 20);
  const double scale = std::ldexp(draw.integer(1, 1000), exponent);
  const double sx = draw.coin() ? -1 : 1, sy = draw.coin() ? -1 : 1;
  return exchanged_by_chance(
      draw, EllipsePair{{{0, 0}, {45 * scale, 80 * scale}, {1, 0}},
                        {{-21 * sx * scale, 28 * sy * scale}, {60 * scale, 60 * scale}, {1, 2}}});
}

EllipsePair four_crossings(Draw& draw) {
  const double aspect = draw.log_uniform(1.05, 1000);
  RawEllipse a = body(draw, 1);
  a.semi_axes = {aspect, 1};
  const std::array<double, 2> axes{aspect * draw.real(0.9, 1.1), draw.real(0.9, 1.1)};
  RawEllipse b{a.centre, axes, any_direction(draw)};
  for (double& v : b.centre) v += draw.real(-0.1, 0.1);
  return {a, b};
}

EllipsePair concentric(Draw& draw) {
  EllipsePair pair{body(draw, 10), body(draw, 10)};
  pair.b.centre = pair.a.centre;
  switch (draw.integer(0, 3)) {
    case 0:
      pair.b.direction = pair.a.direction;
      break;
    case 1:  // two touches, or homothetic
      pair.b.direction = {-2 * pair.a.direction[1], 2 * pair.a.direction[0]};
      pair.b.semi_axes[1] = pair.a.semi_axes[0];
      if (draw.coin()) pair.b.semi_axes[0] = 2 * pair.a.semi_axes[1];
      break;
    case 2:
      pair.b.direction = pair.a.direction;
      pair.b.semi_axes = {2 * pair.a.semi_axes[0], 2 * pair.a.semi_axes[1]};
      break;
    default:
      break;
  }
  return exchanged_by_chance(draw, pair);
}

// The same set labelled otherwise, or just not the same.
EllipsePair equal_or_nearly(Draw& draw) {
  EllipsePair pair{body(draw, 100), {}};
  pair.b = pair.a;
  const double stretch = std::ldexp(1.0, draw.integer(-9, 9));
  auto& [x, y] = pair.b.direction;
  x *= stretch, y *= stretch;
  if (draw.coin()) {
    std::swap(pair.b.semi_axes[0], pair.b.semi_axes[1]);
    pair.b.direction = {-y, x};
  }
  if (draw.coin()) {
    double& v = draw.coin() ? pair.b.semi_axes[0] : pair.b.centre[1];
    v = std::nextafter(v, std::numeric_limits<double>::max());
  }
  return pair;
}

EllipsePair circles(Draw& draw) {
  const auto circle = [&] {
    const double r = draw.coin() ? draw.integer(1, 6) : draw.log_uniform(0.1, 10);
    return RawEllipse{{0, 0}, {r, r}, any_direction(draw)};
  };
  EllipsePair pair{circle(), circle()};
  if (!draw.coin()) return apart(draw, pair.a, pair.b, draw.real(0, 1.5));
  pair.b.centre = {3.0 * draw.integer(-2, 2), 4.0 * draw.integer(-2, 2)};
  return pair;
}

EllipsePair near_touch(Draw& draw) {
  const double off = draw.log_uniform(1e-16, 1e-3), aspect = draw.log_uniform(1, 1000);
  const RawEllipse a = body(draw, aspect), b = body(draw, aspect);
  return apart(draw, a, b, draw.coin() ? 1 + off : 1 - off);
}

EllipsePair extreme(Draw& draw, double largest_aspect) {
  const double aspect = draw.log_uniform(1, largest_aspect);
  const RawEllipse a = body(draw, aspect), b = body(draw, aspect, draw.log_uniform(1e-3, 1e3));
  EllipsePair pair = apart(draw, a, b, draw.real(0, 1.3));
  const int kind = draw.integer(0, 2);
  const double scale = std::ldexp(1.0, kind == 0 ? 500 : kind == 1 ? -500 : 0);
  for (RawEllipse* e : {&pair.a, &pair.b}) {
    for (double& v : e->semi_axes) v *= scale;
    for (double& v : e->centre) v = v * scale + (kind == 2 ? std::ldexp(1.0, 20) : 0.0);
  }
  return pair;
}

}  // namespace

std::vector<InputFamily<EllipsePair>> ellipse_families(double extreme_aspect) {
  return {
      drawn_family("random", 80, random_pair),
      drawn_family("four crossings", 50, four_crossings),
      drawn_family("near touch", 60, near_touch),
      drawn_family("vertex touches", 60, vertex_touches),
      drawn_family("osculating", 20, osculating),
      drawn_family("concentric", 40, concentric),
      drawn_family("equal or nearly", 30, equal_or_nearly),
      drawn_family("circles", 40, circles),
      drawn_family("extreme", 50, [=](Draw& draw) { return extreme(draw, extreme_aspect); }),
  };
}

}  // namespace tangency::inline v0::verify
