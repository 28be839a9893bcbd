// SPDX-License-Identifier: MIT
/// @file
/// A line against the surface of an ellipsoid in exact integers. Internal (GMP).
///
/// With the form F of the body and x(t) = origin + t direction the level x(t)' F x(t) is
/// C0 + 2 C1 t + C2 t^2, up to units, with C2 > 0: negative inside the body.
/// Every sign is that of the stored doubles.
#pragma once

#include <array>

#include <tangency/geometry/bodies/rational_solid.hpp>
#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>

namespace tangency::inline v0::exact {

class RayForm {
 public:
  /// @param direction  not 0
  RayForm(const Ellipsoid& body, const Vec3& origin, const Vec3& direction);
  /// Of a body given by a matrix.
  /// @param rounded  that body by doubles: for the digits of hit(), of no sign
  RayForm(const RationalSolid<3>& body, const Ellipsoid& rounded, const Vec3& origin,
          const Vec3& direction);

  /// 1 where the line meets the interior, 0 where it touches, -1 where it misses.
  int discriminant_sign() const { return sgn(discriminant_); }
  /// -1 inside the body, 0 on its surface.
  int level_sign(double t) const;
  /// Of the level's derivative: -1 before the middle of the chord.
  int slope_sign(double t) const;

  struct Hit {
    detail::DoubleDouble
        t;        ///< within 2^-100 of the distance of origin and body over the direction's
    Vec3 normal;  ///< unit, outwards, rounded
  };
  /// Requires discriminant_sign() >= 0.
  /// @param side      -1 the first, 1 the second, 0 the middle of the chord: the touch of a tangent
  /// @param exponent  the answer is t / 2^exponent
  Hit hit(int side, int exponent) const;

 private:
  using IntegerVector = std::array<mpz_class, 3>;

  RayForm(int exponent, const Ellipsoid& body, const Vec3& origin, const Vec3& direction);
  /// @param form  in coordinates x / 2^exponent, of which origin has integers
  RayForm(IntegerForm<4> form, int exponent, const Ellipsoid& body, const Vec3& origin,
          const Vec3& direction);

  IntegerForm<4> form_;
  IntegerVector origin_, direction_;
  int unit_;          ///< C0, C1, C2 belong to t 2^unit_
  mp_bitcnt_t bits_;  ///< after the point, of t 2^unit_
  mpz_class c0_, c1_, c2_, discriminant_;
};

}  // namespace tangency::inline v0::exact
