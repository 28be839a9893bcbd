// SPDX-License-Identifier: MIT
/// @file
/// Bodies that repeat along edge vectors, and pairs of their images.
///
/// (1) The true c_B + edges * image - c_A is within separation().error of separation().vector;
///     error 0 says that it is that vector. In every floating-point environment.
#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

/// How many edges a body is moved by along each axis.
using LatticeImage = std::array<std::int32_t, 3>;

/// Three edge vectors, of which the periodic ones repeat the bodies.
struct Lattice {
  Mat3 edges = Mat3::Identity();  ///< columns, linearly independent; an open one is a direction
  std::array<bool, 3> periodic{true, true, true};  ///< which edges the bodies are repeated along

  /// Nothing repeats.
  static Lattice open() { return {Mat3::Identity(), {false, false, false}}; }
};

/// Body a, and body b moved by edges * image.
struct NearPair {
  std::uint32_t a, b;  ///< places of A and B in the list of bodies
  LatticeImage image;  ///< the image of B

  /// By a, then b, then image.
  auto operator<=>(const NearPair&) const = default;
};

/// c_B + edges * image - c_A, rounded.
struct ImageSeparation {
  Vec3 vector;   ///< finite; where the true one is not within the range of doubles, the nearest
  double error;  ///< of its length; infinite where the true one is beyond the range of doubles
};

/// @param centre_a  of the first body
/// @param centre_b  of the second body
/// @param image  the image of b
/// @param edges  columns; finite. Those that the image does not count are not read
ImageSeparation separation(const Vec3& centre_a, const Vec3& centre_b, const Mat3& edges,
                           const LatticeImage& image) noexcept;

}  // namespace tangency::inline v0
