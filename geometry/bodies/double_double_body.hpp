// SPDX-License-Identifier: MIT
/// @file
/// An ellipsoid's support in double-double: what the last floating-point tiers of the
/// yes/no question and of the gap evaluate. Requirements as for double_double.hpp.
#pragma once

#include <cstddef>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/numbers/double_double.hpp>

namespace tangency::inline v0::detail {

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

}  // namespace tangency::inline v0::detail
