// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The exact relation (relation.hpp) of ellipsoids by their integer forms. Inner header of the
/// oracles.
#pragma once

#include <tangency/verify/oracles/inertia.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::inline v0::verify {

/// Of two surfaces by their forms in (x, y, z, 1), either sign of each, by (6) to (8) alone. Throws
/// std::invalid_argument unless both are real ellipsoids.
ExactRelation exact_relation_by_pencil(const IntegerMatrix& a, const IntegerMatrix& b);

}  // namespace tangency::inline v0::verify
