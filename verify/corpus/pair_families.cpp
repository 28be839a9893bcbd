// SPDX-License-Identifier: GPL-3.0-or-later
//
// Families whose gaps are moderate or small against the bodies.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include <tangency/verify/corpus/placing.hpp>

namespace tangency::verify {
namespace {

// The published classes: aspect and size ratio drawn, gaps uniform in +- `share` of the unit.
struct ContactClass {
  bool spheroids;  // of one shape
  double aspect, size_ratio;
  bool by_radii;  // the gap's unit: least radii of curvature, else the smallest semi-axis
  double share;
};

EllipsoidPair class_shapes(Draw& draw, const ContactClass& kind) {
  const auto axes = [&](double size) {
    if (!kind.spheroids) return triaxial_axes(draw, size, draw.log_uniform(1, kind.aspect));
    std::array<double, 3> spheroid{size * kind.aspect, size, size};
    draw.shuffle(spheroid);
    return spheroid;
  };
  EllipsoidPair pair{turned_body(draw, axes(1)), {}};
  const double size = draw.log_uniform(1 / kind.size_ratio, kind.size_ratio);
  pair.b = turned_body(draw, axes(size));
  for (double& v : pair.a.centre) v = draw.real(-1, 1);
  return pair;
}

PairDraw class_draw(const ContactClass& kind) {
  return [kind](Draw& draw) {
    EllipsoidPair pair = class_shapes(draw, kind);
    const double radii = least_radii(pair);
    const double unit = kind.by_radii ? radii : std::min(least_axis(pair.a), least_axis(pair.b));
    const double most = unit * kind.share;
    place_b(pair, draw.direction(), draw.real(-std::min(most, radii), most));
    return pair;
  };
}

constexpr ContactClass kClass1{true, 1.43, 1, false, 0.02};
constexpr ContactClass kClass2{false, 5, 3, false, 0.02};
constexpr ContactClass kClass3{false, 1000, 1000, true, 1e-3};

// The rounded centre leaves a gap between a third of `gap` and three times it, of the same sign.
PairDraw near_draw(double gap) {
  return [gap](Draw& draw) -> std::optional<EllipsoidPair> {
    EllipsoidPair pair = class_shapes(draw, kClass2);
    const double unit = std::min(least_axis(pair.a), least_axis(pair.b));
    const double wanted = (draw.coin() ? gap : -gap) * unit;
    // Chosen: below 1e-16 one rounding in some tens falls right.
    for (int attempt = 0; attempt < 100; ++attempt) {
      const Real3 n = draw.direction();
      place_b(pair, n, wanted);
      const Real ratio = placed_gap(pair, n) / wanted;
      if (ratio > 1 / Real(3) && ratio < 3) return pair;
    }
    return std::nullopt;
  };
}

EllipsoidPair exchanged_by_chance(Draw& draw, const EllipsoidPair& pair) {
  return draw.coin() ? EllipsoidPair{pair.b, pair.a} : pair;
}

// A sphere or spheroid and any body.
std::optional<EllipsoidPair> equal_axes(Draw& draw) {
  const double size = draw.real(0.5, 2);
  std::array<double, 3> axes{size, size,
                             draw.integer(0, 2) == 0 ? size : draw.log_uniform(0.1, 10)};
  draw.shuffle(axes);
  EllipsoidPair pair{turned_body(draw, axes), turned_body(draw, triaxial_axes(draw, 1, 4))};
  place_b(pair, draw.direction(), draw.real(-0.2, 0.2) * least_radii(pair));
  return exchanged_by_chance(draw, pair);
}

// Both third axes along z and both centres at one height: the contact lies in that plane.
std::optional<EllipsoidPair> common_plane(Draw& draw) {
  EllipsoidPair pair{{{}, triaxial_axes(draw, 1, draw.log_uniform(1, 10)), {}},
                     {{}, triaxial_axes(draw, draw.real(0.5, 2), draw.log_uniform(1, 10)), {}}};
  const double height = draw.real(-1, 1);
  for (RawEllipsoid* body : {&pair.a, &pair.b}) {
    body->orientation = {draw.real(0.1, 1), 0, 0, draw.real(-1, 1)};
    body->centre = {0, 0, height};
  }
  Real3 n = draw.direction();
  n[2] = 0;
  const Real length = sqrt(n[0] * n[0] + n[1] * n[1]);
  n[0] /= length, n[1] /= length;
  place_b(pair, n, draw.real(-0.2, 0.2) * least_radii(pair));
  return pair;
}

// One coaxial with the other, spheroids about a space axis, at any distance.
std::optional<EllipsoidPair> common_axis(Draw& draw) {
  const auto axis = static_cast<std::size_t>(draw.integer(0, 2));
  const auto spheroid = [&] {
    const double round = draw.log_uniform(0.2, 5);
    RawEllipsoid body{{}, {round, round, round}, {1, 0, 0, 0}};
    body.semi_axes[axis] = draw.log_uniform(0.2, 5);
    return body;
  };
  EllipsoidPair pair{spheroid(), spheroid()};
  pair.a.centre = {draw.real(-1, 1), draw.real(-1, 1), draw.real(-1, 1)};
  pair.b.centre = pair.a.centre;
  const double reach = pair.a.semi_axes[axis] + pair.b.semi_axes[axis];
  pair.b.centre[axis] += draw.real(-1.2, 1.2) * reach;
  return pair;
}

// B within the inner ball of A.
std::optional<EllipsoidPair> strictly_inside(Draw& draw) {
  EllipsoidPair pair{turned_body(draw, triaxial_axes(draw, 1, draw.log_uniform(1, 20))),
                     turned_body(draw, triaxial_axes(draw, 1, draw.log_uniform(1, 20)))};
  const double shrink = draw.log_uniform(0.01, 0.8) / most_axis(pair.b);
  for (double& v : pair.b.semi_axes) v *= shrink;
  const double room = (1 - most_axis(pair.b)) / 2;
  for (std::size_t i = 0; i < 3; ++i) pair.b.centre[i] = draw.real(-room, room);
  return exchanged_by_chance(draw, pair);
}

}  // namespace

PairFamilies class_families() {
  return {drawn_family("class 1", 150, class_draw(kClass1)),
          drawn_family("class 2", 150, class_draw(kClass2)),
          drawn_family("class 3", 150, class_draw(kClass3))};
}

PairFamilies near_families() {
  PairFamilies families;
  for (int exponent = 3; exponent <= 17; ++exponent) {
    const std::string digits = std::to_string(exponent);
    families.push_back(drawn_family("gap 1e-" + std::string(exponent < 10 ? "0" : "") + digits, 24,
                                    near_draw(rounded(pow(Real(10), -exponent)))));
  }
  return families;
}

PairFamilies touch_families() {
  return {integer_family("integer_touch_outside", 90), integer_family("next_float_grid", 120),
          integer_family("far_origin", 60), integer_family("extreme_scale", 60),
          integer_family("unnormalised_quaternion", 60)};
}

PairFamilies symmetric_families() {
  return {integer_family("spheres", 80),
          integer_family("equal_shapes_parallel_axes", 60),
          integer_family("coaxial_spheroids", 80),
          drawn_family("equal axes", 60, equal_axes),
          drawn_family("common plane", 60, common_plane),
          drawn_family("common axis", 60, common_axis)};
}

PairFamilies nested_families() {
  return {drawn_family("strictly inside", 50, strictly_inside),
          integer_family("integer_touch_inside", 50),
          integer_family("concentric_parallel", 50),
          integer_family("concentric_turned", 50),
          integer_family("equal_sets", 30),
          integer_family("osculating", 40),
          integer_family("shared_vertex", 40),
          integer_family("two_points_or_circle", 40)};
}

}  // namespace tangency::verify
