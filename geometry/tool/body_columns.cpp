// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/body_columns.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace tangency::inline v0::tool {
namespace {

using Fields = std::vector<std::string_view>;

enum class Form : std::size_t { axes, shape, precision, vectors, quadric };

const std::vector<BodyForm>& ellipsoid_forms() {
  static const Fields centre{"x", "y", "z"};
  static const std::vector<BodyForm> all{
      {"semi-axes", centre, {"r1", "r2", "r3"}, {"qw", "qx", "qy", "qz"}},
      {"a shape matrix", centre, {"m.xx", "m.yy", "m.zz", "m.xy", "m.yz", "m.zx"}, {}, true},
      {"a precision matrix", centre, {"p.xx", "p.yy", "p.zz", "p.xy", "p.yz", "p.zx"}, {}, true},
      {"axis vectors",
       centre,
       {"u1.x", "u1.y", "u1.z", "u2.x", "u2.y", "u2.z", "u3.x", "u3.y", "u3.z"},
       {}},
      {"a quadric", {}, {"A", "B", "C", "D", "E", "F", "G", "H", "J", "K"}, {}},
  };
  return all;
}
constexpr std::string_view kOneForm =
    "a body is given in one form: semi-axes r1 r2 r3, a shape matrix m.xx ..., a precision matrix "
    "p.xx ..., axis vectors u1.x ..., or a quadric A ... K";

enum class PlaneForm : std::size_t { direction, angle, shape, precision, conic };

const std::vector<BodyForm>& ellipse_forms() {
  static const Fields centre{"x", "y"}, axes{"x", "y", "r1", "r2"};
  static const std::vector<BodyForm> all{
      {"semi-axes and a direction", axes, {"ux", "uy"}, {}},
      {"semi-axes and an angle", axes, {"angle"}, {}},
      {"a shape matrix", centre, {"m.xx", "m.yy", "m.xy"}, {}, true},
      {"a precision matrix", centre, {"p.xx", "p.yy", "p.xy"}, {}, true},
      {"a conic", {}, {"A", "B", "C", "D", "E", "F"}, {}},
  };
  return all;
}
constexpr std::string_view kOnePlaneForm =
    "an ellipse is given in one form: semi-axes r1 r2 with a direction ux uy or an angle, a shape "
    "matrix m.xx ..., a precision matrix p.xx ..., or a conic A ... F";

Vec3 vector_at(const std::vector<double>& p, std::size_t first) {
  return {p[first], p[first + 1], p[first + 2]};
}

/// Of xx yy zz xy yz zx.
Mat3 symmetric_at(const std::vector<double>& p, std::size_t first) {
  return Symmetric3{p[first], p[first + 1], p[first + 2], p[first + 4], p[first + 5], p[first + 3]}
      .matrix();
}

}  // namespace

const char* const kBodyColumnsHelp = R"(
Columns of body a, in any order; others are ignored. Its centre and one of five forms:
  a.x a.y a.z      centre
  a.r1 a.r2 a.r3   semi-axes, > 0, and if it is turned
  a.qw a.qx a.qy a.qz
                   its orientation, a quaternion other than 0 of any length that turns
                   body axes into space axes; all four or none
or, of the body (x-c)' M^-1 (x-c) <= level,
  a.m.xx a.m.yy a.m.zz a.m.xy a.m.yz a.m.zx
                   M, the shape or covariance matrix, length^2
  a.p.xx a.p.yy a.p.zz a.p.xy a.p.yz a.p.zx
                   or its inverse, the precision matrix
  a.level          1 without it
  a.confidence     or, in (0, 1), the level that holds this share of a normal distribution
or vectors from the centre to the ends of the semi-axes, at right angles,
  a.u1.x a.u1.y a.u1.z a.u2.x ... a.u3.z
or, without a centre, the coefficients of
  A x^2 + B y^2 + C z^2 + 2D xy + 2E yz + 2F zx + 2G x + 2H y + 2J z + K = 0
  a.A a.B ... a.K  with --mixed-terms full those of D xy + E yz + F zx + G x + H y + J z
The relation is exact for the numbers as they are read, in every form. The other numbers
are those of the nearest body by semi-axes and quaternion; how far it is from the true
one is in gap_error.
)";

const char* const kEllipseColumnsHelp = R"(
Columns of ellipse a, in any order; others are ignored. Its centre and one of four forms:
  a.x a.y          centre
  a.r1 a.r2        semi-axes, > 0, and
  a.ux a.uy        the direction of the first, not both 0, of any length, meant exactly; or
  a.angle          in radians: short for its cosine and sine, each rounded correctly
or, of the ellipse (x-c)' M^-1 (x-c) <= level,
  a.m.xx a.m.yy a.m.xy
                   M, the shape or covariance matrix, length^2
  a.p.xx a.p.yy a.p.xy
                   or its inverse, the precision matrix
  a.level          1 without it
  a.confidence     or, in (0, 1), the level that holds this share of a normal distribution
