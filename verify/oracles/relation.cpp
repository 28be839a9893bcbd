// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/relation.hpp>

#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>
#include <variant>
#include <vector>

#include <tangency/verify/oracles/inertia.hpp>
#include <tangency/verify/oracles/square_free.hpp>
#include <tangency/verify/oracles/witness_guess.hpp>

namespace tangency::inline v0::verify {
namespace {

using Kernel = CGAL::Algebraic_kernel_d_1<CGAL::Gmpz>;
using Polynomial = Kernel::Polynomial_1;
using Root = Kernel::Algebraic_real_1;
using Vector = std::array<mpz_class, 3>;

// ---- the forms

// A multiple of the level function that is -1 at the centre: q = level * matrix entries.
struct Form {
  IntegerMatrix matrix;
  mpz_class level;  // > 0; the matrix is level times that of the level function
};

struct Forms {
  Form a, b;
  Vector between;  // c_B - c_A
  int unit;        // lengths are integers times 2^unit; the origin is A's centre
};

void require_ellipsoid(const RawEllipsoid& body) {
  for (const double a : body.semi_axes) {
    if (!(a > 0)) throw std::invalid_argument("oracle: a semi-axis must be finite and > 0");
  }
  if (std::ranges::all_of(body.orientation, [](double v) { return v == 0; })) {
    throw std::invalid_argument("oracle: an orientation must not be zero");
  }
}

// With the integer quaternion q, R' = |q|^2 R and n = |q|^4: n (a1 a2 a3)^2 times the level
// function has the upper block S = R' diag(a2^2 a3^2, ...) R'^T, which is integer.
Form form_of(const RawEllipsoid& body, const mpz_class* axes, const Vector& centre) {
  const std::vector<mpz_class> q = to_integers(body.orientation).m;
  const mpz_class &w = q[0], &x = q[1], &y = q[2], &z = q[3];
  const mpz_class ww = w * w, xx = x * x, yy = y * y, zz = z * z, wx = w * x, wy = w * y,
                  wz = w * z, xy = x * y, xz = x * z, yz = y * z;
  const std::array<Vector, 3> columns{{{ww + xx - yy - zz, 2 * (xy + wz), 2 * (xz - wy)},
                                       {2 * (xy - wz), ww - xx + yy - zz, 2 * (yz + wx)},
                                       {2 * (xz + wy), 2 * (yz - wx), ww - xx - yy + zz}}};
  const mpz_class norm = ww + xx + yy + zz;
  const Vector squares{axes[0] * axes[0], axes[1] * axes[1], axes[2] * axes[2]};
  Form form;
  form.level = norm * norm * squares[0] * squares[1] * squares[2];
  for (std::size_t k = 0; k < 3; ++k) {
    const mpz_class weight = squares[(k + 1) % 3] * squares[(k + 2) % 3];
    for (std::size_t i = 0; i < 3; ++i) {
      const mpz_class scaled = weight * columns[k][i];
      for (std::size_t j = i; j < 3; ++j) form.matrix[i][j] += scaled * columns[k][j];
    }
  }
  mpz_class& last = form.matrix[3][3];
  last = -form.level;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < i; ++j) form.matrix[i][j] = form.matrix[j][i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    mpz_class& entry = form.matrix[i][3];
    for (std::size_t j = 0; j < 3; ++j) entry -= form.matrix[i][j] * centre[j];
    form.matrix[3][i] = entry;
    last -= entry * centre[i];
  }
  return form;
}

Forms forms_of(const RawEllipsoid& a, const RawEllipsoid& b) {
  require_ellipsoid(a);
  require_ellipsoid(b);
  std::array<double, 12> lengths;
  auto out = std::ranges::copy(a.semi_axes, lengths.begin()).out;
  out = std::ranges::copy(b.semi_axes, out).out;
  out = std::ranges::copy(a.centre, out).out;
  std::ranges::copy(b.centre, out);
  const ScaledIntegers s = to_integers(lengths);
  const Vector between{s.m[9] - s.m[6], s.m[10] - s.m[7], s.m[11] - s.m[8]};
  return {form_of(a, &s.m[0], {}), form_of(b, &s.m[3], between), between, s.exponent};
}

// ---- members of the pencil

// The member a Q_A + b Q_B.
Inertia inertia_of_member(const IntegerMatrix& qa, const mpz_class& a, const IntegerMatrix& qb,
                          const mpz_class& b) {
  IntegerMatrix m;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i; j < 4; ++j) {
      m[i][j] = a * qa[i][j] + b * qb[i][j];
      m[j][i] = m[i][j];
    }
  }
  return inertia(std::move(m), 4);
}

