// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>

#include <tangency/geometry/numbers/wide_float.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>
#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency {
namespace {

using detail::WideFloat;
// 600 bits, so that its own rounding is not seen.
using Digits = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<200, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

constexpr std::uint64_t kSeed = 20261122;

/// Exactly: 512 bits are at most eleven doubles, taken off one after the other.
Digits digits(WideFloat v) {
  Digits sum = 0;
  while (!v.is_zero()) {
    const double part = static_cast<double>(v);
    sum += part, v = v - WideFloat(part);
  }
  return sum;
}

double relative(const Digits& value, const Digits& truth, const Digits& to) {
  return static_cast<double>(Digits(abs(value - truth) / to));
}

/// Numbers with all their bits, of any sign and of exponents that let them cancel or not.
class Numbers {
 public:
  WideFloat next() {
    WideFloat v = number() / number();
    if (random_() % 4 == 0) v = v * number();
    if (random_() % 8 == 0) return v.scaled(static_cast<long>(random_() % 300) - 150);
    return v;
  }
  std::uint64_t random() { return random_(); }

 private:
  double number() { return std::uniform_real_distribution<double>(-2, 2)(random_); }
  std::mt19937_64 random_{kSeed};
};

TEST(WideFloat, OperationsAreWithinTheirEpsilonOf200Digits) {
  Numbers numbers;
  double worst = 0;
  for (int i = 0; i < 20'000; ++i) {
    const WideFloat a = numbers.next();
    // A quarter cancels: all but the last bits of two are the same.
    const WideFloat near =
        a + a * WideFloat(std::exp2(-static_cast<double>(numbers.random() % 500)));
    const WideFloat b = i % 4 == 0 ? near : numbers.next();
    const Digits x = digits(a), y = digits(b);
    const auto see = [&](const WideFloat& found, const Digits& truth, const Digits& to) {
      const double error = relative(digits(found), truth, to);
      ASSERT_LE(error, detail::kWideEpsilon) << i;
      worst = std::max(worst, error / detail::kWideEpsilon);
    };
    see(a + b, x + y, abs(x) + abs(y));
    see(a - b, x - y, abs(x) + abs(y));
    see(a * b, x * y, abs(x * y));
    see(a / b, x / y, abs(x / y));
    see(sqrt(abs(a)), sqrt(Digits(abs(x))), sqrt(Digits(abs(x))));
    ASSERT_EQ(a < b, x < y);
  }
  std::printf("errors to %.2f of the bound\n", worst);
}

TEST(WideFloat, HoldsEveryDoubleExactlyAndGivesTheNearestBack) {
  constexpr double kMost = std::numeric_limits<double>::max();
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  for (const double v : {0.0, 1.0, -1.5, kMost, -kMost, kLeast, -3 * kLeast, 0x1.fffffp-1023}) {
    for (const auto& environment : testing::all_environments()) {
      const bool subnormal = v != 0 && std::abs(v) < std::numeric_limits<double>::min();
      if (environment.flush && subnormal) continue;  // the caller could not read it
      const testing::EnvironmentGuard guard(environment);
      EXPECT_EQ(static_cast<double>(WideFloat(v)), v) << environment.name;
    }
  }
  EXPECT_EQ(static_cast<double>(WideFloat(1.0) / WideFloat(3.0)), 1.0 / 3.0);  // rounded down
  EXPECT_EQ(static_cast<double>(WideFloat(1.0) / WideFloat(5.0)), 1.0 / 5.0);  // up
  EXPECT_EQ(static_cast<double>(WideFloat(kMost) * WideFloat(2.0)),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(static_cast<double>(WideFloat(kLeast) * WideFloat(kLeast)), 0.0);
  const WideFloat one = 1.0;
  EXPECT_TRUE((one - one).is_zero());
  EXPECT_FALSE(-(one - one) < WideFloat(0.0));
  EXPECT_TRUE(sqrt(-one).is_zero());
}

}  // namespace
}  // namespace tangency
