// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/body_columns.hpp>

#include <algorithm>
#include <stdexcept>

#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/tool/columns.hpp>

namespace tangency::tool {
namespace {

using Fields = std::vector<std::string_view>;

/// A form's columns: those of the centre, which all forms but a quadric have, and its own.
struct FormFields {
  std::string_view name;
  Fields centre, own;
};

const std::array<FormFields, 5>& forms() {
  static const Fields centre{"x", "y", "z"};
  static const std::array<FormFields, 5> all{{
      {"semi-axes", centre, {"r1", "r2", "r3"}},
      {"a shape matrix", centre, {"m.xx", "m.yy", "m.zz", "m.xy", "m.yz", "m.zx"}},
      {"a precision matrix", centre, {"p.xx", "p.yy", "p.zz", "p.xy", "p.yz", "p.zx"}},
      {"axis vectors",
       centre,
       {"u1.x", "u1.y", "u1.z", "u2.x", "u2.y", "u2.z", "u3.x", "u3.y", "u3.z"}},
      {"a quadric", {}, {"A", "B", "C", "D", "E", "F", "G", "H", "J", "K"}},
  }};
  return all;
}

constexpr std::array<std::string_view, 4> kOrientationFields{"qw", "qx", "qy", "qz"};
constexpr std::string_view kOneForm =
    "a body is given in one form: semi-axes r1 r2 r3, a shape matrix m.xx ..., a precision matrix "
    "p.xx ..., axis vectors u1.x ..., or a quadric A ... K";

Vec3 vector_at(const std::vector<double>& p, std::size_t first) {
  return {p[first], p[first + 1], p[first + 2]};
}

/// Of xx yy zz xy yz zx.
Mat3 symmetric_at(const std::vector<double>& p, std::size_t first) {
  return Symmetric3{p[first],     p[first + 1], p[first + 2],
                    p[first + 4], p[first + 5], p[first + 3]}
      .matrix();
}

}  // namespace

const char* const kBodyColumnsHelp = R"(
Columns of body a, in any order; others are ignored. Its centre and one of five forms:
  a.x a.y a.z      centre
  a.r1 a.r2 a.r3   semi-axes, > 0, and if it is turned
  a.qw a.qx a.qy a.qz
                   its orientation, a quaternion other than 0 of any length that turns
                   body axes into space axes; all four or none (no rotation)
or, with M the shape or covariance matrix of (x-c)' M^-1 (x-c) <= level,
  a.m.xx a.m.yy a.m.zz a.m.xy a.m.yz a.m.zx    M, length^2
  a.p.xx a.p.yy a.p.zz a.p.xy a.p.yz a.p.zx    its inverse, the precision matrix
  a.level          1 without it; or instead
  a.confidence     in (0, 1): the level that holds this share of a normal distribution
or three vectors from the centre to the ends of the semi-axes, at right angles:
  a.u1.x a.u1.y a.u1.z a.u2.x ... a.u3.z
or, without a centre, the coefficients of
  A x^2 + B y^2 + C z^2 + 2D xy + 2E yz + 2F zx + 2G x + 2H y + 2J z + K = 0:
  a.A a.B ... a.K  with --mixed-terms full those written without the factor 2
The relation is exact for the numbers as they are read, in every form; the other numbers
are those of the nearest body by semi-axes and quaternion, whose distance from the true
one is in their errors.
)";

MixedTerms mixed_terms_named(std::string_view name) {
  return name == "full" ? MixedTerms::full : MixedTerms::half;
}

