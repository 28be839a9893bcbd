// SPDX-License-Identifier: GPL-3.0-or-later
//
// Families of two ellipsoids that move.
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

namespace tangency::inline v0::verify {
namespace {

using Triple = std::array<double, 3>;

Triple scaled(const Real3& v, double by) {
  return {rounded(by * v[0]), rounded(by * v[1]), rounded(by * v[2])};
}

RawEllipsoid any_body(Draw& draw, double aspect) {
  const double size = draw.log_uniform(0.3, 3), ratio = draw.log_uniform(1, aspect);
  return turned_body(draw, triaxial_axes(draw, size / ratio, ratio));
}

struct Flight {
  double aspect;     ///< of the bodies at most
  double turns;      ///< of each body in the horizon at most, radians
  double miss;       ///< how far beside A's centre B flies, over both largest semi-axes, at most
  double tolerance;  ///< over the horizon
};

// B flies past A's place, both may turn.
MovingPair flight(Draw& draw, const Flight& kind) {
  MovingPair pair{{any_body(draw, kind.aspect), {}}, {any_body(draw, kind.aspect), {}}, 0, 0};
  const double reach = most_axis(pair.a.body) + most_axis(pair.b.body);
  pair.horizon = draw.log_uniform(0.1, 10);
  pair.tolerance = pair.horizon * kind.tolerance;
  const Real3 from = drawn_direction(draw), beside = drawn_direction(draw);
  const double distance = reach * draw.real(1.2, 3), miss = reach * kind.miss * draw.real(0, 1);
  const double way = distance * draw.real(0.8, 2);
  for (std::size_t i = 0; i < 3; ++i) {
    pair.a.body.centre[i] = draw.real(-1, 1);
    pair.b.body.centre[i] = rounded(pair.a.body.centre[i] + distance * from[i] + miss * beside[i]);
    pair.a.motion.velocity[i] = draw.real(-1, 1) * reach / pair.horizon;
    pair.b.motion.velocity[i] = rounded(pair.a.motion.velocity[i] - way * from[i] / pair.horizon);
  }
  for (MovingBody* body : {&pair.a, &pair.b}) {
    const double turn = kind.turns > 0 ? draw.real(0, kind.turns) / pair.horizon : 0;
    if (turn > 0) body->motion.angular_velocity = scaled(drawn_direction(draw), turn);
  }
  return pair;
}

// Whole numbers, the bodies touch at time 0, or overlap there by one.
MovingPair at_start(Draw& draw) {
  for (;;) {
    const auto contact = construction::contact(draw, false);
    if (!contact) continue;
    const auto a = construction::raw(contact->a), b = construction::raw(contact->b);
    if (!a || !b) continue;
    MovingPair pair{{*a, {}}, {*b, {}}, 1, 0x1p-20};
    for (std::size_t i = 0; i < 3; ++i) {
      const double n = contact->n[i].get_d();
      if (draw.coin()) pair.a.motion.velocity[i] = draw.integer(-3, 3);
      pair.b.motion.velocity[i] = n;
    }
    return pair;
  }
}

// Two balls, of whole numbers, that fly past each other along x: their least distance, at a whole
// time, is the sum of their radii, or `off` more.
MovingPair passing_balls(Draw& draw, double off) {
  struct Quadruple {
    double x, y, radius;
  };
  constexpr std::array<Quadruple, 3> kAcross{{{3, 4, 5}, {5, 12, 13}, {8, 15, 17}}};
  const Quadruple across = draw.one_of(kAcross);
  const double a = draw.integer(1, static_cast<int>(across.radius) - 1);
  const double speed = draw.integer(1, 8), when = draw.integer(1, 9);
  MovingPair pair{{{{}, {a, a, a}}, {}}, {{}, {}}, 16, 0x1p-16};
  const double b = across.radius - a;
  pair.b.body = {{-speed * when, across.x, across.y * (1 + off)}, {b, b, b}};
  pair.b.motion.velocity = {speed, 0, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const double moved = draw.integer(-8, 8);
    pair.a.body.centre[i] += moved, pair.b.body.centre[i] += moved;
  }
  return pair;
}

MovingPair grazing(Draw& draw) { return passing_balls(draw, 0); }

MovingPair nearly_grazing(Draw& draw) {
  const double off = std::ldexp(1.0, -draw.integer(6, 24));
  return passing_balls(draw, draw.coin() ? off : -off);
}

InputFamily<MovingPair> flights(const char* name, std::size_t count, const Flight& kind) {
  return drawn_family(name, count, [kind](Draw& draw) { return flight(draw, kind); });
}

}  // namespace

std::vector<InputFamily<MovingPair>> time_families() {
  return {flights("straight", 40, {10, 0, 0.8, 1e-6}),
          flights("turning", 40, {10, 6, 0.8, 1e-6}),
          flights("needles and discs that spin", 20, {100, 20, 0.5, 1e-4}),
          flights("fine tolerance", 20, {5, 3, 0.5, 1e-9}),
          flights("passing", 30, {10, 6, 2, 1e-6}),
          drawn_family("touching at start", 20, at_start),
          drawn_family("grazing", 20, grazing),
          drawn_family("nearly grazing", 30, nearly_grazing)};
}

}  // namespace tangency::inline v0::verify
