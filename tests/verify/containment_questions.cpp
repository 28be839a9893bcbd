// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <utility>

#include <tangency/geometry/containment.hpp>
#include <tangency/geometry/ellipse_containment.hpp>
#include <tangency/tests/verify/questions.hpp>
#include <tangency/verify/oracles/containment.hpp>
#include <tangency/verify/oracles/ellipse.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::questions {
namespace {

using verify::RawEllipse;
using verify::RawEllipsoid;
using verify::Real;

constexpr double kU = kUnitRoundoff;

// What differs between space and the plane.

Ellipsoid body_of(const RawEllipsoid& e) {
  const auto& [c, a, q] = e;
  return Ellipsoid({c[0], c[1], c[2]}, {a[0], a[1], a[2]}, Quaternion(q[0], q[1], q[2], q[3]));
}
Ellipse body_of(const RawEllipse& e) {
  const auto& [c, a, u] = e;
  return Ellipse({c[0], c[1]}, {a[0], a[1]}, {u[0], u[1]});
}
verify::ExactRelation true_relation(const RawEllipsoid& a, const RawEllipsoid& b) {
  return verify::exact_relation(a, b);
}
verify::ExactRelation true_relation(const RawEllipse& a, const RawEllipse& b) {
  return verify::exact_ellipse_relation(a, b).relation;
}
void turn_freely(Source& source, RawEllipsoid& e) {
  for (double& v : e.orientation) v = source.uniform(-1, 1);
}
void turn_freely(Source& source, RawEllipse& e) {
  for (double& v : e.direction) v = source.uniform(-1, 1);
}
void take_turn(const RawEllipsoid& from, RawEllipsoid& e) { e.orientation = from.orientation; }
void take_turn(const RawEllipse& from, RawEllipse& e) { e.direction = from.direction; }
std::array<double, 3> array_of(const Vec3& v) { return {v[0], v[1], v[2]}; }
std::array<double, 2> array_of(const Vec2& v) { return {v[0], v[1]}; }

/// A point of the boundary.
template <class Raw>
auto boundary_point(Source& source, const Raw& e) {
  auto n = body_of(e).centre();
  for (auto& v : n) v = source.uniform(-1, 1) + 0x1p-60;
  return body_of(e).support_point(n);
}

template <class Raw>
struct Nest {
  Raw inner, outer;
};

/// Inside the outer body at a random place, as large as the oracle says that it may be, times
/// `share`.
template <class Raw>
void fit(Source& source, Nest<Raw>& pair, double share) {
  const auto point = boundary_point(source, pair.outer);
  const double off = source.below(3) == 0 ? 0.0 : source.uniform(0, 1);
  for (std::size_t i = 0; i < pair.inner.centre.size(); ++i)
    pair.inner.centre[i] = off * point[static_cast<int>(i)];
  pair.outer.centre = {};
  const auto most = static_cast<double>(verify::margin_truth(pair.inner, pair.outer).low);
  if (!(most > 0)) return;
  for (double& a : pair.inner.semi_axes) a *= share * most;
}

enum Family { kPlain, kExtreme, kClose, kCoaxial, kWhole, kRound, kFar, kTouching, kNotNested };
constexpr int kFamilies = 9;

/// Parallel bodies in whole numbers that touch from inside at an end of an axis: a ball in a ball,
/// the inner body in the smaller one, the outer body around the larger one.
template <class Raw>
Nest<Raw> touching(Source& source) {
  Nest<Raw> pair{};
  const double scale = std::ldexp(1.0, source.whole(40));
  const std::size_t last = pair.inner.semi_axes.size() - 1;
  const int a = 20 + source.below(20), b = 1 + source.below(a - 1);
  pair.outer.semi_axes.fill(scale * a), pair.inner.semi_axes.fill(scale * b);
  for (std::size_t i = 0; i < last; ++i) {
    pair.outer.semi_axes[i] = scale * (a + source.below(10));
    pair.inner.semi_axes[i] = scale * (1 + source.below(b));
  }
  pair.inner.centre[last] = scale * (a - b) * (source.below(2) == 0 ? 1 : -1);
  return pair;
}

template <class Raw>
Nest<Raw> drawn(Source& source, int family) {
  if (family == kTouching) return touching<Raw>(source);
  Nest<Raw> pair{};
  const double aspect = source.log_uniform(1, family == kExtreme ? 1e8 : 100);
  for (double& a : pair.outer.semi_axes) a = source.log_uniform(1 / aspect, 1);
  for (double& a : pair.inner.semi_axes) a = source.log_uniform(1 / aspect, 1);
  turn_freely(source, pair.outer);
  turn_freely(source, pair.inner);
  if (source.below(3) == 0) take_turn(pair.outer, pair.inner);
  if (family == kRound) {
    auto& body = source.below(2) == 0 ? pair.inner : pair.outer;
    std::fill(body.semi_axes.begin(), body.semi_axes.end(), body.semi_axes[0]);
  }
  if (family == kClose) {
    take_turn(pair.outer, pair.inner);
    const double close = source.log_uniform(1e-15, 1e-2);
    for (std::size_t i = 0; i < pair.inner.semi_axes.size(); ++i) {
      pair.inner.semi_axes[i] = pair.outer.semi_axes[i] * (1 - close * source.uniform(0, 1));
      if (source.below(2) == 0)
        pair.inner.centre[i] = close * source.uniform(-1, 1) * pair.outer.semi_axes[i];
    }
    return pair;
  }
  if (family == kCoaxial || family == kWhole) {
    take_turn(pair.outer, pair.inner);
    pair.inner.semi_axes[1] = pair.inner.semi_axes.back();
    pair.outer.semi_axes[1] = pair.outer.semi_axes.back();
    if (family == kWhole) {
      for (double& a : pair.outer.semi_axes) a = 10 + source.below(4);
      for (double& a : pair.inner.semi_axes) a = 10 - source.below(4);
      return pair;
    }
  }
  fit(source, pair,
      source.below(4) == 0 ? 1 - source.log_uniform(1e-16, 1e-3) : source.uniform(0.2, 1));
  if (family == kCoaxial) pair.inner.centre = {};
  if (family == kFar) {
    const double unit = std::ldexp(1.0, source.whole(300));
    for (auto* body : {&pair.inner, &pair.outer}) {
      for (double& a : body->semi_axes) a *= unit;
      for (double& c : body->centre) c = (c + (source.below(2) == 0 ? 0.0 : 1e6)) * unit;
    }
  }
  if (family == kNotNested) {
    for (double& a : pair.inner.semi_axes) a *= source.uniform(1, 3);
  }
  return pair;
}

int sign_of(double x) { return (x > 0) - (x < 0); }

/// Of the inner body in the outer one: 1 in its interior, 0 touching from inside, else -1.
template <class Raw>
int true_side(const Nest<Raw>& pair) {
  const verify::ExactRelation found = true_relation(pair.inner, pair.outer);
  if (found.relation == verify::Relation::a_in_b) return 1;
  const bool touches =
      found.relation == verify::Relation::equal ||
      (found.relation == verify::Relation::internal_touch && found.inner == verify::Inner::a);
  return touches ? 0 : -1;
}

template <class Raw>
double size_of(const Nest<Raw>& pair) {
  double square = 0;
  for (std::size_t i = 0; i < pair.inner.centre.size(); ++i) {
    const double d = pair.inner.centre[i] - pair.outer.centre[i];
    square = std::hypot(square, d);
  }
  return square + std::ranges::max(pair.inner.semi_axes) + std::ranges::max(pair.outer.semi_axes);
}

/// Values at other normals: none is below what the answer says.
template <class Raw, class Found>
bool none_is_below(Source& source, const Nest<Raw>& pair, const Found& found) {
  auto n = found.normal;
  for (int i = 0; i < 12; ++i) {
    const double near = i < 6 ? 1.0 : source.log_uniform(1e-8, 1);
    for (auto& v : n) v = source.uniform(-1, 1) + 0x1p-60;
    if (i >= 6) n = found.normal + near * n;
    if (!(n.norm() > 1e-3)) continue;
    const Real other = verify::clearance_at(pair.inner, pair.outer, array_of(n));
    if (other < Real(found.clearance) - found.clearance_error) return false;
  }
  return true;
}

/// Its own words about the witness points: on a common normal, as far apart as it says.
template <class Raw, class Found>
bool witnesses_agree(const Nest<Raw>& pair, const Found& found) {
  const double size = size_of(pair);
  auto apart = found.arm_outer;
  for (std::size_t i = 0; i < pair.inner.centre.size(); ++i) {
    const auto k = static_cast<int>(i);
    apart[k] += (pair.outer.centre[i] - pair.inner.centre[i]) - found.arm_inner[k];
  }
  return std::abs(apart.dot(found.normal) - found.clearance) <=
             32 * kU * size + found.clearance_error &&
         std::abs(found.normal.norm() - 1) <= 8 * kU;
}

template <class Raw>
bool clearances(const char* what, Source& source, long count) {
  Tally tally{what};
  long local = 0, shown = 0, to_show = 0;
  for (long i = 0; i < count; ++i) {
    const int family = source.below(kFamilies);
    const Nest<Raw> pair = drawn<Raw>(source, family);
    const auto found = clearance(body_of(pair.inner), body_of(pair.outer));
    const int side = true_side(pair);
    const double c = found.clearance, error = found.clearance_error;
    // The branch that the normal is on, to all digits; and, for one body in the other, a proof that
    // no branch is lower but by what the oracle's doubles cannot tell.
    const Real near = side == 0
                          ? Real(0)
                          : verify::clearance_near(pair.inner, pair.outer, array_of(found.normal));
    const double least = std::ranges::min(pair.outer.semi_axes);
    // Minima that tie along a circle take boxes all along it.
    const bool tie = family == kCoaxial || family == kWhole || family == kRound;
    const double off = (tie ? 1e-3 : 1e-6) * least, bar = (c - error) - off;
    if (family != kExtreme && family != kFar && side > 0 && bar > 10 * off) {
      ++to_show;
      shown += verify::clearance_is_at_least(pair.inner, pair.outer, bar);
    }
    local += found.status == GapStatus::local;
    tally.special += side == 0;
    const bool narrow = found.status == GapStatus::local || error <= 100 * kU * size_of(pair);
    const double share = side == 0 ? (c == 0 ? 0.0 : 2.0) : share_of(Real(near - c), error);
    const bool kept = sign_of(c) == side && narrow && none_is_below(source, pair, found) &&
                      witnesses_agree(pair, found);
    if (!kept || !(share <= 1)) {
      std::printf("  family %d: clearance %.17g +- %.3g, truth near it %.20g, side %d, status %d\n",
                  family, c, error, static_cast<double>(near), side,
                  static_cast<int>(found.status));
    }
    tally.see(kept, share);
  }
  std::printf("  %ld local; of %ld lower bounds %ld are proven by distances\n", local, to_show,
              shown);
  return tally.print("touches", count / 40) && local <= count / 50 && shown * 20 >= to_show * 19;
}

template <class Raw>
bool margins(const char* what, Source& source, long count) {
  Tally tally{what};
  for (long i = 0; i < count; ++i) {
    const Nest<Raw> pair = drawn<Raw>(source, source.below(kFamilies));
    const ContainmentMargin found = containment_margin(body_of(pair.inner), body_of(pair.outer));
    const verify::MarginTruth truth = verify::margin_truth(pair.inner, pair.outer);
    const int side = true_side(pair);
    tally.special += side == 0;
    const bool known = truth.high - truth.low <= Real("1e-60") * truth.high;
    const bool narrow = found.margin_error <= 4 * kU * found.margin;
    // Of the bits of the truth none is left where it is 1.
    const double share = side == 0
                             ? (found.margin == 1 && abs(truth.low - 1) < Real("1e-60") ? 0.0 : 2.0)
                             : share_of(Real(truth.low - found.margin), found.margin_error);
    tally.see(known && narrow && sign_of(found.margin - 1) == side, share);
  }
  return tally.print("touches", count / 40);
}

}  // namespace

bool check_clearances(Source& source, long count) {
  return clearances<RawEllipsoid>("clearance", source, count);
}
bool check_margins(Source& source, long count) {
  return margins<RawEllipsoid>("margin", source, count);
}
bool check_plane_clearances(Source& source, long count) {
  return clearances<RawEllipse>("clearance in the plane", source, count);
}
bool check_plane_margins(Source& source, long count) {
  return margins<RawEllipse>("margin in the plane", source, count);
}

}  // namespace tangency::questions
