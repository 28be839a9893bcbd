// SPDX-License-Identifier: MIT
#include <tangency/geometry/exact/containment.hpp>

#include <algorithm>

#include <tangency/geometry/exact/ellipsoid_form.hpp>
#include <tangency/geometry/exact/integer_forms.hpp>
#include <tangency/geometry/exact/pencil_form.hpp>

namespace tangency::exact {
namespace {

/// A power of two above the absolute values of all roots [Fujiwara's bound, roughly].
mpq_class root_bound(const IntegerPolynomial& p) {
  const auto c = p.coefficients();
  const auto bits = [](const mpz_class& x) { return mpz_sizeinbase(x.get_mpz_t(), 2); };
  const auto lead = static_cast<long>(bits(p.leading())) - 1;
  long exponent = 0;
  const int n = p.degree();
  for (int k = 0; k < n; ++k) {
    const mpz_class& x = c[static_cast<std::size_t>(k)];
    if (x == 0) continue;
    const long excess = static_cast<long>(bits(x)) - lead;  // log2 |c_k / c_n| is below it
    exponent = std::max(exponent, excess > 0 ? (excess + n - k - 1) / (n - k) : 0);
  }
  mpq_class bound = 1;
  mpq_mul_2exp(bound.get_mpq_t(), bound.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent + 1));
  return bound;
}

/// The bounds of an interval low < x <= high with low > 0 that holds just the largest positive
/// root, low being no root. Requires a positive root.
struct Isolated {
  mpq_class low, high;
};

Isolated isolate_largest(const SturmSequence& sturm) {
  Isolated root{0, root_bound(sturm.square_free())};
  for (;;) {
    const mpq_class middle = (root.low + root.high) / 2;
    const int above = sturm.roots_above(middle);
    if (above == 0) {
      root.high = middle;
      continue;
    }
    root.low = middle;
    if (above == 1 && sturm.square_free().sign_at(middle) != 0) return root;
  }
}

/// Sign of p at the one root that the square-free f has in (low, high].
int sign_at_root(const IntegerPolynomial& p, const SturmSequence& f, Isolated root) {
  if (p.is_zero()) return 0;
  const IntegerPolynomial common = gcd(p, f.square_free());
  if (common.degree() > 0 && SturmSequence(common).roots_between(root.low, root.high) > 0) return 0;
  // p has no root there: narrow the interval until it has none in it.
  const SturmSequence sturm(p);
  while (sturm.roots_between(root.low, root.high) > 0) {
    const mpq_class middle = (root.low + root.high) / 2;
    (f.roots_between(root.low, middle) > 0 ? root.high : root.low) = middle;
  }
  return p.sign_at(root.high);
}

bool positive_definite(const IntegerForm<4>& form) { return inertia<4>(form).positive == 4; }

}  // namespace

Containment containment(const Ellipsoid& a, const Ellipsoid& b, const IntegerPolynomial& quartic) {
  const SturmSequence sturm(quartic.reflected());
  if (sturm.roots_above(0) == 0) return Containment::none;
  const int unit = std::min(length_exponent(a), length_exponent(b));
  // Both as discriminant matrices of the same scale, so that t means what it means in the quartic.
  const EllipsoidForm fa = ellipsoid_form(a, unit), fb = ellipsoid_form(b, unit);
  const IntegerForm<4> qa = combine<4>(fb.denominator, fa.form, 0, fb.form);
  const IntegerForm<4> qb = combine<4>(0, fa.form, fa.denominator, fb.form);

  const Isolated largest = isolate_largest(sturm);
  const mpz_class numerator = largest.low.get_num(), denominator = largest.low.get_den();
  if (positive_definite(combine<4>(numerator, qa, -denominator, qb))) return Containment::interior;
  // Semidefinite <=> D1 to D4 of -Q_B + t Q_A are all >= 0; D4 is 0 at the root.
  const PencilInvariants invariants = pencil_invariants(combine<4>(-1, qb, 0, qa), qa);
  for (std::size_t k = 3; k < 6; ++k) {
    if (sign_at_root(invariants[k], sturm, largest) < 0) return Containment::none;
  }
  return Containment::touching;
}

bool equal(const Ellipsoid& a, const Ellipsoid& b) {
  const int unit = std::min(length_exponent(a), length_exponent(b));
  const EllipsoidForm fa = ellipsoid_form(a, unit), fb = ellipsoid_form(b, unit);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      if (fa.form[i][j] * fb.denominator != fb.form[i][j] * fa.denominator) return false;
    }
  }
  return true;
}

}  // namespace tangency::exact
