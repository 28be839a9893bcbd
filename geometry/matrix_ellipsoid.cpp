// SPDX-License-Identifier: MIT
#include <tangency/geometry/matrix_ellipsoid.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <tangency/geometry/bodies/classify_coefficients.hpp>
#include <tangency/geometry/bodies/given_matrix.hpp>
#include <tangency/geometry/bodies/rational_solid.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>

namespace tangency::inline v0 {
namespace {

using exact::RationalMatrix;
using exact::RationalSolid;
using exact::to_rational;

/// Semi-axes may be off a right angle by so much of their lengths. Chosen: files of 13 digits pass.
constexpr double kRightAngle = 0x1p-40;

[[noreturn]] void refuse(const char* field, double value, const char* rule) {
  exact::refuse<InvalidEllipsoid>(field, value, rule);
}

void require_finite(const Vec3& centre) {
  if (const auto fault = Ellipsoid::find_fault(centre, Vec3::Ones(), Quaternion::Identity()))
    throw InvalidEllipsoid(*fault);
}

exact::RationalVector<3> rational(const Vec3& v) {
  return {to_rational(v.x()), to_rational(v.y()), to_rational(v.z())};
}

/// Names of the entries on and above the diagonal, row by row.
using EntryNames = std::array<std::array<const char*, 3>, 3>;
constexpr EntryNames kShapeNames{
    {{"m.xx", "m.xy", "m.zx"}, {"m.xy", "m.yy", "m.yz"}, {"m.zx", "m.yz", "m.zz"}}};
constexpr EntryNames kPrecisionNames{
    {{"p.xx", "p.xy", "p.zx"}, {"p.xy", "p.yy", "p.yz"}, {"p.zx", "p.yz", "p.zz"}}};
constexpr EntryNames kAxisNames{
    {{"u1.x", "u2.x", "u3.x"}, {"u1.y", "u2.y", "u3.y"}, {"u1.z", "u2.z", "u3.z"}}};

RationalMatrix<3> rational(const Mat3& m, const EntryNames& names) {
  RationalMatrix<3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double entry = m(static_cast<int>(i), static_cast<int>(j));
      result[i][j] = exact::rational_entry<InvalidEllipsoid>(entry, names[i][j]);
    }
  }
  return result;
}

/// @param field  of the whole matrix, in messages
RationalMatrix<3> definite(const Mat3& m, const EntryNames& names, const char* field) {
  RationalMatrix<3> result = rational(m, names);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i + 1; j < 3; ++j) {
      if (result[i][j] != result[j][i])
        refuse(names[i][j], m(static_cast<int>(j), static_cast<int>(i)),
               "the matrix must be symmetric, and its other entry is not equal");
    }
  }
  exact::require_definite<InvalidEllipsoid>(result, field);
  return result;
}

Ellipsoid nearest_ellipsoid(const exact::NearestSolid<3>& s, const char* field) {
  exact::require_in_range<InvalidEllipsoid>(s, s.relative, field);
  return Ellipsoid(
      Vec3(s.centre[0], s.centre[1], s.centre[2]),
      Vec3(s.semi_axes[0], s.semi_axes[1], s.semi_axes[2]),
      Quaternion(s.orientation[0], s.orientation[1], s.orientation[2], s.orientation[3]));
}

RationalMatrix<3> quadric_block(const Quadric::Coefficients& c) {
  return {{{to_rational(c[0]), to_rational(c[3]), to_rational(c[5])},
           {to_rational(c[3]), to_rational(c[1]), to_rational(c[4])},
           {to_rational(c[5]), to_rational(c[4]), to_rational(c[2])}}};
}

// Of level_of_confidence(). Newton's method takes at most 14 steps (measured, for confidences of
// every size). Halvings take a bracket with ends in a ratio of 8 to 2^-77 of x, whatever those did.
constexpr int kNewtonSteps = 60, kHalvings = 80;

/// Both tails of chi-squared with three degrees of freedom, and its density, at x > 0. With
/// y = x/2 the lower one is density (4/3) y (1 + y/(5/2) + y^2/((5/2)(7/2)) + ...): all terms are
/// positive, so that nothing cancels.
struct Tail {
  long double below, above, density;
};
Tail chi_squared_of_three(long double x) {
  const long double y = x / 2, pi = std::acos(-1.0L);
  const long double density = std::sqrt(y / pi) * std::exp(-y);
  const long double above = std::erfc(std::sqrt(y)) + 2 * density;
  long double term = 4 * y * density / 3, below = 0;
  for (long double k = 2.5L; term > below * 0x1p-70L; k += 1) {
    below += term;
    term *= y / k;
  }
  return {below, above, density};
}

}  // namespace

MatrixEllipsoid::MatrixEllipsoid(const Ellipsoid& ellipsoid) : ellipsoid_(ellipsoid) {}

