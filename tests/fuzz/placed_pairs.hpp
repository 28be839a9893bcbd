// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Pairs whose gap is known by how they are made, many of them from few bodies.
///
/// Where both bodies have the outer normal n at their witness points, and the separation is
/// x_A(n) + x_B(n) + g n, the gap is g: from 0 on, and down to -rho (gap.hpp), as both bodies are
/// there the sums of a convex body and a ball. Deeper the gap is at least g. Points are computed
/// in double, by no call of the kernel but Ellipsoid::rotation(); what that rounds is allowed for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/indexed_pair.hpp>
#include <tangency/tests/fuzz/pair_checks.hpp>

namespace tangency::testing::fuzz {

struct PlacedPair {
  IndexedPair bodies;  ///< may be one body twice
  Vec3 separation;     ///< c_B - c_A, taken as it is
  Vec3 normal;         ///< of length 1 to rounding, from A to B
  Enclosure gap;       ///< what is known of it; `high` is infinite deeper than -rho
};

class PlacedPairs {
 public:
  /// Are the semi-axes within [2^-300, 2^300], so that no square of one is beyond a double, and
  /// none 2^40 times another?
  static bool takes(const Ellipsoid& body);

  /// @param bodies  at least one, each of which takes() is true of; not kept
  /// @param seed  of the normals and of what draw() makes
  PlacedPairs(std::span<const Ellipsoid> bodies, std::uint64_t seed);

  /// Gaps of both signs from the size of the bodies down to their roundings; one in 2048 within a
  /// few roundings of a touch, one in 8192 deeper than -rho: such pairs take as long as a hundred
  /// or a thousand others.
  PlacedPair draw();

 private:
  // A pair's normal is one of so many; chosen: points for them are computed once a body.
  static constexpr std::size_t kNormals = 16;

  struct Size {
    double largest, radius;  ///< semi-axis; least radius of curvature
    double unsure;  ///< greatest radius of curvature: how far a turned normal moves a point
    bool is_slow;   ///< the kernel is, of pairs with it
  };
  struct Depth {
    double gap;
    bool is_known;
  };
  Vec3 drawn_normal(std::span<const Ellipsoid> bodies);
  std::size_t drawn_body();
  Depth drawn_gap(double size, double rho);

  std::uint64_t state_;
  std::array<Vec3, kNormals> normals_;
  std::vector<Vec3> points_;  ///< kNormals of each body
  std::vector<Size> sizes_;
};

}  // namespace tangency::testing::fuzz
