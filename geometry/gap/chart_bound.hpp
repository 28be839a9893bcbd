// SPDX-License-Identifier: MIT
/// @file
/// What f(n) = n.d - h_A(n) + h_B(n), minus a clearance, is at most on an arc or a triangle of
/// normals, in the chart p = c + s of a normal c among them. Derivation: section 4 of
/// docs/derivations/containment.md. Assumes rounding to nearest.
///
/// (1) For p = c + sum of l_i s_i, l_i >= 0 of sum 1, f(p / |p|) <= value + excess().
///
/// What excess() is too large by is of the third order in the s_i, times |n.d - value| / (h_A +
/// h_B): for bodies that are nearly the same, as small as the difference between them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::detail {

/// (Q) of the derivation, of the size |d| + a_A + a_B: `noise` in double and in double-double.
inline constexpr double kChartNoise = 0x1p-44, kChartNoiseInDoubleDouble = 0x1p-86;

inline double inner_product(const Vec3& a, const Vec3& b) noexcept { return a.dot(b); }
inline DoubleDouble inner_product(const DoubleDoubleVector& a,
                                  const DoubleDoubleVector& b) noexcept {
  return dot(a, b);
}
inline DoubleDouble inner_product(const DoubleDouble2& a, const DoubleDouble2& b) noexcept {
  return dot(a, b);
}

/// By pairs of corners.
template <class Real, std::size_t Corners>
using PairTable = std::array<std::array<Real, Corners>, Corners>;

/// One body: y = A'c and w_i = A's_i.
template <class Real, std::size_t Corners>
struct ChartSide {
  Real h;                            ///< |y|
  double width = 0.0;                ///< |w| <= width h between the corners
  double most = 0.0;                 ///< of s' Hess h s between them
  double low = 0.0, high = 0.0;      ///< of w . y / h^2 there
  std::array<Real, Corners> along;   ///< w_i . y / h
  PairTable<Real, Corners> product;  ///< w_i . w_j
  PairTable<Real, Corners> bend;     ///< s_i' Hess h s_j

  /// @param stretch  v -> A'v
  template <class Vector, class Stretch>
  ChartSide(const Stretch& stretch, const Vector& c, const std::array<Vector, Corners>& s) {
    using std::sqrt;
    const Vector y = stretch(c);
    h = sqrt(inner_product(y, y));
    std::array<Vector, Corners> w;
    for (std::size_t i = 0; i < Corners; ++i) {
      w[i] = stretch(s[i]);
      along[i] = inner_product(y, w[i]) / h;
      const double share = double(along[i]) / double(h);
      low = std::min(low, share), high = std::max(high, share);
    }
    for (std::size_t i = 0; i < Corners; ++i) {
      for (std::size_t j = i; j < Corners; ++j) {
        product[i][j] = product[j][i] = inner_product(w[i], w[j]);
        bend[i][j] = bend[j][i] = (product[i][j] - along[i] * along[j]) / h;
      }
      width = std::max(width, std::sqrt(double(product[i][i])) / double(h));
      most = std::max(most, double(bend[i][i]));
    }
  }

  /// Bounds of |y + w| less its second order, h + along + bend / 2: from w's part across y, as |y +
  /// w| + (y + w).y/h is at least 2 h (1 + low), and at most 2 h (1 + high) + most / (2 + 2 low).
  double third() const {
    const double above = high + 0.25 * most / (double(h) * (1.0 + low));
    return 0.5 * most * std::max(-low / (1.0 + low), above / (1.0 + above));
  }
};

template <class Real, std::size_t Corners>
class Chart {
 public:
  /// @param c         unit but for rounding in Real
  /// @param corner    of any length
  /// @param stretch_a, stretch_b  v -> A'v, B'v
  template <class Vector, class StretchA, class StretchB>
  Chart(const Vector& d, const Vector& c, const std::array<Vector, Corners>& corner,
        const StretchA& stretch_a, const StretchB& stretch_b)
      : Chart(d, c, spread(c, corner), stretch_a, stretch_b, 0) {}

  /// f(c)
  Real at_centre() const noexcept { return (d_at_c_ - a_.h) + b_.h; }

  /// Infinite where the corners are too far apart for the chart.
  /// @param noise  what lengths may be off by
  double excess(const Real& value, double noise) const noexcept;

