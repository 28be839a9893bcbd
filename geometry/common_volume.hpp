// SPDX-License-Identifier: MIT
/// @file
/// The volume that two solid ellipsoids have in common, and how it changes as one of them moves:
/// the exchange force of packing codes is minus its gradient times a pressure.
///
/// Frame and units as for Ellipsoid; volumes in the unit of length cubed, gradients in it squared.
/// d = c_B - c_A. With V(d) the common volume the gradient is
///
///     dV/dd = integral of B's outer normal over the part of B's surface that lies in A,
///           = - integral of A's outer normal over the part of A's surface that lies in B,
///
/// which points from B to A, more or less: moving B away from A makes the volume smaller.
///
/// (1) common_volume(b, a) is common_volume(a, b) with the gradient reversed, to the last bit.
/// (2) Volume, gradient and their errors are 0 where the exact relation says that the interiors do
///     not meet. Where it says that one body lies in the other the volume is that body's and the
///     gradient is 0. Only of bodies that overlap without that is anything approximate.
/// (3) 0 <= volume <= the smaller of the two volumes.
/// (4) Scaling both bodies and d by a power of two scales volumes by its cube and gradients by its
///     square, to the last bit.
/// (5) Growing a body, or adding one that holds it, never makes the volume smaller by more than the
///     two errors.
/// (6) The gradient is the derivative: between two places of B the volume changes by the integral
///     of the gradient along the way.
///
/// How: in a frame in which the first body is a ball, planes of one direction cut both bodies in
/// circles, whose common area is elementary; it is integrated over the height by Gaussian
/// quadrature where that is proven to converge: docs/derivations/common-volume.md. In any
/// floating-point environment, at any scale. Allocates only where the relation needs exact
/// integers. Thread safe.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>

namespace tangency::inline v0 {

/// How well a common volume is known.
enum class CommonVolumeStatus {
  ok,                     ///< both errors are within the tolerance
  tolerance_not_reached,  ///< they are not, and still hold
};

/// The volume that two bodies have in common, and its derivative.
struct CommonVolume {
  /// Infinite above the range of doubles; below it rounded to a subnormal or to 0.
  double volume;
  double volume_error;        ///< proven: |volume - true volume| is at most this
  Vec3 gradient;              ///< dV/dd
  double gradient_error;      ///< proven: |gradient - true gradient| is at most this
  CommonVolumeStatus status;  ///< whether both errors are within the tolerance
};

/// Of volume_error over the smaller body's volume, and of gradient_error over pi times the product
/// of the two longer semi-axes of that body. Chosen: what a cycle of a packing code can use, at a
/// fraction of the price of the last digits.
inline constexpr double kCommonVolumeTolerance = 1e-12;

/// The common volume of two bodies in any pose.
///
/// Where the overlap is thin the work goes on until the error is within the tolerance of the common
/// volume itself, if that is possible: seen to 1e-11 of it for lenses as thin as 1e-12 of bodies of
/// aspect ratios to 10. Medians for bodies that overlap: 50 us for moderate shapes, 0.1 ms for thin
/// lenses, 0.2 ms at an aspect ratio of 1e8, where some pairs need 512 bits and then some ms
/// (measured by tests/verify/common_volume_agreement.cpp). Much of it is the proof: a tolerance of
/// 1e-6 saves no more than a quarter.
/// @param a,b  the bodies, in this order
/// @param tolerance  > 0; below 2^-46 it is that for the work, and as it is for the status
CommonVolume common_volume(const Ellipsoid& a, const Ellipsoid& b,
                           double tolerance = kCommonVolumeTolerance) noexcept;

/// The same with the separation d = c_B - c_A given, in place of the centres: for periodic images.
/// @param a,b  the bodies, in this order
/// @param tolerance  > 0, of the smaller body's volume and of its section
/// @param separation  finite: else the process ends with one line on standard error
CommonVolume common_volume(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation,
                           double tolerance = kCommonVolumeTolerance) noexcept;

/// Of bodies given by matrices: (2) holds for the exact relation of their numbers as they were
/// given; numbers are those of MatrixEllipsoid::ellipsoid() of each, and their roundings go into
/// the errors. Allocates.
CommonVolume common_volume(const MatrixEllipsoid& a, const MatrixEllipsoid& b,
                           double tolerance = kCommonVolumeTolerance) noexcept;

}  // namespace tangency::inline v0
