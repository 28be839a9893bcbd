// SPDX-License-Identifier: MIT
/// @file
/// Elementary functions with the same bits on every machine, where a state hangs on them: those of
/// the C library depend on its version and, where it has copies with fused multiply-adds, on the
/// processor.
///
/// They use nothing but operations that IEEE 754 rounds. In the default rounding mode.
#pragma once

namespace tangency::inline v0::dem {

/// The natural logarithm, within kLogarithmError; of 0 and of negative numbers as std::log.
double logarithm(double x);

/// In ulps of the true value. Measured: 1.8.
inline constexpr double kLogarithmError = 2.5;

/// The exponential function of -700 to 700, within kExponentialError.
double exponential(double x);

/// In ulps of the true value. Measured: 0.93.
inline constexpr double kExponentialError = 1.5;

/// The cube root, rounded correctly but for one in 2^45 that lies by a tie.
double cube_root(double x);

struct CosineSine {
  double cosine, sine;
};
/// Of an angle of at most 2^20 rad, either within detail::kSineError.
CosineSine cosine_sine(double angle);

}  // namespace tangency::inline v0::dem
