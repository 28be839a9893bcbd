// SPDX-License-Identifier: MIT
#include <tangency/geometry/plane/lens.hpp>

#include <cmath>
#include <tuple>

#include <tangency/geometry/plane/real_quartic.hpp>

namespace tangency::detail {
namespace {

LensBody lens_body(const Ellipse& e) noexcept {
  return {double_double_direction(e.direction()), e.semi_axes()[0], e.semi_axes()[1]};
}

/// A key that orders the two bodies of a pair, whichever comes first.
auto key(const Ellipse& e, const Vec2& d) {
  const Vec2 &a = e.semi_axes(), &u = e.direction();
  return std::make_tuple(a[0] * a[1], a[0], a[1], u[0], u[1], d[0], d[1]);
}

DoubleDouble level(const DoubleDouble2& y) noexcept { return dot(y, y) - DoubleDouble(1.0); }

/// y with the square of its first component, and so on: coefficients of a square, and of a product.
using Quadratic = std::array<DoubleDouble, 3>;

void add_square(std::array<DoubleDouble, 5>& sum, const Quadratic& q, double weight) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      sum[i + j] = sum[i + j] + DoubleDouble(weight) * (q[i] * q[j]);
    }
  }
}

}  // namespace

DoubleDouble2 LensBody::to_plane(const DoubleDouble2& y) const noexcept {
  return turned(axis, {DoubleDouble(a1) * y.x, DoubleDouble(a2) * y.y});
}

DoubleDouble2 LensBody::from_plane(const DoubleDouble2& x) const noexcept {
  const DoubleDouble2 local = turned_back(axis, x);
  return {local.x / DoubleDouble(a1), local.y / DoubleDouble(a2)};
}

PlaneLens::PlaneLens(const Ellipse& a, const Ellipse& b, const Vec2& d, const Vec2& d_low,
                     exact::Meeting meeting) noexcept
    : first_is_a_(key(a, d) <= key(b, -d)) {
  const DoubleDouble2 between = exactly(d) + exactly(d_low);
  d_ = first_is_a_ ? between : -between;
  body_ = {lens_body(first_is_a_ ? a : b), lens_body(first_is_a_ ? b : a)};
  column_ = {body_[1].from_plane(body_[0].to_plane({1.0, 0.0})),
             body_[1].from_plane(body_[0].to_plane({0.0, 1.0}))};
  shift_ = body_[1].from_plane(d_);
  find_vertices(meeting);
}

DoubleDouble2 PlaneLens::second_frame(const DoubleDouble2& z) const noexcept {
  return (z.x * column_[0] + z.y * column_[1]) - shift_;
}

// With z(w) = (1 - w^2, 2w) / (1 + w^2), seen from the direction `zero`, the level of the second
// body times (1 + w^2)^2 is a quartic in w. Its leading coefficient is the level opposite to
// `zero`, where w is infinite: that is put where the level is largest.
void PlaneLens::find_vertices(exact::Meeting meeting) noexcept {
  if (meeting == exact::Meeting::equal || meeting == exact::Meeting::nowhere) return;
  constexpr int kDirections = 16;
  constexpr double kCosine = 0x1.d906bcf328d46p-1, kSine = 0x1.87de2a6aea963p-2;  // of pi/8
  DoubleDouble2 z{1.0, 0.0}, zero = z;
  double most = -1.0;
  for (int k = 0; k < kDirections; ++k, z = turned({kCosine, kSine}, z)) {
    const double value = std::abs(level(second_frame(z)).high);
    if (value > most) most = value, zero = -z;
  }
  zero = normalised(zero);
  const DoubleDouble2 along = zero.x * column_[0] + zero.y * column_[1];
  const DoubleDouble2 across = zero.x * column_[1] - zero.y * column_[0];
  const DoubleDouble two(2.0), one(1.0);
  std::array<DoubleDouble, 5> quartic{};
  add_square(quartic, {along.x - shift_.x, two * across.x, -(along.x + shift_.x)}, 1.0);
  add_square(quartic, {along.y - shift_.y, two * across.y, -(along.y + shift_.y)}, 1.0);
  add_square(quartic, {one, DoubleDouble(), one}, -1.0);

  const QuarticRoots roots = real_quartic_roots(quartic, meeting);
  for (int i = 0; i < roots.count; ++i) {
    const QuarticRoot& root = roots.root[static_cast<std::size_t>(i)];
    const DoubleDouble square = root.at * root.at, norm = one + square;
    const DoubleDouble2 seen{(one - square) / norm, two * root.at / norm};
    const DoubleDouble2 unit = turned(zero, seen);
    vertex_[static_cast<std::size_t>(count_++)] = {
        {unit, normalised(second_frame(unit))}, body_[0].to_plane(unit), root.multiplicity};
  }
}

DoubleDouble2 arc_middle(const DoubleDouble2& from, const DoubleDouble2& to, bool whole) noexcept {
  const double ahead = cross(from, to).high;
  if (length(to - from).high == 0.0) return whole ? -from : from;
  const DoubleDouble2 sum = from + to;
  if (length(sum).high < 0x1p-20) return normalised(quarter(from - to));
  return normalised(ahead < 0.0 ? -sum : sum);
}

double arc_span(const DoubleDouble2& from, const DoubleDouble2& to, bool whole) noexcept {
  constexpr double kTurn = 0x1.921fb54442d18p+2;
  const double chord = length(to - from).high, sum = length(to + from).high;
  if (chord == 0.0) return whole ? kTurn : 0.0;
  const double span = 2.0 * std::atan2(chord, sum);
  return cross(from, to).high < 0.0 ? kTurn - span : span;
}

double PlaneLens::level_between(int i) const noexcept {
  return level(second_frame(arc_middle((*this)[i].unit[0], next(i).unit[0], is_last(i)))).high;
}

}  // namespace tangency::detail
