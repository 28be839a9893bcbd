// SPDX-License-Identifier: MIT
#include <tangency/geometry/plane/ellipse_meeting.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <tangency/geometry/bodies/rational_solid.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>
#include <tangency/geometry/numbers/integer_polynomial.hpp>
#include <tangency/geometry/numbers/real_roots.hpp>
#include <tangency/geometry/numbers/running_error.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0::exact {
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

// With x = 2^unit X the form in X becomes one in x by powers of two on either side.
IntegerForm<3> conic_form(const Ellipse& e) {
  const std::array<double, 4> lengths{e.centre()[0], e.centre()[1], e.semi_axes()[0],
                                      e.semi_axes()[1]};
  const int unit = common_exponent(lengths);
  IntegerForm<3> form = form_of(e, to_integers(e.centre(), unit), unit);
  const auto shift = static_cast<mp_bitcnt_t>(std::abs(unit));
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const auto lines =
          static_cast<mp_bitcnt_t>(unit > 0 ? (i == 2) + (j == 2) : (i != 2) + (j != 2));
      form[i][j] <<= shift * lines;
    }
  }
  return form;
}

IntegerForm<3> conic_form(const MatrixEllipse& e) {
  return e.exact() != nullptr ? integer_form(*e.exact()).form : conic_form(e.ellipse());
}

ConicAnswer conic_relation(const Ellipse& a, const Ellipse& b) {
  const Forms q = forms_of(a, b);
  return conic_relation(q.a, q.b);
}

ConicAnswer conic_relation(const IntegerForm<3>& a, const IntegerForm<3>& b) {
  const Forms q{a, b};
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

}  // namespace tangency::inline v0::exact

namespace tangency::inline v0::detail {
namespace {

using exact::ConicAnswer;
using exact::Meeting;

// Halvings from the largest length to the thinnest axis; chosen: products of sixteen lengths stay
// clear of 2^-1022.
constexpr int kThinnest = 40;

/// One ellipse, in a unit of length and with a direction in [1, 2): their powers of two cancel.
struct Body {
  double ux, uy;
  Bounded norm;           ///< |u|^2
  Bounded first, second;  ///< squares of the semi-axes

  Body(const Ellipse& e, int exponent) noexcept : Body(e, exponent, direction_exponent(e)) {}
  Bounded determinant() const noexcept { return first * second; }
  /// A component as it was scaled, which underflow may have rounded.
  static Bounded component(double u) noexcept { return {u, 0x1p-1070}; }

 private:
  static int direction_exponent(const Ellipse& e) noexcept {
    return std::max(exponent_of(e.direction()[0]), exponent_of(e.direction()[1]));
  }
  Body(const Ellipse& e, int exponent, int turn) noexcept
      : ux(scaled_by_power(e.direction()[0], -turn)),
        uy(scaled_by_power(e.direction()[1], -turn)),
        norm(square(component(ux)) + square(component(uy))),
        first(square(scaled_by_power(e.semi_axes()[0], -exponent))),
        second(square(scaled_by_power(e.semi_axes()[1], -exponent))) {}
};

/// c0 + c1 l + c2 l^2 + c3 l^3 = |u_A|^2 |u_B|^2 det M_A det M_B det(l Q_A + Q_B), and what it is
/// made of; docs/derivations/ellipses.md.
struct Cubic {
  Bounded determinant_a, determinant_b, mixed;  ///< times |u_A|^2 |u_B|^2
  Bounded c0, c1, c2, c3;

  Bounded operator()(double l) const noexcept { return c0 + l * (c1 + l * (c2 + l * c3)); }

  Bounded discriminant() const noexcept {
    const Bounded inner = c1 * c2, outer = c0 * c3;
    return square(inner) - 4.0 * (c0 * (c2 * square(c2))) - 4.0 * (c3 * (c1 * square(c1))) +
           18.0 * (inner * outer) - 27.0 * square(outer);
  }
};

/// d' adj(|u|^2 M) d
Bounded adjugate_form(const Body& e, const Bounded& dx, const Bounded& dy) noexcept {
  const Bounded ux = Body::component(e.ux), uy = Body::component(e.uy);
  return e.second * square(ux * dx + uy * dy) + e.first * square(ux * dy - uy * dx);
}

Cubic cubic_of(const Body& a, const Body& b, const Bounded& dx, const Bounded& dy) noexcept {
  const Bounded norms = a.norm * b.norm;
  const Bounded n_a = b.norm * adjugate_form(a, dx, dy), n_b = a.norm * adjugate_form(b, dx, dy);
  const Bounded ax = Body::component(a.ux), ay = Body::component(a.uy);
  const Bounded bx = Body::component(b.ux), by = Body::component(b.uy);
  const Bounded cosine2 = square(ax * bx + ay * by), sine2 = square(ax * by - ay * bx);
  const Bounded det_a = norms * a.determinant(), det_b = norms * b.determinant();
  const Bounded mixed = cosine2 * (a.second * b.first + a.first * b.second) +
                        sine2 * (a.second * b.second + a.first * b.first);
  return {det_a, det_b, mixed, -det_a, n_a - det_a - mixed, n_b - mixed - det_b, -det_b};
}

/// Is the 2 x 2 block of t Q_A - Q_B surely definite, surely not?
struct Block {
  Bounded trace, determinant;