or, without a centre, the coefficients of A x^2 + B xy + C y^2 + D x + E y + F = 0
  a.A a.B a.C a.D a.E a.F
                   with --mixed-terms half those of A x^2 + 2B xy + C y^2 + 2D x + 2E y + F,
                   entries of the matrix with the rows (A, B, D), (B, C, E), (D, E, F)
Relation and crossings are exact for the numbers as they are read, in every form. The
other numbers are those of the nearest ellipse by semi-axes and direction; how far it is
from the true one is in gap_error.
)";

MixedTerms mixed_terms_named(std::string_view name) {
  return name == "full" ? MixedTerms::full : MixedTerms::half;
}

BodyColumns::BodyColumns(const tables::Header& header, std::string_view body,
                         MixedTerms mixed_terms)
    : columns_(header, body, ellipsoid_forms(), kOneForm), mixed_terms_(mixed_terms) {}

MatrixEllipsoid BodyColumns::body_of(const tables::RowCursor& row) const {
  const std::vector<double> p = columns_.numbers(row);
  switch (static_cast<Form>(columns_.form())) {
    case Form::axes: {
      const bool turned = p.size() > 6;
      const Quaternion q = turned ? Quaternion(p[6], p[7], p[8], p[9]) : Quaternion(1, 0, 0, 0);
      return Ellipsoid(vector_at(p, 0), vector_at(p, 3), q);
    }
    case Form::shape:
      return MatrixEllipsoid::from_shape(vector_at(p, 0), symmetric_at(p, 3),
                                         columns_.level(row, 3));
    case Form::precision:
      return MatrixEllipsoid::from_precision(vector_at(p, 0), symmetric_at(p, 3),
                                             columns_.level(row, 3));
    case Form::vectors: {
      Mat3 axes;
      axes << vector_at(p, 3), vector_at(p, 6), vector_at(p, 9);
      return MatrixEllipsoid::from_axes(vector_at(p, 0), axes);
    }
    case Form::quadric:
      break;
  }
  Quadric::Coefficients c{};
  std::ranges::copy(p, c.begin());
  if (mixed_terms_ == MixedTerms::full) {
    // Twice the equation is exact, where halves of subnormal numbers would not be.
    for (const std::size_t k : {0U, 1U, 2U, 9U}) c[k] *= 2.0;
  }
  return MatrixEllipsoid::from_quadric(Quadric(c));
}

MatrixEllipsoid BodyColumns::read(const tables::RowCursor& row) const {
  const auto refused = [&](const auto& fault) {
    return columns_.refused(row, fault.field, fault.value, fault.rule);
  };
  try {
    return body_of(row);
  } catch (const InvalidEllipsoid& invalid) {
    throw refused(invalid.fault());
  } catch (const InvalidQuadric& invalid) {
    throw refused(invalid.fault());
  }
}

EllipseColumns::EllipseColumns(const tables::Header& header, std::string_view body,
                               MixedTerms mixed_terms)
    : columns_(header, body, ellipse_forms(), kOnePlaneForm), mixed_terms_(mixed_terms) {}

MatrixEllipse EllipseColumns::body_of(const tables::RowCursor& row) const {
  const std::vector<double> p = columns_.numbers(row);
  const auto centre = [&] { return Vec2(p[0], p[1]); };
  switch (static_cast<PlaneForm>(columns_.form())) {
    case PlaneForm::direction:
      return Ellipse(centre(), Vec2(p[2], p[3]), Vec2(p[4], p[5]));
    case PlaneForm::angle:
      return Ellipse::at_angle(centre(), Vec2(p[2], p[3]), p[4]);
    case PlaneForm::shape:
      return MatrixEllipse::from_shape(centre(), {p[2], p[3], p[4]}, columns_.level(row, 2));
    case PlaneForm::precision:
      return MatrixEllipse::from_precision(centre(), {p[2], p[3], p[4]}, columns_.level(row, 2));
    case PlaneForm::conic:
      break;
  }
  std::array<double, 6> c{};
  std::ranges::copy(p, c.begin());
  if (mixed_terms_ == MixedTerms::half) {
    for (const std::size_t k : {1U, 3U, 4U}) c[k] *= 2.0;
  }
  return MatrixEllipse::from_conic(c);
}

MatrixEllipse EllipseColumns::read(const tables::RowCursor& row) const {
  try {
    return body_of(row);
  } catch (const InvalidEllipse& invalid) {
    throw columns_.refused(row, invalid.fault().field, invalid.fault().value, invalid.fault().rule);
  }
}

void write_inner(Inner inner, tables::RowText& out) {
  switch (inner) {
    case Inner::none:
      out.empty();
      break;
    case Inner::a:
      out.text("a");
      break;
    case Inner::b:
      out.text("b");
      break;
  }
}

}  // namespace tangency::inline v0::tool
