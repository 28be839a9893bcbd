// SPDX-License-Identifier: MIT
/// @file
/// Is the thread's floating-point arithmetic the one that a proof assumes, and what is done where
/// it is not: every public call computes in the default environment and leaves the caller's behind
/// (docs/decisions/0008-default-environment.md).
#pragma once

#include <bit>
#include <cfenv>
#include <cstdint>

#include <tangency/geometry/floating_point.hpp>

#if defined(__SSE2_MATH__)
#include <xmmintrin.h>
#endif

namespace tangency::inline v0 {

/// Does this thread round to nearest, keep subnormal results and read subnormal operands as they
/// are?
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
  constexpr double u = kUnitRoundoff;
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

namespace detail {

#if defined(__SSE2_MATH__)
/// Rounding mode, flush-to-zero and denormals-are-zero of MXCSR.
inline constexpr unsigned kModes = 0x6000 | 0x8000 | 0x0040;
#endif

/// The default environment for the length of a scope; then the caller's modes again. Exception
/// flags that were raised meanwhile stay raised, masks stay as they are.
class DefaultEnvironment {
 public:
#if defined(__SSE2_MATH__)
  DefaultEnvironment() noexcept : modes_(_mm_getcsr() & kModes) {
    _mm_setcsr(_mm_getcsr() & ~kModes);
  }
  ~DefaultEnvironment() { _mm_setcsr((_mm_getcsr() & ~kModes) | modes_); }
#else
  DefaultEnvironment() noexcept {
    std::fegetenv(&old_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultEnvironment() { std::feupdateenv(&old_); }
#endif
  DefaultEnvironment(const DefaultEnvironment&) = delete;
  DefaultEnvironment& operator=(const DefaultEnvironment&) = delete;

 private:
#if defined(__SSE2_MATH__)
  unsigned modes_;
#else
  std::fenv_t old_;
#endif
};

/// A compiler may move arithmetic past a change of the modes, but no call that reads memory: so the
/// computation is one.
template <class Compute>
[[gnu::noinline]] auto computed(const Compute& compute) {
  return compute();
}

template <class Compute>
[[gnu::noinline, gnu::cold]] auto computed_elsewhere(const Compute& compute) {
  const DefaultEnvironment environment;
  return computed(compute);
}

}  // namespace detail

inline bool environment_is_default() noexcept {
#if defined(__SSE2_MATH__)
  return (_mm_getcsr() & detail::kModes) == 0;
#else
  return probe_environment();
#endif
}

/// compute(), in the default environment whatever the thread's is; three instructions more where
/// the two are the same. `compute` does all of the arithmetic, on what it holds by reference.
template <class Compute>
auto in_default_environment(const Compute& compute) {
  if (environment_is_default()) [[likely]]
    return compute();
  return detail::computed_elsewhere(compute);
}

}  // namespace tangency::inline v0
