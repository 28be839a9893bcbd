// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/tests/verify/batch_families.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <tangency/verify/families/adversarial.hpp>
#include <tangency/verify/families/extreme.hpp>
#include <tangency/verify/families/manufactured.hpp>
#include <tangency/verify/families/placing.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>

namespace tangency::testing {
namespace {

using verify::ContactFamily;
using verify::DeepFamily;
using verify::Draw;
using verify::EllipsoidPair;
using verify::least_axis;
using verify::most_axis;
using verify::RawEllipsoid;
using verify::Real;
using verify::Real3;

template <class Next>
BatchFamily drawn_family(const char* name, double share, Next next) {
  return {name, share, [next](std::uint64_t seed, std::size_t count) {
            Draw draw(seed);
            std::vector<EllipsoidPair> pairs;
            pairs.reserve(count);
            while (pairs.size() < count) pairs.push_back(next(draw));
            return pairs;
          }};
}

EllipsoidPair ordinary(Draw& draw, int which) {
  return drawn(draw, verify::contact_classes()[static_cast<std::size_t>(which)]);
}

EllipsoidPair contact(Draw& draw, double aspect, double size_ratio) {
  const ContactFamily family{"",
                             ContactFamily::Shape::triaxial,
                             aspect,
                             size_ratio,
                             ContactFamily::GapUnit::smallest_semi_axis,
                             0.02};
  return drawn(draw, family);
}

double either_sign(Draw& draw, double from, double to) {
  const double size = draw.log_uniform(from, to);
  return draw.coin() ? size : -size;
}

// One long axis or one short one, the other two alike to a factor of 1.5.
RawEllipsoid needle_or_disc(Draw& draw, double aspect) {
  const double alike = draw.real(1, 1.5);
  std::array<double, 3> axes{1, alike, aspect};
  if (draw.coin()) axes[1] = aspect / alike;
  draw.shuffle(axes);
  return verify::turned_body(draw, axes);
}

EllipsoidPair needles_and_discs(Draw& draw) {
  const double aspect = draw.log_uniform(10, 100);
  EllipsoidPair pair{needle_or_disc(draw, aspect), {}};
  pair.b = needle_or_disc(draw, aspect);
  place_b(pair, verify::drawn_direction(draw), either_sign(draw, 1e-3, 1e-1));
  return pair;
}

EllipsoidPair class2_at_gap(Draw& draw, double from, double to) {
  EllipsoidPair pair = contact_bodies(draw, verify::contact_classes()[1]);
  const double gap = either_sign(draw, from, to) * least_axis(pair);
  place_b(pair, verify::drawn_direction(draw), gap);
  return pair;
}

// A's flattest side, or B's too where `both`, at a normal tilted so little that the witness point
// lies anywhere on it.
EllipsoidPair on_faces(Draw& draw, double most_aspect, bool both) {
  const auto body = [&](double aspect) {
    std::array<double, 3> axes{1 / aspect, draw.real(0.3, 1), 1};
    return verify::turned_body(draw, axes);
  };
  const double aspect = draw.log_uniform(10, most_aspect);
  EllipsoidPair pair{body(aspect), {}};
  if (both) {
    pair.b = body(aspect);
    pair.b.orientation = pair.a.orientation;
    for (double& q : pair.b.orientation) q += draw.real(-1, 1) * 0x1p-20;
  } else {
    pair.b = verify::turned_body(draw, verify::triaxial_axes(draw, draw.log_uniform(0.01, 3), 1.5));
  }
  const auto shapes = separation(verify::real(pair.a), verify::real(pair.b));
  const Real tilt = draw.log_uniform(1e-3, 3) / aspect;
  const Real3 any = verify::drawn_direction(draw);
  const Real3 n = verify::ascent::normalised(
      verify::ascent::combined(shapes.a.axes[0], tilt, any, Real(0), any));
  place_b(pair, n, either_sign(draw, 1e-14, 1e-2) * verify::least_radii(pair));
  return pair;
}

// Two ways out of nearly the same length.
EllipsoidPair near_tie(Draw& draw) {
  const double share = draw.log_uniform(1e-14, 0.1);
  return drawn(draw, DeepFamily{"", draw.log_uniform(1.01, 10), 0, share});
}

// Spheres, or the same spheroid twice, alike to the last bit or to a few.
EllipsoidPair equal_bodies(Draw& draw) {
  const double size = draw.log_uniform(0.5, 2);
  std::array<double, 3> axes{size, size, size};
  if (draw.coin()) axes[2] *= draw.log_uniform(0.2, 5);
  EllipsoidPair pair{verify::turned_body(draw, axes), {}};
  pair.b = pair.a;
  if (draw.coin()) pair.b.orientation = draw.orientation();
  if (draw.coin()) {
    for (double& r : pair.b.semi_axes)
      r *= 1 + draw.integer(0, 3) * draw.log_uniform(0x1p-52, 1e-9);
  }
  const double gap = draw.real(-0.02, 0.02) * least_axis(pair);
  place_b(pair, verify::drawn_direction(draw), gap);
  return pair;
}

void scale(EllipsoidPair& pair, int exponent) {
  for (RawEllipsoid* body : {&pair.a, &pair.b}) {
    for (double& c : body->centre) c = std::ldexp(c, exponent);
    for (double& r : body->semi_axes) r = std::max(std::ldexp(r, exponent), 0x1p-1074);
  }
}

// At powers of two where float or double ends, where their squares do, and where a lane's range
// may: 2^20, 2^60.
EllipsoidPair at_range_ends(Draw& draw) {
  static constexpr std::array<int, 9> kEnds{20, 42, 60, 64, 126, 149, 500, 1000, 1018};
  EllipsoidPair pair = ordinary(draw, 1);
  const int end = draw.one_of(kEnds);
  const int exponent = std::min(end + draw.integer(-3, 3), 1018);
  scale(pair, draw.coin() ? exponent : -exponent);
  return pair;
}

EllipsoidPair far_apart(Draw& draw) {
  EllipsoidPair pair = contact_bodies(draw, verify::contact_classes()[1]);
  const double most = std::max(most_axis(pair.a), most_axis(pair.b));
  place_b(pair, verify::drawn_direction(draw), most * draw.log_uniform(0.5, 1e8));
  return pair;
}

EllipsoidPair deep(Draw& draw) {
  const double aspect = draw.log_uniform(1.01, 20);
  return drawn(draw, DeepFamily{"", aspect, 0, draw.coin() ? 1.0 : draw.log_uniform(1e-3, 1)});
}

// ---- One term of the certificate each.

// n'(fl(M) - M) n over u n'|M| n as far as an extended double tells it: how much the rounding of M
// to doubles moves h.
double drift_of_matrix(const RawEllipsoid& body, const std::array<double, 3>& n) {
  using Wide = long double;
  const auto [w, x, y, z] = std::array<Wide, 4>{body.orientation[0], body.orientation[1],
                                                body.orientation[2], body.orientation[3]};
  const Wide s = 2 / (w * w + x * x + y * y + z * z);
  const Wide r[3][3] = {{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                        {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
                        {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}};
  Wide drift = 0, all = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      Wide m = 0;
      for (std::size_t k = 0; k < 3; ++k)
        m += r[i][k] * r[j][k] * body.semi_axes[k] * body.semi_axes[k];
      const Wide weight = Wide(n[i]) * n[j];
      drift += weight * (static_cast<Wide>(static_cast<double>(m)) - m);
      all += std::abs(weight * m);
    }
  }
  return static_cast<double>(drift / (all * 0x1p-53L));
}

// Of 40 orientations the one whose matrix errs most one way, the same way in both bodies.
EllipsoidPair matrices_rounded_one_way(Draw& draw) {
  EllipsoidPair pair = contact_bodies(draw, verify::contact_classes()[1]);
  const Real3 n = verify::drawn_direction(draw);
  const std::array<double, 3> way{verify::rounded(n[0]), verify::rounded(n[1]),
                                  verify::rounded(n[2])};
  for (RawEllipsoid* body : {&pair.a, &pair.b}) {
    double most = drift_of_matrix(*body, way);
    for (int i = 0; i < 40; ++i) {
      RawEllipsoid other = *body;
      other.orientation = draw.orientation();
      const double drift = drift_of_matrix(other, way);
      if (drift > most) *body = other, most = drift;
    }
  }
  place_b(pair, n, draw.real(-0.02, 0.02) * least_axis(pair));
  return pair;
}

// Centres so far from the origin that their difference is rounded, or all that is left of them.
EllipsoidPair far_origin(Draw& draw) {
  EllipsoidPair pair = contact_bodies(draw, verify::contact_classes()[1]);
  const double far = draw.log_uniform(1, 1e15);
  for (double& c : pair.a.centre) c = far * draw.real(-1, 1);
  place_b(pair, verify::drawn_direction(draw), draw.real(-0.02, 0.02) * least_axis(pair));
  return pair;
}

// One pair in eight takes many steps, its neighbours none or two.
EllipsoidPair slow_neighbours(Draw& draw) {
  if (draw.integer(0, 7) > 0) return ordinary(draw, 0);
  return draw.coin() ? contact(draw, 100, 3) : on_faces(draw, 100, draw.coin());
}

// A least semi-axis, or all of a body, that floats scaled to the largest have no bits for.
EllipsoidPair beyond_floats(Draw& draw) {
  EllipsoidPair pair = contact_bodies(draw, verify::contact_classes()[1]);
  const double small = std::ldexp(1.0, -draw.integer(12, 170));
  if (draw.coin()) {
    for (double& r : pair.b.semi_axes) r *= small;
  } else {
    const auto k = static_cast<std::size_t>(draw.integer(0, 2));
    pair.a.semi_axes[k] *= small;
  }
  place_b(pair, verify::drawn_direction(draw), either_sign(draw, 1e-3, 1) * least_axis(pair));
  return pair;
}

// Turns by quarters and zeros in d: products that are exact, components that are 0.
EllipsoidPair along_axes(Draw& draw) {
  EllipsoidPair pair = contact_bodies(draw, verify::contact_classes()[draw.coin() ? 0 : 1]);
  for (RawEllipsoid* body : {&pair.a, &pair.b}) {
    for (double& q : body->orientation) q = draw.integer(0, 1);
    if (body->orientation == std::array<double, 4>{}) body->orientation[0] = 1;
  }
  Real3 n{0, 0, 0};
  n[static_cast<std::size_t>(draw.integer(0, 2))] = draw.coin() ? 1 : -1;
  place_b(pair, n, draw.real(-0.02, 0.02) * least_axis(pair));
  return pair;
}

BatchFamily hostile() {
  return {"adversarial", 0.1, [](std::uint64_t seed, std::size_t count) {
            std::vector<EllipsoidPair> pairs;
            verify::for_each_adversarial_pair(
                seed, count, [&](const verify::AdversarialPair& p) { pairs.push_back(p); });
            return pairs;
          }};
}

}  // namespace

const std::vector<BatchFamily>& batch_families() {
  static const std::vector<BatchFamily> families{
      drawn_family("class1", 1, [](Draw& draw) { return ordinary(draw, 0); }),
      drawn_family("class2", 1, [](Draw& draw) { return ordinary(draw, 1); }),
      drawn_family("class3", 1, [](Draw& draw) { return ordinary(draw, 2); }),
      drawn_family("aspect to 5, overlap to 30 %", 1,
                   [](Draw& draw) { return drawn(draw, verify::deep_families()[0]); }),
      drawn_family("needles and discs, 10 to 100", 1, needles_and_discs),
      drawn_family("aspect 100", 1, [](Draw& draw) { return contact(draw, 100, 3); }),
      drawn_family("gaps of 1e-17 to 1e-3", 1,
                   [](Draw& draw) { return class2_at_gap(draw, 1e-17, 1e-3); }),
      drawn_family("flat faces", 1, [](Draw& draw) { return on_faces(draw, 1e6, false); }),
      drawn_family("equal bodies", 1, equal_bodies),
      drawn_family("size ratio to 1e6", 1, [](Draw& draw) { return contact(draw, 5, 1e6); }),
      drawn_family("far apart", 1, far_apart),
      drawn_family("ends of ranges", 0.1, at_range_ends),
      drawn_family("deep", 0.02, deep),
      drawn_family("near ties", 0.02, near_tie),
      hostile(),
      drawn_family("matrices rounded one way", 0.1, matrices_rounded_one_way),
      drawn_family("faces on faces", 0.1, [](Draw& draw) { return on_faces(draw, 100, true); }),
      drawn_family("thinnest faces", 0.1, [](Draw& draw) { return on_faces(draw, 1e18, false); }),
      drawn_family("far origins", 0.1, far_origin),
      drawn_family("slow neighbours", 0.1, slow_neighbours),
      drawn_family("beyond floats", 0.1, beyond_floats),
      drawn_family("along axes", 0.1, along_axes),
  };
  return families;
}

}  // namespace tangency::testing
