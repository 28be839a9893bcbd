// SPDX-License-Identifier: MIT
#include <tangency/geometry/numbers/integer_polynomial.hpp>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

namespace tangency::inline v0::exact {
namespace {

/// Changes of sign in a sequence, zeros skipped.
template <typename Signs>
int variations(const std::vector<IntegerPolynomial>& sequence, const Signs& sign_of) {
  int count = 0;
  int previous = 0;
  for (const IntegerPolynomial& p : sequence) {
    const int sign = sign_of(p);
    if (sign == 0) continue;
    if (sign == -previous) ++count;
    previous = sign;
  }
  return count;
}

int quadratic_discriminant_sign(std::span<const mpz_class> c) {
  return sgn(mpz_class(c[1] * c[1] - 4 * c[2] * c[0]));
}

int cubic_discriminant_sign(std::span<const mpz_class> c) {
  const mpz_class &a = c[3], &b = c[2], &g = c[1], &d = c[0];
  return sgn(mpz_class(18 * a * b * g * d - 4 * b * b * b * d + b * b * g * g - 4 * a * g * g * g -
                       27 * a * a * d * d));
}

// 27 times the discriminant is 4 I^3 - J^2 in the quartic's invariants I and J.
int quartic_discriminant_sign(std::span<const mpz_class> coefficients) {
  const mpz_class &a = coefficients[4], &b = coefficients[3], &c = coefficients[2],
                  &d = coefficients[1], &e = coefficients[0];
  const mpz_class i = 12 * a * e - 3 * b * d + c * c;
  const mpz_class j = c * (72 * a * e + 9 * b * d - 2 * c * c) - 27 * (a * d * d + e * b * b);
  return sgn(mpz_class(4 * i * i * i - j * j));
}

/// A prime. Chosen: the largest whose residues are an unsigned long, and their products 64 bits,
/// everywhere. One pair in 2^31 that is coprime is not so modulo it, and takes longer.
constexpr std::uint64_t kPrime = (std::uint64_t{1} << 31) - 1;

std::vector<std::uint64_t> modular(const IntegerPolynomial& p) {
  std::vector<std::uint64_t> residues;
  for (const mpz_class& c : p.coefficients()) {
    residues.push_back(mpz_fdiv_ui(c.get_mpz_t(), kPrime));
  }
  return residues;
}

/// Euclid's algorithm, each remainder up to a factor: is the last one a constant other than 0?
/// Requires leading coefficients that are not 0.
bool modular_coprime(std::vector<std::uint64_t> a, std::vector<std::uint64_t> b) {
  for (;;) {
    if (a.size() < b.size()) std::swap(a, b);
    if (b.size() <= 1) return !b.empty();
    const std::size_t shift = a.size() - b.size();
    const std::uint64_t weight = a.back(), factor = b.back();
    for (std::size_t i = 0; i < a.size(); ++i) {
      const std::uint64_t taken = i < shift ? 0 : weight * b[i - shift] % kPrime;
      a[i] = (factor * a[i] + (kPrime - taken)) % kPrime;
    }
    while (!a.empty() && a.back() == 0) a.pop_back();
  }
}

}  // namespace

IntegerPolynomial::IntegerPolynomial(std::vector<mpz_class> coefficients)
    : coefficients_(std::move(coefficients)) {
  trim();
}

void IntegerPolynomial::trim() {
  while (!coefficients_.empty() && coefficients_.back() == 0) coefficients_.pop_back();
}

// With x = n/d, d > 0, Horner's rule on the sum of c_i n^i d^(degree - i). Powers of two in d,
// mostly all of it, are shifts.
int IntegerPolynomial::sign_at(const mpq_class& x) const {
  if (is_zero()) return 0;
  const mpz_class& numerator = x.get_num();
  const mp_bitcnt_t shift = mpz_scan1(x.get_den_mpz_t(), 0);
  const mpz_class denominator = x.get_den() >> shift;
  mpz_class value = coefficients_.back(), power = 1, term;
  mp_bitcnt_t shifted = 0;
  for (std::size_t i = coefficients_.size() - 1; i-- > 0;) {
    shifted += shift;
    value *= numerator;
    term = coefficients_[i] << shifted;
    if (denominator != 1) term *= power *= denominator;
    value += term;
  }
  return sgn(value);
}

int IntegerPolynomial::sign_at_plus_infinity() const noexcept {
  return is_zero() ? 0 : sgn(leading());
}

int IntegerPolynomial::sign_at_minus_infinity() const noexcept {
  return degree() % 2 == 0 ? sign_at_plus_infinity() : -sign_at_plus_infinity();
}

IntegerPolynomial IntegerPolynomial::derivative() const {
  std::vector<mpz_class> result;
  for (std::size_t i = 1; i < coefficients_.size(); ++i) {
    result.push_back(coefficients_[i] * static_cast<unsigned long>(i));
  }
  return IntegerPolynomial(std::move(result));
}

IntegerPolynomial IntegerPolynomial::primitive_part() const {
  mpz_class content = 0;
  for (const mpz_class& c : coefficients_) {
    mpz_gcd(content.get_mpz_t(), content.get_mpz_t(), c.get_mpz_t());
    if (content == 1) return *this;
  }
  IntegerPolynomial result = *this;
  for (mpz_class& c : result.coefficients_) {
    mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), content.get_mpz_t());
  }
  return result;
}

