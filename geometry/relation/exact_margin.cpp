// SPDX-License-Identifier: MIT
#include <tangency/geometry/relation/exact_margin.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/numbers/integer_polynomial.hpp>
#include <tangency/geometry/numbers/real_roots.hpp>

namespace tangency::inline v0::exact {
namespace {

using Polynomial = IntegerPolynomial;
template <std::size_t N>
using PolynomialMatrix = std::array<std::array<Polynomial, N>, N>;

// Of s^2, so that s is known to half of it and its rounding to 53 bits is nearly all of its error.
constexpr mp_bitcnt_t kBits = 56;
// Of a square root that is taken in integers; chosen, beyond kBits.
constexpr long kRootBits = 80;

/// 2^k
mpq_class power_of_two(long k) {
  mpq_class result(1);
  if (k >= 0) {
    result <<= static_cast<mp_bitcnt_t>(k);
  } else {
    result >>= static_cast<mp_bitcnt_t>(-k);
  }
  return result;
}

/// The least common denominator of what it is given.
class Denominator {
 public:
  void take(const mpq_class& q) {
    mpz_lcm(value_.get_mpz_t(), value_.get_mpz_t(), q.get_den().get_mpz_t());
  }
  template <class Rows>
  void take_rows(const Rows& rows) {
    for (const auto& row : rows) {
      for (const mpq_class& q : row) take(q);
    }
  }
  const mpz_class& value() const { return value_; }
  /// q times it.
  mpz_class numerator(const mpq_class& q) const { return q.get_num() * (value_ / q.get_den()); }

 private:
  mpz_class value_ = 1;
};

Polynomial difference(Polynomial a, const Polynomial& b) { return a -= b; }

/// By the first row.
template <std::size_t N>
Polynomial determinant_of(const PolynomialMatrix<N>& m) {
  const auto minor = [&](std::size_t i, std::size_t j) {
    return difference(m[1][i] * m[N - 1][j], m[1][j] * m[N - 1][i]);
  };
  if constexpr (N == 2) {
    return difference(m[0][0] * m[1][1], m[0][1] * m[1][0]);
  } else {
    Polynomial result = m[0][0] * minor(1, 2);
    result += m[0][1] * minor(2, 0);
    result += m[0][2] * minor(0, 1);
    return result;
  }
}

/// e' adj(m) e of a symmetric m = - det [[m, e], [e', 0]], by cofactors.
template <std::size_t N>
Polynomial form_of_adjugate(const PolynomialMatrix<N>& m, const std::array<Polynomial, N>& e) {
  Polynomial result;
  if constexpr (N == 2) {
    result += e[0] * e[0] * m[1][1];
    result += e[1] * e[1] * m[0][0];
    result -= e[0] * e[1] * m[0][1];
    result -= e[0] * e[1] * m[1][0];
  } else {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
        result += e[i] * e[j] * difference(m[a][c] * m[b][d], m[a][d] * m[b][c]);
      }
    }
  }
  return result;
}

/// G(v) = 1/v - N(v) / D(v) and what tells on which side of its maximum v is.
template <std::size_t N>
class MarginForm {
 public:
  MarginForm(const RationalSolid<N>& inner, const RationalSolid<N>& outer) {
    // v M_A - M_B in a unit of length in which both are integers, times `unit`; e times `length`.
    Denominator shapes, lengths;
    shapes.take_rows(outer.shape), shapes.take_rows(inner.shape);
    RationalVector<N> e;
    for (std::size_t i = 0; i < N; ++i) {
      e[i] = inner.centre[i] - outer.centre[i];
      lengths.take(e[i]);
    }
    PolynomialMatrix<N> m;
    std::array<Polynomial, N> apart;
    for (std::size_t i = 0; i < N; ++i) {
      apart[i] = Polynomial({lengths.numerator(e[i])});
      for (std::size_t j = 0; j < N; ++j) {
        m[i][j] =
            Polynomial({-shapes.numerator(inner.shape[i][j]), shapes.numerator(outer.shape[i][j])});
      }
    }
    // N / D = (unit / length^2) e' adj e / det.
    const Polynomial unit({shapes.value()}), square({lengths.value() * lengths.value()});
    denominators_.push_back(square * determinant_of(m));
    numerator_ = unit * form_of_adjugate(m, apart);
    for (std::size_t k = 1; k < N; ++k) denominators_.push_back(denominators_.back().derivative());
    const Polynomial& d = denominators_.front();
    slope_ = Polynomial({0, 0, 1}) *
             difference(numerator_ * d.derivative(), numerator_.derivative() * d);
    slope_ -= d * d;
  }

  /// Is e in the interior of A: e' M_A^-1 e < 1?
  bool centre_is_inside() const {
    if (numerator_.degree() < static_cast<int>(N) - 1) return true;
    return numerator_.leading() < denominators_.front().leading();
  }

