// SPDX-License-Identifier: MIT
/// @file
/// A solid ellipsoid as its owner has it: by a shape or covariance matrix, by the inverse of one,
/// by three axis vectors, or by the coefficients of a quadric.
///
/// Frame and units as for Ellipsoid. The solid is determined by the doubles as they are given, and
/// every yes/no question about it is answered for exactly that solid: relation() of relation.hpp.
/// Numbers, the gap for one, are those of the nearest solid by semi-axes and a quaternion, whose
/// distance from the true one is known and goes into their errors: signed_gap() of gap.hpp.
///
/// Making one costs some 100 us: its eigenvalues are found with as many digits as its shape takes.
/// Values never change once made: any number of threads may read them.
#pragma once

#include <cstddef>
#include <memory>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/quadric.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

namespace exact {
template <std::size_t N>
struct RationalSolid;
}  // namespace exact

/// Faults are InvalidEllipsoid, with the names of the file formats: "m.xx", "p.xy", "u1.x",
/// "level", "A". Of a matrix that is not positive definite the field is "m", "p" or "quadric" and
/// the value its smallest eigenvalue.
///
/// (1) from_precision(c, inverse of M) is from_shape(c, M), where the inverse is exact.
/// (2) from_shape(c, M, level) is from_shape(c, level M), where the product is exact.
/// (3) relation() of bodies from ellipsoid() alone is that of the Ellipsoids.
/// (4) A common factor of all coefficients of a quadric, its sign included, changes nothing.
class MatrixEllipsoid {
 public:
  /// That solid itself.
  MatrixEllipsoid(const Ellipsoid& ellipsoid);

  /// { x : (x - c)' M^-1 (x - c) <= level }: of a covariance matrix, the ellipsoid of that squared
  /// Mahalanobis distance. With level 1 and M = R diag(a^2) R' the semi-axes are a.
  /// @param centre  finite
  /// @param shape  length^2; symmetric to the bit, positive definite
  /// @param level  finite and > 0
  /// @throws InvalidEllipsoid  also where a semi-axis is beyond the range of doubles
  static MatrixEllipsoid from_shape(const Vec3& centre, const Mat3& shape, double level = 1.0);

  /// { x : (x - c)' P (x - c) <= level }, P an inverse covariance (precision) matrix, length^-2.
  static MatrixEllipsoid from_precision(const Vec3& centre, const Mat3& precision,
                                        double level = 1.0);

  /// { c + U y : |y| <= 1 } with the vectors of the semi-axes in the columns of U. They may be off
  /// a right angle by rounding, 2^-40 of their lengths; the solid is that of U as it is.
  static MatrixEllipsoid from_axes(const Vec3& centre, const Mat3& axes);

  /// The inside of a real ellipsoid, whichever sign its coefficients have there; not rounded as
  /// Quadric::to_ellipsoid() is.
  static MatrixEllipsoid from_quadric(const Quadric& quadric);

  /// The solid by doubles: centre, semi-axes and a quaternion, each rounded once.
  const Ellipsoid& ellipsoid() const noexcept { return ellipsoid_; }
  /// No point of either surface is farther from the other solid's, and no support function differs
  /// more: length, proven. 0 where ellipsoid() is the solid itself.
  double rounding() const noexcept { return rounding_; }
  /// ellipsoid(), smaller and larger about its centre by this share, lies in the true solid and
  /// has it inside: proven. 0 where ellipsoid() is the solid itself.
  double relative_rounding() const noexcept { return relative_rounding_; }

  /// Null where ellipsoid() is the solid itself.
  const exact::RationalSolid<3>* exact() const noexcept { return exact_.get(); }

 private:
  MatrixEllipsoid(std::shared_ptr<const exact::RationalSolid<3>> exact, const char* field);

  std::shared_ptr<const exact::RationalSolid<3>> exact_;
  Ellipsoid ellipsoid_;
  double rounding_ = 0.0, relative_rounding_ = 0.0;
};

/// The level of the ellipsoid that holds a share of a normal distribution: the quantile of the
/// chi-squared distribution, to a double's last place.
/// @param confidence  in (0, 1), else std::invalid_argument
/// @param dimensions  2 or 3, else std::invalid_argument
double level_of_confidence(double confidence, int dimensions);

}  // namespace tangency::inline v0
