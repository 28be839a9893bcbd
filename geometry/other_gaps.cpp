// SPDX-License-Identifier: MIT
#include <tangency/geometry/other_gaps.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <tangency/geometry/bodies/scaled_pair.hpp>
#include <tangency/geometry/normals/precise_perram_wertheim.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0 {
namespace {

using detail::Direction;
using detail::DoubleDouble;
using detail::PerramWertheimPoint;
using detail::PreciseShape;
using detail::Rough;
using detail::Vector3;
using detail::WideFloat;
using AskedPair = detail::AskedPair<Ellipsoid>;
using UnitPair = detail::UnitPair<Ellipsoid>;

// Of L, what the errors of a normal or of a point before its rounding may come to: two of them, and
// what else is rounded, stay below u L / 64 (docs/derivations/other-gaps.md).
constexpr double kOfSize = 0x1p-61;

// Of the factor and of its root: twice 2^-61, some epsilons and their rounding (section 5).
constexpr double kOfFactor = (1.0 + 0x1p-6) * kUnitRoundoff;
constexpr double kDenormal = std::numeric_limits<double>::denorm_min();

constexpr double kOfValue =
    0x1p8;  // of L, in units of epsilon: evaluation of a gap (sections 3, 4)
constexpr double kRoundedUp = 1.0 + 0x1p-40;  // covers the roundings of a bound in doubles

constexpr double kTurned = 0x1p7;  // of R'v over |v|, in units of the arithmetic's epsilon
constexpr double kOfFoot = 1.5;    // of the foot over |z|, for a turn of the line: sqrt(2)

/// Both bodies in one unit, and what was found between them.
template <class T>
struct Found {
  const PreciseShape<T>& a;
  const PreciseShape<T>& b;
  Vector3<T> d;
  Rough<T> size;  ///< L
  const PerramWertheimPoint<T>& at;
};

/// What is measured; nothing where it is not known well enough.
template <class Measure>
using Measured = std::optional<typename Measure::Answer>;

OtherGap nothing(OtherGapStatus status) {
  return {0.0, Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), status, 0.0};
}

template <class T>
Vector3<T> unit(const Vector3<T>& v) {
  return (T(1.0) / length(v)) * v;
}

/// @param off  bounds |gap - true gap|
template <class T>
OtherGap rounded(const T& gap, const Vector3<T>& normal, const Vector3<T>& arm_a,
                 const Vector3<T>& arm_b, const Rough<T>& off) {
  const auto value = static_cast<double>(gap);
  const double error =
      kRoundedUp * (kUnitRoundoff * std::abs(value) + static_cast<double>(off)) + 2.0 * kDenormal;
  return {value,
          detail::rounded(normal),
          detail::rounded(arm_a),
          detail::rounded(arm_b),
          OtherGapStatus::ok,
          error};
}

/// What both gaps have in common.
struct AnyGap {
  using Answer = OtherGap;
  static Answer of_coinciding_centres() { return nothing(OtherGapStatus::not_applicable); }
  static Answer not_converged() { return nothing(OtherGapStatus::not_converged); }
};

struct BetweenTangentPlanes : AnyGap {
  template <class T>
  std::optional<OtherGap> operator()(const Found<T>& pair) const {
    using R = Rough<T>;
    const R allowed = R(kOfSize) * pair.size;
    const R of_arm_a = R(pair.a.body.largest_semi_axis()) * pair.at.turn_a;
    const R of_arm_b = R(pair.b.body.largest_semi_axis()) * pair.at.turn_b;
    if (!(pair.at.turn < R(kOfSize)) || !(of_arm_a < allowed) || !(of_arm_b < allowed)) {
      return std::nullopt;
    }
    const Vector3<T> n = unit(pair.at.v);
    const Vector3<T> y_a = pair.a.stretched(n), y_b = pair.b.stretched(n);
    const T h_a = length(y_a), h_b = length(y_b), one = 1.0;
    const R off = (pair.at.turn + R(kOfValue * detail::Arithmetic<T>::kEpsilon)) * pair.size;
    return rounded(dot(n, pair.d) - h_a - h_b, n, pair.a.spread((one / h_a) * y_a),
                   -pair.b.spread((one / h_b) * y_b), off);
  }
};

struct AlongTheNormal : AnyGap {
  /// Where the line leaves a body.
  template <class T>
  struct End {
    enum { known, misses, unknown } is = unknown;
    Vector3<T> arm;
    Rough<T> off;  ///< bounds |the error of arm|
  };

