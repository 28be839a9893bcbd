// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/families/extreme.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <tangency/verify/families/placing.hpp>
#include <tangency/verify/oracles/newton_ascent.hpp>
#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::inline v0::verify {
namespace {

using Form = ExtremeFamily::Shape;

std::array<double, 3> extreme_axes(Draw& draw, Form shape, double size, double aspect) {
  const double thin = size / aspect;
  if (shape == Form::triaxial) return triaxial_axes(draw, thin, aspect);
  // The two like axes are equal, or differ by up to 2.
  const double factor = draw.coin() ? 1 : draw.log_uniform(1, std::min(aspect, 2.0));
  std::array<double, 3> axes{size, shape == Form::needles ? thin * factor : size / factor, thin};
  draw.shuffle(axes);
  return axes;
}

RawEllipsoid extreme_body(Draw& draw, const ExtremeFamily& family, Form of_mixed, double size) {
  Form shape = family.shape;
  if (shape == Form::mixed) shape = draw.coin() ? Form::triaxial : of_mixed;
  return turned_body(draw, extreme_axes(draw, shape, size, family.aspect));
}

// A third anywhere, a third along an axis of a body, a third at 1e-12 to 1 of it.
Real3 contact_normal(Draw& draw, const EllipsoidPair& pair) {
  const Real3 any = drawn_direction(draw);
  const int kind = draw.integer(0, 2);
  if (kind == 0) return any;
  const Separation<Real> shapes = separation(real(pair.a), real(pair.b));
  const Shape<Real>& of = draw.coin() ? shapes.a : shapes.b;
  const Real off = kind == 1 ? 0 : draw.log_uniform(1e-12, 1);
  const Real3 axis = of.axes[static_cast<std::size_t>(draw.integer(0, 2))];
  return ascent::normalised(ascent::combined(axis, off, any, Real(0), any));
}

}  // namespace

std::span<const ExtremeFamily> extreme_families() {
  static const std::vector<ExtremeFamily> families = [] {
    std::vector<ExtremeFamily> all;
    for (const auto& [name, shape] :
         {std::pair("needles", Form::needles), {"discs", Form::discs}, {"mixed", Form::mixed}}) {
      for (const auto& [aspect, text] : {std::pair(1e0, "1"),
                                         {1e1, "10"},
                                         {1e2, "100"},
                                         {1e4, "1e4"},
                                         {1e6, "1e6"},
                                         {1e8, "1e8"}}) {
        all.push_back({std::string(name) + " of aspect " + text, shape, aspect});
      }
    }
    all.push_back({"size ratio to 1e8, aspect 10", Form::mixed, 10, 1e8});
    all.push_back({"size ratio to 1e8, aspect 1e8", Form::mixed, 1e8, 1e8});
    all.push_back({"scale 1e-150, aspect 1e4", Form::mixed, 1e4, 3, 1e-150});
    all.push_back({"scale 1e150, aspect 1e4", Form::mixed, 1e4, 3, 1e150});
    all.push_back({"origin 1e12 away, aspect 10", Form::mixed, 10, 3, 1, 1e12});
    all.push_back({"origin 1e12 away, aspect 1e8", Form::mixed, 1e8, 3, 1, 1e12});
    return all;
  }();
  return families;
}

std::span<const ExtremeFamily> slender_contacts() {
  static const std::vector<ExtremeFamily> families = [] {
    std::vector<ExtremeFamily> all;
    for (const auto& [name, shape] :
         {std::pair("needles", Form::needles), {"discs", Form::discs}}) {
      for (const int aspect : {10, 30, 100}) {
        ExtremeFamily family{
            "contacts of " + std::string(name) + " of aspect " + std::to_string(aspect), shape,
            static_cast<double>(aspect)};
        family.least_gap = 1e-3, family.largest_gap = 1e-1;
        all.push_back(family);
      }
    }
    return all;
  }();
  return families;
}

