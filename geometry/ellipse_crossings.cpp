// SPDX-License-Identifier: MIT
#include <tangency/geometry/ellipse_crossings.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

#include <tangency/geometry/bodies/scaled_pair.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/plane/ellipse_meeting.hpp>
#include <tangency/geometry/plane/lens.hpp>

namespace tangency::inline v0 {
namespace {

using detail::DoubleDouble;
using detail::DoubleDouble2;
using detail::LensBody;
using detail::LensVertex;
using detail::PlaneLens;
using exact::ConicAnswer;
using exact::Meeting;

using Asked = detail::AskedPair<Ellipse>;
using ScaledPair = detail::ScaledPair<Ellipse>;

/// What is exactly known of the pair.
ConicAnswer exact_meeting(const Asked& asked) {
  const auto [a, b] = asked.placed();
  return detail::ellipse_meeting(a, b).answer;
}

PlaneLens lens_of(const ScaledPair& s, Meeting meeting) {
  return PlaneLens(s.a, s.b, s.d, s.d_low, meeting);
}

Crossings crossings(const Asked& asked, Meeting meeting) {
  Crossings result{0, meeting == Meeting::equal, {}};
  const ScaledPair s = detail::scaled_pair(asked);
  const auto in_unit = [&](const DoubleDouble2& v) {
    return scaled_by_power(detail::rounded(v), s.exponent);
  };
  const PlaneLens lens = lens_of(s, meeting);
  for (int i = 0; i < lens.count(); ++i) {
    const DoubleDouble2 near = lens[i].arm, far = near - lens.separation();
    Crossing& crossing = result.at[static_cast<std::size_t>(result.count++)];
    crossing.arm_a = in_unit(lens.first_is_a() ? near : far);
    crossing.arm_b = in_unit(lens.first_is_a() ? far : near);
    crossing.multiplicity = lens[i].multiplicity;
  }
  detail::sort_few(result.at, result.count, [](const Crossing& p, const Crossing& q) {
    return p.arm_a[0] != q.arm_a[0] ? p.arm_a[0] < q.arm_a[0] : p.arm_a[1] < q.arm_a[1];
  });
  return result;
}

/// t - sin t without cancellation, for t in [0, 2 pi].
double span_less_sine(double t) {
  if (t > 1.0) return t - std::sin(t);
  // sum of (-1)^k t^(2k+3) / (2k+3)!, to below rounding at t = 1.
  const double square = t * t;
  double sum = 1.0;
  for (int n = 18; n >= 4; n -= 2) sum = 1.0 - square * sum / (n * (n + 1.0));
  return t * square * sum / 6.0;
}

/// Polygon of the vertices plus the segments between it and the boundary: all of them >= 0.
double area_of(const PlaneLens& lens) {
  double area = 0.0;
  for (int i = 1; i + 1 < lens.count(); ++i) {
    area += 0.5 * detail::cross(lens[i].arm - lens[0].arm, lens[i + 1].arm - lens[0].arm).high;
  }
  for (int i = 0; i < lens.count(); ++i) {
    const std::size_t which = lens.first_bounds(i) ? 0 : 1;
    const LensBody& body = lens.body(which);
    const double span =
        detail::arc_span(lens[i].unit[which], lens.next(i).unit[which], lens.is_last(i));
    area += 0.5 * body.a1 * body.a2 * span_less_sine(span);
  }
  return area;
}

double common_area(const Asked& asked) {
  const ConicAnswer known = exact_meeting(asked);
  switch (known.relation) {
    case Relation::separate:
    case Relation::external_touch:
      return 0.0;
    case Relation::equal:
    case Relation::internal_touch:
    case Relation::a_in_b:
    case Relation::b_in_a:
      return std::min(asked.a.area(), asked.b.area());
    case Relation::overlap:
      break;
  }
  const ScaledPair s = detail::scaled_pair(asked);
  // (3) holds for needles too, whose vertices err by more than they are apart.
  const double area = std::max(area_of(lens_of(s, known.meeting)), 0.0);
  return std::min({std::scalbn(area, 2 * s.exponent), asked.a.area(), asked.b.area()});
}

/// How far from the midpoint of a chord the boundary is along n, which points to the arc's side.
/// @param from, to  the chord's ends in the body's circle frame
double reach(const LensBody& body, const DoubleDouble2& from, const DoubleDouble2& to,
             const DoubleDouble2& n) {
  const DoubleDouble2 middle = DoubleDouble(0.5) * (from + to), e = body.from_plane(n);
  // 1 - |middle|^2, from the chord: no cancellation.
  const DoubleDouble2 half = DoubleDouble(0.5) * (to - from);
  const DoubleDouble below = detail::dot(half, half), along = detail::dot(middle, e);
  const DoubleDouble square = detail::dot(e, e);
  const DoubleDouble root = detail::sqrt(along * along + square * below);
  if (along.high >= 0.0) return (below / (along + root)).high;
  return ((root - along) / square).high;
}

ChordContact chord_contact(const Asked& asked) {
  const Vec2 zero = Vec2::Zero();
  const ChordContact none{ChordStatus::not_applicable, 0.0, zero, zero, zero, zero};
  const Meeting meeting = exact_meeting(asked).meeting;
  if (meeting != Meeting::two_simple && meeting != Meeting::triple_and_simple) return none;
  const ScaledPair s = detail::scaled_pair(asked);
  const PlaneLens lens = lens_of(s, meeting);
  // Of the first body's two arcs the one that is inside the second.
  const int begin = lens.level_between(0) < lens.level_between(1) ? 0 : 1;
  const LensVertex &from = lens[begin], &to = lens.next(begin);
  const DoubleDouble2 chord = to.arm - from.arm;
  if (detail::length(chord).high == 0.0) return none;
  const DoubleDouble2 n = -detail::quarter(detail::normalised(chord));
  const double ahead = reach(lens.body(0), from.unit[0], to.unit[0], n);
  const double back = reach(lens.body(1), from.unit[1], to.unit[1], -n);
  const DoubleDouble2 middle = DoubleDouble(0.5) * (from.arm + to.arm);
  const DoubleDouble2 on_first = middle + DoubleDouble(ahead) * n;
  const DoubleDouble2 on_second = middle - DoubleDouble(back) * n - lens.separation();
  const DoubleDouble2 point = middle + DoubleDouble(0.5 * (ahead - back)) * n;
  const bool straight = lens.first_is_a();
  const auto in_unit = [&](const DoubleDouble2& v) {
    return scaled_by_power(detail::rounded(v), s.exponent);
  };
  return {ChordStatus::ok,
          std::scalbn(ahead + back, s.exponent),
          detail::rounded(straight ? n : -n),
          in_unit(straight ? on_first : on_second),
          in_unit(straight ? on_second : on_first),
          in_unit(straight ? point : point - lens.separation())};
}

}  // namespace

Crossings crossings(const Ellipse& a, const Ellipse& b) noexcept {
  return in_default_environment([&] {
    const Asked asked{a, b};
    return crossings(asked, exact_meeting(asked).meeting);
  });
}
Crossings crossings(const Ellipse& a, const Ellipse& b, const Vec2& separation) noexcept {
  assert(separation.allFinite());
  return in_default_environment([&] {
    const Asked asked{a, b, &separation};
    return crossings(asked, exact_meeting(asked).meeting);
  });
}
Crossings crossings(const MatrixEllipse& a, const MatrixEllipse& b) noexcept {
  if (a.exact() == nullptr && b.exact() == nullptr) return crossings(a.ellipse(), b.ellipse());
  return in_default_environment([&] {
    const ConicAnswer known = exact::conic_relation(exact::conic_form(a), exact::conic_form(b));
    return crossings(Asked{a.ellipse(), b.ellipse()}, known.meeting);
  });
}

double common_area(const Ellipse& a, const Ellipse& b) noexcept {
  return in_default_environment([&] { return common_area(Asked{a, b}); });
}
double common_area(const Ellipse& a, const Ellipse& b, const Vec2& separation) noexcept {
  assert(separation.allFinite());
  return in_default_environment([&] { return common_area(Asked{a, b, &separation}); });
}

ChordContact chord_contact(const Ellipse& a, const Ellipse& b) noexcept {
  return in_default_environment([&] { return chord_contact(Asked{a, b}); });
}
ChordContact chord_contact(const Ellipse& a, const Ellipse& b, const Vec2& separation) noexcept {
  assert(separation.allFinite());
  return in_default_environment([&] { return chord_contact(Asked{a, b, &separation}); });
}

}  // namespace tangency::inline v0