  /// In the coordinates that make the body the unit ball the line is z + t e.
  /// @param off   bounds |the error of z|
  /// @param sign  1: the last point in the body, -1: the first
  template <class T>
  static End<T> end(const PreciseShape<T>& body, const Vector3<T>& z, const Rough<T>& off,
                    double sign, const Found<T>& pair) {
    using std::abs, std::sqrt;
    using R = Rough<T>;
    const auto rough = [](const T& v) { return detail::Arithmetic<T>::rough(v); };
    const Vector3<T> w = body.in_ball(pair.at.v);
    const T length_w = length(w);
    const Vector3<T> e = (T(1.0) / length_w) * w;
    const Vector3<T> foot = z + -dot(z, e) * e;
    const T square = dot(foot, foot), room = T(1.0) - square;

    const R two = 2.0, slack = detail::kSlack;
    const R of_v = slack * pair.at.turn + R(kTurned * detail::Arithmetic<T>::kEpsilon);
    const R turn =
        of_v * rough(length(pair.at.v)) / (R(body.body.smallest_semi_axis()) * rough(length_w));
    const R of_foot = slack * (off + R(kOfFoot) * rough(length(z)) * turn);
    const R of_room = of_foot * (two * sqrt(rough(square)) + of_foot);
    if (!(two * of_room < abs(rough(room)))) return {End<T>::unknown, {}, {}};
    if (static_cast<double>(room) < 0.0) return {End<T>::misses, {}, {}};
    const T cosine = sqrt(room);
    const R error = R(body.body.largest_semi_axis()) * (of_foot + turn + of_room / rough(cosine));
    if (!(error < R(kOfSize) * pair.size)) return {End<T>::unknown, {}, {}};
    return {End<T>::known, body.spread(foot + T(sign) * cosine * e), error};
  }

  template <class T>
  std::optional<OtherGap> operator()(const Found<T>& pair) const {
    const int unit_exponent = pair.at.exponent;
    const auto at_a = end(pair.a, scaled_by_power(pair.at.y_a, unit_exponent),
                          scaled_by_power(pair.at.off_a, unit_exponent), 1.0, pair);
    if (at_a.is == at_a.misses) return nothing(OtherGapStatus::not_applicable);
    const auto at_b = end(pair.b, -scaled_by_power(pair.at.y_b, unit_exponent),
                          scaled_by_power(pair.at.off_b, unit_exponent), -1.0, pair);
    if (at_b.is == at_b.misses) return nothing(OtherGapStatus::not_applicable);
    if (!(pair.at.turn < Rough<T>(kOfSize)) || at_a.is == at_a.unknown || at_b.is == at_b.unknown) {
      return std::nullopt;
    }
    const Vector3<T> n = unit(pair.at.v);
    using R = Rough<T>;
    const R of_value = R(kOfValue * detail::Arithmetic<T>::kEpsilon);
    const R off = at_a.off + at_b.off + (pair.at.turn * pair.at.turn + of_value) * pair.size;
    return rounded(dot(n, pair.d + at_b.arm + -at_a.arm), n, at_a.arm, at_b.arm, off);
  }
};

/// F is the level of both bodies at the point, |y_a|^2.
struct OfSizes {
  using Answer = PerramWertheimFactor;
  static Answer of_coinciding_centres() { return {0.0, 0.0, 0.0, 0.0, OtherGapStatus::ok}; }
  static Answer not_converged() { return {0.0, 0.0, 0.0, 0.0, OtherGapStatus::not_converged}; }

  template <class T>
  std::optional<Answer> operator()(const Found<T>& pair) const {
    if (!(pair.at.turn_a < Rough<T>(kOfSize))) return std::nullopt;
    const T level = dot(pair.at.y_a, pair.at.y_a);
    const int exponent = pair.at.exponent;
    const auto factor = static_cast<double>(scaled_by_power(level, 2 * exponent));
    const auto scale = static_cast<double>(scaled_by_power(sqrt(level), exponent));
    const auto error = [](double value) { return kOfFactor * value + 2.0 * kDenormal; };
    return Answer{factor, scale, error(factor), error(scale), OtherGapStatus::ok};
  }
};

/// @param ratio  l, as find_perram_wertheim_point() takes and leaves it
template <class Measure, class T>
Measured<Measure> measured(const Ellipsoid& a, const Ellipsoid& b, const Direction<T>& d,
                           double& ratio) {
  const PreciseShape<T> shape_a(a), shape_b(b);
  const auto at = detail::find_perram_wertheim_point<T>(shape_a, shape_b, d, ratio);
  if (!at) return std::nullopt;
  const Vector3<T> separation = scaled_by_power(d.vector, d.exponent);
  const Rough<T> distance = detail::Arithmetic<T>::rough(length(separation));
  const Rough<T> size =
      distance + Rough<T>(a.largest_semi_axis()) + Rough<T>(b.largest_semi_axis());
  return Measure()(Found<T>{shape_a, shape_b, separation, size, *at});
}

Direction<DoubleDouble> direction(const Vec3& d, const Vec3& d_low) {
  Vector3<DoubleDouble> v;
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = {d[static_cast<int>(i)], d_low[static_cast<int>(i)]};
  }
  return detail::direction<DoubleDouble>(v);
}