MatrixEllipsoid::MatrixEllipsoid(std::shared_ptr<const RationalSolid<3>> exact, const char* field)
    : exact_(std::move(exact)), ellipsoid_(Vec3::Zero(), Vec3::Ones()) {
  in_default_environment([&] {
    const exact::NearestSolid<3> nearest = exact::nearest_solid(*exact_);
    ellipsoid_ = nearest_ellipsoid(nearest, field);
    rounding_ = nearest.absolute;
    relative_rounding_ = nearest.relative;
  });
  if (rounding_ == 0.0) exact_.reset();
}

MatrixEllipsoid MatrixEllipsoid::from_shape(const Vec3& centre, const Mat3& shape, double level) {
  require_finite(centre);
  const mpq_class factor = exact::rational_level<InvalidEllipsoid>(level);
  return {exact::shared(RationalSolid<3>{rational(centre),
                                         exact::scaled(definite(shape, kShapeNames, "m"), factor)}),
          "m"};
}

MatrixEllipsoid MatrixEllipsoid::from_precision(const Vec3& centre, const Mat3& precision,
                                                double level) {
  require_finite(centre);
  const mpq_class factor = exact::rational_level<InvalidEllipsoid>(level);
  const RationalMatrix<3> given = definite(precision, kPrecisionNames, "p");
  return {exact::shared(
              RationalSolid<3>{rational(centre), exact::scaled(exact::inverse(given), factor)}),
          "p"};
}

MatrixEllipsoid MatrixEllipsoid::from_axes(const Vec3& centre, const Mat3& axes) {
  require_finite(centre);
  const RationalMatrix<3> u = rational(axes, kAxisNames);
  static constexpr const char* kFields[] = {"u1", "u2", "u3"};
  for (int i = 0; i < 3; ++i) {
    const Vec3 first = axes.col(i), second = axes.col((i + 1) % 3);
    const double a = first.stableNorm(), b = second.stableNorm();
    if (a == 0.0) refuse(kFields[i], a, "a semi-axis must be longer than 0");
    if (b == 0.0) continue;  // named in its turn
    const double cosine = (first / a).dot(second / b);
    if (!(std::abs(cosine) <= kRightAngle))
      refuse(kFields[i], cosine,
             "the cosine between this semi-axis and the next must be at most 2^-40 in size");
  }
  RationalSolid<3> solid{rational(centre), {}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) solid.shape[i][j] += u[i][k] * u[j][k];
    }
  }
  return {exact::shared(std::move(solid)), "u1"};
}

MatrixEllipsoid MatrixEllipsoid::from_quadric(const Quadric& quadric) {
  const Quadric::Coefficients& c = quadric.coefficients();
  const QuadricType type = detail::classify_coefficients(c).type;
  RationalMatrix<3> block = quadric_block(c);
  if (type != QuadricType::real_ellipsoid)
    refuse("quadric", exact::smallest_eigenvalue(block),
           "the quadric must be a real ellipsoid; this is the smallest eigenvalue of its block");
  RationalMatrix<3> shape = exact::inverse(block);
  RationalSolid<3> solid;
  mpq_class at_centre = to_rational(c[9]);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) solid.centre[i] -= shape[i][j] * to_rational(c[6 + j]);
    at_centre += solid.centre[i] * to_rational(c[6 + i]);
  }
  // Whatever the sign of the block, this one's is the other.
  solid.shape = exact::scaled(std::move(shape), mpq_class(-at_centre));
  return {exact::shared(std::move(solid)), "quadric"};
}

double level_of_confidence(double confidence, int dimensions) {
  if (!(confidence > 0.0 && confidence < 1.0))
    throw std::invalid_argument("a confidence must be > 0 and < 1");
  if (dimensions != 2 && dimensions != 3)
    throw std::invalid_argument("a confidence is of 2 or 3 dimensions");
  return in_default_environment([&] {
    const long double p = confidence;
    if (dimensions == 2) return static_cast<double>(-2 * std::log1p(-p));
    // With y = x/2 the lower tail is at most 4/(3 sqrt pi) y^(3/2), and at least e^-y times that: x
    // is above `low` and, where 8 low < 1, below 8 low. Else the ends are in a ratio of 8 or of 2.
    const long double pi = std::acos(-1.0L), root = std::cbrt(p);
    long double low = 1.98L * std::cbrt(9 * pi / 16) * root * root;
    long double high = std::min(1.0L, 8 * low);
    const auto is_below = [&](const Tail& t) { return p < 0.5L ? t.below < p : t.above > 1 - p; };
    while (is_below(chi_squared_of_three(high))) low = high, high *= 2;
    long double x = (low + high) / 2;
    for (int step = 0; step < kNewtonSteps + kHalvings; ++step) {
      const Tail tail = chi_squared_of_three(x);
      const long double excess = p < 0.5L ? tail.below - p : (1 - p) - tail.above;
      (excess > 0 ? high : low) = x;
      const long double newton = x - excess / tail.density;
      if (std::abs(newton - x) <= 0x1p-58L * x) return static_cast<double>(newton);
      const bool halves = step >= kNewtonSteps || !(newton > low && newton < high);
      x = halves ? (low + high) / 2 : newton;
    }
    return static_cast<double>(x);  // in a bracket that is narrower than its rounding
  });
}

}  // namespace tangency::inline v0
