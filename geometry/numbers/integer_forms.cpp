// SPDX-License-Identifier: MIT
#include <tangency/geometry/numbers/integer_forms.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>
#include <optional>
#include <utility>

namespace tangency::inline v0::exact {
namespace {

template <std::size_t N>
void swap_indices(IntegerForm<N>& form, std::size_t i, std::size_t j) {
  if (i == j) return;
  std::swap(form[i], form[j]);
  for (auto& row : form) std::swap(row[i], row[j]);
}

/// Row and column j added to row and column i.
template <std::size_t N>
void add_index(IntegerForm<N>& form, std::size_t i, std::size_t j) {
  for (std::size_t c = 0; c < N; ++c) form[i][c] += form[j][c];
  for (std::size_t r = 0; r < N; ++r) form[r][i] += form[r][j];
}

/// An index >= k whose diagonal entry is not zero, made by adding two rows where there is none;
/// nothing where the block from k on is zero.
template <std::size_t N>
std::optional<std::size_t> find_pivot(IntegerForm<N>& form, std::size_t k) {
  for (std::size_t i = k; i < N; ++i) {
    if (form[i][i] != 0) return i;
  }
  for (std::size_t i = k; i < N; ++i) {
    for (std::size_t j = i + 1; j < N; ++j) {
      if (form[i][j] != 0) {
        add_index(form, i, j);
        return i;
      }
    }
  }
  return std::nullopt;
}

/// Bareiss' step on the rows below k: the divisions leave no remainder.
template <std::size_t N>
void eliminate(IntegerForm<N>& form, std::size_t k, const mpz_class& previous_pivot) {
  mpz_class entry;
  for (std::size_t i = k + 1; i < N; ++i) {
    for (std::size_t j = i; j < N; ++j) {
      entry = form[k][k] * form[i][j] - form[i][k] * form[k][j];
      mpz_divexact(form[i][j].get_mpz_t(), entry.get_mpz_t(), previous_pivot.get_mpz_t());
      if (j != i) form[j][i] = form[i][j];
    }
  }
}

/// Leading principal minors, none of them zero, of a matrix congruent to the form by a matrix of
/// determinant +-1; as many as its rank.
template <std::size_t N>
struct Minors {
  std::array<mpz_class, N> value;
  std::size_t count = 0;
};

template <std::size_t N>
Minors<N> regular_minors(IntegerForm<N> form) {
  Minors<N> minors;
  mpz_class previous = 1;
  for (std::size_t k = 0; k < N; ++k) {
    const auto pivot = find_pivot(form, k);
    if (!pivot) break;
    swap_indices(form, k, *pivot);
    eliminate(form, k, previous);
    previous = form[k][k];
    minors.value[minors.count++] = previous;
  }
  return minors;
}

}  // namespace

Dyadic decode(double value) noexcept {
  constexpr int mantissa_bits = std::numeric_limits<double>::digits - 1;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const auto biased_exponent = static_cast<int>((bits >> mantissa_bits) & 0x7ff);
  assert(biased_exponent != 0x7ff && "a finite double");
  std::uint64_t magnitude = bits & ((std::uint64_t{1} << mantissa_bits) - 1);
  if (biased_exponent != 0) magnitude |= std::uint64_t{1} << mantissa_bits;
  if (magnitude == 0) return {0, 0};
  const int trailing = std::countr_zero(magnitude);
  const auto odd = static_cast<std::int64_t>(magnitude >> trailing);
  const int exponent = std::max(biased_exponent, 1) - 1075 + trailing;
  return {bits >> 63 != 0 ? -odd : odd, exponent};
}

int common_exponent(std::span<const double> values) noexcept {
  constexpr int none = std::numeric_limits<int>::max();
  int smallest = none;
  for (const double value : values) {
    const Dyadic dyadic = decode(value);
    if (dyadic.mantissa != 0) smallest = std::min(smallest, dyadic.exponent);
  }
  return smallest == none ? 0 : smallest;
}

mpz_class to_integer(std::int64_t value) {
  // GMP's own conversions end at a long, which has 32 bits on some systems.
  if constexpr (sizeof(long) >= sizeof(value)) return static_cast<long>(value);
  mpz_class result = static_cast<long>(value >> 32);
  result <<= 32;
  result += static_cast<unsigned long>(value & 0xffffffff);
  return result;
}

mpz_class to_integer(double value, int exponent) {
  const Dyadic dyadic = decode(value);
  mpz_class result = to_integer(dyadic.mantissa);
  if (dyadic.mantissa == 0) return result;
  assert(dyadic.exponent >= exponent && "an integer multiple of 2^exponent");
  result <<= static_cast<mp_bitcnt_t>(dyadic.exponent - exponent);
  return result;
}

mpq_class to_rational(double value) {
  const Dyadic dyadic = decode(value);
  mpq_class result = to_integer(dyadic.mantissa);
  if (dyadic.exponent >= 0) {
    result <<= static_cast<mp_bitcnt_t>(dyadic.exponent);
  } else {
    result >>= static_cast<mp_bitcnt_t>(-dyadic.exponent);
  }
  return result;
}

void strip_powers_of_two(std::span<mpz_class> values) {
  mp_bitcnt_t common = ~mp_bitcnt_t{0};
  for (const mpz_class& v : values) {
    if (v != 0) common = std::min(common, mpz_scan1(v.get_mpz_t(), 0));
  }
  for (mpz_class& v : values) v >>= common;
}

template <std::size_t N>
Inertia inertia(const IntegerForm<N>& form) {
  const Minors<N> minors = regular_minors(form);
  Inertia result;
  int previous = 1;
  for (std::size_t k = 0; k < minors.count; ++k) {
    const int sign = sgn(minors.value[k]);
    ++(sign == previous ? result.positive : result.negative);
    previous = sign;
  }
  result.zero = static_cast<int>(N) - result.rank();
  return result;
}

template <std::size_t N>
mpz_class determinant(const IntegerForm<N>& form) {
  const Minors<N> minors = regular_minors(form);
  return minors.count == N ? minors.value[N - 1] : mpz_class(0);
}

// Faddeev and LeVerrier's recurrence: M_1 = F, e_k = tr(M_k)/k, M_(k+1) = F (e_k I - M_k).
template <std::size_t N>
std::array<mpz_class, N + 1> characteristic_coefficients(const IntegerForm<N>& form) {
  std::array<mpz_class, N + 1> coefficients;
  coefficients[0] = 1;
  IntegerForm<N> power = form;
  for (std::size_t k = 1; k <= N; ++k) {
    mpz_class trace = 0;
    for (std::size_t i = 0; i < N; ++i) trace += power[i][i];
    mpz_divexact_ui(coefficients[k].get_mpz_t(), trace.get_mpz_t(), k);
    if (k == N) break;
    IntegerForm<N> next;
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j < N; ++j) {
        next[i][j] = coefficients[k] * form[i][j];
        for (std::size_t m = 0; m < N; ++m) next[i][j] -= form[i][m] * power[m][j];
      }
    }
    power = std::move(next);
  }
  return coefficients;
}

