// SPDX-License-Identifier: MIT
/// @file
/// A solid ellipsoid in space.
///
/// Frame and conventions, here and everywhere in geometry: a right-handed Cartesian frame; lengths
/// in any one unit; semi-axes in any order; the orientation is a quaternion (w, x, y, z) that is
/// not zero and *not necessarily normalised: it means the rotation R(q/|q|) exactly*, so that the
/// solid is determined by the stored doubles and every yes/no question about it has one answer.
/// R turns body coordinates into space coordinates.
#pragma once

#include <optional>
#include <stdexcept>

#include <tangency/geometry/symmetric3.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

/// What is wrong with the numbers of a would-be ellipsoid: the first offending field by its name
/// in the file formats ("x" "y" "z" "r1" "r2" "r3" "qw" "qx" "qy" "qz"), its value, and the rule.
struct EllipsoidFault {
  /// name of the field
  const char* field;
  double value;  ///< the value that breaks the rule
  /// what is allowed
  const char* rule;
};

/// Thrown by the constructor of Ellipsoid; what() reads "r2 = -1: a semi-axis must be ...".
class InvalidEllipsoid : public std::invalid_argument {
 public:
  /// With the text "FIELD = VALUE: RULE".
  explicit InvalidEllipsoid(const EllipsoidFault& fault);
  /// What is wrong.
  const EllipsoidFault& fault() const noexcept { return fault_; }

 private:
  EllipsoidFault fault_;
};

/// A solid ellipsoid { c + R diag(a) y : |y| <= 1 }.
///
/// (1) contains(centre()) is true.
/// (2) support(s n) = |s| support(n).
/// (3) support(n) = n . support_point(n), for every n other than 0.
/// (4) A turn by a half about a body axis, the quaternion's sign or power-of-two length, and a
///     permutation of semi-axes with the matching turn leave the solid as it is.
class Ellipsoid {
 public:
  /// @param centre       finite
  /// @param semi_axes    finite and > 0, in any order
  /// @param orientation  finite, not zero, of any length
  /// @throws InvalidEllipsoid  naming the first field that breaks its rule
  Ellipsoid(const Vec3& centre, const Vec3& semi_axes,
            const Quaternion& orientation = Quaternion::Identity());

  /// The same checks as the constructor's, without an exception: nothing where it would succeed.
  static std::optional<EllipsoidFault> find_fault(const Vec3& centre, const Vec3& semi_axes,
                                                  const Quaternion& orientation) noexcept;

  /// As given to the constructor.
  const Vec3& centre() const noexcept { return centre_; }
  /// As given to the constructor, all > 0.
  const Vec3& semi_axes() const noexcept { return semi_axes_; }
  /// As given to the constructor.
  Quaternion orientation() const noexcept { return orientation_; }
  /// R(q/|q|), each entry r within u |r| + 2^-96 of its true value, u = 2^-53:
  /// docs/derivations/relation-filter.md.
  const Mat3& rotation() const noexcept { return rotation_; }
  /// M = R diag(a^2) R', which is (x - c)' M^-1 (x - c) <= 1 as a solid, rounded. Like adjugate and
  /// determinant it overflows or underflows unless moderate().
  const Symmetric3& shape() const noexcept { return shape_; }
  /// J = adj M = R diag(a2^2 a3^2, a3^2 a1^2, a1^2 a2^2) R', rounded.
  const Symmetric3& shape_adjugate() const noexcept { return shape_adjugate_; }
  /// det M = (a1 a2 a3)^2, rounded.
  double shape_determinant() const noexcept { return shape_determinant_; }
  /// Are all semi-axes within [2^-60, 2^60], so that products of up to ten of them and squares of
  /// distances as moderate neither overflow nor underflow?
  bool moderate() const noexcept { return moderate_; }
  /// max(a1, a2, a3)
  double largest_semi_axis() const noexcept { return largest_; }
  /// min(a1, a2, a3)
  double smallest_semi_axis() const noexcept { return smallest_; }
  /// The least radius of curvature of the surface, smallest^2 / largest, rounded.
  double least_radius() const noexcept { return least_radius_; }
  /// Are all semi-axes equal, exactly?
  bool is_sphere() const noexcept { return is_sphere_; }

  /// The same solid elsewhere, sharing the work of the constructor.
  /// @param centre  finite (asserted)
  Ellipsoid moved_to(const Vec3& centre) const noexcept;

  /// Support function h(n) = max over points p of the solid of n . (p - centre()); n of any length.
  double support(const Vec3& n) const noexcept;

  /// The point where that maximum is reached, relative to the centre. Requires n != 0.
  Vec3 support_point(const Vec3& n) const noexcept;

  /// Value of the level function |diag(1/a) R' (p - c)|^2: below 1 inside, above 1 outside, up to
  /// rounding.
  double level(const Vec3& point) const noexcept;

  /// Is the point in the closed solid (up to rounding of level())?
  bool contains(const Vec3& point) const noexcept { return level(point) <= 1.0; }

  /// An axis-aligned box that encloses the solid, each side no further out than 40 u (|c| + half
  /// width) + 2^-91 of the largest semi-axis: docs/derivations/bounding-box.md.
  Eigen::AlignedBox3d bounding_box() const noexcept;

 private:
  Vec3 centre_;
  Vec3 semi_axes_;
  Quaternion orientation_;
  Mat3 rotation_;
  Symmetric3 shape_;
  Symmetric3 shape_adjugate_;
  double shape_determinant_;
  double largest_, smallest_, least_radius_;
  bool is_sphere_;
  bool moderate_;
};

/// R(q/|q|) for a finite quaternion of any length but 0, each entry as Ellipsoid::rotation().
Mat3 rotation_of(const Quaternion& q) noexcept;

}  // namespace tangency::inline v0
