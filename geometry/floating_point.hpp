// SPDX-License-Identifier: MIT
/// @file
/// What this library needs of the compiler: C++20, and IEEE 754 binary64.
/// Every public header includes this one, so that a user who compiles with -ffast-math or
/// -ffinite-math-only is told so instead of being given unproven answers. The library's own files
/// are compiled with -ffp-contract=off: there each operation rounds once. A user may have products
/// and sums contracted into fused multiply-adds: no inline function of a public header is part of a
/// proof where a user compiles it, and what it returns then differs by roundings alone.
#pragma once

#if __cplusplus < 202002L && (!defined(_MSVC_LANG) || _MSVC_LANG < 202002L)
#error "tangency needs C++20: compile with -std=c++20"
#endif

#include <cfloat>
#include <limits>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "tangency: its proofs need IEEE arithmetic; compile without -ffast-math and its parts"
#endif

#if !defined(FLT_EVAL_METHOD) || FLT_EVAL_METHOD != 0
#error "tangency: its proofs need double arithmetic that is rounded to double at every operation"
#endif

namespace tangency::inline v0 {
static_assert(std::numeric_limits<double>::is_iec559, "double must be IEEE 754 binary64");
static_assert(std::numeric_limits<double>::digits == 53, "double must be IEEE 754 binary64");

/// u: half the distance from 1 to the next double.
inline constexpr double kUnitRoundoff = 0x1p-53;
}  // namespace tangency::inline v0