Inertia inertia_from_signs(std::span<const int> signs) noexcept {
  Inertia result;
  int previous_direct = 1;
  int previous_alternating = 1;
  int parity = 1;
  std::size_t last_nonzero = 0;
  for (std::size_t k = 1; k < signs.size(); ++k) {
    parity = -parity;
    if (signs[k] == 0) continue;
    last_nonzero = k;
    if (signs[k] != previous_direct) ++result.negative;
    if (parity * signs[k] != previous_alternating) ++result.positive;
    previous_direct = signs[k];
    previous_alternating = parity * signs[k];
  }
  result.zero = static_cast<int>(signs.size() - 1 - last_nonzero);
  return result;
}

IntegerForm<3> sub_form(const IntegerForm<4>& form) {
  IntegerForm<3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = form[i][j];
  }
  return result;
}

template <std::size_t N>
IntegerForm<N> combine(const mpz_class& weight_a, const IntegerForm<N>& a,
                       const mpz_class& weight_b, const IntegerForm<N>& b) {
  IntegerForm<N> result;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) result[i][j] = weight_a * a[i][j] + weight_b * b[i][j];
  }
  return result;
}

IntegerForm<4> quadric_form(std::span<const double, 10> coefficients, int exponent) {
  constexpr std::array<std::array<std::size_t, 4>, 4> position{
      {{0, 3, 5, 6}, {3, 1, 4, 7}, {5, 4, 2, 8}, {6, 7, 8, 9}}};
  IntegerForm<4> form;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      form[i][j] = to_integer(coefficients[position[i][j]], exponent);
    }
  }
  return form;
}

// NOLINTBEGIN(bugprone-macro-parentheses): a template argument takes none
#define TANGENCY_INSTANTIATE(N)                                                                 \
  template Inertia inertia<N>(const IntegerForm<N>&);                                           \
  template mpz_class determinant<N>(const IntegerForm<N>&);                                     \
  template std::array<mpz_class, N + 1> characteristic_coefficients<N>(const IntegerForm<N>&);  \
  template IntegerForm<N> combine<N>(const mpz_class&, const IntegerForm<N>&, const mpz_class&, \
                                     const IntegerForm<N>&)
TANGENCY_INSTANTIATE(2);
TANGENCY_INSTANTIATE(3);
TANGENCY_INSTANTIATE(4);
#undef TANGENCY_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace tangency::inline v0::exact
