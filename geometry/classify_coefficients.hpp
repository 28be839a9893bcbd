// SPDX-License-Identifier: MIT
/// @file
/// The ladder of tiers of classify(), from coefficients: what Quadric itself may ask.
#pragma once

#include <tangency/geometry/quadric_type.hpp>

namespace tangency {

/// The type of the quadric with these coefficients. Requires finite ones. As classify().
Classification classify_coefficients(const QuadricCoefficients& coefficients) noexcept;

}  // namespace tangency
