// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/families/draw.hpp>

#include <boost/multiprecision/mpfr.hpp>

#include <cmath>

namespace tangency::inline v0::verify {
namespace {

// Chosen: 24 digits more than a double has, in half the time that those of Real take.
using Digits = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<40, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;

}  // namespace

double Draw::unit() { return std::ldexp(static_cast<double>(bits_() >> 11), -53); }

int Draw::integer(int from, int to) {
  return from + static_cast<int>(bits_() % static_cast<std::uint64_t>(to - from + 1));
}

double Draw::real(double from, double to) { return from + (to - from) * unit(); }

double Draw::log_uniform(double from, double to) {
  const Digits low = log(Digits(from)), high = log(Digits(to));
  return Digits(exp(low + (high - low) * unit())).convert_to<double>();
}

std::array<double, 4> Draw::orientation() {
  for (;;) {
    std::array<double, 4> q;
    double square = 0;
    for (double& v : q) v = real(-1, 1), square += v * v;
    if (square > 0.01 && square <= 1) return q;
  }
}

}  // namespace tangency::inline v0::verify
