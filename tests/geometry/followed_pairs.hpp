// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Pairs that are placed at a gap, for tests that recompute what is derived of them.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>

namespace tangency::testing {

/// Numbers, directions and bodies at the origin, from a fixed seed.
struct Draw {
  double real(double from, double to) {
    return from + (to - from) * (static_cast<double>(random() >> 11) * 0x1p-53);
  }
  double power(double from, double to) { return std::exp2(real(from, to)); }
  Vec3 direction() { return Vec3(real(-1, 1), real(-1, 1), real(-1, 1)).normalized(); }
  Ellipsoid body(const Vec3& axes) {
    return {Vec3::Zero(), axes, {real(-1, 1), real(-1, 1), real(-1, 1), real(0.1, 1)}};
  }
  std::mt19937_64 random;
};

/// Pairs, and normals that have turned from their true ones.
struct FollowedPairs {
  Family pairs{"", {}, {}};
  std::vector<Vec3> previous;

  /// At gap `gap` along n, followed from a normal that is `turn` away.
  void place(Draw& draw, const Ellipsoid& a, const Ellipsoid& b, const Vec3& n, double gap,
             double turn) {
    pairs.a.push_back(a);
    pairs.b.push_back(b.moved_to(a.support_point(n) + b.support_point(n) + gap * n));
    previous.push_back(n + turn * n.cross(draw.direction()).normalized());
  }
};

}  // namespace tangency::testing
