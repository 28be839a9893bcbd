// SPDX-License-Identifier: MIT
#include <tangency/geometry/common_volume.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>

#include <tangency/geometry/bodies/scaled_pair.hpp>
#include <tangency/geometry/numbers/arc_tangent.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/numbers/vector3.hpp>
#include <tangency/geometry/numbers/wide_float.hpp>
#include <tangency/geometry/power_of_two.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/volume/slice_integrals.hpp>

namespace tangency::inline v0 {
namespace {

using detail::CircularSections;
using detail::SliceIntegrals;
using Asked = detail::AskedPair<Ellipsoid>;
using ScaledPair = detail::ScaledPair<Ellipsoid>;

constexpr double kU = kUnitRoundoff;
constexpr double kBall = 4.0 / 3.0 * detail::kPi;
constexpr double kLeastTolerance = 0x1p-46;  // chosen: above the rounding of the sections
constexpr double kLeastNumber = std::numeric_limits<double>::denorm_min();

/// mantissa * 2^exponent, the mantissa in [1, 8).
struct Product {
  double mantissa;
  int exponent;
};
/// Of the semi-axes; within 2 u of itself at any scale.
Product product_of_axes(const Ellipsoid& body) {
  Product p{1.0, 0};
  for (int k = 0; k < 3; ++k) {
    const double axis = body.semi_axes()[k];
    const int exponent = exponent_of(axis);
    p.mantissa *= scaled_by_power(axis, -exponent), p.exponent += exponent;
  }
  return p;
}
double scaled(double value, int exponent) { return std::scalbn(value, exponent); }
/// The same of an error: never 0 where the value is not.
double error_scaled(double error, int exponent) {
  return error > 0.0 ? std::scalbn(error, exponent) + kLeastNumber : 0.0;
}

bool smaller(const Product& p, const Product& q) {
  if (p.exponent == q.exponent) return p.mantissa < q.mantissa;
  const int apart = std::clamp(p.exponent - q.exponent, -8, 8);
  return scaled(p.mantissa, apart) < q.mantissa;
}

/// What a body adds to a key that orders the two of a pair whichever comes first.
auto key(const Ellipsoid& e, const Vec3& d) {
  const Vec3& a = e.semi_axes();
  const Quaternion q = e.orientation();
  return std::make_tuple(a[0], a[1], a[2], q.w(), q.x(), q.y(), q.z(), d[0], d[1], d[2]);
}

/// Is B the first body, which is made a ball: the smaller one?
bool b_is_first(const Asked& asked) {
  const Product a = product_of_axes(asked.a), b = product_of_axes(asked.b);
  if (smaller(a, b)) return false;
  if (smaller(b, a)) return true;
  const Vec3 d = asked.d();
  return key(asked.b, -d) < key(asked.a, d);
}

/// The product of the two longer semi-axes: what errors of a ball's gradient come to at most.
double face(const Ellipsoid& body) {
  const Vec3& a = body.semi_axes();
  return std::max({a[0] * a[1], a[1] * a[2], a[2] * a[0]});
}

/// How far a body given by a matrix may be from the one by doubles, over its size.
struct Roundings {
  double of_a = 0.0, of_b = 0.0;
  double sum() const { return of_a + of_b; }
};

CommonVolume nothing() { return {0.0, 0.0, Vec3::Zero(), 0.0, CommonVolumeStatus::ok}; }

/// @param rounding  of the body, over its size
CommonVolume whole(const Ellipsoid& body, double rounding, double tolerance) {
  const Product p = product_of_axes(body);
  const double relative = 6.0 * kU + 3.1 * rounding, volume = kBall * p.mantissa;
  // A body that is known to a tenth is held to have nothing but its bounds.
  const double error = rounding < 0.03 ? relative * volume : 8.0 * (1.0 + rounding) * volume;
  return {scaled(volume, p.exponent), error_scaled(error, p.exponent), Vec3::Zero(), 0.0,
          error <= tolerance * volume ? CommonVolumeStatus::ok
                                      : CommonVolumeStatus::tolerance_not_reached};
}

bool usable(const SliceIntegrals& s) {
  constexpr double most = std::numeric_limits<double>::max();
  return s.volume_error < most && s.gradient_error < most && std::isfinite(s.volume) &&
         s.gradient.allFinite();
}

/// Are the errors within the tolerance of the ball's volume and of the area of its great circle?
bool within(const SliceIntegrals& s, double tolerance) {
  return s.volume_error <= tolerance * kBall && s.gradient_error <= tolerance * detail::kPi;
}

/// Passes with less and less tolerance, until it is one of the common volume itself.
template <class T>
SliceIntegrals sliced(const CircularSections<T>& bodies, double tolerance) {
  constexpr int kMostPasses = 4;
  double of_volume = tolerance * kBall, of_area = tolerance * detail::kPi;
  SliceIntegrals found = slice_integrals(bodies, of_volume, of_area);
  for (int pass = 1; pass < kMostPasses && usable(found); ++pass) {
    const bool done = found.volume_error <= tolerance * found.volume;
    if (done || found.volume_error > 2.0 * of_volume) break;
    of_volume = std::min(of_volume, tolerance * (found.volume + found.volume_error));
    of_area = std::min(of_area, tolerance * (found.gradient.norm() + found.gradient_error));
    const SliceIntegrals next = slice_integrals(bodies, of_volume, of_area);
    if (!(usable(next) && next.volume_error < found.volume_error)) break;
    found = next;
  }
  return found;
}

/// A pair in one unit, the smaller body first.
struct Ordered {
  const Ellipsoid &first, &second;
  Vec3 d, d_low;  ///< from the centre of the first to that of the second: their sum
  double distortion;

