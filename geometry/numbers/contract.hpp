// SPDX-License-Identifier: MIT
/// @file
/// What a caller has to keep, checked in every build: a call that was asked wrongly ends the
/// process with one line on standard error instead of writing where it must not
/// (docs/decisions/0009-broken-contracts-end-the-process.md). Internal.
#pragma once

#include <cstddef>
#include <limits>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::contract {

/// "tangency: signed_gaps: answers: 3 entries, and there are 4 pairs"
[[noreturn]] void wrong_length(const char* call, const char* what, std::size_t length,
                               std::size_t pairs) noexcept;
/// "tangency: signed_gaps: pairs[2].b = 9, and there are 9 walls"
/// @param entry, what  'b' and "walls"
[[noreturn]] void outside(const char* call, std::size_t pair, char entry, std::size_t index,
                          std::size_t count, const char* what = "bodies") noexcept;
/// "tangency: BodyArray::refresh: body 9, and there are 9 bodies"
[[noreturn]] void no_body(const char* call, std::size_t index, std::size_t bodies) noexcept;
/// "tangency: MovingBodies::refresh: from body 2 to before body 1"
[[noreturn]] void wrong_range(const char* call, std::size_t first, std::size_t last) noexcept;
/// "tangency: MovingBodies: orientations: 3 entries, and there are 4 bodies"
[[noreturn]] void wrong_column(const char* call, const char* what, std::size_t length,
                               std::size_t bodies) noexcept;
/// "tangency: signed_gaps: body 1: r3 = -1: a semi-axis must be finite and > 0"
[[noreturn]] void no_ellipsoid(const char* call, std::size_t index, const char* why) noexcept;
/// "tangency: signed_gaps: accuracy: single precision or a cutoff, and the bodies are looked at in
/// double alone"
[[noreturn]] void no_floats(const char* call) noexcept;
/// "tangency: signed_gap: separation = (1, nan, 0): must be finite"
[[noreturn]] void not_finite(const char* call, const char* what, const Vec3& value) noexcept;

inline void require_length(const char* call, const char* what, std::size_t length,
                           std::size_t pairs) noexcept {
  if (length != pairs) wrong_length(call, what, length, pairs);
}

inline void require_finite(const char* call, const char* what, const Vec3& v) noexcept {
  // Each by itself: a sum of large components may overflow.
  constexpr double most = std::numeric_limits<double>::max();
  const auto finite = [](double x) { return -most <= x && x <= most; };
  if (!(finite(v[0]) && finite(v[1]) && finite(v[2]))) not_finite(call, what, v);
}

}  // namespace tangency::inline v0::contract