  /// Is v below the maximum: v M_A - M_B not positive definite, or G'(v) > 0? All roots of D are
  /// real, so that v is above them if and only if D and its derivatives are > 0 there.
  bool is_below(const mpq_class& v) const {
    for (const Polynomial& d : denominators_) {
      if (d.sign_at(v) <= 0) return true;
    }
    return slope_.sign_at(v) > 0;
  }

  /// N(v) / D(v)
  mpq_class quotient(const mpq_class& v) const {
    return value_at(numerator_, v) / value_at(denominators_.front(), v);
  }

 private:
  static mpq_class value_at(const Polynomial& p, const mpq_class& v) {
    mpq_class value;
    for (auto c = p.coefficients().rbegin(); c != p.coefficients().rend(); ++c)
      value = value * v + *c;
    return value;
  }

  std::vector<Polynomial> denominators_;  ///< D and its derivatives
  Polynomial numerator_;
  Polynomial slope_;  ///< v^2 D^2 G'(v)
};

/// k with 2^k below the maximum and 2^(k + 1) not.
template <std::size_t N>
long power_below(const MarginForm<N>& form) {
  long low = 0, high = 0, width = 1;
  if (form.is_below(power_of_two(0))) {
    for (high = width; form.is_below(power_of_two(high)); high += (width *= 2)) low = high;
  } else {
    for (low = -width; !form.is_below(power_of_two(low)); low -= (width *= 2)) high = low;
  }
  while (high - low > 1) {
    const long middle = low + (high - low) / 2;
    (form.is_below(power_of_two(middle)) ? low : high) = middle;
  }
  return low;
}

/// The integers whose squares are next to q 2^(2 shift), where shift leaves them kRootBits long.
MarginEnclosure root(const mpq_class& low, const mpq_class& high) {
  const long bits = bit_length(high.get_num()) - bit_length(high.get_den());
  const long shift = kRootBits - bits / 2;
  const mpq_class square = power_of_two(2 * shift), unit = power_of_two(-shift);
  mpz_class below, above;
  const mpq_class scaled_low = low * square, scaled_high = high * square;
  mpz_fdiv_q(below.get_mpz_t(), scaled_low.get_num().get_mpz_t(), scaled_low.get_den().get_mpz_t());
  mpz_cdiv_q(above.get_mpz_t(), scaled_high.get_num().get_mpz_t(),
             scaled_high.get_den().get_mpz_t());
  const mpz_class root_below = sqrt(below);
  mpz_class root_above = sqrt(above);
  if (root_above * root_above < above) ++root_above;
  return {unit * root_below, unit * root_above};
}

}  // namespace

template <std::size_t N>
MarginEnclosure margin(const RationalSolid<N>& inner, const RationalSolid<N>& outer) {
  const MarginForm<N> form(inner, outer);
  if (!form.centre_is_inside()) return {0, 0};
  const long power = power_below(form);
  mpq_class below = power_of_two(power), beyond = power_of_two(power + 1);
  const auto halve = [&] {
    const mpq_class middle = (below + beyond) / 2;
    (form.is_below(middle) ? below : beyond) = middle;
  };
  // s^2 is at most 1/v, so that it takes as many halvings at least.
  for (mp_bitcnt_t i = 0; i < kBits; ++i) halve();
  for (;; halve()) {
    // The maximum is between: 1/v is less at `beyond` than there, and N/D less than anywhere
    // before.
    const mpq_class least = 1 / beyond, quotient = form.quotient(beyond);
    const mpq_class low = least - quotient, width = 1 / below - least;
    if (low > 0 && (width << kBits) <= low) return root(low, low + width);
  }
}

template MarginEnclosure margin(const RationalSolid<2>&, const RationalSolid<2>&);
template MarginEnclosure margin(const RationalSolid<3>&, const RationalSolid<3>&);

RoundedMargin rounded(const MarginEnclosure& enclosure, int side) {
  if (enclosure.high == 0) return {0.0, 0.0};
  if (side == 0) return {1.0, 0.0};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const mpq_class middle = (enclosure.low + enclosure.high) / 2;
  double value = double_below(middle);
  const double next = double_above(middle);
  if (next == kInfinity) return {kInfinity, kInfinity};
  if (next - middle < middle - value) value = next;
  if (side > 0 && value <= 1.0) value = 1.0 + 2.0 * kUnitRoundoff;
  if (side < 0 && value >= 1.0) value = 1.0 - kUnitRoundoff;
  if (value == 0.0) value = std::numeric_limits<double>::denorm_min();
  const mpq_class at = to_rational(value);
  return {value,
          double_above(std::max(mpq_class(enclosure.high - at), mpq_class(at - enclosure.low)))};
}

}  // namespace tangency::inline v0::exact
