// SPDX-License-Identifier: MIT
#include <tangency/geometry/exact/containment.hpp>

#include <tangency/geometry/exact/largest_root.hpp>

namespace tangency::exact {
namespace {

/// Are all roots real? For a polynomial of degree 1 to 3 without multiple roots.
bool all_roots_are_real(const IntegerPolynomial& p) { return discriminant_sign(p) > 0; }

/// Is p a multiple of (1 + l)^n, n its degree?
bool is_binomial(const IntegerPolynomial& p) {
  const auto c = p.coefficients();
  const auto n = static_cast<unsigned long>(p.degree());
  unsigned long binomial = 1;
  for (unsigned long k = 0; k < n; ++k) {
    if (c[k] != binomial * p.leading()) return false;
    binomial = binomial * (n - k) / (k + 1);
  }
  return c[0] == p.leading();
}

}  // namespace

Containment containment(const PairPolynomials& pair) {
  const IntegerPolynomial quartic = pair.quartic.reflected();  // R
  const IntegerPolynomial shapes = -pair.shapes.reflected();   // C
  // Then A's shape, put about B's centre, would not be inside B's.
  if (largest_root_exceeds_one(shapes)) return Containment::none;
  const int discriminant = discriminant_sign(quartic);
  if (discriminant < 0) return Containment::none;
  const IntegerPolynomial distinct = discriminant > 0 ? quartic : square_free_part(quartic);
  if (discriminant == 0 && !all_roots_are_real(distinct)) return Containment::none;
  const IntegerPolynomial block =
      discriminant_sign(shapes) != 0 ? shapes : square_free_part(shapes);
  switch (compare_largest_roots(distinct, block)) {
    case 1:
      return discriminant > 0 || multiplicity_of_largest_root(quartic) == 1 ? Containment::interior
                                                                            : Containment::touching;
    case 0:
      return discriminant == 0 &&
                     multiplicity_of_largest_root(quartic) > multiplicity_of_largest_root(shapes)
                 ? Containment::touching
                 : Containment::none;
    default:
      return Containment::none;
  }
}

bool equal(const PairPolynomials& pair) {
  return is_binomial(pair.shapes) && is_binomial(pair.quartic);
}

}  // namespace tangency::exact