// The verdict (1), (2), (3) or (4) of a member Q_A + f Q_B of that inertia, if it has one.
std::optional<ExactRelation> verdict(const Inertia& member, int sign_of_f) {
  if (member.rank() == 0) return ExactRelation{Relation::equal};
  if (member.positive > 0 && member.negative > 0) return std::nullopt;
  const bool definite = member.zero == 0;
  if (sign_of_f > 0) {
    return ExactRelation{definite ? Relation::separate : Relation::external_touch};
  }
  if (member.positive > 0) {
    if (definite) return ExactRelation{Relation::a_in_b};
    return ExactRelation{Relation::internal_touch, Inner::a};
  }
  if (definite) return ExactRelation{Relation::b_in_a};
  return ExactRelation{Relation::internal_touch, Inner::b};
}

// det(Q_A + f Q_B), coefficients from f^0 to f^4, by Laplace's expansion along the upper two rows.
std::array<mpz_class, 5> characteristic_quartic(const IntegerMatrix& qa, const IntegerMatrix& qb) {
  const auto minor = [&](std::size_t row, std::size_t i, std::size_t j) -> Vector {
    const auto &a0 = qa[row], &a1 = qa[row + 1], &b0 = qb[row], &b1 = qb[row + 1];
    return {a0[i] * a1[j] - a0[j] * a1[i],
            a0[i] * b1[j] - a0[j] * b1[i] + b0[i] * a1[j] - b0[j] * a1[i],
            b0[i] * b1[j] - b0[j] * b1[i]};
  };
  static constexpr std::size_t kColumns[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                                 {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
  std::array<mpz_class, 5> p;
  for (const auto& c : kColumns) {
    const Vector upper = minor(0, c[0], c[1]);
    const Vector lower = minor(2, c[2], c[3]);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) p[i + j] += upper[i] * lower[j];
    }
  }
  return p;
}

mpz_class integer(const CGAL::Gmpz& value) { return mpz_class(value.mpz()); }

CGAL::Gmpq rational(const mpz_class& numerator, const mpz_class& denominator) {
  return {CGAL::Gmpz(numerator.get_mpz_t()), CGAL::Gmpz(denominator.get_mpz_t())};
}

// ---- the walk along the pencil

class PencilWalk {
 public:
  // Requires both matrices to have inertia (3,1). Brings them to like size by powers of two.
  PencilWalk(IntegerMatrix qa, IntegerMatrix qb) : qa_(std::move(qa)), qb_(std::move(qb)) {
    std::array<mpz_class, 5> p = characteristic_quartic(qa_, qb_);
    const long bits_a = static_cast<long>(mpz_sizeinbase(p[0].get_mpz_t(), 2));
    const long bits_b = static_cast<long>(mpz_sizeinbase(p[4].get_mpz_t(), 2));
    const auto shift = static_cast<mp_bitcnt_t>(std::abs(bits_a - bits_b) / 4);
    const bool raise_b = bits_a > bits_b;
    for (auto& row : raise_b ? qb_ : qa_) {
      for (mpz_class& entry : row) entry <<= shift;
    }
    for (std::size_t i = 0; i < 5; ++i) p[i] <<= shift * (raise_b ? i : 4 - i);
    distinct_ = distinct_roots({p.begin(), p.end()});
  }

  ExactRelation relation() {
    find_gaps();
    for (const CGAL::Gmpq& f : gaps_) {  // (6): the definite members
      if (const auto answer = verdict_at(f)) return *answer;
    }
    if (const auto answer = verdict_at_multiple_roots()) return *answer;  // (7)
    return {Relation::overlap};
  }

 private:
  // A rational number in each gap between neighbouring real roots of p.
  void find_gaps() {
    std::vector<CGAL::Gmpz> coefficients;
    for (const mpz_class& c : distinct_.all) coefficients.emplace_back(c.get_mpz_t());
    const Polynomial p(coefficients.begin(), coefficients.end());
    std::vector<Root> roots;
    constexpr bool kSquareFree = true;
    Kernel().solve_1_object()(p, kSquareFree, std::back_inserter(roots));
    for (std::size_t i = 0; i + 1 < roots.size(); ++i) {
      while (true) {
        const CGAL::Gmpq f = (roots[i].high() + roots[i + 1].low()) / CGAL::Gmpq(2);
        if (roots[i].high() <= roots[i + 1].low() && p.sign_at(f) != CGAL::ZERO) {
          gaps_.push_back(f);
          break;
        }
        roots[i].refine();
        roots[i + 1].refine();
      }
    }
  }

