// SPDX-License-Identifier: MIT
/// @file
/// What two circular sections need at heights near a base: polynomials of the height, and what they
/// are at least and at most on a disc of the complex plane. Internal.
///
/// With r_1^2, r_2^2 the squares of the radii, D that of the distance of the centres and
///
///     q_1 = D + r_1^2 - r_2^2,  q_2 = D + r_2^2 - r_1^2,  P = 4 D r_1^2 - q_1^2 = 4 D r_2^2 -
///     q_2^2
///
/// the circles cross where P > 0, in a chord of length sqrt(P / D), whose half is seen from the
/// centres under the angles whose tangents are sqrt(P) / q_1 and sqrt(P) / q_2.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/volume/circular_sections.hpp>

namespace tangency::inline v0::detail {

/// c_0 + c_1 v + ...
template <std::size_t N>
struct SlicePolynomial {
  std::array<double, N> c{};

  double operator()(double v) const noexcept {
    double sum = c[N - 1];
    for (std::size_t k = N - 1; k-- > 0;) sum = sum * v + c[k];
    return sum;
  }
  /// |value| <= most(r) for |v| <= r.
  double most(double r) const noexcept {
    double sum = std::abs(c[N - 1]);
    for (std::size_t k = N - 1; k-- > 0;) sum = sum * r + std::abs(c[k]);
    return sum;
  }
  /// |value| >= least(r) for |v| <= r; negative where nothing is known.
  double least(double r) const noexcept { return 2.0 * std::abs(c[0]) - most(r); }
  SlicePolynomial<N - 1> derivative() const noexcept {
    SlicePolynomial<N - 1> d;
    for (std::size_t k = 1; k < N; ++k) d.c[k - 1] = static_cast<double>(k) * c[k];
    return d;
  }
  /// Divided by v, but for the constant.
  SlicePolynomial<N - 1> deflated() const noexcept {
    SlicePolynomial<N - 1> d;
    for (std::size_t k = 1; k < N; ++k) d.c[k - 1] = c[k];
    return d;
  }
};

/// In v = (z - base) / step, rounded from the arithmetic of the bodies.
struct SliceExpansion {
  template <class T>
  SliceExpansion(const CircularSections<T>& bodies, const DoubleDouble& base, double step) noexcept;

  double base, step;
  SlicePolynomial<2> x;  ///< of the second circle's centre; y is constant
  double y;
  SlicePolynomial<3> ball, second, distance;  ///< r_1^2, r_2^2, D
  SlicePolynomial<3> q1, q2;
  SlicePolynomial<5> p;
  /// Beyond the rounding of each coefficient, what each of these is off on |v| <= kFarthest:
  /// squares of lengths, P, and x.
  double of_square, of_p, of_x;

  static constexpr double kFarthest = 4.5;
};

}  // namespace tangency::inline v0::detail
