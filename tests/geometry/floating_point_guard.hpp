// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Hostile floating-point environments for the length of a scope.
#pragma once

#include <cfenv>
#include <string>
#include <vector>

#if defined(__SSE2_MATH__)
#include <xmmintrin.h>
#endif

namespace tangency::testing {

struct FloatingPointEnvironment {
  std::string name;
  int rounding;
  bool flush;  ///< subnormal results to zero and subnormal operands as zero (where MXCSR exists)
};

/// All four rounding modes, with subnormals as IEEE 754 has them and flushed.
inline std::vector<FloatingPointEnvironment> all_environments() {
  std::vector<FloatingPointEnvironment> result;
  for (const bool flush : {false, true}) {
    const std::string suffix = flush ? ", subnormals flushed" : "";
    result.push_back({"to nearest" + suffix, FE_TONEAREST, flush});
    result.push_back({"upwards" + suffix, FE_UPWARD, flush});
    result.push_back({"downwards" + suffix, FE_DOWNWARD, flush});
    result.push_back({"towards zero" + suffix, FE_TOWARDZERO, flush});
  }
  return result;
}

/// Sets an environment and restores the old one at the end of its life.
class EnvironmentGuard {
 public:
  explicit EnvironmentGuard(const FloatingPointEnvironment& environment) {
    std::fegetenv(&old_);
    std::fesetround(environment.rounding);
#if defined(__SSE2_MATH__)
    constexpr unsigned flush_to_zero_and_denormals_are_zero = 0x8040;
    if (environment.flush) _mm_setcsr(_mm_getcsr() | flush_to_zero_and_denormals_are_zero);
#endif
  }
  ~EnvironmentGuard() { std::fesetenv(&old_); }
  EnvironmentGuard(const EnvironmentGuard&) = delete;
  EnvironmentGuard& operator=(const EnvironmentGuard&) = delete;

 private:
  std::fenv_t old_;
};

}  // namespace tangency::testing
