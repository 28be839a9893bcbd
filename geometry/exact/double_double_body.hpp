// SPDX-License-Identifier: MIT
/// @file
/// An ellipsoid's rotation and support in double-double: what the last floating-point tiers of the
/// yes/no question and of the gap evaluate. Requirements as for double_double.hpp.
#pragma once

#include <array>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/exact/double_double.hpp>

namespace tangency::exact {

using DoubleDoubleVector = std::array<DoubleDouble, 3>;
using DoubleDoubleMatrix = std::array<DoubleDoubleVector, 3>;  ///< by rows

/// R(q/|q|), each entry within 20 units of kDoubleDoubleEpsilon.
DoubleDoubleMatrix double_double_rotation(const Quaternion& q) noexcept;

/// R' v
DoubleDoubleVector turned_back(const DoubleDoubleMatrix& r, const DoubleDoubleVector& v) noexcept;

DoubleDouble dot(const DoubleDoubleVector& a, const DoubleDoubleVector& b) noexcept;

/// |a_1| + |a_2| + |a_3|
double sum_of_absolutes(const DoubleDoubleVector& v) noexcept;

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

}  // namespace tangency::exact
