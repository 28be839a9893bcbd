// SPDX-License-Identifier: MIT
/// @file
/// Vectors and rotations of space in double-double. Requirements as for double_double.hpp.
#pragma once

#include <array>

#include <tangency/geometry/exact/double_double.hpp>
#include <tangency/geometry/vectors.hpp>

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

inline DoubleDoubleVector exactly(const Vec3& v) noexcept { return {v[0], v[1], v[2]}; }
inline Vec3 rounded(const DoubleDoubleVector& v) noexcept {
  return {v[0].high, v[1].high, v[2].high};
}

inline DoubleDouble length(const DoubleDoubleVector& v) noexcept { return sqrt(dot(v, v)); }
inline DoubleDoubleVector operator*(const DoubleDouble& s, const DoubleDoubleVector& v) noexcept {
  return {s * v[0], s * v[1], s * v[2]};
}
inline DoubleDoubleVector operator+(const DoubleDoubleVector& a,
                                    const DoubleDoubleVector& b) noexcept {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline DoubleDoubleVector operator-(const DoubleDoubleVector& v) noexcept {
  return {-v[0], -v[1], -v[2]};
}

}  // namespace tangency::exact
