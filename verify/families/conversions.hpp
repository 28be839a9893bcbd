// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Between the kernel's bodies and the raw doubles of oracles and families.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::inline v0::verify {

inline Ellipsoid to_ellipsoid(const RawEllipsoid& raw) {
  const auto& [c, r, q] = raw;
  return {{c[0], c[1], c[2]}, {r[0], r[1], r[2]}, Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
}

inline RawEllipsoid to_raw(const Ellipsoid& e) {
  const Vec3 &c = e.centre(), &r = e.semi_axes();
  const Quaternion q = e.orientation();
  return {{c[0], c[1], c[2]}, {r[0], r[1], r[2]}, {q.w(), q.x(), q.y(), q.z()}};
}

}  // namespace tangency::inline v0::verify
