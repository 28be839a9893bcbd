// SPDX-License-Identifier: GPL-3.0-or-later
// The arithmetic of the cheap oracle beside 150 digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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

// Operands at the ends of wide balls, where bounds are all but reached.
TEST(Ball, AResultEnclosesWhateverItsOperandsMayBe) {
  Numbers numbers;
  std::mt19937_64 engine(kSeed + 1);
  std::uniform_int_distribution<int> digits(1, 40), ends(0, 1);
  std::array<double, 6> worst{};
  for (int i = 0; i < 4000; ++i) {
    const auto wide = [&](double share, int end) {
      const Both v = numbers.next();
      const double error = share * static_cast<double>(v.ball.value());
      return Both{v.ball + Ball(0, error), v.exact + end * Real(error)};
    };
    const auto operand = [&] {
      return wide(std::ldexp(1.0, -digits(engine)), 2 * ends(engine) - 1);
    };
    const Both a = operand(), b = operand();
    const Both minus{-a.ball, -a.exact};
    const std::array results{a + b, a - b, a * b, minus * b, minus / b, root(a)};
    for (std::size_t k = 0; k < results.size(); ++k) {
      const double share = share_of_error(results[k]);
      EXPECT_LE(share, 1) << "seed " << kSeed << ", pair " << i << ", result " << k;
      worst[k] = std::max(worst[k], share);
    }
  }
  // A root's bound takes the root at the lower end for 0.
  EXPECT_GT(worst.back(), 0.55);
  worst.back() = 1;
  for (const double share : worst) EXPECT_GT(share, 0.95);
}

TEST(Ball, WhatUnderflowsIsInTheError) {
  for (const int exponent : {-500, -520, -535, -600}) {
    const double v = std::ldexp(1.75, exponent);
    const Both tiny{Ball(v), Real(v)};
    for (const Both& product : {tiny * tiny, tiny * tiny * tiny, tiny * tiny / tiny - tiny})
      EXPECT_LE(share_of_error(product), 1) << exponent;
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
