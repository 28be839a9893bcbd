// SPDX-License-Identifier: MIT
#include <tangency/geometry/matrix_ellipse.hpp>

#include <cmath>
#include <utility>

#include <tangency/geometry/bodies/given_matrix.hpp>
#include <tangency/geometry/bodies/rational_solid.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>

namespace tangency::inline v0 {
namespace {

using exact::RationalMatrix;
using exact::RationalSolid;
using exact::to_rational;

mpq_class entry(double value, const char* field) {
  return exact::rational_entry<InvalidEllipse>(value, field);
}

exact::RationalVector<2> rational_centre(const Vec2& centre) {
  if (const auto fault = Ellipse::find_fault(centre, Vec2::Ones(), Vec2::UnitX()))
    throw InvalidEllipse(*fault);
  return {to_rational(centre[0]), to_rational(centre[1])};
}

RationalMatrix<2> symmetric(const mpq_class& xx, const mpq_class& yy, const mpq_class& xy) {
  RationalMatrix<2> m;
  m[0] = {xx, xy};
  m[1] = {xy, yy};
  return m;
}

Ellipse nearest_ellipse(const exact::NearestSolid<2>& s, const char* field) {
  exact::require_in_range<InvalidEllipse>(s, s.absolute, field);
  return Ellipse(Vec2(s.centre[0], s.centre[1]), Vec2(s.semi_axes[0], s.semi_axes[1]),
                 Vec2(s.orientation[0], s.orientation[1]));
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
  const mpq_class factor = exact::rational_level<InvalidEllipse>(level);
  const RationalMatrix<2> m =
      symmetric(entry(shape.xx, "m.xx"), entry(shape.yy, "m.yy"), entry(shape.xy, "m.xy"));
  exact::require_definite<InvalidEllipse>(m, "m");
  solid.shape = exact::scaled(m, factor);
  return {exact::shared(std::move(solid)), "m"};
}

MatrixEllipse MatrixEllipse::from_precision(const Vec2& centre, const Symmetric2& precision,
                                            double level) {
  RationalSolid<2> solid{rational_centre(centre), {}};
  const mpq_class factor = exact::rational_level<InvalidEllipse>(level);
  const RationalMatrix<2> p = symmetric(entry(precision.xx, "p.xx"), entry(precision.yy, "p.yy"),
                                        entry(precision.xy, "p.xy"));
  exact::require_definite<InvalidEllipse>(p, "p");
  solid.shape = exact::scaled(exact::inverse(p), factor);
  return {exact::shared(std::move(solid)), "p"};
}

MatrixEllipse MatrixEllipse::from_conic(const std::array<double, 6>& coefficients) {
  static constexpr const char* kNames[] = {"A", "B", "C", "D", "E", "F"};
  constexpr const char* kReal =
      "the conic must be a real ellipse; this is the smallest eigenvalue of its block";
  std::array<mpq_class, 6> c;
  for (std::size_t k = 0; k < 6; ++k)
    c[k] = exact::rational_entry<InvalidEllipse>(coefficients[k], kNames[k],
                                                 "a coefficient must be finite");
  if (c[0] < 0) {
    for (mpq_class& coefficient : c) coefficient = -coefficient;
  }
  const RationalMatrix<2> block = symmetric(c[0], c[2], c[1] / 2);
  exact::require_definite<InvalidEllipse>(block, "conic", kReal);
  const RationalMatrix<2> inverse = exact::inverse(block);
  RationalSolid<2> solid;
  mpq_class at_centre = c[5];
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) solid.centre[i] -= inverse[i][j] * c[3 + j] / 2;
    at_centre += solid.centre[i] * c[3 + i] / 2;
  }
  if (at_centre >= 0)
    exact::refuse<InvalidEllipse>("F", coefficients[5],
                                  "the conic must be a real ellipse; this one has no inside");
  solid.shape = exact::scaled(inverse, mpq_class(-at_centre));
  return {exact::shared(std::move(solid)), "conic"};
}

}  // namespace tangency::inline v0
