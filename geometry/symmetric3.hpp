// SPDX-License-Identifier: MIT
/// @file
/// Symmetric 3x3 matrices by their six entries, and the adjugates that pairs of shape matrices
/// need.
#pragma once

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

/// A symmetric 3x3 matrix.
struct Symmetric3 {
  double xx, yy, zz, yz, zx, xy;  ///< the six entries

  /// The product with a vector, rounded.
  Vec3 operator*(const Vec3& v) const noexcept {
    return {xx * v.x() + xy * v.y() + zx * v.z(),  //
            xy * v.x() + yy * v.y() + yz * v.z(),  //
            zx * v.x() + yz * v.y() + zz * v.z()};
  }
  /// Every entry times s, rounded.
  Symmetric3 operator*(double s) const noexcept {
    return {s * xx, s * yy, s * zz, s * yz, s * zx, s * xy};
  }
  /// The sum by entries, rounded.
  Symmetric3 operator+(const Symmetric3& b) const noexcept {
    return {xx + b.xx, yy + b.yy, zz + b.zz, yz + b.yz, zx + b.zx, xy + b.xy};
  }
  /// xx + yy + zz
  double trace() const noexcept { return xx + yy + zz; }
  /// v' S v
  double form(const Vec3& v) const noexcept { return v.dot(*this * v); }
  /// The full matrix.
  Mat3 matrix() const { return (Mat3() << xx, xy, zx, xy, yy, yz, zx, yz, zz).finished(); }
};

/// v v'
inline Symmetric3 square(const Vec3& v) noexcept {
  const double x = v.x(), y = v.y(), z = v.z();
  return {x * x, y * y, z * z, y * z, z * x, x * y};
}

/// tr(A B); v' S v is that of S and square(v).
inline double trace_of_product(const Symmetric3& a, const Symmetric3& b) noexcept {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.yz * b.yz + a.zx * b.zx + a.xy * b.xy);
}

/// The X of adj(A + l B) = adj A + l X + l^2 adj B; adj A is mixed_adjugate(A, A) / 2.
inline Symmetric3 mixed_adjugate(const Symmetric3& a, const Symmetric3& b) noexcept {
  return {a.yy * b.zz + a.zz * b.yy - 2.0 * a.yz * b.yz,
          a.zz * b.xx + a.xx * b.zz - 2.0 * a.zx * b.zx,
          a.xx * b.yy + a.yy * b.xx - 2.0 * a.xy * b.xy,
          a.zx * b.xy + a.xy * b.zx - a.xx * b.yz - a.yz * b.xx,
          a.xy * b.yz + a.yz * b.xy - a.yy * b.zx - a.zx * b.yy,
          a.yz * b.zx + a.zx * b.yz - a.zz * b.xy - a.xy * b.zz};
}

/// Its adjugate: the transposed matrix of cofactors, rounded.
inline Symmetric3 adjugate(const Symmetric3& a) noexcept {
  return {a.yy * a.zz - a.yz * a.yz, a.zz * a.xx - a.zx * a.zx, a.xx * a.yy - a.xy * a.xy,
          a.zx * a.xy - a.xx * a.yz, a.xy * a.yz - a.yy * a.zx, a.yz * a.zx - a.zz * a.xy};
}

}  // namespace tangency::inline v0
