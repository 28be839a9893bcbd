// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/ellipse.hpp>

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>
#include <gmpxx.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <tangency/verify/oracles/inertia.hpp>
#include <tangency/verify/oracles/square_free.hpp>

namespace tangency::inline v0::verify {
namespace {

using Kernel = CGAL::Algebraic_kernel_d_1<CGAL::Gmpz>;
using Polynomial = Kernel::Polynomial_1;
using Root = Kernel::Algebraic_real_1;

void require_ellipse(const RawEllipse& body) {
  for (const double a : body.semi_axes) {
    if (!(a > 0)) throw std::invalid_argument("oracle: a semi-axis must be finite and > 0");
  }
  if (body.direction[0] == 0 && body.direction[1] == 0) {
    throw std::invalid_argument("oracle: a direction must not be zero");
  }
}

// xx x^2 + 2 xy xy + yy y^2 + 2 x x + 2 y y + one, negative inside; lengths in units of 2^unit from
// A's centre.
struct Conic {
  mpz_class xx, xy, yy, x, y, one;
};

struct Conics {
  Conic a, b;
  std::array<mpz_class, 2> between;  // c_B - c_A
  mpz_class area_a, area_b;          // squares of the products of the semi-axes
  int unit;
};

Conic conic_of(const RawEllipse& body, const mpz_class* axes, const mpz_class& cx,
               const mpz_class& cy) {
  const std::vector<mpz_class> u = to_integers(body.direction).m;
  const mpz_class p = axes[1] * axes[1], q = axes[0] * axes[0];
  // |u|^2 a1^2 a2^2 level: p (u.r)^2 + q (u x r)^2 - |u|^2 p q.
  Conic c;
  c.xx = p * u[0] * u[0] + q * u[1] * u[1];
  c.yy = p * u[1] * u[1] + q * u[0] * u[0];
  c.xy = (p - q) * u[0] * u[1];
  c.x = -(c.xx * cx + c.xy * cy);
  c.y = -(c.xy * cx + c.yy * cy);
  c.one = -(c.x * cx + c.y * cy) - (u[0] * u[0] + u[1] * u[1]) * p * q;
  return c;
}

Conics conics_of(const RawEllipse& a, const RawEllipse& b) {
  require_ellipse(a);
  require_ellipse(b);
  const std::array<double, 8> lengths{a.centre[0],    a.centre[1],    b.centre[0],
                                      b.centre[1],    a.semi_axes[0], a.semi_axes[1],
                                      b.semi_axes[0], b.semi_axes[1]};
  const ScaledIntegers s = to_integers(lengths);
  const mpz_class dx = s.m[2] - s.m[0], dy = s.m[3] - s.m[1];
  const mpz_class pa = s.m[4] * s.m[5], pb = s.m[6] * s.m[7];
  return {conic_of(a, &s.m[4], 0, 0),
          conic_of(b, &s.m[6], dx, dy),
          {dx, dy},
          pa * pa,
          pb * pb,
          s.exponent};
}

mpz_class value_at(const Conic& c, const mpz_class& x, const mpz_class& y) {
  return c.xx * x * x + 2 * c.xy * x * y + c.yy * y * y + 2 * (c.x * x + c.y * y) + c.one;
}

// With x = X - k y: a y^2 + b(X) y + c(X), b = b[0] + b[1] X.
struct Sheared {
  mpz_class a;
  std::array<mpz_class, 2> b;
  std::array<mpz_class, 3> c;
};

Sheared sheared(const Conic& q, long k) {
  Sheared s;
  s.a = q.yy - 2 * k * q.xy + mpz_class(k * k) * q.xx;
  s.b = {2 * (q.y - k * q.x), 2 * (q.xy - k * q.xx)};
  s.c = {q.one, 2 * q.x, q.xx};
  return s;
}

void trim(IntegerPolynomial& p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
}

// The resultant of two boundaries in X, and what their common points' y follow from.
struct Elimination {
  long k;
  IntegerPolynomial resultant;  // R
  IntegerPolynomial s;          // a_1 b_2 - a_2 b_1
  IntegerPolynomial t;          // a_1 c_2 - a_2 c_1, so that y = -t / s
};

Elimination eliminate(const Conics& q, long k) {
  const Sheared f = sheared(q.a, k), g = sheared(q.b, k);
  Elimination e{k, IntegerPolynomial(5), IntegerPolynomial(2), IntegerPolynomial(3)};
  for (std::size_t i = 0; i < 2; ++i) e.s[i] = f.a * g.b[i] - g.a * f.b[i];
  for (std::size_t i = 0; i < 3; ++i) e.t[i] = f.a * g.c[i] - g.a * f.c[i];
  std::array<mpz_class, 4> w;  // b_1 c_2 - b_2 c_1
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 3; ++j) w[i + j] += f.b[i] * g.c[j] - g.b[i] * f.c[j];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) e.resultant[i + j] += e.t[i] * e.t[j];
  }
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 4; ++j) e.resultant[i + j] -= e.s[i] * w[j];
  }
  trim(e.resultant);
  trim(e.s);
  trim(e.t);
  return e;
}

