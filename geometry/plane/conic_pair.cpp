// SPDX-License-Identifier: MIT
#include <tangency/geometry/plane/conic_pair.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/geometry/numbers/integer_polynomial.hpp>
#include <tangency/geometry/numbers/real_roots.hpp>

namespace tangency::exact {
namespace {

struct Forms {
  IntegerForm<3> a, b;
};

using Integer2 = std::array<mpz_class, 2>;

Integer2 to_integers(const Vec2& v, int exponent) {
  return {to_integer(v[0], exponent), to_integer(v[1], exponent)};
}

/// |u|^2 a1^2 a2^2 times (x - c)' M^-1 (x - c) - 1.
IntegerForm<3> form_of(const Ellipse& e, const Integer2& c, int unit) {
  const std::array<double, 2> direction{e.direction()[0], e.direction()[1]};
  const Integer2 u = to_integers(e.direction(), common_exponent(direction));
  Integer2 squares = to_integers(e.semi_axes(), unit);
  for (mpz_class& s : squares) s *= s;
  const mpz_class xx = u[0] * u[0], yy = u[1] * u[1];
  const mpz_class s00 = squares[1] * xx + squares[0] * yy, s11 = squares[1] * yy + squares[0] * xx;
  const mpz_class s01 = (squares[1] - squares[0]) * u[0] * u[1];
  const mpz_class level = (xx + yy) * squares[0] * squares[1];
  const mpz_class column0 = -(s00 * c[0] + s01 * c[1]), column1 = -(s01 * c[0] + s11 * c[1]);
  const mpz_class last = -(column0 * c[0] + column1 * c[1]) - level;
  return {{{s00, s01, column0}, {s01, s11, column1}, {column0, column1, last}}};
}

Forms forms_of(const Ellipse& a, const Ellipse& b) {
  const std::array<double, 8> lengths{a.centre()[0],    a.centre()[1],    b.centre()[0],
                                      b.centre()[1],    a.semi_axes()[0], a.semi_axes()[1],
                                      b.semi_axes()[0], b.semi_axes()[1]};
  const int unit = common_exponent(lengths);
  const Integer2 ca = to_integers(a.centre(), unit), cb = to_integers(b.centre(), unit);
  return {form_of(a, {0, 0}, unit), form_of(b, {cb[0] - ca[0], cb[1] - ca[1]}, unit)};
}

/// The columns are from `first` where the bit of the column is 0 and from `second` where it is 1.
mpz_class mixed_determinant(const IntegerForm<3>& first, const IntegerForm<3>& second,
                            unsigned columns) {
  const auto m = [&](std::size_t i, std::size_t j) -> const mpz_class& {
    return ((columns >> j) & 1U) == 0 ? first[i][j] : second[i][j];
  };
  return m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) -
         m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0)) +
         m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
}

/// det(l A + B)
IntegerPolynomial characteristic_cubic(const Forms& q) {
  std::vector<mpz_class> c(4);
  for (unsigned columns = 0; columns < 8; ++columns) {
    const auto from_a =
        static_cast<std::size_t>((columns & 1U) + ((columns >> 1) & 1U) + ((columns >> 2) & 1U));
    c[from_a] += mixed_determinant(q.b, q.a, columns);
  }
  return IntegerPolynomial(std::move(c));
}

Inertia inertia_of_member(const Forms& q, const mpq_class& l) {
  return inertia<3>(combine<3>(l.get_num(), q.a, l.get_den(), q.b));
}

/// The multiple root: with P of degree 3 the greatest common divisor of P and P' is of degree 1, or
/// a square.
mpq_class multiple_root(const IntegerPolynomial& cubic) {
  const IntegerPolynomial common = gcd(cubic, cubic.derivative());
  const auto c = common.coefficients();
  const std::size_t n = static_cast<std::size_t>(common.degree());
  mpq_class root(-c[n - 1], c[n] * static_cast<unsigned long>(n));
  root.canonicalize();
  return root;
}

/// The definite member between neighbouring roots, if there is one.
ConicAnswer without_multiple_root_inside(const Forms& q, const SturmSequence& sturm,
                                         Meeting otherwise, Relation relation, Inner inner) {
  std::vector<RealRoot> roots = isolate_real_roots(sturm);
  for (std::size_t i = 0; i + 1 < roots.size(); ++i) {
    const Inertia member = inertia_of_member(q, sample_between(roots[i], roots[i + 1]));
    // For l < 0: E(l) < 0 is -l Q_A - Q_B > 0, so that all of A is inside B.
    if (member.negative == 3) return {Relation::a_in_b, Inner::none, Meeting::nowhere};
    if (member.positive == 3) return {Relation::b_in_a, Inner::none, Meeting::nowhere};
  }
  return {relation, inner, otherwise};
}

ConicAnswer with_multiple_root(const Forms& q, const IntegerPolynomial& cubic) {
  const mpq_class root = multiple_root(cubic);
  const bool triple = gcd(cubic, cubic.derivative()).degree() == 2;
  const Inertia member = inertia_of_member(q, root);
  if (member.rank() == 0) return {Relation::equal, Inner::none, Meeting::equal};
  const bool semidefinite = member.positive == 0 || member.negative == 0;
  const Inner inner = member.negative > 0 ? Inner::a : Inner::b;
  if (root > 0) return {Relation::external_touch, Inner::none, Meeting::one_double};
  if (member.rank() == 2) {
    if (triple) return {Relation::overlap, Inner::none, Meeting::triple_and_simple};
    if (semidefinite) return {Relation::internal_touch, inner, Meeting::one_double};
    return {Relation::overlap, Inner::none, Meeting::double_and_two_simple};
  }
  if (triple) return {Relation::internal_touch, inner, Meeting::quadruple};
  return without_multiple_root_inside(q, SturmSequence(cubic), Meeting::two_double,
                                      Relation::internal_touch, inner);
}

}  // namespace

ConicAnswer conic_relation(const Ellipse& a, const Ellipse& b) {
  const Forms q = forms_of(a, b);
  const IntegerPolynomial cubic = characteristic_cubic(q);
  const int discriminant = discriminant_sign(cubic);
  if (discriminant < 0) return {Relation::overlap, Inner::none, Meeting::two_simple};
  if (discriminant == 0) return with_multiple_root(q, cubic);
  const auto c = cubic.coefficients();
  // Where all roots are real, Descartes' rule counts the positive ones.
  if (sgn(c[1]) > 0 || sgn(c[2]) > 0) return {Relation::separate, Inner::none, Meeting::nowhere};
  return without_multiple_root_inside(q, SturmSequence(cubic), Meeting::four_simple,
                                      Relation::overlap, Inner::none);
}

}  // namespace tangency::exact
