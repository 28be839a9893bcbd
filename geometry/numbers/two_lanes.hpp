// SPDX-License-Identifier: MIT
/// @file
/// Numbers of A and the same numbers of B side by side: what is done to both bodies alike is done
/// in the two lanes of one register, which every x86-64 and arm64 has. A vector type of the
/// compiler's (GCC, Clang) and not a class, so that it stays in that register.
#pragma once

#include <cmath>

#include <tangency/geometry/symmetric3.hpp>

namespace tangency::inline v0::detail {

using TwoLanes = double __attribute__((vector_size(16)));  ///< of A, of B

inline TwoLanes sqrt(const TwoLanes& v) noexcept {
  return TwoLanes{std::sqrt(v[0]), std::sqrt(v[1])};
}

inline double sum(const TwoLanes& v) noexcept { return v[0] + v[1]; }

struct TwoLanesVec3 {
  TwoLanes x, y, z;

  /// A's + B's
  Vec3 sum() const noexcept { return {x[0] + x[1], y[0] + y[1], z[0] + z[1]}; }
  Vec3 of_a() const noexcept { return {x[0], y[0], z[0]}; }
  Vec3 of_b() const noexcept { return {x[1], y[1], z[1]}; }
};

inline TwoLanesVec3 both(const Vec3& a, const Vec3& b) noexcept {
  return {TwoLanes{a.x(), b.x()}, TwoLanes{a.y(), b.y()}, TwoLanes{a.z(), b.z()}};
}
inline TwoLanesVec3 operator*(const TwoLanesVec3& v, const TwoLanes& s) noexcept {
  return {v.x * s, v.y * s, v.z * s};
}
inline TwoLanesVec3 operator+(const TwoLanesVec3& v, const TwoLanesVec3& w) noexcept {
  return {v.x + w.x, v.y + w.y, v.z + w.z};
}
/// By components.
inline TwoLanesVec3 operator*(const TwoLanesVec3& v, const TwoLanesVec3& w) noexcept {
  return {v.x * w.x, v.y * w.y, v.z * w.z};
}
inline TwoLanes dot(const TwoLanesVec3& v, const TwoLanesVec3& w) noexcept {
  return v.x * w.x + v.y * w.y + v.z * w.z;
}
inline TwoLanes dot(const TwoLanesVec3& v, const Vec3& w) noexcept {
  return v.x * w.x() + v.y * w.y() + v.z * w.z();
}

struct TwoLanesSymmetric3 {
  TwoLanes xx, yy, zz, yz, zx, xy;

  TwoLanesSymmetric3(const Symmetric3& a, const Symmetric3& b) noexcept
      : xx{a.xx, b.xx},
        yy{a.yy, b.yy},
        zz{a.zz, b.zz},
        yz{a.yz, b.yz},
        zx{a.zx, b.zx},
        xy{a.xy, b.xy} {}

  TwoLanesVec3 operator*(const Vec3& v) const noexcept {
    return {xx * v.x() + xy * v.y() + zx * v.z(),  //
            xy * v.x() + yy * v.y() + yz * v.z(),  //
            zx * v.x() + yz * v.y() + zz * v.z()};
  }
};

/// tr(S_A T_A), tr(S_B T_B)
inline TwoLanes trace_of_product(const TwoLanesSymmetric3& s,
                                 const TwoLanesSymmetric3& t) noexcept {
  return s.xx * t.xx + s.yy * t.yy + s.zz * t.zz + 2.0 * (s.yz * t.yz + s.zx * t.zx + s.xy * t.xy);
}

/// w_A S_A + w_B S_B
inline Symmetric3 weighted_sum(const TwoLanesSymmetric3& s, const TwoLanes& w) noexcept {
  return {sum(w * s.xx), sum(w * s.yy), sum(w * s.zz), sum(w * s.yz), sum(w * s.zx), sum(w * s.xy)};
}

/// Two rotations by their columns, the body axes in space.
struct TwoLanesRotations {
  TwoLanesVec3 columns[3];

  TwoLanesRotations(const Mat3& a, const Mat3& b) noexcept
      : columns{both(a.col(0), b.col(0)), both(a.col(1), b.col(1)), both(a.col(2), b.col(2))} {}

  /// R' n
  TwoLanesVec3 back(const Vec3& n) const noexcept {
    return {dot(columns[0], n), dot(columns[1], n), dot(columns[2], n)};
  }
  /// R w
  TwoLanesVec3 operator*(const TwoLanesVec3& w) const noexcept {
    const TwoLanesVec3* c = columns;
    return {c[0].x * w.x + c[1].x * w.y + c[2].x * w.z, c[0].y * w.x + c[1].y * w.y + c[2].y * w.z,
            c[0].z * w.x + c[1].z * w.y + c[2].z * w.z};
  }
};

}  // namespace tangency::inline v0::detail