// (2): with each root of R belonging to one point; an empty s where the ellipses are concentric and
// homothetic (or equal, with an empty R).
Elimination in_general_position(const Conics& q) {
  constexpr long kShears[] = {0, 1, -1, 2, -3, 5, -7, 11, -13, 17, -19};
  for (const long k : kShears) {
    Elimination e = eliminate(q, k);
    if (e.resultant.empty()) return e;
    if (e.s.empty()) continue;
    if (e.s.size() == 1 || e.resultant.size() == 1) return e;
    if (greatest_common_divisor(e.resultant, e.s).size() == 1) return e;
  }
  return eliminate(q, 0);
}

using RootsWithMultiplicity = std::vector<std::pair<Root, Kernel::Multiplicity_type>>;

RootsWithMultiplicity real_roots(const IntegerPolynomial& p) {
  RootsWithMultiplicity roots;
  if (p.size() < 2) return roots;
  std::vector<CGAL::Gmpz> coefficients;
  for (const mpz_class& c : p) coefficients.emplace_back(c.get_mpz_t());
  const Polynomial polynomial(coefficients.begin(), coefficients.end());
  Kernel().solve_1_object()(polynomial, std::back_inserter(roots));
  return roots;
}

// ---- numbers

Real real(const mpz_class& value) {
  Real result;
  mpfr_set_z(result.backend().data(), value.get_mpz_t(), MPFR_RNDN);
  return result;
}

Real real(const CGAL::Gmpq& value) {
  Real result;
  mpfr_set_q(result.backend().data(), value.mpq(), MPFR_RNDN);
  return result;
}

Real value_of(const IntegerPolynomial& p, const Real& x) {
  Real sum = 0;
  for (auto c = p.rbegin(); c != p.rend(); ++c) sum = sum * x + real(*c);
  return sum;
}

