// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Seeded draws for the families. Logarithms and roots are MPFR's, and all else is rounded once an
/// operation, so that the same seed gives the same doubles with every standard library, compiler
/// and processor. For that a family draws in the order of its statements: never twice among the
/// arguments of one call, whose order is the compiler's. A pair takes tens of microseconds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>

namespace tangency::inline v0::verify {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : bits_(seed) {}

  /// Both ends included.
  int integer(int from, int to);
  bool coin() { return integer(0, 1) == 1; }
  /// In [from, to), the product and the sum rounded to double each.
  double real(double from, double to);
  double log_uniform(double from, double to);
  /// Uniform over rotations: a point of the ball, of any length.
  std::array<double, 4> orientation();

  template <std::size_t n, class T>
  const T& one_of(const std::array<T, n>& values) {
    return values[static_cast<std::size_t>(integer(0, static_cast<int>(n) - 1))];
  }
  template <class Range>
  void shuffle(Range& values) {
    for (std::size_t i = values.size(); i-- > 1;) {
      std::swap(values[i], values[static_cast<std::size_t>(integer(0, static_cast<int>(i)))]);
    }
  }

 private:
  double unit();

  std::mt19937_64 bits_;
};

/// What drawn(draw, family) makes, again and again: an endless sequence, the same for a seed.
template <class Family>
class Sequence {
 public:
  Sequence(const Family& family, std::uint64_t seed) : family_(family), draw_(seed) {}
  auto next() { return drawn(draw_, family_); }

 private:
  Family family_;
  Draw draw_;
};

}  // namespace tangency::inline v0::verify
