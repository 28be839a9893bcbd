// SPDX-License-Identifier: MIT
/// @file
/// A solid ellipse in the plane as its owner has it: by a shape or covariance matrix, by the
/// inverse of one, or by the coefficients of a conic. The plane's counterpart of
/// matrix_ellipsoid.hpp, with the same promises: the relation is exact for the numbers as they are
/// given, and numbers are those of the nearest Ellipse, with a known distance from the true one.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

namespace exact {
template <std::size_t N>
struct RationalSolid;
}  // namespace exact

/// Faults are InvalidEllipse, with the names of the file formats: "m.xx", "p.xy", "level", "A". Of
/// a matrix that is not positive definite the field is "m", "p" or "conic" and the value its
/// smallest eigenvalue.
///
/// (1) from_precision(c, inverse of M) is from_shape(c, M), where the inverse is exact.
/// (2) from_shape(c, M, level) is from_shape(c, level M), where the product is exact.
/// (3) relation() of bodies from ellipse() alone is that of the Ellipses.
/// (4) A common factor of all coefficients of a conic, its sign included, changes nothing.
class MatrixEllipse {
 public:
  /// xx, yy and xy of a symmetric matrix.
  struct Symmetric2 {
    double xx, yy, xy;  ///< its entries
  };

  /// That solid itself.
  MatrixEllipse(const Ellipse& ellipse);

  /// { x : (x - c)' M^-1 (x - c) <= level }.
  /// @param centre  finite
  /// @param shape  length^2; positive definite
  /// @param level  finite and > 0
  /// @throws InvalidEllipse  also where a semi-axis is beyond the range of doubles
  static MatrixEllipse from_shape(const Vec2& centre, const Symmetric2& shape, double level = 1.0);

  /// { x : (x - c)' P (x - c) <= level }.
  static MatrixEllipse from_precision(const Vec2& centre, const Symmetric2& precision,
                                      double level = 1.0);

  /// The inside of A x^2 + B xy + C y^2 + D x + E y + F = 0, a real ellipse, whichever sign its
  /// coefficients have there.
  static MatrixEllipse from_conic(const std::array<double, 6>& coefficients);

  /// The solid by doubles: centre, semi-axes and a direction, each rounded once.
  const Ellipse& ellipse() const noexcept { return ellipse_; }
  /// No point of either boundary is farther from the other solid's, and no support function differs
  /// more: length, proven. 0 where ellipse() is the solid itself.
  double rounding() const noexcept { return rounding_; }

  /// Null where ellipse() is the solid itself.
  const exact::RationalSolid<2>* exact() const noexcept { return exact_.get(); }

 private:
  MatrixEllipse(std::shared_ptr<const exact::RationalSolid<2>> exact, const char* field);

  std::shared_ptr<const exact::RationalSolid<2>> exact_;
  Ellipse ellipse_;
  double rounding_ = 0.0;
};

}  // namespace tangency::inline v0