// An isolated root to the precision of Real, by halving and then Newton's method.
Real refined(Root& root, const IntegerPolynomial& square_free) {
  for (int i = 0; i < 60 && root.low() != root.high(); ++i) root.refine();
  Real low = real(root.low()), high = real(root.high());
  if (low == high) return low;
  const bool rising = value_of(square_free, high) > value_of(square_free, low);
  for (int i = 0; i < 520; ++i) {
    const Real middle = (low + high) / 2;
    ((value_of(square_free, middle) > 0) == rising ? high : low) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

EllipseTruth exact_ellipse_relation(const RawEllipse& a, const RawEllipse& b) {
  const Conics q = conics_of(a, b);
  const Elimination e = in_general_position(q);
  if (e.resultant.empty()) return {{Relation::equal}, -1, {}};
  EllipseTruth truth{{Relation::overlap}, 0, {}};
  if (!e.s.empty()) {
    for (const auto& [root, multiplicity] : real_roots(e.resultant)) {
      truth.multiplicities.push_back(static_cast<int>(multiplicity));
    }
  }
  std::ranges::sort(truth.multiplicities);
  truth.crossings = static_cast<int>(truth.multiplicities.size());
  if (std::ranges::any_of(truth.multiplicities, [](int m) { return m % 2 == 1; })) return truth;
  const bool touching = truth.crossings > 0;
  const bool nested = value_at(q.b, 0, 0) < 0 || value_at(q.a, q.between[0], q.between[1]) < 0;
  if (!nested) {
    truth.relation = {touching ? Relation::external_touch : Relation::separate};
    return truth;
  }
  const bool a_inside = q.area_a < q.area_b;
  if (touching) {
    truth.relation = {Relation::internal_touch, a_inside ? Inner::a : Inner::b};
  } else {
    truth.relation = {a_inside ? Relation::a_in_b : Relation::b_in_a};
  }
  return truth;
}

std::vector<Real2> ellipse_crossings(const RawEllipse& a, const RawEllipse& b) {
  const Conics q = conics_of(a, b);
  const Elimination e = in_general_position(q);
  std::vector<Real2> points;
  if (e.resultant.empty() || e.s.empty()) return points;
  const IntegerPolynomial distinct = distinct_roots(e.resultant).all;
  const Real unit = ldexp(Real(1), q.unit);
  for (auto& [root, multiplicity] : real_roots(e.resultant)) {
    const Real x = refined(root, distinct), y = -value_of(e.t, x) / value_of(e.s, x);
    points.push_back({(x - e.k * y) * unit, y * unit});
  }
  return points;
}

namespace {

// Slices at x of a sheared ellipse: y in middle -+ half.
struct Slice {
  Real middle, half;
};

struct RealConic {
  Real a;
  std::array<Real, 2> b;
  std::array<Real, 3> c;

  // b^2 - 4 a c
  std::array<Real, 3> discriminant() const {
    return {b[0] * b[0] - 4 * a * c[0], 2 * b[0] * b[1] - 4 * a * c[1], b[1] * b[1] - 4 * a * c[2]};
  }
};

RealConic real_conic(const Sheared& s) {
  return {real(s.a), {real(s.b[0]), real(s.b[1])}, {real(s.c[0]), real(s.c[1]), real(s.c[2])}};
}

// Ends of the range of x, and the slice at one that is given from either end, so that no digits are
// lost there: the discriminant is lead (x - low) (x - high).
struct Range {
  RealConic conic;
  Real low, high, lead;

  explicit Range(const RealConic& q) : conic(q) {
    const auto d = q.discriminant();
    lead = d[2];
    const Real middle = -d[1] / (2 * d[2]), half = sqrt(middle * middle - d[0] / d[2]);
    low = middle - half;
    high = middle + half;
  }
  Slice at(const Real& x) const {
    Real d = lead * (x - low) * (x - high);
    if (d < 0) d = 0;
    return {-(conic.b[0] + conic.b[1] * x) / (2 * conic.a), sqrt(d) / (2 * conic.a)};
  }
};

Real width(const Range& a, const Range& b, const Real& x) {
  const Slice p = a.at(x), q = b.at(x);
  const Real top = std::min(Real(p.middle + p.half), Real(q.middle + q.half));
  const Real bottom = std::max(Real(p.middle - p.half), Real(q.middle - q.half));
  return top > bottom ? Real(top - bottom) : Real(0);
}

// Tanh-sinh: nodes and weights for (-1, 1), made once.
struct Node {
  Real at, weight;  // 1 - |at| is kept as `rest`
  Real rest;
};

std::vector<Node> nodes_of(int level) {
  const Real half_pi = acos(Real(-1)) / 2;
  std::vector<Node> nodes;
  const Real step = ldexp(Real(1), -level);
  for (int i = 0;; ++i) {
    const Real t = i * step, s = half_pi * sinh(t), c = cosh(s);
    const Real weight = step * half_pi * cosh(t) / (c * c), rest = exp(-s) / c;
    if (weight < 1e-50) break;
    nodes.push_back({tanh(s), weight, rest});
  }
  return nodes;
}

template <class F>
Real integral(const F& f, const Real& low, const Real& high) {
  static const std::vector<std::vector<Node>> levels{nodes_of(3), nodes_of(4), nodes_of(5),
                                                     nodes_of(6), nodes_of(7)};
  const Real half = (high - low) / 2, middle = (high + low) / 2;
  Real previous = -1;
  for (const std::vector<Node>& nodes : levels) {
    Real sum = nodes[0].weight * f(middle);
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      const Real off = half * nodes[i].rest;
      sum += nodes[i].weight * (f(low + off) + f(high - off));
    }
    sum *= half;
    if (abs(sum - previous) <= 1e-20 * abs(sum)) return sum;
    previous = sum;
  }
  return previous;
}

}  // namespace

Real common_area(const RawEllipse& a, const RawEllipse& b) {
  const Conics q = conics_of(a, b);
  const Elimination e = in_general_position(q);
  const Range ra(real_conic(sheared(q.a, e.k))), rb(real_conic(sheared(q.b, e.k)));
  std::vector<Real> ends{std::max(ra.low, rb.low), std::min(ra.high, rb.high)};
  if (!(ends[0] < ends[1])) return 0;
  if (!e.resultant.empty() && !e.s.empty()) {
    const IntegerPolynomial distinct = distinct_roots(e.resultant).all;
    for (auto& [root, multiplicity] : real_roots(e.resultant)) {
      const Real x = refined(root, distinct);
      if (x > ends[0] && x < ends[1]) ends.push_back(x);
    }
  }
  std::ranges::sort(ends);
  Real area = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (width(ra, rb, (ends[i] + ends[i + 1]) / 2) == 0) continue;
    area += integral([&](const Real& x) { return width(ra, rb, x); }, ends[i], ends[i + 1]);
  }
  return ldexp(area, 2 * q.unit);
}

}  // namespace tangency::inline v0::verify
