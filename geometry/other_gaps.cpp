// SPDX-License-Identifier: MIT
#include <tangency/geometry/other_gaps.hpp>

#include <cmath>
#include <cstdint>
#include <optional>

#include <tangency/geometry/bodies/scaled_pair.hpp>
#include <tangency/geometry/normals/precise_perram_wertheim.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/numbers/power_of_two.hpp>

namespace tangency {
namespace {

using detail::Direction;
using detail::DoubleDouble;
using detail::EqualLevel;
using detail::Rough;
using detail::ShapeIn;
using detail::VectorOf;
using detail::WideFloat;

// Of L, what the errors of a normal or of a point before its rounding may come to: two of them, and
// what else is rounded, stay below u L / 64 (docs/derivations/other-gaps.md).
constexpr double kOfSize = 0x1p-61;

constexpr double kTurned = 0x1p7;  // of R'v over |v|, in units of the arithmetic's epsilon
constexpr double kOfFoot = 1.5;    // of the foot over |z|, for a turn of the line: sqrt(2)

/// Both bodies in one unit, and what was found between them.
template <class T>
struct Found {
  const ShapeIn<T>& a;
  const ShapeIn<T>& b;
  VectorOf<T> d;
  Rough<T> size;  ///< L
  const EqualLevel<T>& at;
};

/// What is measured; nothing where it is not known well enough.
using Measured = std::optional<OtherGap>;

OtherGap nothing(OtherGapStatus status) {
  return {0.0, Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), status};
}

double as_double(const DoubleDouble& v) { return v.high; }
double as_double(const WideFloat& v) { return static_cast<double>(v); }

double scaled(double v, int power) { return std::scalbn(v, power); }
DoubleDouble scaled(const DoubleDouble& v, int power) {
  return {std::scalbn(v.high, power), std::scalbn(v.low, power)};
}
WideFloat scaled(const WideFloat& v, int power) { return v.scaled(power); }

template <class T>
VectorOf<T> scaled(const VectorOf<T>& v, int power) {
  return {scaled(v[0], power), scaled(v[1], power), scaled(v[2], power)};
}

template <class T>
VectorOf<T> unit(const VectorOf<T>& v) {
  return (T(1.0) / length(v)) * v;
}

template <class T>
OtherGap rounded(const T& gap, const VectorOf<T>& normal, const VectorOf<T>& arm_a,
                 const VectorOf<T>& arm_b) {
  return {as_double(gap), detail::rounded(normal), detail::rounded(arm_a), detail::rounded(arm_b),
          OtherGapStatus::ok};
}

struct BetweenTangentPlanes {
  template <class T>
  Measured operator()(const Found<T>& pair) const {
    using R = Rough<T>;
    const R allowed = R(kOfSize) * pair.size;
    const R of_arm_a = R(pair.a.body.largest_semi_axis()) * pair.at.turn_a;
    const R of_arm_b = R(pair.b.body.largest_semi_axis()) * pair.at.turn_b;
    if (!(pair.at.turn < R(kOfSize)) || !(of_arm_a < allowed) || !(of_arm_b < allowed)) {
      return std::nullopt;
    }
    const VectorOf<T> n = unit(pair.at.v);
    const VectorOf<T> y_a = pair.a.stretched(n), y_b = pair.b.stretched(n);
    const T h_a = length(y_a), h_b = length(y_b), one = 1.0;
    return rounded(dot(n, pair.d) - h_a - h_b, n, pair.a.spread((one / h_a) * y_a),
                   -pair.b.spread((one / h_b) * y_b));
  }
};

struct AlongTheNormal {
  /// Where the line leaves a body.
  template <class T>
  struct End {
    enum { known, misses, unknown } is = unknown;
    VectorOf<T> arm;
  };

  /// In the coordinates that make the body the unit ball the line is z + t e.
  /// @param off   bounds |the error of z|
  /// @param sign  1: the last point in the body, -1: the first
  template <class T>
  static End<T> end(const ShapeIn<T>& body, const VectorOf<T>& z, const Rough<T>& off, double sign,
                    const Found<T>& pair) {
    using std::abs, std::sqrt;
    using R = Rough<T>;
    const auto rough = [](const T& v) { return detail::Arithmetic<T>::rough(v); };
    const VectorOf<T> w = body.in_ball(pair.at.v);
    const T length_w = length(w);
    const VectorOf<T> e = (T(1.0) / length_w) * w;
    const VectorOf<T> foot = z + -dot(z, e) * e;
    const T square = dot(foot, foot), room = T(1.0) - square;

    const R two = 2.0, slack = detail::kSlack;
    const R of_v = slack * pair.at.turn + R(kTurned * detail::Arithmetic<T>::kEpsilon);
    const R turn =
        of_v * rough(length(pair.at.v)) / (R(body.body.smallest_semi_axis()) * rough(length_w));
    const R of_foot = slack * (off + R(kOfFoot) * rough(length(z)) * turn);
    const R of_room = of_foot * (two * sqrt(rough(square)) + of_foot);
    if (!(two * of_room < abs(rough(room)))) return {End<T>::unknown, {}};
    if (as_double(room) < 0.0) return {End<T>::misses, {}};
    const T cosine = sqrt(room);
    const R error = of_foot + turn + of_room / rough(cosine);
    if (!(R(body.body.largest_semi_axis()) * error < R(kOfSize) * pair.size)) {
      return {End<T>::unknown, {}};
    }
    return {End<T>::known, body.spread(foot + T(sign) * cosine * e)};
  }

