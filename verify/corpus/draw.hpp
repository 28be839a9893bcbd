// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Seeded draws for the corpora. Logarithms and roots are MPFR's, correctly rounded, so that the
/// same seed gives the same doubles with every standard library, compiler and processor.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>

#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::verify {

inline double rounded(const Real& v) { return v.convert_to<double>(); }

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : bits_(seed) {}

  int integer(int from, int to) {  // both ends included
    return from + static_cast<int>(bits_() % static_cast<std::uint64_t>(to - from + 1));
  }
  bool coin() { return integer(0, 1) == 1; }
  // In [from, to), the product and the sum rounded to double each.
  double real(double from, double to) { return from + (to - from) * unit(); }
  double log_uniform(double from, double to) {
    const Real low = log(Real(from));
    return rounded(exp(low + (log(Real(to)) - low) * unit()));
  }
  // Uniform over the unit sphere.
  Real3 direction() {
    for (;;) {
      Real3 n;
      for (Real& v : n) v = real(-1, 1);
      const Real square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
      if (square > 1 || square < 0.01) continue;
      for (Real& v : n) v /= sqrt(square);
      return n;
    }
  }
  // Uniform over rotations: a point of the ball, of any length.
  std::array<double, 4> orientation() {
    for (;;) {
      std::array<double, 4> q;
      double square = 0;
      for (double& v : q) v = real(-1, 1), square += v * v;
      if (square > 0.01 && square <= 1) return q;
    }
  }
  template <class Range>
  void shuffle(Range& values) {
    for (std::size_t i = values.size(); i-- > 1;) {
      std::swap(values[i], values[static_cast<std::size_t>(integer(0, static_cast<int>(i)))]);
    }
  }

 private:
  double unit() { return std::ldexp(static_cast<double>(bits_() >> 11), -53); }

  std::mt19937_64 bits_;
};

}  // namespace tangency::verify
