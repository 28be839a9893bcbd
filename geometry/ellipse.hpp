// SPDX-License-Identifier: MIT
/// @file
/// A solid ellipse in the plane.
///
/// Frame and conventions as for Ellipsoid: a right-handed Cartesian frame; lengths in any one unit;
/// semi-axes in any order; angles in radians, counter-clockwise. The first axis points along a
/// direction u that is not zero and *not necessarily normalised: it means u/|u| exactly*, the
/// second a quarter turn further. The shape matrix
///
///     M = (a1^2 u u' + a2^2 v v') / |u|^2,   v = (-u_y, u_x),
///
/// is rational in the stored doubles, so that every yes/no question about an ellipse has one
/// answer.
#pragma once

#include <optional>
#include <stdexcept>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

/// What is wrong with the numbers of a would-be ellipse: the first offending field by its name in
/// the file formats ("x" "y" "r1" "r2" "ux" "uy" "angle"), its value, and the rule.
struct EllipseFault {
  /// name of the field
  const char* field;
  double value;  ///< the value that breaks the rule
  /// what is allowed
  const char* rule;
};

/// Thrown by the constructors of Ellipse; what() reads "r2 = -1: a semi-axis must be ...".
class InvalidEllipse : public std::invalid_argument {
 public:
  /// With the text "FIELD = VALUE: RULE".
  explicit InvalidEllipse(const EllipseFault& fault);
  /// What is wrong.
  const EllipseFault& fault() const noexcept { return fault_; }

 private:
  EllipseFault fault_;
};

/// A solid ellipse { c + a1 y1 u/|u| + a2 y2 v/|u| : |y| <= 1 }.
///
/// (1) contains(centre()) is true.
/// (2) support(s n) = |s| support(n).
/// (3) support(n) = n . support_point(n), for every n other than 0.
/// (4) A half turn, the direction's power-of-two length, and an exchange of semi-axes with a
/// quarter
///     turn leave the solid as it is.
class Ellipse {
 public:
  /// @param centre     finite
  /// @param semi_axes  finite and > 0, in any order
  /// @param direction  of the first axis: finite, not zero, of any length
  /// @throws InvalidEllipse  naming the first field that breaks its rule
  Ellipse(const Vec2& centre, const Vec2& semi_axes, const Vec2& direction = Vec2(1.0, 0.0));

  /// The direction is (cos, sin) of the angle, each rounded correctly to double.
  /// @param centre  finite
  /// @param semi_axes  of each body, finite and > 0
  /// @param angle  rad, finite
  /// @throws InvalidEllipse
  static Ellipse at_angle(const Vec2& centre, const Vec2& semi_axes, double angle);

  /// The same checks as the constructor's, without an exception: nothing where it would succeed.
  static std::optional<EllipseFault> find_fault(const Vec2& centre, const Vec2& semi_axes,
                                                const Vec2& direction) noexcept;

  /// As given to the constructor.
  const Vec2& centre() const noexcept { return centre_; }
  /// As given to the constructor, both > 0.
  const Vec2& semi_axes() const noexcept { return semi_axes_; }
  /// As given to the constructor.
  const Vec2& direction() const noexcept { return direction_; }
  /// u/|u|, each component within u of itself (u = 2^-53).
  const Vec2& axis() const noexcept { return axis_; }
  /// max(a1, a2)
  double largest_semi_axis() const noexcept { return semi_axes_.maxCoeff(); }
  /// min(a1, a2)
  double smallest_semi_axis() const noexcept { return semi_axes_.minCoeff(); }
  /// The least radius of curvature of the boundary, smallest^2 / largest, rounded.
  double least_radius() const noexcept {
    return smallest_semi_axis() * (smallest_semi_axis() / largest_semi_axis());
  }
  /// Are both semi-axes equal, exactly?
  bool is_circle() const noexcept { return semi_axes_[0] == semi_axes_[1]; }
  /// pi a1 a2, in the unit of length squared.
  double area() const noexcept;

  /// The same solid elsewhere. @param centre  finite (asserted)
  Ellipse moved_to(const Vec2& centre) const noexcept;

  /// Support function h(n) = max over points p of the solid of n . (p - centre()); n of any length.
  double support(const Vec2& n) const noexcept;

  /// The point where that maximum is reached, relative to the centre. Requires n != 0.
  Vec2 support_point(const Vec2& n) const noexcept;

  /// Value of the level function |diag(1/a) R' (p - c)|^2: below 1 inside, above 1 outside, up to
  /// rounding.
  double level(const Vec2& point) const noexcept;

  /// Is the point in the closed solid (up to rounding of level())?
  bool contains(const Vec2& point) const noexcept { return level(point) <= 1.0; }

 private:
  Vec2 centre_;
  Vec2 semi_axes_;
  Vec2 direction_;
  Vec2 axis_;
};

/// A vector of the frame in the frame of the axis (unit), and back.
inline Vec2 turned_back(const Vec2& axis, const Vec2& v) noexcept {
  return {axis[0] * v[0] + axis[1] * v[1], axis[0] * v[1] - axis[1] * v[0]};
}
/// A vector of the frame of the axis in the frame.
inline Vec2 turned(const Vec2& axis, const Vec2& v) noexcept {
  return {axis[0] * v[0] - axis[1] * v[1], axis[1] * v[0] + axis[0] * v[1]};
}

}  // namespace tangency::inline v0
