// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// rapidcheck generators of ellipses and pairs of them: log-uniform shapes and sizes, circles and
/// nearly circles, directions of any length and along axes, small whole numbers that touch exactly,
/// and gaps near zero.
#pragma once

#include <rapidcheck.h>

#include <iosfwd>
#include <ostream>

#include <tangency/geometry/ellipse.hpp>

namespace tangency {

/// What a property prints of a counterexample; found by argument-dependent lookup.
void showValue(const Ellipse& e, std::ostream& os);

}  // namespace tangency

namespace tangency::testing {

struct EllipsePair {
  Ellipse a, b;
};

void showValue(const EllipsePair& p, std::ostream& os);

/// A unit vector; now and then along a coordinate axis or a diagonal.
rc::Gen<Vec2> plane_direction();

/// A body near the origin, with an aspect ratio of at most `aspect`; circles and nearly circles
/// among them.
rc::Gen<Ellipse> ellipse(double aspect);

/// Coordinates that are small whole numbers, among which touches, nesting and equality are
/// frequent.
rc::Gen<Ellipse> whole_ellipse();

/// A pair whose centres are `fraction` times as far apart as those of a pair that touches with the
/// same normal.
rc::Gen<EllipsePair> ellipse_pair(double aspect);

rc::Gen<EllipsePair> any_ellipse_pair();

}  // namespace tangency::testing