/// c_B - c_A in the unit of the pair.
Direction<DoubleDouble> separation_of(const UnitPair& pair) {
  const Vec3 d = pair.asked.d();
  if (!d.allFinite()) return direction(pair.d, pair.rest_of_d());
  // d itself: in the unit of large bodies a small one would lose digits.
  Direction<DoubleDouble> between = direction(d, pair.asked.rest_of(d));
  between.exponent -= pair.exponent;
  return between;
}
Direction<WideFloat> separation_of(const AskedPair& asked) {
  const auto component = [&](int i) {
    return asked.separation != nullptr
               ? WideFloat((*asked.separation)[i])
               : WideFloat(asked.b.centre()[i]) - WideFloat(asked.a.centre()[i]);
  };
  return detail::direction<WideFloat>({component(0), component(1), component(2)});
}

/// Are the bodies those that were asked about? Scaling makes the thinnest axes thicker.
bool as_asked(const UnitPair& pair) {
  const auto& [a, b, separation] = pair.asked;
  const double thinnest = std::min(a.smallest_semi_axis(), b.smallest_semi_axis());
  return pair.in_own_unit() || scaled_by_power(thinnest, -pair.exponent) >= detail::kThinnestAxis;
}

PerramWertheimFactor scaled_back(const PerramWertheimFactor& found, int) { return found; }
OtherGap scaled_back(const OtherGap& found, int exponent) {
  // In the caller's unit gap and error may be subnormal, and so rounded.
  const double error = scaled_by_power(found.gap_error, exponent);
  return {scaled_by_power(found.gap, exponent),
          found.normal,
          scaled_by_power(found.arm_a, exponent),
          scaled_by_power(found.arm_b, exponent),
          found.status,
          exponent == 0 || found.status != OtherGapStatus::ok ? error : error + 2.0 * kDenormal};
}

template <class Measure>
typename Measure::Answer answer(const AskedPair& asked) {
  const bool coincide = asked.separation != nullptr ? *asked.separation == Vec3::Zero()
                                                    : asked.a.centre() == asked.b.centre();
  if (coincide) return Measure::of_coinciding_centres();
  double ratio = 0.0;
  const Vec3 d = asked.d();
  const UnitPair pair(asked, d, detail::moderate(asked.a, asked.b, d));
  if (as_asked(pair)) {
    if (const auto found = measured<Measure>(pair.a, pair.b, separation_of(pair), ratio))
      return scaled_back(*found, pair.exponent);
  }
  return measured<Measure>(asked.a, asked.b, separation_of(asked), ratio)
      .value_or(Measure::not_converged());
}

}  // namespace

PerramWertheimFactor perram_wertheim_factor(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return in_default_environment([&] { return answer<OfSizes>({a, b}); });
}

PerramWertheimFactor perram_wertheim_factor(const Ellipsoid& a, const Ellipsoid& b,
                                            const Vec3& separation) noexcept {
  contract::require_finite("perram_wertheim_factor", "separation", separation);
  return in_default_environment([&] { return answer<OfSizes>({a, b, &separation}); });
}

PerramWertheimFactor perram_wertheim_factor(const MatrixEllipsoid& a,
                                            const MatrixEllipsoid& b) noexcept {
  PerramWertheimFactor found = perram_wertheim_factor(a.ellipsoid(), b.ellipsoid());
  const double off = std::max(a.relative_rounding(), b.relative_rounding());
  if (off == 0.0 || found.status != OtherGapStatus::ok) return found;
  return in_default_environment([&] {
    // Section 5; 1.01 is for rounding here, and leaves room for a relative error below 2^-8.
    if (!(off < 0x1p-8)) {
      found.factor_error = found.scale_error = std::numeric_limits<double>::infinity();
      return found;
    }
    const double error =
        1.01 * (found.scale_error + off * (1.0 + found.scale + found.scale_error) / (1.0 - off));
    found.factor_error += 1.01 * error * (2.0 * (found.scale + found.scale_error) + error);
    found.scale_error = error + 2.0 * kDenormal;
    return found;
  });
}

OtherGap perram_wertheim_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return in_default_environment([&] { return answer<BetweenTangentPlanes>({a, b}); });
}

OtherGap perram_wertheim_gap(const Ellipsoid& a, const Ellipsoid& b,
                             const Vec3& separation) noexcept {
  contract::require_finite("perram_wertheim_gap", "separation", separation);
  return in_default_environment([&] { return answer<BetweenTangentPlanes>({a, b, &separation}); });
}

OtherGap midpoint_potential_gap(const Ellipsoid& a, const Ellipsoid& b) noexcept {
  return in_default_environment([&] { return answer<AlongTheNormal>({a, b}); });
}

OtherGap midpoint_potential_gap(const Ellipsoid& a, const Ellipsoid& b,
                                const Vec3& separation) noexcept {
  contract::require_finite("midpoint_potential_gap", "separation", separation);
  return in_default_environment([&] { return answer<AlongTheNormal>({a, b, &separation}); });
}

}  // namespace tangency::inline v0
