// SPDX-License-Identifier: MIT
/// @file
/// Arithmetic of vectors of double-double numbers.
#pragma once

#include <tangency/geometry/exact/double_double_body.hpp>

namespace tangency::exact {

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
