// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/inertia.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tangency::inline v0::verify {
namespace {

// The block [from, size) has a zero diagonal; makes one of its diagonal entries nonzero by a
// unimodular congruence. False if the block is zero.
bool create_pivot(IntegerMatrix& m, std::size_t from, std::size_t size) {
  for (std::size_t i = from; i < size; ++i) {
    for (std::size_t j = i + 1; j < size; ++j) {
      if (m[i][j] == 0) continue;
      for (std::size_t k = from; k < size; ++k) m[i][k] += m[j][k];
      for (std::size_t k = from; k < size; ++k) m[k][i] += m[k][j];
      return true;
    }
  }
  return false;
}

// Exchanges variables i and j.
void exchange(IntegerMatrix& m, std::size_t i, std::size_t j, std::size_t size) {
  if (i == j) return;
  std::swap(m[i], m[j]);
  for (std::size_t k = 0; k < size; ++k) std::swap(m[k][i], m[k][j]);
}

}  // namespace

ScaledIntegers to_integers(std::span<const double> values) {
  constexpr int kDigits = std::numeric_limits<double>::digits;
  std::vector<std::pair<std::int64_t, int>> parts;  // value = first 2^second, first odd or 0
  parts.reserve(values.size());
  int lowest = std::numeric_limits<int>::max();
  for (const double value : values) {
    if (!std::isfinite(value)) throw std::invalid_argument("oracle: a number is not finite");
    int exponent = 0;
    auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), kDigits));
    exponent -= kDigits;
    if (mantissa != 0) {
      const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
      mantissa /= std::int64_t{1} << zeros;
      exponent += zeros;
      lowest = std::min(lowest, exponent);
    }
    parts.emplace_back(mantissa, exponent);
  }
  ScaledIntegers result;
  if (lowest != std::numeric_limits<int>::max()) result.exponent = lowest;
  result.m.reserve(parts.size());
  for (const auto& [mantissa, exponent] : parts) {
    mpz_class integer(static_cast<double>(mantissa));  // below 2^53, so exact
    if (mantissa != 0) integer <<= static_cast<mp_bitcnt_t>(exponent - lowest);
    result.m.push_back(std::move(integer));
  }
  return result;
}

IntegerMatrix discriminant_matrix(const RawQuadric& q) {
  const std::array<double, 10> values{q.A, q.B, q.C, q.D, q.E, q.F, q.G, q.H, q.J, q.K};
  const ScaledIntegers s = to_integers(values);
  const mpz_class &a = s.m[0], &b = s.m[1], &c = s.m[2], &d = s.m[3], &e = s.m[4], &f = s.m[5],
                  &g = s.m[6], &h = s.m[7], &j = s.m[8], &k = s.m[9];
  return {{{a, d, f, g}, {d, b, e, h}, {f, e, c, j}, {g, h, j, k}}};
}

Inertia inertia(IntegerMatrix m, int size) {
  const auto n = static_cast<std::size_t>(size);
  Inertia result;
  mpz_class previous = 1;
  for (std::size_t step = 0; step < n; ++step) {
    std::size_t pivot = step;
    while (pivot < n && m[pivot][pivot] == 0) ++pivot;
    if (pivot == n) {
      if (!create_pivot(m, step, n)) {
        result.zero = size - static_cast<int>(step);
        return result;
      }
      pivot = step;
      while (m[pivot][pivot] == 0) ++pivot;
    }
    exchange(m, step, pivot, n);
    const mpz_class p = m[step][step];
    // The entries are minors: this Schur pivot is p / previous.
    (sgn(p) * sgn(previous) > 0 ? result.positive : result.negative) += 1;
    for (std::size_t i = step + 1; i < n; ++i) {
      for (std::size_t j = i; j < n; ++j) {
        mpz_class entry = p * m[i][j] - m[i][step] * m[j][step];
        mpz_divexact(entry.get_mpz_t(), entry.get_mpz_t(), previous.get_mpz_t());
        m[i][j] = entry;
        m[j][i] = entry;
      }
    }
    previous = p;
  }
  return result;
}

}  // namespace tangency::inline v0::verify