 private:
  template <class Vector, class StretchA, class StretchB>
  Chart(const Vector& d, const Vector& c, const std::array<Vector, Corners>& s,
        const StretchA& stretch_a, const StretchB& stretch_b, int)
      : a_(stretch_a, c, s), b_(stretch_b, c, s), d_at_c_(inner_product(d, c)) {
    double reach = 0.0;
    for (std::size_t i = 0; i < Corners; ++i) {
      d_along_[i] = inner_product(d, s[i]);
      for (std::size_t j = 0; j < Corners; ++j) square_[i][j] = inner_product(s[i], s[j]);
      reach = std::max(reach, double(square_[i][i]));
    }
    longest_ = std::sqrt(1.0 + reach);
  }

  /// The s_i; -c, too long for the chart, for corners that are far from c.
  template <class Vector>
  static std::array<Vector, Corners> spread(const Vector& c,
                                            const std::array<Vector, Corners>& corner) {
    std::array<Vector, Corners> s;
    for (std::size_t i = 0; i < Corners; ++i) {
      const Real t = inner_product(corner[i], c), square = inner_product(corner[i], corner[i]);
      const bool near = double(t) > 0.0 && 2.0 * double(t) * double(t) > double(square);
      const Real inverse = near ? Real(1.0) / t : Real(0.0);
      s[i] = inverse * corner[i] + Real(-1.0) * c;
    }
    return s;
  }

  ChartSide<Real, Corners> a_, b_;
  Real d_at_c_;
  std::array<Real, Corners> d_along_;  ///< d . s_i
  PairTable<Real, Corners> square_;    ///< s_i . s_j
  double longest_;                     ///< of p
};

template <class Real, std::size_t Corners>
double Chart<Real, Corners>::excess(const Real& value, double noise) const noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kWidest = 0.5, kLongest = 1.25;  // chosen
  constexpr double kSlack = 1.0 + 0x1p-20;          // covers what is rounded in double
  if (a_.width > kWidest || b_.width > kWidest || longest_ > kLongest) return kInfinity;
  // psi = n.d - value, times |p|, is at most ..., g = h_A + h_B, times |p|, about ..., and q =
  // h_A^2 - h_B^2, times |p|^2, is the quadratic form of these coefficients.
  // |p| <= 1 + |s|^2 / 2, and >= 1 + |s|^2 / (1 + longest).
  const Real half(0.5);
  const Real tilt = Real(double(value) < 0.0 ? -0.5 : -1.0 / (kSlack * (1.0 + longest_))) * value;
  PairTable<Real, Corners> psi, g, q;
  double largest = 0.0;
  for (std::size_t i = 0; i < Corners; ++i) {
    for (std::size_t j = 0; j < Corners; ++j) {
      const Real along_a = a_.along[i] + a_.along[j], along_b = b_.along[i] + b_.along[j];
      psi[i][j] = (d_at_c_ - value) + half * (d_along_[i] + d_along_[j]) + tilt * square_[i][j];
      g[i][j] = (a_.h + b_.h) + half * ((along_a + along_b) + (a_.bend[i][j] + b_.bend[i][j]));
      q[i][j] = ((a_.h * a_.h - b_.h * b_.h) + (a_.h * along_a - b_.h * along_b)) +
                (a_.product[i][j] - b_.product[i][j]);
      largest = std::max(largest, std::abs(double(psi[i][j])));
    }
  }
  // No polynomial is above the largest of its Bernstein coefficients.
  double most = -kInfinity;
  for (std::size_t i = 0; i < Corners; ++i) {
    for (std::size_t j = i; j < Corners; ++j) {
      for (std::size_t k = j; k < Corners; ++k) {
        for (std::size_t l = k; l < Corners; ++l) {
          const auto of = [&](std::size_t m, std::size_t n, std::size_t o, std::size_t p) {
            return (psi[m][n] * g[o][p] - q[m][n]) + (psi[o][p] * g[m][n] - q[o][p]);
          };
          const Real sum = (of(i, j, k, l) + of(i, k, j, l)) + of(i, l, j, k);
          const double bound = double(sum) / 6.0;
          if (!(bound <= most) && !std::isnan(most)) most = bound;  // NaN stays
        }
      }
    }
  }
  const double h_a = double(a_.h), h_b = double(b_.h);
  const double g_high = kSlack * ((1.0 + a_.width) * h_a + (1.0 + b_.width) * h_b);
  const double g_low = ((1.0 - a_.width) * h_a + (1.0 - b_.width) * h_b) / kSlack;
  most += kSlack * largest * (a_.third() + b_.third()) + noise * g_high;
  return most > 0.0 ? kSlack * most / g_low : most / (kSlack * longest_ * g_high);
}

}  // namespace tangency::inline v0::detail
