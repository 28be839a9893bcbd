// SPDX-License-Identifier: MIT
#include <tangency/geometry/relation/exact_pair.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <tangency/geometry/bodies/ellipsoid_form.hpp>
#include <tangency/geometry/bodies/pencil_form.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/geometry/numbers/largest_root.hpp>

namespace tangency::inline v0::exact {
namespace {

/// xx yy zz yz zx xy
using Symmetric = std::array<mpz_class, 6>;

mpz_class trace_of_product(const Symmetric& a, const Symmetric& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// v' S v, from the products of v's components.
mpz_class form(const Symmetric& s, const Symmetric& vv) { return trace_of_product(s, vv); }

Symmetric mixed_adjugate(const Symmetric& a, const Symmetric& b) {
  return {a[1] * b[2] + a[2] * b[1] - 2 * a[3] * b[3],
          a[2] * b[0] + a[0] * b[2] - 2 * a[4] * b[4],
          a[0] * b[1] + a[1] * b[0] - 2 * a[5] * b[5],
          a[4] * b[5] + a[5] * b[4] - a[0] * b[3] - a[3] * b[0],
          a[5] * b[3] + a[3] * b[5] - a[1] * b[4] - a[4] * b[1],
          a[3] * b[4] + a[4] * b[3] - a[2] * b[5] - a[5] * b[2]};
}

/// Integers of one body: R = R~ / |q|^2, M = shape / norm2, adj M = adjugate / norm2.
struct Body {
  mpz_class norm2;        ///< |q|^4
  Symmetric shape;        ///< R~ diag(a^2) R~'
  Symmetric adjugate;     ///< R~ diag(a2^2 a3^2, a3^2 a1^2, a1^2 a2^2) R~'
  mpz_class determinant;  ///< det M = (a1 a2 a3)^2
};

Body body(const Ellipsoid& e, int exponent) {
  // Of a sphere any rotation is as good: the one of the shortest numbers.
  const auto [r, norm] = scaled_rotation(e.is_sphere() ? Quaternion(1, 0, 0, 0) : e.orientation());
  std::array<mpz_class, 3> a2, b2;
  for (int k = 0; k < 3; ++k) {
    const mpz_class axis = to_integer(e.semi_axes()[k], exponent);
    a2[static_cast<std::size_t>(k)] = axis * axis;
  }
  for (std::size_t k = 0; k < 3; ++k) b2[k] = a2[(k + 1) % 3] * a2[(k + 2) % 3];

  Body body;
  body.norm2 = norm * norm;
  body.determinant = a2[0] * b2[0];
  constexpr std::size_t kRow[] = {0, 1, 2, 1, 2, 0}, kColumn[] = {0, 1, 2, 2, 0, 1};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < 6; ++i) {
      const mpz_class product = r[kRow[i]][k] * r[kColumn[i]][k];
      body.shape[i] += product * a2[k];
      body.adjugate[i] += product * b2[k];
    }
  }
  return body;
}

/// Divided by the largest power of two that divides all.
IntegerPolynomial without_powers_of_two(std::vector<mpz_class> coefficients) {
  strip_powers_of_two(coefficients);
  return IntegerPolynomial(std::move(coefficients));
}

IntegerPolynomial reversed(const IntegerPolynomial& p) {
  return IntegerPolynomial({p.coefficients().rbegin(), p.coefficients().rend()});
}

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

int length_exponent(const Mat3& edges, const LatticeImage& image, int otherwise) noexcept {
  int unit = otherwise;
  for (int k = 0; k < 3; ++k) {
    if (image[static_cast<std::size_t>(k)] == 0 || edges.col(k).isZero(0.0)) continue;
    unit = std::min(unit, common_exponent(std::span(edges.col(k).data(), 3)));
  }
  return unit;
}

ExactPair::ExactPair(const Ellipsoid& a, const Ellipsoid& b)
    : ExactPair(a, b, Mat3::Identity(), LatticeImage{}) {}

ExactPair::ExactPair(const Ellipsoid& a, const Ellipsoid& b, const Mat3& edges,
                     const LatticeImage& image) {
  const int unit = length_exponent(edges, image, std::min(length_exponent(a), length_exponent(b)));
  const Body ba = body(a, unit), bb = body(b, unit);
  std::array<mpz_class, 3> d;
  for (int i = 0; i < 3; ++i) {
    mpz_class& along = d[static_cast<std::size_t>(i)];
    along = to_integer(b.centre()[i], unit) - to_integer(a.centre()[i], unit);
    for (int k = 0; k < 3; ++k) {
      const std::int32_t edge = image[static_cast<std::size_t>(k)];
      if (edge != 0) along += edge * to_integer(edges(i, k), unit);
    }
  }
  const Symmetric dd = {d[0] * d[0], d[1] * d[1], d[2] * d[2],
                        d[1] * d[2], d[2] * d[0], d[0] * d[1]};

  // |q_A|^4 |q_B|^4 D and |q_A|^4 |q_B|^4 (l N - (1 + l) D)
  const mpz_class norms = ba.norm2 * bb.norm2;
  const mpz_class n0 = bb.norm2 * form(ba.adjugate, dd), n2 = ba.norm2 * form(bb.adjugate, dd);
  const mpz_class n1 = form(mixed_adjugate(ba.shape, bb.shape), dd);
  const mpz_class d0 = norms * ba.determinant, d3 = norms * bb.determinant;
  const mpz_class d1 = trace_of_product(ba.adjugate, bb.shape);
  const mpz_class d2 = trace_of_product(bb.adjugate, ba.shape);
  quartic_ = without_powers_of_two({-d0, n0 - d1 - d0, n1 - d2 - d1, n2 - d3 - d2, -d3});
  shapes_ = without_powers_of_two({d0, d1, d2, d3});
}

// With forms a and b times the denominators da and db, det(l a + b) in l da/db is what is asked.
ExactPair::ExactPair(const SolidForm<4>& a, const SolidForm<4>& b) {
  const auto weighted = [&](std::size_t size) {
    const IntegerPolynomial p = pencil_determinant(b.form, a.form, size);
    std::vector<mpz_class> c(p.coefficients().begin(), p.coefficients().end());
    for (std::size_t k = 0; k < c.size(); ++k) {
      for (std::size_t i = 0; i + 1 < c.size(); ++i) c[k] *= i < k ? b.denominator : a.denominator;
    }
    return without_powers_of_two(std::move(c));
  };
  quartic_ = weighted(4);
  shapes_ = weighted(3);
}

ExactPair::ExactPair(IntegerPolynomial quartic, IntegerPolynomial shapes)
    : quartic_(std::move(quartic)), shapes_(std::move(shapes)) {}

ExactPair ExactPair::exchanged() const { return {reversed(quartic_), reversed(shapes_)}; }

Position ExactPair::position() const {
  const auto c = quartic_.coefficients();
  if (sgn(c[1]) <= 0 && sgn(c[2]) <= 0 && sgn(c[3]) <= 0) return Position::interiors_meet;
  // The signs change: at most two positive roots, by identity (2).
  const int discriminant = discriminant_sign(quartic_);
  if (discriminant > 0) return Position::apart;
  if (discriminant < 0) return Position::interiors_meet;
  const IntegerPolynomial distinct = square_free_part(quartic_);
  // One real root is the negative one that is double, by identity (2).
  if (distinct.degree() == 3 && discriminant_sign(distinct) < 0) return Position::interiors_meet;
  // All roots are real: by Descartes' rule they change the sign once for each that is positive.
  switch (sign_changes(distinct)) {
    case 0:
      return Position::interiors_meet;
    case 1:
      return Position::touching;
    default:
      return Position::apart;
  }
}

Containment ExactPair::containment() const {
  const IntegerPolynomial quartic = quartic_.reflected();  // R
  const IntegerPolynomial shapes = -shapes_.reflected();   // C
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

bool ExactPair::equal() const { return is_binomial(shapes_) && is_binomial(quartic_); }

}  // namespace tangency::inline v0::exact
