// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/families/extreme.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <tangency/verify/families/support.hpp>

namespace tangency::families {
namespace {

using verify::RawEllipsoid;

/// Log-uniform in [low, high].
Real log_uniform(std::mt19937_64& random, Real low, Real high) {
  return std::exp(uniform(random, std::log(low), std::log(high)));
}

std::array<double, 3> shuffled(std::mt19937_64& random, Real x, Real y, Real z) {
  std::array<double, 3> axes = {static_cast<double>(x), static_cast<double>(y),
                                static_cast<double>(z)};
  for (std::size_t i = 2; i > 0; --i) std::swap(axes[i], axes[random() % (i + 1)]);
  return axes;
}

std::array<double, 3> needle(std::mt19937_64& random, Real size, Real aspect) {
  const Real wider = log_uniform(random, 1, std::min(aspect, Real(2)));
  return shuffled(random, size, size / aspect * (random() % 2 ? 1 : wider), size / aspect);
}

std::array<double, 3> disc(std::mt19937_64& random, Real size, Real aspect) {
  const Real narrower = log_uniform(random, 1, std::min(aspect, Real(2)));
  return shuffled(random, size, size / (random() % 2 ? 1 : narrower), size / aspect);
}

std::array<double, 3> triaxial(std::mt19937_64& random, Real size, Real aspect) {
  return shuffled(random, size, size / log_uniform(random, 1, aspect), size / aspect);
}

Real smallest(const RawEllipsoid& e) {
  return *std::min_element(e.semi_axes.begin(), e.semi_axes.end());
}
Real largest(const RawEllipsoid& e) {
  return *std::max_element(e.semi_axes.begin(), e.semi_axes.end());
}

Vector draw_normal(std::mt19937_64& random, const RawEllipsoid& a, const RawEllipsoid& b) {
  const Vector any = draw_direction(random);
  const auto kind = random() % 3;
  if (kind == 0) return any;
  Vector axis = axes_of(random() % 2 ? a : b)[random() % 3];
  const Real off = kind == 1 ? 0 : log_uniform(random, 1e-12L, 1);
  for (std::size_t i = 0; i < 3; ++i) axis[i] += off * any[i];
  const Real length = std::sqrt(dot(axis, axis));
  if (!(length > 0.1L)) return any;
  for (Real& c : axis) c /= length;
  return axis;
}

}  // namespace

std::span<const ExtremeFamily> extreme_families() {
  using Shape = ExtremeFamily::Shape;
  static const std::vector<ExtremeFamily> families = [] {
    std::vector<ExtremeFamily> all;
    const std::pair<const char*, Shape> shapes[] = {
        {"needles", Shape::needles}, {"discs", Shape::discs}, {"mixed", Shape::mixed}};
    for (const auto& [name, shape] : shapes) {
      for (const auto& [aspect, text] : {std::pair(1e0, "1"),
                                         {1e1, "10"},
                                         {1e2, "100"},
                                         {1e4, "1e4"},
                                         {1e6, "1e6"},
                                         {1e8, "1e8"}})
        all.push_back({std::string(name) + " of aspect " + text, shape, aspect, 3, 1, 0});
    }
    all.push_back({"size ratio to 1e8, aspect 10", Shape::mixed, 10, 1e8, 1, 0});
    all.push_back({"size ratio to 1e8, aspect 1e8", Shape::mixed, 1e8, 1e8, 1, 0});
    all.push_back({"scale 1e-150, aspect 1e4", Shape::mixed, 1e4, 3, 1e-150, 0});
    all.push_back({"scale 1e150, aspect 1e4", Shape::mixed, 1e4, 3, 1e150, 0});
    all.push_back({"origin 1e12 away, aspect 10", Shape::mixed, 10, 3, 1, 1e12});
    all.push_back({"origin 1e12 away, aspect 1e8", Shape::mixed, 1e8, 3, 1, 1e12});
    return all;
  }();
  return families;
}

std::span<const DeepFamily> deep_families() {
  static const std::vector<DeepFamily> families = {
      {"aspect to 5, overlap to 30 %", 5, 0, 1, 0.3},
      {"aspect to 1.05, any overlap", 1.05, 0, 1, 0},
      {"aspect to 5, any overlap", 5, 0, 1, 0},
      {"aspect to 5, concentric", 5, 0, 0, 0},
      {"aspect to 20, any overlap", 20, 0, 1, 0},
      {"aspect to 20, nearly concentric", 20, 0, 0.05, 0},
      {"aspect to 20, concentric", 20, 0, 0, 0},
      {"aspect to 100, any overlap", 100, 0, 1, 0},
      {"aspect to 1000, any overlap", 1000, 0, 1, 0},
      {"aspect to 1000, concentric", 1000, 0, 0, 0},
  };
  return families;
}

ExtremePairs::ExtremePairs(const ExtremeFamily& family, std::uint64_t seed)
    : family_(family), random_(seed) {}

RawPair ExtremePairs::next() {
  using Shape = ExtremeFamily::Shape;
  RawPair pair;
  const auto body = [&](RawEllipsoid& e, Real size, bool first) {
    const bool is_needle =
        family_.shape == Shape::needles || (family_.shape == Shape::mixed && first);
    const bool any = family_.shape == Shape::mixed && random_() % 2 == 0;
    e.semi_axes = any         ? triaxial(random_, size, family_.aspect)
                  : is_needle ? needle(random_, size, family_.aspect)
                              : disc(random_, size, family_.aspect);
    e.orientation = draw_orientation(random_);
  };
  const Real scale = family_.scale;
  const bool a_is_first = random_() % 2 == 0;
  body(pair.a, scale, a_is_first);
  body(pair.b, scale * log_uniform(random_, 1 / Real(family_.size_ratio), family_.size_ratio),
       !a_is_first);
  const Vector place = draw_direction(random_), n = draw_normal(random_, pair.a, pair.b);
  for (std::size_t i = 0; i < 3; ++i)
    pair.a.centre[i] = static_cast<double>(scale * family_.origin * place[i]);

  const Real least = std::min(smallest(pair.a), smallest(pair.b));
  const Real most = std::max(largest(pair.a), largest(pair.b));
  const Real rho = smallest(pair.a) / largest(pair.a) * smallest(pair.a) +
                   smallest(pair.b) / largest(pair.b) * smallest(pair.b);
  Real gap = log_uniform(random_, 1e-16L * least, 1e6L * most);
  if (random_() % 4 == 0) gap = -log_uniform(random_, std::min(1e-16L * least, rho / 2), rho);
  const Vector point_a = support_point(pair.a, n), point_b = support_point(pair.b, n);
  for (std::size_t i = 0; i < 3; ++i) {
    pair.b.centre[i] = static_cast<double>(pair.a.centre[i] + point_a[i] + gap * n[i] + point_b[i]);
  }
  return pair;
}

DeepPairs::DeepPairs(const DeepFamily& family, std::uint64_t seed)
    : family_(family), random_(seed) {}

RawPair DeepPairs::next() {
  RawPair pair;
  for (RawEllipsoid* e : {&pair.a, &pair.b}) {
    const Real size = e == &pair.a ? 1 : log_uniform(random_, 1 / Real(3), 3);
    e->semi_axes = triaxial(random_, size, log_uniform(random_, 1, family_.aspect));
    e->orientation = draw_orientation(random_);
    e->centre = {};
  }
  const Vector n = draw_direction(random_);
  const Vector point_a = support_point(pair.a, n), point_b = support_point(pair.b, n);
  if (family_.within > 0) {
    const Real overlap =
        uniform(random_, 0, family_.within) * std::min(smallest(pair.a), smallest(pair.b));
    for (std::size_t i = 0; i < 3; ++i)
      pair.b.centre[i] = static_cast<double>(point_a[i] + point_b[i] - overlap * n[i]);
    return pair;
  }
  const Real depth = uniform(random_, family_.least_depth, family_.largest_depth);
  for (std::size_t i = 0; i < 3; ++i)
    pair.b.centre[i] = static_cast<double>(depth * (point_a[i] + point_b[i]));
  return pair;
}

HeaviestPairs::HeaviestPairs(std::uint64_t seed, int range) : random_(seed), range_(range) {}

double HeaviestPairs::magnitude() {
  constexpr double least = std::numeric_limits<double>::denorm_min();
  const auto exponent = static_cast<int>(uniform(random_, -range_, std::min(range_, 1023)));
  const auto mantissa = static_cast<double>(uniform(random_, 1, 2));
  return std::max(least, std::ldexp(mantissa, exponent));
}

double HeaviestPairs::number() { return random_() % 2 == 0 ? magnitude() : -magnitude(); }

RawEllipsoid HeaviestPairs::body() {
  RawEllipsoid e;
  for (double& c : e.centre) c = number();
  for (double& r : e.semi_axes) r = magnitude();
  for (double& q : e.orientation) q = number();
  return e;
}

RawPair HeaviestPairs::next() {
  constexpr double most = std::numeric_limits<double>::max();
  const auto nudged = [&](double x) {
    return std::nextafter(x, random_() % 2 == 0 ? most : -most);
  };
  RawPair pair;
  pair.a = pair.b = body();
  RawEllipsoid& b = pair.b;
  switch (kind_++ % 6) {
    case 0:
      b = body();
      break;
    case 1:
      for (double& c : b.centre) c = random_() % 2 == 0 ? c : nudged(c);
      break;
    case 2:
      b.semi_axes[random_() % 3] *= 1 + 0x1p-52;
      break;
    case 3:
      for (double& r : b.semi_axes) {
        const auto growth = static_cast<int>(random_() % 300);
        if (random_() % 2 == 0) r = std::min(most, std::ldexp(r, growth));
      }
      break;
    case 4: {
      double& q = b.orientation[random_() % 4];
      q = random_() % 2 == 0 ? nudged(q) : q / 2;
      break;
    }
    default:
      for (double& r : b.semi_axes) r = std::min(most, 2 * r);
      b.centre[0] = std::clamp(b.centre[0] + b.semi_axes[0] / 4, -most, most);
  }
  return pair;
}

}  // namespace tangency::families