  Inertia inertia_at(const CGAL::Gmpq& f) const {
    return inertia_of_member(qa_, integer(f.denominator()), qb_, integer(f.numerator()));
  }

  std::optional<ExactRelation> verdict_at(const CGAL::Gmpq& f) const {
    return verdict(inertia_at(f), static_cast<int>(CGAL::sign(f)));
  }

  // (8)
  std::optional<ExactRelation> verdict_at_multiple_roots() const {
    const IntegerPolynomial& m = distinct_.multiple;
    if (m.size() == 1) return std::nullopt;
    if (m.size() == 2) return verdict_at(rational(-m[0], m[1]));
    assert(m.size() == 3);
    const mpz_class discriminant = m[1] * m[1] - 4 * m[0] * m[2];
    if (!mpz_perfect_square_p(discriminant.get_mpz_t())) return verdict_at_irrational_roots();
    const mpz_class root = sqrt(discriminant);
    const auto answer = verdict_at(rational(-m[1] - root, 2 * m[2]));
    return answer ? answer : verdict_at(rational(-m[1] + root, 2 * m[2]));
  }

  // p = c m^2: one gap, with the inertia (3,1) if the later root changes nothing, else (1,3).
  ExactRelation verdict_at_irrational_roots() const {
    return {Relation::internal_touch, inertia_at(gaps_.at(0)).positive == 3 ? Inner::a : Inner::b};
  }

  IntegerMatrix qa_, qb_;
  DistinctRoots distinct_;  // of p
  std::vector<CGAL::Gmpq> gaps_;
};

// ---- concentric bodies

// (9)
std::optional<ExactRelation> of_concentric(const Forms& forms) {
  if (std::ranges::any_of(forms.between, [](const mpz_class& v) { return v != 0; })) return {};
  IntegerMatrix m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      m[i][j] = forms.b.level * forms.a.matrix[i][j] - forms.a.level * forms.b.matrix[i][j];
    }
  }
  const auto decided = verdict(inertia(std::move(m), 3), -1);
  return decided ? decided : ExactRelation{Relation::overlap};
}

// ---- verified guesses

// value = mantissa 2^exponent to about 2^-31 of it; the mantissa is not 0.
std::pair<mpz_class, long> short_binary(long double value) {
  int exponent = 0;
  const long double fraction = std::frexp(value, &exponent);
  return {mpz_class(static_cast<double>(std::round(std::ldexp(fraction, 31)))), exponent - 31L};
}

// The member t sign_a q_A + sign_b q_B, or one close by, is positive definite. q = matrix / level.
bool is_definite(const Forms& forms, const DefiniteMember& guess, int sign_a, int sign_b) {
  long exponent_a = 0, exponent_b = 0;
  const double level_a = mpz_get_d_2exp(&exponent_a, forms.a.level.get_mpz_t());
  const double level_b = mpz_get_d_2exp(&exponent_b, forms.b.level.get_mpz_t());
  auto [a, exponent] = short_binary(guess.t * static_cast<long double>(level_b) / level_a);
  exponent += exponent_b - exponent_a;
  mpz_class b = 1;
  if (exponent > 0) a <<= static_cast<mp_bitcnt_t>(exponent);
  if (exponent < 0) b <<= static_cast<mp_bitcnt_t>(-exponent);
  if (sign_a < 0) a = -a;
  if (sign_b < 0) b = -b;
  return inertia_of_member(forms.a.matrix, a, forms.b.matrix, b) == Inertia{4, 0, 0};
}

// A point with the coordinates x / w in units of 2^Forms::unit, w > 0.
struct HomogeneousPoint {
  Vector x;
  mpz_class w;
};

// Some point near `p`: rounded to 2^-40 of `size`, and exact from there on. Nothing if out of
// range.
std::optional<HomogeneousPoint> exact_point(const Point& p, double size, int unit) {
  const int grid = std::ilogb(size) - 40;
  const int shift = grid - unit;
  HomogeneousPoint result{{}, 1};
  if (shift < 0) result.w <<= static_cast<mp_bitcnt_t>(-shift);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto steps = static_cast<double>(std::round(std::ldexp(p[i], -grid)));
    if (!std::isfinite(steps)) return std::nullopt;
    result.x[i] = steps;
    if (shift > 0) result.x[i] <<= static_cast<mp_bitcnt_t>(shift);
  }
  return result;
}