  /// Of t M_A^-1 - M_B^-1 times |u_A|^2 |u_B|^2 det M_A det M_B.
  Block(const Body& a, const Body& b, const Cubic& cubic, double t) noexcept
      : trace(0.0), determinant(0.0) {
    const Bounded weight_a = t * b.determinant(), weight_b = a.determinant();
    const Bounded norms = a.norm * b.norm;
    trace = norms * (weight_a * (a.first + a.second) - weight_b * (b.first + b.second));
    determinant = square(weight_a) * cubic.determinant_a - weight_a * (weight_b * cubic.mixed) +
                  square(weight_b) * cubic.determinant_b;
  }
  bool positive() const noexcept { return trace.positive() && determinant.positive(); }
  bool negative() const noexcept { return trace.negative() && determinant.positive(); }
  bool not_positive() const noexcept { return trace.negative() || determinant.negative(); }
  bool not_negative() const noexcept { return trace.positive() || determinant.negative(); }
};

/// Three negative roots: one inside the other, or four crossings.
std::optional<ConicAnswer> filter_inside(const Body& a, const Body& b,
                                         const Cubic& cubic) noexcept {
  // R(t) = det(t Q_A - Q_B) is < 0 between its two lower roots and > 0 between the two upper ones:
  // its turning points, roughly, are where to look.
  const double linear = -cubic.c1.value, square_term = -cubic.c2.value, lead = -cubic.c3.value;
  const double root = std::sqrt(square_term * square_term - 3.0 * lead * linear);
  const double upper = (square_term + root) / (3.0 * lead), lower = linear / (3.0 * lead * upper);
  if (!(0.0 < lower && lower < upper && std::isfinite(upper))) return std::nullopt;
  // R(t) = -P(-t)
  if (!cubic(-lower).positive() || !cubic(-upper).negative()) return std::nullopt;
  const Block high(a, b, cubic, upper), low(a, b, cubic, lower);
  if (high.positive()) return ConicAnswer{Relation::a_in_b, Inner::none, Meeting::nowhere};
  if (low.negative()) return ConicAnswer{Relation::b_in_a, Inner::none, Meeting::nowhere};
  if (!high.not_positive() || !low.not_negative()) return std::nullopt;
  return ConicAnswer{Relation::overlap, Inner::none, Meeting::four_simple};
}

}  // namespace

std::optional<ConicAnswer> filter_meeting(const Ellipse& a, const Ellipse& b) noexcept {
  const Vec2 d = b.centre() - a.centre();
  if (!d.allFinite()) return std::nullopt;
  const double reach = d.cwiseAbs().maxCoeff();
  const int exponent = exponent_of(std::max({reach, a.largest_semi_axis(), b.largest_semi_axis()}));
  const double thinnest = std::min(a.smallest_semi_axis(), b.smallest_semi_axis());
  if (exponent_of(thinnest) < exponent - kThinnest) return std::nullopt;
  const auto component = [&](double v) {
    const double scaled = scaled_by_power(v, -exponent);
    return Bounded(scaled, kUnitRoundoff * std::abs(scaled) + 0x1p-1070);
  };
  const Bounded dx = component(d[0]), dy = component(d[1]);
  const Body body_a(a, exponent), body_b(b, exponent);
  const Cubic cubic = cubic_of(body_a, body_b, dx, dy);

  const Bounded discriminant = cubic.discriminant();
  if (discriminant.negative())
    return ConicAnswer{Relation::overlap, Inner::none, Meeting::two_simple};
  if (!discriminant.positive()) return std::nullopt;
  // All roots are real: Descartes' rule counts the positive ones.
  if (cubic.c1.positive() || cubic.c2.positive())
    return ConicAnswer{Relation::separate, Inner::none, Meeting::nowhere};
  if (!cubic.c1.negative() || !cubic.c2.negative()) return std::nullopt;
  return filter_inside(body_a, body_b, cubic);
}

MeetingAnswer ellipse_meeting(const Ellipse& a, const Ellipse& b) noexcept {
  if (const auto found = filter_meeting(a, b)) return {*found, Tier::filter};
  return {exact::conic_relation(a, b), Tier::exact};
}

}  // namespace tangency::inline v0::detail
