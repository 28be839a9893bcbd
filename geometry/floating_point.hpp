// SPDX-License-Identifier: MIT
/// @file
/// What this library needs of the compiler: IEEE 754 binary64, each operation rounded once.
/// Every public header includes this one, so that a user who compiles with -ffast-math or
/// -ffinite-math-only is told so instead of being given unproven answers. Contraction into fused
/// multiply-adds shows in no macro: the CMake target carries -ffp-contract=off to its users.
#pragma once

#include <cfloat>
#include <limits>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "tangency: its proofs need IEEE arithmetic; compile without -ffast-math and its parts"
#endif

#if !defined(FLT_EVAL_METHOD) || FLT_EVAL_METHOD != 0
#error "tangency: its proofs need double arithmetic that is rounded to double at every operation"
#endif

namespace tangency {
static_assert(std::numeric_limits<double>::is_iec559, "double must be IEEE 754 binary64");
static_assert(std::numeric_limits<double>::digits == 53, "double must be IEEE 754 binary64");

/// u: half the distance from 1 to the next double.
inline constexpr double kUnitRoundoff = 0x1p-53;
}  // namespace tangency
