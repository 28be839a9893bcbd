// SPDX-License-Identifier: MIT
#include <tangency/geometry/numbers/largest_root.hpp>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

#include <tangency/geometry/numbers/integer_forms.hpp>

namespace tangency::inline v0::exact {
namespace {

/// A polynomial in coordinates y, t = x + 2^e y, that move: x comes down on the largest root, which
/// stays at y <= 0, and 2^e becomes smaller. Known up to a factor > 0.
class Approach {
 public:
  explicit Approach(const IntegerPolynomial& p)
      : c_(p.coefficients().begin(), p.coefficients().end()) {
    if (sgn(c_.back()) < 0) {
      for (mpz_class& c : c_) mpz_neg(c.get_mpz_t(), c.get_mpz_t());
    }
  }

  /// An exponent e with 2^e above all roots: their sum is -c_(n-1) / c_n, and they are > 0.
  long exponent_above() const { return bit_length(c_[c_.size() - 2]) - bit_length(c_.back()) + 1; }

  /// t = 2^exponent t'.
  void scale(long exponent) {
    for (std::size_t k = 0; k < c_.size(); ++k) {
      const std::size_t power = exponent > 0 ? k : c_.size() - 1 - k;
      c_[k] <<= power * static_cast<mp_bitcnt_t>(exponent > 0 ? exponent : -exponent);
    }
    strip_powers_of_two(c_);
  }

  /// x moves to x + step, in units 2^e: Horner's rule.
  void move(const mpz_class& step) {
    for (std::size_t k = 0; k + 1 < c_.size(); ++k) {
      for (std::size_t i = c_.size() - 1; i-- > k;) {
        mpz_addmul(c_[i].get_mpz_t(), c_[i + 1].get_mpz_t(), step.get_mpz_t());
      }
    }
  }

  /// Is no root at y > 0? Descartes' rule, the roots being real.
  bool is_above_all_roots() const {
    return std::all_of(c_.begin(), c_.end(), [](const mpz_class& c) { return sgn(c) >= 0; });
  }
  bool is_root() const { return sgn(c_[0]) == 0; }

  /// floor(s) with s = p / p' at y = 0, p' > 0: the largest root lies within [s, n s] below, n the
  /// degree, since 1 / s is the sum of the inverse distances of all roots.
  mpz_class newton_step() const { return c_[0] / c_[1]; }

  /// Newton's step for p / p', which finds a root of any multiplicity, and a narrow cluster of
  /// roots, with quadratic convergence: a guess, from leading digits, as many as `digits` ask for.
  mpz_class cluster_step(long digits) const {
    const long spare = std::max(0L, bit_length(c_[1]) - 2 * digits - 64);
    const auto head = [&](std::size_t k) {
      return k < c_.size() ? mpz_class(c_[k] >> static_cast<mp_bitcnt_t>(spare)) : mpz_class(0);
    };
    const mpz_class p0 = head(0), p1 = head(1);
    const mpz_class denominator = p1 * p1 - 2 * p0 * head(2);
    return denominator > 0 ? mpz_class(p0 * p1 / denominator) : mpz_class(0);
  }

  int degree() const { return static_cast<int>(c_.size()) - 1; }

 private:
  std::vector<mpz_class> c_;
};

/// For f and g without a common root. Both are looked at from one x above all roots, which comes
/// down until one of the two largest roots is proven to be the further one.
int compare_coprime(const IntegerPolynomial& f, const IntegerPolynomial& g) {
  if (f.degree() < 1) return -1;
  if (g.degree() < 1) return 1;
  Approach to_f(f), to_g(g);
  const long start = std::max(to_f.exponent_above(), to_g.exponent_above());
  for (Approach* p : {&to_f, &to_g}) {
    p->scale(start);
    p->move(1);
  }
  long digits = 1;  // how many of a step are trusted; as many as came true, and more each time
  for (;;) {
    if (to_f.is_root()) return 1;
    if (to_g.is_root()) return -1;
    mpz_class step_f = to_f.newton_step(), step_g = to_g.newton_step();
    // The distances lie in [step, degree (step + 1)].
    if (step_f > to_g.degree() * (step_g + 1)) return -1;
    if (step_g > to_f.degree() * (step_f + 1)) return 1;
    const long finer = digits + 8 - bit_length(std::min(step_f, step_g));
    if (finer > 0) {
      to_f.scale(-finer);
      to_g.scale(-finer);
      step_f = to_f.newton_step();
      step_g = to_g.newton_step();
    }
    mpz_class leap = std::min(to_f.cluster_step(digits), to_g.cluster_step(digits));
    leap -= leap >> static_cast<mp_bitcnt_t>(digits);
    const mpz_class safe = std::min(step_f, step_g);
    if (leap > safe) {
      Approach far_f = to_f, far_g = to_g;
      far_f.move(-leap);
      far_g.move(-leap);
      if (far_f.is_above_all_roots() && far_g.is_above_all_roots()) {
        to_f = std::move(far_f);
        to_g = std::move(far_g);
        digits *= 2;
        continue;
      }
    }
    digits = std::max(1L, digits / 2);
    to_f.move(-safe);
    to_g.move(-safe);
  }
}

}  // namespace

int compare_largest_roots(const IntegerPolynomial& f, const IntegerPolynomial& g) {
  assert(f.degree() >= 1 && g.degree() >= 1);
  if (coprime(f, g)) return compare_coprime(f, g);
  // f = h f', g = h g', no two of h, f', g' with a common root.
  const IntegerPolynomial h = gcd(f, g);
  const IntegerPolynomial rest_f = exact_quotient(f, h), rest_g = exact_quotient(g, h);
  const bool f_above = compare_coprime(rest_f, h) > 0, g_above = compare_coprime(rest_g, h) > 0;
  if (f_above && g_above) return compare_coprime(rest_f, rest_g);
  return static_cast<int>(f_above) - static_cast<int>(g_above);
}

int multiplicity_of_largest_root(const IntegerPolynomial& p) {
  assert(p.degree() >= 1);
  const IntegerPolynomial repeated = gcd(p, p.derivative());
  if (repeated.degree() < 1) return 1;
  const IntegerPolynomial once = exact_quotient(p.primitive_part(), repeated);
  if (compare_largest_roots(once, square_free_part(repeated)) > 0) return 1;
  return 1 + multiplicity_of_largest_root(repeated);
}

bool largest_root_exceeds_one(const IntegerPolynomial& p) {
  Approach to_p(p);
  to_p.move(1);
  return !to_p.is_above_all_roots();
}

}  // namespace tangency::inline v0::exact
