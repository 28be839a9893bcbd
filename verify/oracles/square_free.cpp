// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/square_free.hpp>

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tangency::inline v0::verify {
namespace {

void trim(IntegerPolynomial& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

void make_primitive(IntegerPolynomial& p) {
  if (p.empty()) return;
  mpz_class content = p.back();
  for (const mpz_class& c : p) content = gcd(content, c);
  if (p.back() < 0) content = -content;
  for (mpz_class& c : p) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), content.get_mpz_t());
}

// A nonzero multiple of p mod q.
IntegerPolynomial pseudo_remainder(IntegerPolynomial p, const IntegerPolynomial& q) {
  while (p.size() >= q.size()) {
    const mpz_class lead = p.back();
    const std::size_t shift = p.size() - q.size();
    for (mpz_class& c : p) c *= q.back();
    for (std::size_t i = 0; i < q.size(); ++i) p[i + shift] -= lead * q[i];
    trim(p);
  }
  return p;
}

IntegerPolynomial derivative(const IntegerPolynomial& p) {
  IntegerPolynomial d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(p[i] * static_cast<unsigned long>(i));
  return d;
}

// Coprime modulo one prime that does not divide p's leading coefficient, and so coprime: a common
// factor would survive. False proves nothing.
bool clearly_coprime(const IntegerPolynomial& p, const IntegerPolynomial& q) {
  constexpr std::uint64_t kPrime = 2147483647;  // 2^31 - 1: products fit
  using Residues = std::vector<std::uint64_t>;
  const auto reduced = [](const IntegerPolynomial& f) {
    Residues r;
    for (const mpz_class& c : f) r.push_back(mpz_fdiv_ui(c.get_mpz_t(), kPrime));
    return r;
  };
  const auto drop_zeros = [](Residues& r) {
    while (!r.empty() && r.back() == 0) r.pop_back();
  };
  Residues a = reduced(p), b = reduced(q);
  if (a.empty() || a.back() == 0) return false;
  drop_zeros(b);
  while (!b.empty()) {
    while (a.size() >= b.size()) {
      const std::uint64_t lead_a = a.back(), lead_b = b.back();
      const std::size_t shift = a.size() - b.size();
      for (std::uint64_t& c : a) c = c * lead_b % kPrime;
      for (std::size_t i = 0; i < b.size(); ++i) {
        a[i + shift] = (a[i + shift] + (kPrime - lead_a) * b[i]) % kPrime;
      }
      drop_zeros(a);
    }
    std::swap(a, b);
  }
  return a.size() == 1;
}

// p / q up to a constant factor. Requires q primitive and a divisor of p.
IntegerPolynomial quotient(IntegerPolynomial p, const IntegerPolynomial& q) {
  make_primitive(p);
  IntegerPolynomial result(p.size() - q.size() + 1);
  for (std::size_t k = result.size(); k-- > 0;) {
    // Gauss: the quotient of primitive polynomials is integer, and so is every step.
    mpz_divexact(result[k].get_mpz_t(), p[k + q.size() - 1].get_mpz_t(), q.back().get_mpz_t());
    for (std::size_t i = 0; i < q.size(); ++i) p[k + i] -= result[k] * q[i];
  }
  trim(p);
  assert(p.empty());
  return result;
}

}  // namespace

IntegerPolynomial greatest_common_divisor(IntegerPolynomial p, IntegerPolynomial q) {
  make_primitive(p);
  make_primitive(q);
  if (p.size() < q.size()) std::swap(p, q);
  while (!q.empty()) {
    IntegerPolynomial r = pseudo_remainder(std::move(p), q);
    make_primitive(r);
    p = std::exchange(q, std::move(r));
  }
  return p;
}

DistinctRoots distinct_roots(const IntegerPolynomial& p) {
  const auto with_derivative = [](const IntegerPolynomial& f) {
    return f.size() < 2 ? IntegerPolynomial{1} : greatest_common_divisor(f, derivative(f));
  };
  if (clearly_coprime(p, derivative(p))) return {p, {1}};
  const IntegerPolynomial repeated = with_derivative(p);
  return {quotient(p, repeated), quotient(repeated, with_derivative(repeated))};
}

}  // namespace tangency::inline v0::verify