  template <class T>
  CircularSections<T> sections() const {
    detail::Vector3<T> between;
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = static_cast<int>(k);
      between[k] = T(d[i]) + T(d_low[i]);
    }
    CircularSections<T> result = detail::circular_sections<T>(first, second, between);
    result.distortion += distortion;
    return result;
  }
};

/// In double-double; in 512 bits where that does not suffice for the tolerance and more digits can.
SliceIntegrals sliced(const Ordered& pair, double tolerance) {
  constexpr double kHopeless = 16.0;  // chosen: distortions come in with a factor of up to 12
  const double asked = std::max(tolerance, kLeastTolerance);
  const SliceIntegrals found = sliced(pair.sections<detail::DoubleDouble>(), asked);
  if (usable(found) && within(found, asked)) return found;
  if (kHopeless * pair.distortion > asked) return found;
  const SliceIntegrals wide = sliced(pair.sections<detail::WideFloat>(), asked);
  return usable(wide) && !(wide.volume_error > found.volume_error) ? wide : found;
}

CommonVolume unknown(const Ellipsoid& smaller_body, double rounding, int exponent,
                     const Ellipsoid& in_unit) {
  CommonVolume all = whole(smaller_body, rounding, 0.0);
  all.volume_error += 0.5 * all.volume, all.volume *= 0.5;
  const double area = detail::kPi * (1.0 + rounding) * (1.0 + rounding) * face(in_unit);
  all.gradient_error = error_scaled(1.01 * area, 2 * exponent);
  return all;
}

CommonVolume overlap_volume(const Asked& asked, const Roundings& roundings, double tolerance) {
  const bool b_first = b_is_first(asked);
  const Ellipsoid& smaller_body = b_first ? asked.b : asked.a;
  const double of_smaller = b_first ? roundings.of_b : roundings.of_a;
  const ScaledPair s = detail::scaled_pair(asked);
  const double sign = b_first ? -1.0 : 1.0;
  const Ordered pair{b_first ? s.b : s.a, b_first ? s.a : s.b, sign * s.d, sign * s.d_low,
                     roundings.sum()};
  const bool thick =
      std::min(s.a.smallest_semi_axis(), s.b.smallest_semi_axis()) > detail::kThinnestAxis;
  if (!thick || !(roundings.sum() < 0.01))
    return unknown(smaller_body, of_smaller, s.exponent, pair.first);
  const SliceIntegrals found = sliced(pair, tolerance);
  if (!usable(found)) return unknown(smaller_body, of_smaller, s.exponent, pair.first);

  const Product p = product_of_axes(smaller_body);
  const double most = kBall * (1.0 + 8.0 * kU), volume = std::clamp(found.volume, 0.0, most);
  const double volume_error = found.volume_error + 8.0 * kU * volume;
  const Vec3 &in_ball = found.gradient, &a = pair.first.semi_axes();
  const Vec3 in_body(a[1] * a[2] * in_ball[0], a[2] * a[0] * in_ball[1], a[0] * a[1] * in_ball[2]);
  const Vec3 gradient = sign * (pair.first.rotation() * in_body);
  const double gradient_error = found.gradient_error + 64.0 * kU * found.gradient.norm();
  CommonVolume result{};
  result.volume =
      std::min(scaled(volume * p.mantissa, p.exponent), scaled(kBall * p.mantissa, p.exponent));
  result.volume_error = error_scaled(volume_error * p.mantissa, p.exponent);
  result.gradient = scaled_by_power(gradient, 2 * s.exponent);
  result.gradient_error = error_scaled(1.01 * gradient_error * face(pair.first), 2 * s.exponent);
  result.status = within({volume, volume_error, found.gradient, gradient_error}, tolerance)
                      ? CommonVolumeStatus::ok
                      : CommonVolumeStatus::tolerance_not_reached;
  return result;
}

CommonVolume answer(const Asked& asked, const RelationAnswer& known, const Roundings& roundings,
                    double tolerance) {
  switch (known.relation) {
    case Relation::separate:
    case Relation::external_touch:
      return nothing();
    case Relation::a_in_b:
      return whole(asked.a, roundings.of_a, tolerance);
    case Relation::b_in_a:
      return whole(asked.b, roundings.of_b, tolerance);
    case Relation::internal_touch:
      return known.inner == Inner::a ? whole(asked.a, roundings.of_a, tolerance)
                                     : whole(asked.b, roundings.of_b, tolerance);
    case Relation::equal:
      return b_is_first(asked) ? whole(asked.b, roundings.of_b, tolerance)
                               : whole(asked.a, roundings.of_a, tolerance);
    case Relation::overlap:
      break;
  }
  return overlap_volume(asked, roundings, tolerance);
}

CommonVolume answer(const Asked& asked, double tolerance) {
  const auto [a, b] = asked.placed();
  return answer(asked, relation(a, b), {}, tolerance);
}

}  // namespace

CommonVolume common_volume(const Ellipsoid& a, const Ellipsoid& b, double tolerance) noexcept {
  return in_default_environment([&] { return answer({a, b}, tolerance); });
}

CommonVolume common_volume(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation,
                           double tolerance) noexcept {
  contract::require_finite("common_volume", "separation", separation);
  return in_default_environment([&] { return answer({a, b, &separation}, tolerance); });
}

CommonVolume common_volume(const MatrixEllipsoid& a, const MatrixEllipsoid& b,
                           double tolerance) noexcept {
  return in_default_environment([&] {
    return answer({a.ellipsoid(), b.ellipsoid()}, relation(a, b),
                  {a.relative_rounding(), b.relative_rounding()}, tolerance);
  });
}

}  // namespace tangency::inline v0