  template <class T>
  Measured operator()(const Found<T>& pair) const {
    const int unit_exponent = pair.at.exponent;
    const auto at_a = end(pair.a, scaled(pair.at.y_a, unit_exponent),
                          scaled(pair.at.off_a, unit_exponent), 1.0, pair);
    if (at_a.is == at_a.misses) return nothing(OtherGapStatus::not_applicable);
    const auto at_b = end(pair.b, -scaled(pair.at.y_b, unit_exponent),
                          scaled(pair.at.off_b, unit_exponent), -1.0, pair);
    if (at_b.is == at_b.misses) return nothing(OtherGapStatus::not_applicable);
    if (!(pair.at.turn < Rough<T>(kOfSize)) || at_a.is == at_a.unknown || at_b.is == at_b.unknown) {
      return std::nullopt;
    }
    const VectorOf<T> n = unit(pair.at.v);
    return rounded(dot(n, pair.d + at_b.arm + -at_a.arm), n, at_a.arm, at_b.arm);
  }
};

/// @param ratio  l, as find_equal_level() takes and leaves it
template <class T, class Measure>
Measured solve(const Ellipsoid& a, const Ellipsoid& b, const Direction<T>& d, double& ratio,
               const Measure& measure) {
  const ShapeIn<T> shape_a(a), shape_b(b);
  const auto at = detail::find_equal_level<T>(shape_a, shape_b, d, ratio);
  if (!at) return std::nullopt;
  const VectorOf<T> separation = scaled(d.vector, d.exponent);
  const Rough<T> distance = detail::Arithmetic<T>::rough(length(separation));
  const Rough<T> size =
      distance + Rough<T>(a.largest_semi_axis()) + Rough<T>(b.largest_semi_axis());
  return measure(Found<T>{shape_a, shape_b, separation, size, *at});
}

Direction<DoubleDouble> direction(const Vec3& d, const Vec3& d_low) {
  VectorOf<DoubleDouble> v;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = {d[static_cast<int>(i)], d_low[static_cast<int>(i)]};
  }
  return detail::direction<DoubleDouble>(v);
}

/// In the unit of the bodies as given, times 2^exponent.
template <class Measure>
Measured solve_in_unit(const Ellipsoid& a, const Ellipsoid& b, const Direction<DoubleDouble>& d,
                       int exponent, double& ratio, const Measure& measure) {
  Measured result = solve<DoubleDouble>(a, b, d, ratio, measure);
  if (!result || exponent == 0) return result;
  result->gap = std::scalbn(result->gap, exponent);
  for (Vec3* arm : {&result->arm_a, &result->arm_b}) {
    for (double& component : *arm) component = std::scalbn(component, exponent);
  }
  return result;
}

/// @param separation  null: that of the centres
template <class Measure>
Measured by_double_double(const Ellipsoid& a, const Ellipsoid& b, const Vec3* separation,
                          double& ratio, const Measure& measure) {
  const Vec3 d = separation != nullptr ? *separation : Vec3(b.centre() - a.centre());
  const Vec3 d_low = separation != nullptr ? Vec3(Vec3::Zero())
                                           : detail::separation_error(a.centre(), b.centre(), d);
  if (detail::moderate(a, b, d)) {
    return solve_in_unit(a, b, direction(d, d_low), 0, ratio, measure);
  }
  const detail::ScaledPair pair =
      separation != nullptr ? detail::scaled_pair(a, b, d) : detail::scaled_pair(a, b);
  // d itself, unless it overflows: in the unit of large bodies a small d would lose digits.
  Direction<DoubleDouble> between = direction(pair.d, pair.d_low);
  if (d.allFinite()) {
    between = direction(d, d_low);
    between.exponent -= pair.exponent;
  }
  return solve_in_unit(pair.a, pair.b, between, pair.exponent, ratio, measure);
}

template <class Measure>
OtherGap answer(const Ellipsoid& a, const Ellipsoid& b, const Vec3* separation,
                const Measure& measure) {
  const auto component = [&](int i) {
    return separation != nullptr ? WideFloat((*separation)[i])
                                 : WideFloat(b.centre()[i]) - WideFloat(a.centre()[i]);
  };
  const bool coincide =
      separation != nullptr ? *separation == Vec3::Zero() : a.centre() == b.centre();
  if (coincide) return nothing(OtherGapStatus::not_applicable);
  double ratio = 0.0;
  Measured result = by_double_double(a, b, separation, ratio, measure);
  if (!result) {
    const VectorOf<WideFloat> d = {component(0), component(1), component(2)};
    result = solve<WideFloat>(a, b, detail::direction<WideFloat>(d), ratio, measure);
  }
  return result.value_or(nothing(OtherGapStatus::not_converged));
}

}  // namespace

OtherGap perram_wertheim_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return in_default_environment([&] { return answer(a, b, nullptr, BetweenTangentPlanes{}); });
}

OtherGap perram_wertheim_gap(const Ellipsoid& a, const Ellipsoid& b,
                             const Vec3& separation) noexcept {
  return in_default_environment([&] { return answer(a, b, &separation, BetweenTangentPlanes{}); });
}

OtherGap midpoint_potential_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return in_default_environment([&] { return answer(a, b, nullptr, AlongTheNormal{}); });
}

OtherGap midpoint_potential_gap(const Ellipsoid& a, const Ellipsoid& b,
                                const Vec3& separation) noexcept {
  return in_default_environment([&] { return answer(a, b, &separation, AlongTheNormal{}); });
}

}  // namespace tangency
