// SPDX-License-Identifier: MIT
#include <tangency/geometry/matrix_ellipsoid.hpp>

#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <tangency/geometry/bodies/classify_coefficients.hpp>
#include <tangency/geometry/bodies/rational_solid.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>

namespace tangency {
namespace {

using exact::RationalMatrix;
using exact::RationalSolid;
using exact::to_rational;

/// Semi-axes may be off a right angle by so much of their lengths. Chosen: files of 13 digits pass.
constexpr double kRightAngle = 0x1p-40;

constexpr const char* kFinite = "an entry of a matrix must be finite";
constexpr const char* kPositive = "the smallest eigenvalue must be > 0";
constexpr const char* kInRange = "the semi-axes of the body must be within the range of doubles";

[[noreturn]] void refuse(const char* field, double value, const char* rule) {
  throw InvalidEllipsoid({field, value, rule});
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
      if (!std::isfinite(entry)) refuse(names[i][j], entry, kFinite);
      result[i][j] = to_rational(entry);
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
  if (!exact::is_positive_definite(result))
    refuse(field, exact::smallest_eigenvalue(result), kPositive);
  return result;
}

mpq_class rational_level(double level) {
  if (!std::isfinite(level) || !(level > 0.0))
    refuse("level", level, "a level must be finite and > 0");
  return to_rational(level);
}

RationalMatrix<3> scaled(RationalMatrix<3> m, const mpq_class& factor) {
  for (auto& row : m) {
    for (mpq_class& entry : row) entry *= factor;
  }
  return m;
}

Ellipsoid nearest_ellipsoid(const exact::NearestSolid<3>& s, const char* field) {
  const Vec3 axes(s.semi_axes[0], s.semi_axes[1], s.semi_axes[2]);
  if (!axes.allFinite()) refuse(field, axes.maxCoeff(), kInRange);
  if (!std::isfinite(s.relative)) refuse(field, axes.minCoeff(), kInRange);
  return Ellipsoid(
      Vec3(s.centre[0], s.centre[1], s.centre[2]), axes,
      Quaternion(s.orientation[0], s.orientation[1], s.orientation[2], s.orientation[3]));
}

std::shared_ptr<const RationalSolid<3>> shared(RationalSolid<3> solid) {
  return std::make_shared<const RationalSolid<3>>(std::move(solid));
}

RationalMatrix<3> quadric_block(const Quadric::Coefficients& c) {
  return {{{to_rational(c[0]), to_rational(c[3]), to_rational(c[5])},
           {to_rational(c[3]), to_rational(c[1]), to_rational(c[4])},
           {to_rational(c[5]), to_rational(c[4]), to_rational(c[2])}}};
}

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
  const mpq_class factor = rational_level(level);
  return {shared({rational(centre), scaled(definite(shape, kShapeNames, "m"), factor)}), "m"};
}

MatrixEllipsoid MatrixEllipsoid::from_precision(const Vec3& centre, const Mat3& precision,
                                                double level) {
  require_finite(centre);
  const mpq_class factor = rational_level(level);
  const RationalMatrix<3> given = definite(precision, kPrecisionNames, "p");
  return {shared({rational(centre), scaled(exact::inverse(given), factor)}), "p"};
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
  return {shared(std::move(solid)), "u1"};
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
  solid.shape = scaled(std::move(shape), mpq_class(-at_centre));
  return {shared(std::move(solid)), "quadric"};
}

double level_of_confidence(double confidence, int dimensions) {
  if (!(confidence > 0.0 && confidence < 1.0))
    throw std::invalid_argument("a confidence must be > 0 and < 1");
  if (dimensions != 2 && dimensions != 3)
    throw std::invalid_argument("a confidence is of 2 or 3 dimensions");
  return in_default_environment([&] {
    const long double p = confidence;
    if (dimensions == 2) return static_cast<double>(-2 * std::log1p(-p));
    // Newton's steps, within a bracket that each of them narrows.
    long double low = 0, high = 1;
    while (chi_squared_of_three(high).above > 1 - p) low = high, high *= 2;
    long double x = (low + high) / 2;
    for (int step = 0; step < 200; ++step) {
      const Tail tail = chi_squared_of_three(x);
      const long double excess = p < 0.5L ? tail.below - p : (1 - p) - tail.above;
      (excess > 0 ? high : low) = x;
      long double next = x - excess / tail.density;
      if (!(next > low && next < high)) next = (low + high) / 2;
      if (std::abs(next - x) <= 0x1p-66L * x) return static_cast<double>(next);
      x = next;
    }
    return static_cast<double>(x);
  });
}

}  // namespace tangency
