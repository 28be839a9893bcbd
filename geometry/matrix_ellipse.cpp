// SPDX-License-Identifier: MIT
#include <tangency/geometry/matrix_ellipse.hpp>

#include <cmath>
#include <utility>

#include <tangency/geometry/bodies/rational_solid.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>

namespace tangency {
namespace {

using exact::RationalMatrix;
using exact::RationalSolid;
using exact::to_rational;

constexpr const char* kFinite = "an entry of a matrix must be finite";
constexpr const char* kPositive = "the smallest eigenvalue must be > 0";
constexpr const char* kInRange = "the semi-axes of the body must be within the range of doubles";

[[noreturn]] void refuse(const char* field, double value, const char* rule) {
  throw InvalidEllipse({field, value, rule});
}

double finite(double value, const char* field, const char* rule = kFinite) {
  if (!std::isfinite(value)) refuse(field, value, rule);
  return value;
}

exact::RationalVector<2> rational_centre(const Vec2& centre) {
  if (const auto fault = Ellipse::find_fault(centre, Vec2::Ones(), Vec2::UnitX()))
    throw InvalidEllipse(*fault);
  return {to_rational(centre[0]), to_rational(centre[1])};
}

mpq_class rational_level(double level) {
  if (!std::isfinite(level) || !(level > 0.0))
    refuse("level", level, "a level must be finite and > 0");
  return to_rational(level);
}

RationalMatrix<2> symmetric(const mpq_class& xx, const mpq_class& yy, const mpq_class& xy) {
  RationalMatrix<2> m;
  m[0] = {xx, xy};
  m[1] = {xy, yy};
  return m;
}

RationalMatrix<2> scaled(RationalMatrix<2> m, const mpq_class& factor) {
  for (auto& row : m) {
    for (mpq_class& entry : row) entry *= factor;
  }
  return m;
}

void require_definite(const RationalMatrix<2>& m, const char* field, const char* rule) {
  if (!exact::is_positive_definite(m)) refuse(field, exact::smallest_eigenvalue(m), rule);
}

std::shared_ptr<const RationalSolid<2>> shared(RationalSolid<2> solid) {
  return std::make_shared<const RationalSolid<2>>(std::move(solid));
}

Ellipse nearest_ellipse(const exact::NearestSolid<2>& s, const char* field) {
  const Vec2 axes(s.semi_axes[0], s.semi_axes[1]);
  if (!axes.allFinite()) refuse(field, axes.maxCoeff(), kInRange);
  if (!std::isfinite(s.absolute)) refuse(field, axes.minCoeff(), kInRange);
  return Ellipse(Vec2(s.centre[0], s.centre[1]), axes, Vec2(s.orientation[0], s.orientation[1]));
}

}  // namespace

MatrixEllipse::MatrixEllipse(const Ellipse& ellipse) : ellipse_(ellipse) {}

MatrixEllipse::MatrixEllipse(std::shared_ptr<const RationalSolid<2>> exact, const char* field)
    : exact_(std::move(exact)), ellipse_(Vec2::Zero(), Vec2::Ones()) {
  in_default_environment([&] {
    const exact::NearestSolid<2> nearest = exact::nearest_solid(*exact_);
    ellipse_ = nearest_ellipse(nearest, field);
    rounding_ = nearest.absolute;
  });
  if (rounding_ == 0.0) exact_.reset();
}

MatrixEllipse MatrixEllipse::from_shape(const Vec2& centre, const Symmetric2& shape, double level) {
  RationalSolid<2> solid{rational_centre(centre), {}};
  const mpq_class factor = rational_level(level);
  const RationalMatrix<2> m =
      symmetric(to_rational(finite(shape.xx, "m.xx")), to_rational(finite(shape.yy, "m.yy")),
                to_rational(finite(shape.xy, "m.xy")));
  require_definite(m, "m", kPositive);
  solid.shape = scaled(m, factor);
  return {shared(std::move(solid)), "m"};
}

MatrixEllipse MatrixEllipse::from_precision(const Vec2& centre, const Symmetric2& precision,
                                            double level) {
  RationalSolid<2> solid{rational_centre(centre), {}};
  const mpq_class factor = rational_level(level);
  const RationalMatrix<2> p = symmetric(to_rational(finite(precision.xx, "p.xx")),
                                        to_rational(finite(precision.yy, "p.yy")),
                                        to_rational(finite(precision.xy, "p.xy")));
  require_definite(p, "p", kPositive);
  solid.shape = scaled(exact::inverse(p), factor);
  return {shared(std::move(solid)), "p"};
}

MatrixEllipse MatrixEllipse::from_conic(const std::array<double, 6>& coefficients) {
  static constexpr const char* kNames[] = {"A", "B", "C", "D", "E", "F"};
  constexpr const char* kReal =
      "the conic must be a real ellipse; this is the smallest eigenvalue of its block";
  std::array<mpq_class, 6> c;
  for (std::size_t k = 0; k < 6; ++k)
    c[k] = to_rational(finite(coefficients[k], kNames[k], "a coefficient must be finite"));
  if (c[0] < 0) {
    for (mpq_class& coefficient : c) coefficient = -coefficient;
  }
  const RationalMatrix<2> block = symmetric(c[0], c[2], c[1] / 2);
  require_definite(block, "conic", kReal);
  const RationalMatrix<2> inverse = exact::inverse(block);
  RationalSolid<2> solid;
  mpq_class at_centre = c[5];
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) solid.centre[i] -= inverse[i][j] * c[3 + j] / 2;
    at_centre += solid.centre[i] * c[3 + i] / 2;
  }
  if (at_centre >= 0)
    refuse("F", coefficients[5], "the conic must be a real ellipse; this one has no inside");
  solid.shape = scaled(inverse, mpq_class(-at_centre));
  return {shared(std::move(solid)), "conic"};
}

}  // namespace tangency