BodyColumns::BodyColumns(const tables::Header& header, std::string_view body,
                         MixedTerms mixed_terms)
    : file_(header.file()),
      who_(body.empty() ? std::string("the body") : "body " + std::string(body)),
      prefix_(body.empty() ? std::string() : std::string(body) + '.'),
      mixed_terms_(mixed_terms) {
  std::vector<std::string> present;  // the first column of each form that has any
  for (const FormFields& form : forms()) {
    for (const std::string_view field : form.own) {
      const std::string name = prefix_ + std::string(field);
      if (!header.find(name)) continue;
      if (present.empty()) form_ = static_cast<Form>(&form - forms().data());
      present.push_back(name);
      break;
    }
  }
  if (present.size() > 1)
    throw tables::Error({.file = file_,
                         .line = header.line(),
                         .value = who_ + " with " + present[0] + " and " + present[1],
                         .rule = std::string(kOneForm)});
  const FormFields& form = forms()[static_cast<std::size_t>(form_)];
  fields_ = form.centre;
  fields_.insert(fields_.end(), form.own.begin(), form.own.end());
  std::vector<std::string> missing;
  for (const std::string_view field : fields_) {
    const auto found = find_columns(header, prefix_, std::array{field}, missing);
    columns_.push_back(found[0]);
  }
  if (!missing.empty()) {
    std::string rule = "a body given by " + std::string(form.name) + " has the columns ";
    for (const std::string_view field : fields_)
      rule += (&field == &fields_.front() ? "" : ", ") + std::string(field);
    throw lacking(header, who_, missing,
                  present.empty() ? "a body has the columns x, y, z, r1, r2 and r3, or another "
                                    "form's: --help lists them"
                                  : rule);
  }
  if (form_ == Form::axes) {
    const auto orientation = find_columns(header, prefix_, kOrientationFields, missing);
    if (missing.empty()) {
      fields_.insert(fields_.end(), kOrientationFields.begin(), kOrientationFields.end());
      columns_.insert(columns_.end(), orientation.begin(), orientation.end());
    } else if (missing.size() < kOrientationFields.size()) {
      throw lacking(header, who_, missing,
                    "the orientation columns qw, qx, qy and qz come all four or not at all");
    }
  }
  find_level(header);
}

void BodyColumns::find_level(const tables::Header& header) {
  level_ = header.find(prefix_ + "level");
  confidence_ = header.find(prefix_ + "confidence");
  const bool has_matrix = form_ == Form::shape || form_ == Form::precision;
  const auto refuse = [&](tables::Column column, std::string_view rule) {
    throw tables::Error({.file = file_,
                         .line = header.line(),
                         .value = who_ + " with " + header.name(column),
                         .rule = std::string(rule)});
  };
  if (!has_matrix && (level_ || confidence_))
    refuse(level_ ? *level_ : *confidence_, "a level goes with a shape or precision matrix");
  if (level_ && confidence_) refuse(*confidence_, "a body has a level or a confidence, not both");
}

std::vector<double> BodyColumns::numbers(const tables::RowCursor& row) const {
  std::vector<double> result(columns_.size());
  std::ranges::transform(columns_, result.begin(),
                         [&](tables::Column column) { return row.number(column); });
  return result;
}

double BodyColumns::level(const tables::RowCursor& row) const {
  if (level_) return row.number(*level_);
  if (!confidence_) return 1.0;
  try {
    return level_of_confidence(row.number(*confidence_), 3);
  } catch (const std::invalid_argument& refused) {
    throw row.error(*confidence_, refused.what());
  }
}

MatrixEllipsoid BodyColumns::body_of(const std::vector<double>& p,
                                     const tables::RowCursor& row) const {
  switch (form_) {
    case Form::axes: {
      const bool turned = p.size() > 6;
      const Quaternion q = turned ? Quaternion(p[6], p[7], p[8], p[9]) : Quaternion(1, 0, 0, 0);
      return Ellipsoid(vector_at(p, 0), vector_at(p, 3), q);
    }
    case Form::shape:
      return MatrixEllipsoid::from_shape(vector_at(p, 0), symmetric_at(p, 3), level(row));
    case Form::precision:
      return MatrixEllipsoid::from_precision(vector_at(p, 0), symmetric_at(p, 3), level(row));
    case Form::vectors: {
      Mat3 axes;
      for (int k = 0; k < 3; ++k)
        axes.col(k) = vector_at(p, 3 + 3 * static_cast<std::size_t>(k));
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
  const std::vector<double> p = numbers(row);
  try {
    return body_of(p, row);
  } catch (const InvalidEllipsoid& invalid) {
    throw refused(row, invalid.fault());
  } catch (const InvalidQuadric& invalid) {
    throw refused(row, {invalid.fault().field, invalid.fault().value, invalid.fault().rule});
  }
}

std::optional<tables::Column> BodyColumns::column_of(std::string_view field) const {
  if (field == "level") return level_ ? level_ : confidence_;
  const auto place = std::ranges::find(fields_, field);
  if (place == fields_.end()) return std::nullopt;
  return columns_[static_cast<std::size_t>(place - fields_.begin())];
}

tables::Error BodyColumns::refused(const tables::RowCursor& row, const EllipsoidFault& fault) const {
  if (const auto column = column_of(fault.field)) return row.error(*column, fault.rule);
  return tables::Error({.file = file_,
                        .line = row.line(),
                        .column = prefix_ + fault.field,
                        .value = tables::to_text(fault.value),
                        .rule = fault.rule});
}

}  // namespace tangency::tool
