// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The kit of the adversarial families: seeded draws that do not depend on the standard library's
/// distributions, bodies of integers, and two of them that touch exactly.
#pragma once

#include <gmpxx.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>

#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::verify::construction {

using Vector = std::array<mpz_class, 3>;
using Quaternion = std::array<int, 4>;  // w x y z

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : bits_(seed) {}

  int integer(int from, int to) {  // both ends included
    return from + static_cast<int>(bits_() % static_cast<std::uint64_t>(to - from + 1));
  }
  double real(double from, double to) {
    return from + (to - from) * std::ldexp(static_cast<double>(bits_() >> 11), -53);
  }
  double log_uniform(double from, double to) {
    return std::exp(real(std::log(from), std::log(to)));
  }
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
  Quaternion quaternion() {
    Quaternion q{};
    while (q == Quaternion{}) {
      for (int& v : q) v = integer(-2, 2);
    }
    return q;
  }
  std::array<double, 4> real_quaternion() {
    return {real(-1, 1), real(-1, 1), real(-1, 1), real(0.01, 1)};
  }

 private:
  std::mt19937_64 bits_;
};

int norm(const Quaternion& q);  // w^2 + x^2 + y^2 + z^2

// norm(q) R(q) v, or norm(q) R(q)' v.
Vector turned(const Quaternion& q, const Vector& v, bool back = false);

struct ExactBody {
  Vector centre, axes;
  Quaternion q{1, 0, 0, 0};
};

// The body times 2^exponent. Nothing unless every number is a double: below 2^53 before that.
std::optional<RawEllipsoid> raw(const ExactBody& body, int exponent = 0);

// An integer point of a sphere of integer radius, no coordinate zero.
struct SpherePoint {
  Vector u;
  int radius;
};

SpherePoint sphere_point(Draw& draw);

// Entries from -size to size, and from 1 to largest.
Vector small_vector(Draw& draw, int size);
Vector small_axes(Draw& draw, int largest);

// Two integer bodies that touch in an integer point with a common normal n (outward for A).
// With the surface point R diag(a) u the normal is R diag(1/a) u: u is an integer point of a
// sphere, and B's semi-axes are whatever gives its own such point the normal -n (outside) or n
// (inside).
struct Contact {
  ExactBody a, b;
  Vector n;
  double
      rho;  // outside: sum of the smallest radii of curvature; inside: A's smallest - B's largest
  bool inside;
};

// Nothing if this draw leads to no contact.
std::optional<Contact> contact(Draw& draw, bool inside);

}  // namespace tangency::verify::construction
