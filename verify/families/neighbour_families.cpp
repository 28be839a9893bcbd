// SPDX-License-Identifier: GPL-3.0-or-later
//
// Families of bodies that are neighbours of each other, a box each.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <tangency/verify/families/families.hpp>

namespace tangency::inline v0::verify {
namespace {

// A whole multiple of 2^-16, so that every image's centre is a triple of doubles.
double on_grid(double x) { return std::round(std::ldexp(x, 16)) * 0x1p-16; }

struct Box {
  double height;  ///< in z

  std::array<double, 3> place(Draw& draw) const {
    std::array<double, 3> at{};
    for (double& v : at) v = draw.real(0, kNeighbourBox);
    at[2] = at[2] * (height / kNeighbourBox);
    for (double& v : at) v = on_grid(v);
    return at;
  }
};

RawEllipsoid placed(Draw& draw, const Box& box, const std::array<double, 3>& axes) {
  RawEllipsoid body = turned_body(draw, axes);
  body.centre = box.place(draw);
  return body;
}

RawEllipsoid of_many_sizes(Draw& draw, const Box& box) {
  const double size = draw.log_uniform(0.1, 2.5), aspect = draw.log_uniform(1, 3);
  return placed(draw, box, triaxial_axes(draw, size / aspect, aspect));
}

RawEllipsoid needle_or_plate(Draw& draw, const Box& box) {
  const double other = draw.coin() ? 0.1 : 3;
  return placed(draw, box, {0.1, other, 3});
}

// Balls in the cells of a lattice of diameter 2, or a unit of the grid beside: neighbours touch.
InputFamily<RawEllipsoid> touching_balls(std::size_t count) {
  return drawn_family("touching balls", count, [i = 0](Draw& draw) mutable -> RawEllipsoid {
    constexpr int kAcross = 4;
    const int place = i++;
    std::array<double, 3> at{2.0 * (place % kAcross), 2.0 * (place / kAcross % kAcross),
                             2.0 * (place / (kAcross * kAcross))};
    if (draw.integer(0, 7) == 0) {
      double& v = at[static_cast<std::size_t>(draw.integer(0, 2))];
      v += 0x1p-16 * draw.integer(-1, 1);
    }
    return {at, {1, 1, 1}};
  });
}

// Centres on faces, edges and corners of the box, or a unit of the grid beside.
RawEllipsoid at_the_border(Draw& draw, const Box& box) {
  const double size = draw.real(0.3, 1.5), aspect = draw.log_uniform(1, 3);
  RawEllipsoid body = placed(draw, box, triaxial_axes(draw, size / aspect, aspect));
  const auto k = static_cast<std::size_t>(draw.integer(1, 2));
  body.centre[k] = (draw.coin() ? 0
                    : k == 2    ? box.height
                                : kNeighbourBox) +
                   0x1p-16 * draw.integer(-1, 1);
  return body;
}

}  // namespace

std::vector<InputFamily<RawEllipsoid>> neighbour_families(bool thin) {
  const Box box{thin ? kNeighbourBox / 2 : kNeighbourBox};
  const auto family = [box](const char* name, std::size_t count, auto draw_body) {
    return drawn_family(name, count, [box, draw_body](Draw& draw) { return draw_body(draw, box); });
  };
  std::vector<InputFamily<RawEllipsoid>> families{
      family("many sizes", 60, of_many_sizes), family("needles and plates", 50, needle_or_plate),
      touching_balls(64), family("at the border", 40, at_the_border)};
  if (thin) {  // of which many meet an image of their own
    families.push_back(family("longer than the cell", 6, [](Draw& draw, const Box& own) {
      const double x = draw.real(0.1, 0.3), y = draw.real(0.1, 0.3);
      return placed(draw, own, {x, y, draw.real(4, 7)});
    }));
  }
  return families;
}

}  // namespace tangency::inline v0::verify
