// SPDX-License-Identifier: GPL-3.0-or-later
//
// The families of the corpora of ellipsoids, but for the profiles.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <tangency/verify/families/adversarial.hpp>
#include <tangency/verify/families/extreme.hpp>
#include <tangency/verify/families/families.hpp>
#include <tangency/verify/families/manufactured.hpp>
#include <tangency/verify/families/placing.hpp>

namespace tangency::inline v0::verify {
namespace {

// What drawn() makes of a family that benchmarks and tests draw from as well.
template <class Family>
InputFamily<EllipsoidPair> pairs_of(std::string name, std::size_t count, const Family& family) {
  return drawn_family(std::move(name), count,
                      [family](Draw& draw) -> EllipsoidPair { return drawn(draw, family); });
}

// Chosen: several times the largest count of a family.
constexpr std::size_t kMostOfIntegerFamily = 400;

// The family of this name of adversarial.hpp: one of those made of integers alone.
InputFamily<EllipsoidPair> integer_family(std::string_view name, std::size_t count) {
  const auto sequence = [name](std::uint64_t seed) -> std::function<EllipsoidPair()> {
    std::vector<EllipsoidPair> all;
    for_each_adversarial_pair(seed, adversarial_family_names().size() * kMostOfIntegerFamily,
                              [&](const AdversarialPair& p) {
                                if (p.family == name) all.push_back(p);
                              });
    return [all = std::move(all), next = std::size_t{0}]() mutable { return all.at(next++); };
  };
  return {std::string(name), count, sequence};
}

// The rounded centre leaves a gap between a third of `gap` and three times it, of the same sign.
EllipsoidPair near_pair(Draw& draw, double gap) {
  for (;;) {
    EllipsoidPair pair = contact_bodies(draw, contact_classes()[1]);
    const double wanted = (draw.coin() ? gap : -gap) * least_axis(pair);
    // Chosen: below 1e-16 one rounding in some tens falls right.
    for (int attempt = 0; attempt < 100; ++attempt) {
      const Real ratio = place_b(pair, drawn_direction(draw), wanted) / wanted;
      if (ratio > 1 / Real(3) && ratio < 3) return pair;
    }
  }
}

// A sphere or spheroid and any body.
EllipsoidPair equal_axes(Draw& draw) {
  const double size = draw.real(0.5, 2);
  std::array<double, 3> axes{size, size,
                             draw.integer(0, 2) == 0 ? size : draw.log_uniform(0.1, 10)};
  draw.shuffle(axes);
  EllipsoidPair pair{turned_body(draw, axes), turned_body(draw, triaxial_axes(draw, 1, 4))};
  const double gap = draw.real(-0.2, 0.2) * least_radii(pair);
  place_b(pair, drawn_direction(draw), gap);
  return exchanged_by_chance(draw, pair);
}

// Both third axes along z and both centres at one height: the contact lies in that plane.
EllipsoidPair common_plane(Draw& draw) {
  EllipsoidPair pair{{{}, triaxial_axes(draw, 1, draw.log_uniform(1, 10)), {}}, {}};
  const double aspect = draw.log_uniform(1, 10);
  pair.b.semi_axes = triaxial_axes(draw, draw.real(0.5, 2), aspect);
  const double height = draw.real(-1, 1);
  for (RawEllipsoid* body : {&pair.a, &pair.b}) {
    body->orientation = {draw.real(0.1, 1), 0, 0, draw.real(-1, 1)};
    body->centre = {0, 0, height};
  }
  Real3 n = drawn_direction(draw);
  n[2] = 0;
  const Real length = sqrt(n[0] * n[0] + n[1] * n[1]);
  n[0] /= length, n[1] /= length;
  place_b(pair, n, draw.real(-0.2, 0.2) * least_radii(pair));
  return pair;
}

// One coaxial with the other, spheroids about a space axis, at any distance.
EllipsoidPair common_axis(Draw& draw) {
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
EllipsoidPair strictly_inside(Draw& draw) {
  EllipsoidPair pair{turned_body(draw, triaxial_axes(draw, 1, draw.log_uniform(1, 20))),
                     turned_body(draw, triaxial_axes(draw, 1, draw.log_uniform(1, 20)))};
  const double shrink = draw.log_uniform(0.01, 0.8) / most_axis(pair.b);
  for (double& v : pair.b.semi_axes) v *= shrink;
  const double room = (1 - most_axis(pair.b)) / 2;
  for (std::size_t i = 0; i < 3; ++i) pair.b.centre[i] = draw.real(-room, room);
  return exchanged_by_chance(draw, pair);
}

PairFamilies classes() {
  PairFamilies families;
  for (const ContactFamily& kind : contact_classes()) {
    families.push_back(pairs_of("class " + std::to_string(families.size() + 1), 150, kind));
  }
  return families;
}

PairFamilies near() {
  PairFamilies families;
  for (int exponent = 3; exponent <= 17; ++exponent) {
    const std::string digits = std::to_string(exponent);
    const double gap = rounded(pow(Real(10), -exponent));
    families.push_back(drawn_family("gap 1e-" + std::string(exponent < 10 ? "0" : "") + digits, 24,
                                    [gap](Draw& draw) { return near_pair(draw, gap); }));
  }
  return families;
}

PairFamilies touching() {
  return {integer_family("integer_touch_outside", 90), integer_family("next_float_grid", 120),
          integer_family("far_origin", 60), integer_family("extreme_scale", 60),
          integer_family("unnormalised_quaternion", 60)};
}

PairFamilies symmetric() {
  return {integer_family("spheres", 80),
          integer_family("equal_shapes_parallel_axes", 60),
          integer_family("coaxial_spheroids", 80),
          drawn_family("equal axes", 60, equal_axes),
          drawn_family("common plane", 60, common_plane),
          drawn_family("common axis", 60, common_axis)};
}

PairFamilies nested() {
  return {drawn_family("strictly inside", 50, strictly_inside),
          integer_family("integer_touch_inside", 50),
          integer_family("concentric_parallel", 50),
          integer_family("concentric_turned", 50),
          integer_family("equal_sets", 30),
          integer_family("osculating", 40),
          integer_family("shared_vertex", 40),
          integer_family("two_points_or_circle", 40)};
}

PairFamilies extreme() {
  using Shape = ExtremeFamily::Shape;
  const auto family = [](const std::string& name, std::size_t count, ExtremeFamily kind) {
    kind.least_overlap = 1e-10;
    return pairs_of(name, count, kind);
  };
  PairFamilies families;
  for (const auto& [aspect, text] :
       {std::pair(1e1, "1e1"), std::pair(1e2, "1e2"), std::pair(1e4, "1e4"), std::pair(1e6, "1e6"),
        std::pair(1e8, "1e8")}) {
    families.push_back(family(std::string("needles ") + text, 24, {{}, Shape::needles, aspect}));
    families.push_back(family(std::string("discs ") + text, 24, {{}, Shape::discs, aspect}));
  }
  families.push_back(family("size ratio 1e8", 40, {{}, Shape::triaxial, 10, 1e8}));
  families.push_back(family("scale 1e-150", 30, {{}, Shape::triaxial, 100, 3, 1e-150}));
  families.push_back(family("scale 1e+150", 30, {{}, Shape::triaxial, 100, 3, 1e150}));
  families.push_back(family("origin 1e12", 40, {{}, Shape::triaxial, 10, 3, 1, 1e12}));
  return families;
}

PairFamilies deep() {
  const auto family = [](const char* name, std::size_t count, double aspect, double most) {
    return pairs_of(name, count, DeepFamily{{}, aspect, 0, most});
  };
  return {family("aspect to 1.05", 50, 1.05, 1),     family("aspect to 5", 80, 5, 1),
          family("aspect to 20", 80, 20, 1),         family("aspect to 100", 50, 100, 1),
          family("nearly concentric", 50, 20, 0.05), family("concentric", 50, 20, 0)};
}

}  // namespace

PairFamilies pair_families(std::string_view corpus, std::uint64_t seed) {
  if (corpus == "classes") return classes();
  if (corpus == "near") return near();
  if (corpus == "touching") return touching();
  if (corpus == "symmetric") return symmetric();
  if (corpus == "nested") return nested();
  if (corpus == "extreme") return extreme();
  if (corpus == "profiles") return profile_families(seed);
  return deep();
}

}  // namespace tangency::inline v0::verify
