// SPDX-License-Identifier: MIT
/// @file
/// A quadric surface in space,
///
///     A x^2 + B y^2 + C z^2 + 2D xy + 2E yz + 2F zx + 2G x + 2H y + 2J z + K = 0,
///
/// [x y z 1] Q [x y z 1]' = 0 with the discriminant matrix Q, whose upper-left 3 x 3 block is the
/// sub-discriminant Q_s. [Ouadfel1998, section 4.2.1]
///
/// The quadric is its ten stored doubles: classify() answers exactly for them. The operations below
/// that compute new coefficients round, and near a border between types a rounded quadric can be of
/// another type; each says where it is exact.
#pragma once

#include <optional>
#include <stdexcept>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/quadric_type.hpp>

namespace tangency::inline v0 {

/// What is wrong with the coefficients of a would-be quadric: the first offending one by its name
/// in the file formats ("A" "B" "C" "D" "E" "F" "G" "H" "J" "K"), its value, and the rule.
struct QuadricFault {
  /// name of the field
  const char* field;
  double value;  ///< the value that breaks the rule
  /// what is allowed
  const char* rule;
};

/// Thrown where a coefficient is not finite; what() reads "K = inf: a coefficient must be finite".
class InvalidQuadric : public std::invalid_argument {
 public:
  /// With the text "FIELD = VALUE: RULE".
  explicit InvalidQuadric(const QuadricFault& fault);
  /// What is wrong.
  const QuadricFault& fault() const noexcept { return fault_; }

 private:
  QuadricFault fault_;
};

/// (1) evaluate(x) = [x 1] discriminant() [x 1]'.
/// (2) gradient(x) is the derivative of evaluate at x; at the centre of a central quadric it is 0.
/// (3) q.moved(r, t).evaluate(R x + t) = q.evaluate(x), R = rotation_of(r).
/// (4) q.scaled(s).evaluate(s x) = s q.evaluate(x).
/// (5) from_ellipsoid(e) is negative inside e, positive outside, and to_ellipsoid() of it is e, as
///     a solid.
/// All up to rounding.
class Quadric {
 public:
  /// The ten coefficients, in the order of the file's head.
  using Coefficients = QuadricCoefficients;

  /// @param coefficients  A B C D E F G H J K
  /// @throws InvalidQuadric  naming the first coefficient that is not finite
  explicit Quadric(const Coefficients& coefficients);

  /// The same check without an exception: nothing where the constructor would succeed.
  static std::optional<QuadricFault> find_fault(const Coefficients& coefficients) noexcept;

  /// The surface of a solid ellipsoid: s times (x - c)' R diag(1/a^2) R' (x - c) - 1, s the power
  /// of two in (a_min/2, a_min], so that coefficients stay in range as long as the lengths do.
  ///
  /// Rounded: with w = s u / a_min^2, A to F are within 40 w of the true values, G, H and J within
  /// 80 w |c|, K within 150 w |c|^2 + 2 u s. Far from the origin this can cost the type; the exact
  /// questions about ellipsoids, pencil_members() and relation(), do not come here.
  /// @throws InvalidQuadric  where a coefficient overflows
  static Quadric from_ellipsoid(const Ellipsoid& e);

  /// A B C D E F G H J K
  const Coefficients& coefficients() const noexcept { return coefficients_; }
  /// Q, symmetric.
  Mat4 discriminant() const noexcept;
  /// Q_s, symmetric.
  Mat3 sub_discriminant() const noexcept;

  /// Value of the polynomial.
  double evaluate(const Vec3& point) const noexcept;
  /// Gradient of the polynomial: normal to the surface that passes through the point.
  Vec3 gradient(const Vec3& point) const noexcept;

  /// The same surface with the other sign on either side. Exact.
  Quadric negated() const noexcept;

  /// The surface after the rigid motion x -> rotation_of(rotation) x + translation.
  /// @param rotation     finite, not zero, of any length
  /// @param translation  finite
  /// @throws InvalidQuadric  where a coefficient overflows
  Quadric moved(const Quaternion& rotation, const Vec3& translation) const;

  /// The surface after x -> factor x. Exact for a power of two, barring overflow and underflow.
  /// @param factor  finite and > 0 (asserted)
  /// @throws InvalidQuadric  where a coefficient overflows
  Quadric scaled(double factor) const;

  /// Centre, semi-axes (ascending) and orientation of a real ellipsoid.
  ///
  /// The relative error of a semi-axis is of the order of u |Q_s| |Q_s^-1| (1 + |c|^2/a_min^2).
  /// @return nothing where the quadric is not a real ellipsoid (exactly decided), or is one whose
  ///         rounded eigenvalues do not show it: then its coefficients do not carry one digit of
  ///         some semi-axis
  std::optional<Ellipsoid> to_ellipsoid() const;

 private:
  Coefficients coefficients_;
};

}  // namespace tangency::inline v0