EllipsoidPair drawn(Draw& draw, const ExtremeFamily& family) {
  EllipsoidPair pair{extreme_body(draw, family, Form::needles, family.scale), {}};
  const double ratio = draw.log_uniform(1 / family.size_ratio, family.size_ratio);
  pair.b = extreme_body(draw, family, Form::discs, family.scale * ratio);
  const Real3 place = drawn_direction(draw);
  for (std::size_t i = 0; i < 3; ++i) {
    pair.a.centre[i] = rounded(place[i] * (family.scale * family.origin));
  }
  const double least = least_axis(pair);
  if (family.least_gap > 0) {
    const double gap = least * draw.log_uniform(family.least_gap, family.largest_gap);
    const bool apart = draw.coin();
    place_b(pair, drawn_direction(draw), apart ? gap : -gap);
    return pair;
  }
  const double most = std::max(most_axis(pair.a), most_axis(pair.b));
  double gap = least * draw.log_uniform(1e-16, 1e6 * (most / least));
  if (draw.integer(0, 2) == 0) {
    gap = -least_radii(pair) * draw.log_uniform(family.least_overlap, 1);
  }
  place_b(pair, contact_normal(draw, pair), gap);
  if (draw.coin()) std::swap(pair.a, pair.b);
  return pair;
}

std::span<const DeepFamily> deep_families() {
  static const std::vector<DeepFamily> families{
      {"aspect to 5, overlap to 30 %", 5, 0, 1, 0.3},
      {"aspect to 1.05, any overlap", 1.05},
      {"aspect to 5, any overlap", 5},
      {"aspect to 5, concentric", 5, 0, 0},
      {"aspect to 20, any overlap", 20},
      {"aspect to 20, nearly concentric", 20, 0, 0.05},
      {"aspect to 20, concentric", 20, 0, 0},
      {"aspect to 100, any overlap", 100},
      {"aspect to 1000, any overlap", 1000},
      {"aspect to 1000, concentric", 1000, 0, 0},
  };
  return families;
}

EllipsoidPair drawn(Draw& draw, const DeepFamily& family) {
  const auto body = [&](double aspect, double shortest) {
    return turned_body(draw, triaxial_axes(draw, shortest, aspect));
  };
  EllipsoidPair pair{body(draw.log_uniform(1, family.aspect), 1), {}};
  const double aspect = draw.log_uniform(1, family.aspect);
  pair.b = body(aspect, draw.log_uniform(0.3, 3));
  const double share = draw.real(family.least_depth, family.largest_depth);
  const Real3 n = drawn_direction(draw);
  if (family.within > 0) {
    place_b(pair, n, -share * family.within * least_axis(pair));
  } else {
    place_b(pair, n, 0, share);
  }
  return pair;
}

EllipsoidPair drawn(Draw& draw, const HeaviestFamily& family) {
  constexpr double most = std::numeric_limits<double>::max();
  constexpr double least = std::numeric_limits<double>::denorm_min();
  const auto magnitude = [&] {
    const int exponent = draw.integer(-family.range, std::min(family.range, 1023));
    return std::max(least, std::ldexp(draw.real(1, 2), exponent));
  };
  const auto number = [&] { return draw.coin() ? magnitude() : -magnitude(); };
  const auto nudged = [&](double x) { return std::nextafter(x, draw.coin() ? most : -most); };
  const auto body = [&] {
    RawEllipsoid e;
    for (double& c : e.centre) c = number();
    for (double& r : e.semi_axes) r = magnitude();
    for (double& q : e.orientation) q = number();
    return e;
  };
  EllipsoidPair pair;
  pair.a = pair.b = body();
  RawEllipsoid& b = pair.b;
  switch (draw.integer(0, 5)) {
    case 0:
      b = body();
      break;
    case 1:
      for (double& c : b.centre) c = draw.coin() ? c : nudged(c);
      break;
    case 2:
      b.semi_axes[static_cast<std::size_t>(draw.integer(0, 2))] *= 1 + 0x1p-52;
      break;
    case 3:
      for (double& r : b.semi_axes) {
        const int growth = draw.integer(0, 299);
        if (draw.coin()) r = std::min(most, std::ldexp(r, growth));
      }
      break;
    case 4: {
      double& q = b.orientation[static_cast<std::size_t>(draw.integer(0, 3))];
      q = draw.coin() ? nudged(q) : q / 2;
      break;
    }
    default:
      for (double& r : b.semi_axes) r = std::min(most, 2 * r);
      b.centre[0] = std::clamp(b.centre[0] + b.semi_axes[0] / 4, -most, most);
  }
  return pair;
}

}  // namespace tangency::inline v0::verify
