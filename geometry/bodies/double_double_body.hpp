// SPDX-License-Identifier: MIT
/// @file
/// An ellipsoid's support in double-double: what the last floating-point tiers of the
/// yes/no question and of the gap evaluate. Requirements as for double_double.hpp.
#pragma once

#include <array>
#include <cstddef>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/numbers/double_double.hpp>

namespace tangency::detail {

/// A body seen along a normal of any length but 0.
struct DoubleDoubleSide {
  DoubleDoubleMatrix rotation;
  const Vec3* semi_axes;
  DoubleDoubleVector stretched;  ///< diag(a) R' n
  DoubleDouble support;          ///< its length, h(n)

  DoubleDoubleSide(const Ellipsoid& body, const DoubleDoubleVector& normal) noexcept;

  DoubleDouble axis(std::size_t k) const noexcept { return (*semi_axes)[static_cast<int>(k)]; }
  /// From the centre. Requires support > 0.
  DoubleDoubleVector support_point() const noexcept;
};

// The frame of a body's axes in double-double: for answers each of whose numbers is rounded once.
// Holds where numbers/double_double.hpp does.

/// R(q/|q|), each entry within 20 units of kDoubleDoubleEpsilon (docs/derivations/
/// relation-filter.md, section 4), and vectors turned by it within 25 of them times |v|_1.
class BodyFrame {
 public:
  explicit BodyFrame(const Quaternion& orientation) noexcept;

  DoubleDoubleVector to_body(const DoubleDoubleVector& v) const noexcept;   ///< R' v
  DoubleDoubleVector to_space(const DoubleDoubleVector& v) const noexcept;  ///< R v

 private:
  DoubleDoubleMatrix rotation_;
};

/// A body and a point seen from its centre, in units of 2^exponent: the largest of the semi-axes
/// and of the separation's components in [1, 4). A semi-axis below 2^-200 of that is taken for it.
struct SeenFromCentre {
  Vec3 semi_axes;
  DoubleDoubleVector separation;  ///< point - centre, exactly
  int exponent;
};
SeenFromCentre seen_from_centre(const Ellipsoid& body, const Vec3& point) noexcept;
/// The same for a separation that is given, in the unit of the body.
SeenFromCentre seen_from_centre(const Ellipsoid& body,
                                const DoubleDoubleVector& separation) noexcept;

}  // namespace tangency::detail
