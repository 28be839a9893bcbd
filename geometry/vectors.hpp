// SPDX-License-Identifier: MIT
/// @file
/// The vectors, matrices and quaternions of public signatures and structs.
///
/// Each is an Eigen type that needs no more alignment than a double, whatever a file is compiled
/// for: the alignment of Eigen::Vector2d, Matrix4d and Quaterniond depends on the instruction set
/// and on Eigen's macros, and a library and a user who disagree on it crash. Eigen converts between
/// these and its own in both directions: docs/decisions/0010-own-symbols.md says what that leaves
/// out.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <tangency/geometry/floating_point.hpp>

namespace tangency::inline v0 {

/// A vector in the plane.
using Vec2 = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
/// A vector in space.
using Vec3 = Eigen::Vector3d;  // three doubles are not aligned
/// A 3x3 matrix.
using Mat3 = Eigen::Matrix3d;  // nor are nine
/// A 4x4 matrix.
using Mat4 = Eigen::Matrix<double, 4, 4, Eigen::DontAlign>;
/// (w, x, y, z) in its constructor, stored as x, y, z, w.
using Quaternion = Eigen::Quaternion<double, Eigen::DontAlign>;

}  // namespace tangency::inline v0
