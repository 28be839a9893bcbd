// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Eigenvalues of a symmetric matrix in high precision, by Jacobi's method. Inner header of the
/// oracles.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::inline v0::verify {

/// Eigenvalues in any order, and the orthogonal matrix whose rows are their unit eigenvectors: to
/// some 140 digits. `m` is symmetric.
template <std::size_t N>
std::pair<std::array<Real, N>, std::array<std::array<Real, N>, N>> jacobi_eigen(
    std::array<std::array<Real, N>, N> m) {
  std::array<std::array<Real, N>, N> u{};
  for (std::size_t i = 0; i < N; ++i) u[i][i] = 1;
  constexpr int kSweeps = 40;  // chosen: several times what 150 digits take
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool done = true;
    for (std::size_t p = 0; p < N; ++p) {
      for (std::size_t q = p + 1; q < N; ++q) {
        if (abs(m[p][q]) <= Real("1e-148") * sqrt(abs(m[p][p] * m[q][q]))) continue;
        done = false;
        const Real theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
        Real t = 1 / (abs(theta) + sqrt(theta * theta + 1));
        if (theta < 0) t = -t;
        const Real c = 1 / sqrt(t * t + 1), s = t * c;
        for (std::size_t i = 0; i < N; ++i) {
          const Real ip = m[i][p], iq = m[i][q];
          m[i][p] = c * ip - s * iq, m[i][q] = s * ip + c * iq;
        }
        for (std::size_t i = 0; i < N; ++i) {
          const Real pi = m[p][i], qi = m[q][i], up = u[p][i], uq = u[q][i];
          m[p][i] = c * pi - s * qi, m[q][i] = s * pi + c * qi;
          u[p][i] = c * up - s * uq, u[q][i] = s * up + c * uq;
        }
      }
    }
    if (done) break;
  }
  std::array<Real, N> values;
  for (std::size_t i = 0; i < N; ++i) values[i] = m[i][i];
  return {values, u};
}

}  // namespace tangency::inline v0::verify
