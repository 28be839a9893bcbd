// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/geometry/floating_point_environment.hpp>

#include <gtest/gtest.h>

#include <tangency/tests/geometry/floating_point_guard.hpp>

namespace tangency {
namespace {

TEST(FloatingPointEnvironment, OnlyNearestWithSubnormalsIsDefault) {
  for (const auto& environment : testing::all_environments()) {
    bool is_default = false;
    bool probed = false;
    {
      const testing::EnvironmentGuard guard(environment);
      is_default = environment_is_default();
      probed = probe_environment();
    }
    const bool expected = environment.rounding == FE_TONEAREST && !environment.flush;
    EXPECT_EQ(is_default, expected) << environment.name;
    EXPECT_EQ(probed, expected) << environment.name;
  }
}

#if defined(__SSE2_MATH__)
TEST(FloatingPointEnvironment, FlushedResultsAloneAndFlushedOperandsAloneAreNotDefault) {
  for (const unsigned bit : {0x8000u, 0x0040u}) {
    const unsigned old = _mm_getcsr();
    _mm_setcsr(old | bit);
    const bool is_default = environment_is_default();
    const bool probed = probe_environment();
    _mm_setcsr(old);
    EXPECT_FALSE(is_default) << std::hex << bit;
    EXPECT_FALSE(probed) << std::hex << bit;
  }
}
#endif

}  // namespace
}  // namespace tangency