IntegerPolynomial IntegerPolynomial::reflected() const {
  IntegerPolynomial result = *this;
  for (std::size_t i = 1; i < coefficients_.size(); i += 2) {
    mpz_neg(result.coefficients_[i].get_mpz_t(), coefficients_[i].get_mpz_t());
  }
  return result;
}

IntegerPolynomial IntegerPolynomial::operator-() const {
  IntegerPolynomial result = *this;
  for (mpz_class& c : result.coefficients_) mpz_neg(c.get_mpz_t(), c.get_mpz_t());
  return result;
}

IntegerPolynomial& IntegerPolynomial::operator+=(const IntegerPolynomial& other) {
  coefficients_.resize(std::max(coefficients_.size(), other.coefficients_.size()));
  for (std::size_t i = 0; i < other.coefficients_.size(); ++i) {
    coefficients_[i] += other.coefficients_[i];
  }
  trim();
  return *this;
}

IntegerPolynomial& IntegerPolynomial::operator-=(const IntegerPolynomial& other) {
  coefficients_.resize(std::max(coefficients_.size(), other.coefficients_.size()));
  for (std::size_t i = 0; i < other.coefficients_.size(); ++i) {
    coefficients_[i] -= other.coefficients_[i];
  }
  trim();
  return *this;
}

IntegerPolynomial operator*(const IntegerPolynomial& a, const IntegerPolynomial& b) {
  if (a.is_zero() || b.is_zero()) return {};
  std::vector<mpz_class> result(a.coefficients_.size() + b.coefficients_.size() - 1);
  for (std::size_t i = 0; i < a.coefficients_.size(); ++i) {
    for (std::size_t j = 0; j < b.coefficients_.size(); ++j) {
      result[i + j] += a.coefficients_[i] * b.coefficients_[j];
    }
  }
  return IntegerPolynomial(std::move(result));
}

// Each step multiplies a by |leading(b)|, so the sign is that of the true remainder.
IntegerPolynomial positive_pseudo_remainder(IntegerPolynomial a, const IntegerPolynomial& b) {
  assert(!b.is_zero());
  const mpz_class factor = abs(b.leading());
  while (a.degree() >= b.degree()) {
    const auto shift = static_cast<std::size_t>(a.degree() - b.degree());
    std::vector<mpz_class> remainder(a.coefficients().begin(), a.coefficients().end());
    const mpz_class weight = sgn(b.leading()) * a.leading();
    for (mpz_class& c : remainder) c *= factor;
    for (std::size_t i = 0; i < b.coefficients().size(); ++i) {
      remainder[i + shift] -= weight * b.coefficients()[i];
    }
    a = IntegerPolynomial(std::move(remainder));
  }
  return a;
}