// Sign of the level function: negative inside, positive outside.
int side(const Form& form, const HomogeneousPoint& p) {
  mpz_class value;
  for (std::size_t i = 0; i < 4; ++i) {
    mpz_class row = form.matrix[i][3] * p.w;
    for (std::size_t j = 0; j < 3; ++j) row += form.matrix[i][j] * p.x[j];
    value += row * (i < 3 ? p.x[i] : p.w);
  }
  return sgn(value);
}

std::optional<ExactRelation> verified_guess(const RawEllipsoid& a, const RawEllipsoid& b,
                                            const Forms& forms) {
  Point d;
  for (std::size_t i = 0; i < 3; ++i) {
    d[i] = static_cast<long double>(b.centre[i]) - static_cast<long double>(a.centre[i]);
  }
  const ApproximateBody body_a = approximate_body(a, {});
  const ApproximateBody body_b = approximate_body(b, d);
  const double size =
      std::min(*std::ranges::min_element(a.semi_axes), *std::ranges::min_element(b.semi_axes));
  const auto lies = [&](const Point& x, int side_a, int side_b) {
    const auto point = exact_point(x, size, forms.unit);
    return point && side(forms.a, *point) == side_a && side(forms.b, *point) == side_b;
  };
  const auto has_definite = [&](int sign_a, int sign_b) {
    const Guess guess = guess_member(body_a, body_b, sign_a, sign_b);
    const auto* member = std::get_if<DefiniteMember>(&guess);
    return member != nullptr && is_definite(forms, *member, sign_a, sign_b);
  };

  const Guess first = guess_member(body_a, body_b, 1, 1);
  if (const auto* member = std::get_if<DefiniteMember>(&first)) {
    if (is_definite(forms, *member, 1, 1)) return ExactRelation{Relation::separate};
  }
  const auto* common = std::get_if<CommonPoint>(&first);
  if (common == nullptr) return std::nullopt;
  const auto of_a = guess_protruding_point(body_a, body_b);
  const auto of_b = guess_protruding_point(body_b, body_a);
  if (of_a && of_b && lies(common->x, -1, -1) && lies(*of_a, -1, 1) && lies(*of_b, 1, -1)) {
    return ExactRelation{Relation::overlap};
  }
  if (!of_a && has_definite(1, -1)) return ExactRelation{Relation::a_in_b};
  if (!of_b && has_definite(-1, 1)) return ExactRelation{Relation::b_in_a};
  return std::nullopt;
}

// The matrix, or its negative, that is negative inside.
IntegerMatrix ellipsoid_matrix(IntegerMatrix matrix) {
  if (matrix[0][0] < 0) {
    for (auto& row : matrix) {
      for (mpz_class& entry : row) entry = -entry;
    }
  }
  if (inertia(matrix, 3) != Inertia{3, 0, 0} || inertia(matrix, 4) != Inertia{3, 1, 0}) {
    throw std::invalid_argument("oracle: the quadric is not a real ellipsoid");
  }
  return matrix;
}

}  // namespace

ExactRelation exact_relation(const RawEllipsoid& a, const RawEllipsoid& b) {
  Forms forms = forms_of(a, b);
  if (const auto answer = of_concentric(forms)) return *answer;
  if (const auto answer = verified_guess(a, b, forms)) return *answer;
  return PencilWalk(std::move(forms.a.matrix), std::move(forms.b.matrix)).relation();
}

bool exact_overlaps(const RawEllipsoid& a, const RawEllipsoid& b) {
  const Relation relation = exact_relation(a, b).relation;
  return relation != Relation::separate && relation != Relation::external_touch;
}

ExactRelation exact_relation_by_pencil(const RawEllipsoid& a, const RawEllipsoid& b) {
  Forms forms = forms_of(a, b);
  return PencilWalk(std::move(forms.a.matrix), std::move(forms.b.matrix)).relation();
}

ExactRelation exact_relation_by_pencil(const RawQuadric& a, const RawQuadric& b) {
  return exact_relation_by_pencil(discriminant_matrix(a), discriminant_matrix(b));
}

ExactRelation exact_relation_by_pencil(const IntegerMatrix& a, const IntegerMatrix& b) {
  return PencilWalk(ellipsoid_matrix(a), ellipsoid_matrix(b)).relation();
}

}  // namespace tangency::inline v0::verify
