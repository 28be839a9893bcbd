// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// rapidcheck generators of bodies and pairs. Its own generator of doubles makes none of what
/// breaks contact codes: these make log-uniform shapes and sizes, equal and nearly equal semi-axes,
/// zero components, quaternions of any length, centres that coincide, gaps near zero, and small
/// whole numbers that touch exactly.
#pragma once

#include <rapidcheck.h>

#include <iosfwd>
#include <ostream>

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency {

/// What a property prints of a counterexample; found by argument-dependent lookup.
void showValue(const Ellipsoid& e, std::ostream& os);

}  // namespace tangency

namespace tangency::testing {

struct Pair {
  Ellipsoid a, b;
};

/// Uniform in [low, high]; shrinks towards low.
rc::Gen<double> uniform(double low, double high);

rc::Gen<double> log_uniform(double low, double high);

/// A unit vector; now and then along a coordinate axis, in a coordinate plane or on a diagonal.
rc::Gen<Vec3> direction();

/// Semi-axes of geometric mean near 1 and aspect ratio at most `aspect`: all different, two equal,
/// all equal, or two that differ by a few units in the last place.
rc::Gen<Vec3> semi_axes(double aspect);

/// Quaternions not 0: generic and of any length, of few non-zero components, the identity, and
/// close to it.
rc::Gen<Eigen::Quaterniond> orientation();

/// A body near the origin, sizes within a ratio of `size_ratio`.
rc::Gen<Ellipsoid> ellipsoid(double aspect, double size_ratio = 10);

/// A pair whose centres are `fraction` times as far apart as those of a pair that touches with the
/// same normal: 0 concentric, below 1 overlapping with that normal stationary or better, 1 a touch
/// up to rounding, above 1 apart.
rc::Gen<Pair> pair_at(double aspect, rc::Gen<double> fraction);

/// Pairs at every distance: concentric, deep, nearly touching from either side, apart.
rc::Gen<Pair> pair(double aspect);

/// Pairs whose coordinates are small whole numbers, among which exact touches, nesting and equality
/// are frequent.
rc::Gen<Pair> whole_pair();

rc::Gen<Pair> any_pair();

void showValue(const Pair& p, std::ostream& os);

}  // namespace tangency::testing

namespace rc {
template <>
struct Arbitrary<tangency::Ellipsoid>;  // no default: say which shapes
}  // namespace rc
