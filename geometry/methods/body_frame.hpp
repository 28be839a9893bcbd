// SPDX-License-Identifier: MIT
/// @file
/// The frame of a body's axes in double-double: for answers each of whose numbers is rounded once.
/// Holds where exact/double_double.hpp does.
#pragma once

#include <array>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/exact/double_double_vector.hpp>

namespace tangency::methods {

using exact::DoubleDoubleVector;

/// R(q/|q|), each entry within 20 units of kDoubleDoubleEpsilon (docs/derivations/
/// relation-filter.md, section 4), and vectors turned by it within 25 of them times |v|_1.
class BodyFrame {
 public:
  explicit BodyFrame(const Quaternion& orientation) noexcept;

  DoubleDoubleVector to_body(const DoubleDoubleVector& v) const noexcept;   ///< R' v
  DoubleDoubleVector to_space(const DoubleDoubleVector& v) const noexcept;  ///< R v

 private:
  exact::DoubleDoubleMatrix rotation_;
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

}  // namespace tangency::methods