IntegerPolynomial gcd(IntegerPolynomial a, IntegerPolynomial b) {
  while (!b.is_zero()) {
    IntegerPolynomial remainder = positive_pseudo_remainder(std::move(a), b).primitive_part();
    a = std::move(b);
    b = std::move(remainder);
  }
  a = a.primitive_part();
  return a.sign_at_plus_infinity() < 0 ? -a : a;
}

// A common root would be a common factor, whose leading coefficient divides both leading ones:
// where these are not 0 modulo a prime the factor keeps its degree there.
bool coprime(const IntegerPolynomial& a, const IntegerPolynomial& b) {
  const std::vector<std::uint64_t> ra = modular(a), rb = modular(b);
  if (ra.back() != 0 && rb.back() != 0 && modular_coprime(ra, rb)) return true;
  return gcd(a, b).degree() < 1;
}

IntegerPolynomial exact_quotient(const IntegerPolynomial& a, const IntegerPolynomial& b) {
  assert(!b.is_zero());
  if (a.is_zero()) return {};
  std::vector<mpz_class> remainder(a.coefficients().begin(), a.coefficients().end());
  const std::size_t size = b.coefficients().size();
  std::vector<mpz_class> quotient(remainder.size() - size + 1);
  for (std::size_t k = quotient.size(); k-- > 0;) {
    mpz_divexact(quotient[k].get_mpz_t(), remainder[k + size - 1].get_mpz_t(),
                 b.leading().get_mpz_t());
    for (std::size_t i = 0; i < size; ++i) remainder[k + i] -= quotient[k] * b.coefficients()[i];
  }
  assert(IntegerPolynomial(remainder).is_zero() && "b divides a");
  return IntegerPolynomial(std::move(quotient));
}

IntegerPolynomial square_free_part(const IntegerPolynomial& p) {
  if (p.degree() < 1) return p.primitive_part();
  const IntegerPolynomial primitive = p.primitive_part();
  return exact_quotient(primitive, gcd(primitive, primitive.derivative()));
}

int sign_changes(const IntegerPolynomial& p) noexcept {
  int count = 0;
  int previous = 0;
  for (const mpz_class& c : p.coefficients()) {
    const int sign = sgn(c);
    if (sign == 0) continue;
    if (sign == -previous) ++count;
    previous = sign;
  }
  return count;
}

int discriminant_sign(const IntegerPolynomial& p) {
  assert(p.degree() >= 1 && p.degree() <= 4);
  switch (p.degree()) {
    case 2:
      return quadratic_discriminant_sign(p.coefficients());
    case 3:
      return cubic_discriminant_sign(p.coefficients());
    case 4:
      return quartic_discriminant_sign(p.coefficients());
    default:
      return 1;
  }
}

// The signed remainders end in gcd(p, p'); divided by it they are a Sturm sequence of the
// square-free part, valid at every point.
SturmSequence::SturmSequence(const IntegerPolynomial& p) {
  assert(!p.is_zero());
  sequence_.push_back(p.primitive_part());
  IntegerPolynomial next = sequence_.back().derivative().primitive_part();
  while (!next.is_zero()) {
    const IntegerPolynomial& previous = sequence_.back();
    IntegerPolynomial remainder = -positive_pseudo_remainder(previous, next).primitive_part();
    sequence_.push_back(std::move(next));
    next = std::move(remainder);
  }
  const IntegerPolynomial common = sequence_.back();
  if (common.degree() < 1) return;
  for (IntegerPolynomial& member : sequence_) member = exact_quotient(member, common);
}

int SturmSequence::roots() const {
  return variations(sequence_, [](const auto& p) { return p.sign_at_minus_infinity(); }) -
         variations(sequence_, [](const auto& p) { return p.sign_at_plus_infinity(); });
}

int SturmSequence::roots_between(const mpq_class& low, const mpq_class& high) const {
  assert(low <= high);
  return variations(sequence_, [&](const auto& p) { return p.sign_at(low); }) -
         variations(sequence_, [&](const auto& p) { return p.sign_at(high); });
}

int SturmSequence::roots_above(const mpq_class& low) const {
  return variations(sequence_, [&](const auto& p) { return p.sign_at(low); }) -
         variations(sequence_, [](const auto& p) { return p.sign_at_plus_infinity(); });
}

}  // namespace tangency::inline v0::exact
