// SPDX-License-Identifier: MIT
/// @file
/// Is the thread's floating-point arithmetic the one that a proof assumes?
#pragma once

#include <bit>
#include <cstdint>

#include <tangency/geometry/floating_point.hpp>

#if defined(__SSE2_MATH__)
#include <xmmintrin.h>
#endif

namespace tangency {

/// Does this thread round to nearest, keep subnormal results and read subnormal operands as they
/// are? For filters whose proof needs it: where not, go to exact arithmetic.
///
/// Where the compiler does its double arithmetic in SSE or AVX registers (all of x86-64 unless told
/// otherwise), MXCSR alone governs it: rounding mode (bits 13 and 14, 0 is to nearest),
/// flush-to-zero (bit 15), denormals-are-zero (bit 6). Elsewhere see probe_environment().
inline bool environment_is_default() noexcept;

/// The same by computation, for processors without MXCSR. Sound because the four IEEE 754 modes
/// differ on its two sums: with u = 2^-53, 1 + u/2 gives 1 unless rounding is upwards, and
/// 1 + 3u/2 gives 1 + 2u unless it is downwards or towards zero. Half the smallest normal number
/// must come out as its subnormal bit pattern (else results are flushed), and twice that pattern
/// must give the smallest normal number again (else operands are). The operands are volatile and
/// the results are compared by bits, so that neither the compiler nor the mode under test answers.
inline bool probe_environment() noexcept {
  constexpr double u = 0x1p-53;
  volatile double one = 1.0;
  volatile double half_u = 0.5 * u;
  volatile double three_halves_u = 1.5 * u;
  volatile double smallest_normal = 0x1p-1022;
  volatile double subnormal = std::bit_cast<double>(std::uint64_t{1} << 51);
  volatile double half = 0.5;
  volatile double two = 2.0;

  const double not_upwards = one + half_u;
  const double not_downwards = one + three_halves_u;
  const double kept_result = smallest_normal * half;
  const double kept_operand = subnormal * two;
  const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  return bits(not_upwards) == bits(1.0) && bits(not_downwards) == bits(1.0 + 2.0 * u) &&
         bits(kept_result) == std::uint64_t{1} << 51 && bits(kept_operand) == bits(0x1p-1022);
}

inline bool environment_is_default() noexcept {
#if defined(__SSE2_MATH__)
  constexpr unsigned rounding_mode = 0x6000;
  constexpr unsigned flush_to_zero = 0x8000;
  constexpr unsigned denormals_are_zero = 0x0040;
  return (_mm_getcsr() & (rounding_mode | flush_to_zero | denormals_are_zero)) == 0;
#else
  return probe_environment();
#endif
}

}  // namespace tangency
