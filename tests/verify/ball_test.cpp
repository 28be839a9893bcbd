// SPDX-License-Identifier: GPL-3.0-or-later
// The arithmetic of the cheap oracle beside 150 digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include <tangency/verify/oracles/ball.hpp>
#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::testing {
namespace {

using verify::Ball;
using verify::Real;

constexpr std::uint64_t kSeed = 20261201;

// A number as a ball and exactly.
struct Both {
  Ball ball;
  Real exact;
};

Both operator+(const Both& a, const Both& b) { return {a.ball + b.ball, a.exact + b.exact}; }
Both operator-(const Both& a, const Both& b) { return {a.ball - b.ball, a.exact - b.exact}; }
Both operator*(const Both& a, const Both& b) { return {a.ball * b.ball, a.exact * b.exact}; }
Both operator/(const Both& a, const Both& b) { return {a.ball / b.ball, a.exact / b.exact}; }
Both root(const Both& a) { return {sqrt(a.ball), sqrt(a.exact)}; }

// How far the exact value is from the middle, over what the ball allows.
double share_of_error(const Both& v) {
  const Ball off = v.ball - v.ball.middle();
  const long double allowed = off.most();
  const Real high = Real(static_cast<double>(v.ball.value()));
  const Ball low = v.ball.middle() - Ball(high.convert_to<double>());
  const Real middle = high + Real(low.value());
  return Real(abs(v.exact - middle) / Real(allowed)).convert_to<double>();
}

// Of the size that numbers in a chain have, spread over some decades.
class Numbers {
 public:
  Both next() {
    const double v = std::ldexp(1 + unit_(engine_), spread_(engine_));
    const double low = v * 0x1p-54 * unit_(engine_);
    return {Ball(v) + Ball(low), Real(v) + Real(low)};
  }

 private:
  std::mt19937_64 engine_{kSeed};
  std::uniform_real_distribution<double> unit_{0, 1};
  std::uniform_int_distribution<int> spread_{-20, 20};
};

TEST(Ball, EveryOperationEnclosesTheExactResult) {
  Numbers numbers;
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Both a = numbers.next(), b = numbers.next();
    for (const Both& v : {a + b, a - b, a * b, a / b, root(a)}) {
      const double share = share_of_error(v);
      EXPECT_LE(share, 1) << "seed " << kSeed << ", pair " << i;
      worst = std::max(worst, share);
    }
  }
  // The bounds are no fantasy: some operation uses a twentieth of what it is allowed.
  EXPECT_GT(worst, 0.05);
}

TEST(Ball, ErrorsAreCarriedThroughWhatCancels) {
  Numbers numbers;
  for (int i = 0; i < 20000; ++i) {
    const Both a = numbers.next(), b = numbers.next(), c = numbers.next();
    for (const Both& v : {(a + b) * (a + b) - a * a - b * b, (a / b) * (b / c) - a / c,
                          root(a * a + b) - a, root(a / c) * c / root(b)}) {
      EXPECT_LE(share_of_error(v), 1) << "seed " << kSeed << ", triple " << i;
    }
    // A root and a quotient are good to a hundred binary digits.
    const Ball v = root(a / b).ball;
    EXPECT_LT((v - v.middle()).most(), 0x1p-98L * v.value());
  }
}

TEST(Ball, WhatMayBeZeroIsNoDivisorAndHasNoRoot) {
  const Ball zero(0, 1e-30), one(1);
  for (const Ball& v : {one / zero, sqrt(zero), one / (one - one), (one / zero) * one}) {
    EXPECT_FALSE(v.most() < std::numeric_limits<long double>::infinity());
    EXPECT_FALSE(v.least() > -std::numeric_limits<long double>::infinity());
  }
}

}  // namespace
}  // namespace tangency::testing
