// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/tool/body_columns.hpp>
#include <tangency/geometry/tool/command_line.hpp>
#include <tangency/geometry/tool/contact_columns.hpp>
#include <tangency/geometry/trace_contact.hpp>

namespace tangency::inline v0::tool {
namespace {

using ContactColumns = FurtherColumns<ContactRow>;

constexpr std::array<std::string_view, 15> kOutputColumns{
    "row",  "relation", "gap",  "nx",   "ny",        "nz",     "pa.x", "pa.y",
    "pa.z", "pb.x",     "pb.y", "pb.z", "gap_error", "status", "inner"};

constexpr const char* kHelp = R"(
The same columns with b. are those of body b. Lengths are in any one unit. Numbers are
decimal or hex floats (0x1.8p+3). Lines that begin with # and blank lines are skipped.

Output columns, in this order:
  row              number of the data row, from 0
  relation         separate, external_touch, overlap, internal_touch, a_in_b, b_in_a or
                   equal, as point sets: exact for the numbers as they are read
  gap              > 0: the distance; < 0: minus the penetration depth, the length of the
                   shortest translation that separates the bodies; or by another method
  nx ny nz         unit normal, from a to b
  pa.x pa.y pa.z   witness point on a
  pb.x pb.y pb.z   witness point on b; pb - pa = gap n
  gap_error        proven: the true gap is this near to gap; on a local row it bounds the
                   distance to the local value, and the true gap is at least
                   gap - gap_error. Of perram-wertheim and midpoint-potential it bounds the
                   distance to the gap by that definition, and is empty where a body is given
                   by a matrix; empty for trace
  status           see below
  inner            a or b, the body inside, for internal_touch; else empty
and those that --columns names, in the order of the names; empty where a row has none:
)";

constexpr const char* kStatusHelp = R"(
  Numbers read back to the same double. Their last digits may depend on the processor,
  within gap_error, but never on the number of threads.

Status of a row:
  ok               the global answer
  local            a stationary answer; that no shorter penetration exists elsewhere is
                   not proven
  not_applicable   the method has no answer, or some number is beyond the range of a
                   double; numbers are empty
  not_converged    no answer was found; numbers are empty
  invalid          the row was refused (only with --keep-going); numbers are empty

Methods, definitions of gap, normal and points; the relation is the same for all:
  common-normal    the gap as defined above
  perram-wertheim  at the best s of s (1-s) d'((1-s) Ma + s Mb)^-1 d, d from centre to
                   centre, M the shape matrices: n along ((1-s) Ma + s Mb)^-1 d, gap the
                   distance between the tangent planes with this normal, pa and pb where
                   they touch; pb - pa is in general not along n. Not applicable to
                   coinciding centres
  midpoint-potential
                   with the same n, along the line through the point where both level
                   functions agree, from the last point in a to the first in b. Not
                   applicable to coinciding centres and where the line misses a body
  trace            the published scheme of curves on a, an approximation that depends on
                   which body is a: n across four corners of the region of a in b, gap
                   minus the depth along n through their centroid. Applicable only where
                   relation is overlap, and not where the scheme finds no region

Exit status: 0 every row is ok or local; 1 some row is not; 2 refused command line or
input, or a failed read or write. A refusal is one line on standard error:
  pairs.csv:17: a.r2 = -1: a semi-axis must be finite and > 0
Rows before a refused row may have reached standard output, none for it or after it;
a file named by --out is left as it was.

Example, a unit sphere and an ellipsoid that it touches:
  $ cat pairs.csv
  a.x,a.y,a.z,a.r1,a.r2,a.r3,b.x,b.y,b.z,b.r1,b.r2,b.r3
  0,0,0,1,1,1,3,0,0,2,1,1
  $ tangency contact pairs.csv
  row,relation,gap,nx,ny,nz,pa.x,pa.y,pa.z,pb.x,pb.y,pb.z,gap_error,status,inner
  0,external_touch,0,1,0,0,1,0,0,1,0,0,0,ok,
  $ tangency contact --columns mu,curvature_min,curvature_max pairs.csv
  row,relation,gap,nx,ny,nz,pa.x,pa.y,pa.z,pb.x,pb.y,pb.z,gap_error,status,inner,mu,curvature_min,curvature_max
  0,external_touch,0,1,0,0,1,0,0,1,0,0,0,ok,,1,3,3
)";

/// What is known about a pair: one row of the output.
struct Answer {
  RelationAnswer relation;
  std::string_view status;
  bool has_numbers;
  double gap;
  Vec3 normal;
  Vec3 point_a;
  Vec3 point_b;
  std::optional<double> gap_error;
  std::optional<Gap> common_normal;  ///< where it is by that method
};

/// The answer that says nothing but why it is empty.
Answer without_numbers(const RelationAnswer& relation, std::string_view status) {
  const Vec3 none = Vec3::Zero();
  return {relation, status, false, 0, none, none, none, std::nullopt, std::nullopt};
}

/// The answer with the numbers of a Gap or OtherGap, unless one is beyond the range of a double.
template <class AnyGap>
Answer with_numbers(const MatrixEllipsoid& a, const MatrixEllipsoid& b, const AnyGap& found,
                    std::string_view status, std::optional<double> gap_error) {
  const RelationAnswer exact = relation(a, b);
  const Vec3 point_a = a.ellipsoid().centre() + found.arm_a;
  const Vec3 point_b = b.ellipsoid().centre() + found.arm_b;
  const bool representable = std::isfinite(found.gap) && found.normal.allFinite() &&
                             point_a.allFinite() && point_b.allFinite() &&
                             std::isfinite(gap_error.value_or(0.0));
  if (!representable) return without_numbers(exact, "not_applicable");
  Answer answer{exact,   status,  true,      found.gap,   found.normal,
                point_a, point_b, gap_error, std::nullopt};
  if constexpr (std::is_same_v<AnyGap, Gap>) answer.common_normal = found;
  return answer;
}

template <OtherGap (*find)(const Ellipsoid&, const Ellipsoid&) noexcept>
Answer by_other_definition(const MatrixEllipsoid& a, const MatrixEllipsoid& b) {
  const OtherGap found = find(a.ellipsoid(), b.ellipsoid());
  switch (found.status) {
    case OtherGapStatus::ok: {
      // What the rounding of a matrix to semi-axes does to these gaps is not bounded.
      const bool by_axes = a.exact() == nullptr && b.exact() == nullptr;
      const auto error = by_axes ? std::optional(found.gap_error) : std::nullopt;
      return with_numbers(a, b, found, "ok", error);
    }
    case OtherGapStatus::not_applicable:
      return without_numbers(relation(a, b), "not_applicable");
    case OtherGapStatus::not_converged:
      break;
  }
  return without_numbers(relation(a, b), "not_converged");
}

Answer by_trace(const MatrixEllipsoid& a, const MatrixEllipsoid& b) {
  const TraceContact found = trace_contact(a.ellipsoid(), b.ellipsoid());
  if (found.status != TraceStatus::ok) return without_numbers(relation(a, b), "not_applicable");
  return with_numbers(a, b, found, "ok", std::nullopt);
}

tables::RowOutcome write_answer(const Answer& answer, const MatrixEllipsoid& a,
                                const MatrixEllipsoid& b, const ContactColumns& further,
                                tables::RowText& out) {
  out.text(to_string(answer.relation.relation));
  if (answer.has_numbers) {
    out.number(answer.gap);
    for (const Vec3* vector : {&answer.normal, &answer.point_a, &answer.point_b}) {
      for (const double component : *vector) out.number(component);
    }
    if (answer.gap_error) {
      out.number(*answer.gap_error);
    } else {
      out.empty();
    }
  } else {
    out.empty(11);
  }
  out.text(answer.status);
  write_inner(answer.relation.inner, out);
  if (!further.empty()) {
    const ContactRow row{.a = a,
                         .b = b,
                         .relation = answer.relation,
                         .normal = answer.has_numbers ? &answer.normal : nullptr,
                         .gap = answer.common_normal ? &*answer.common_normal : nullptr};
    further.write(row, out);
  }
  return answer.has_numbers ? tables::RowOutcome::answered : tables::RowOutcome::unanswered;
}

std::string_view status_of(const Gap& gap) { return gap.status == GapStatus::ok ? "ok" : "local"; }

Answer by_common_normal(const MatrixEllipsoid& a, const MatrixEllipsoid& b) {
  const Gap gap = signed_gap(a, b);
  return with_numbers(a, b, gap, status_of(gap), gap.gap_error);
}

/// The same of bodies by their axes, for all rows that are read in one call.
class CommonNormalRows : public tables::Rows {
 public:
  CommonNormalRows(const BodyColumns& a, const BodyColumns& b, const ContactColumns& further)
      : columns_a_(a), columns_b_(b), further_(further) {}

  void read(const tables::RowCursor& row) override {
    const MatrixEllipsoid a = columns_a_.read(row), b = columns_b_.read(row);
    a_.push_back(a.ellipsoid()), b_.push_back(b.ellipsoid());
  }
  void answer() override {
    gaps_.resize(a_.size());
    signed_gaps(a_, b_, gaps_, Accuracy::certified());
  }
  tables::RowOutcome write(std::size_t i, tables::RowText& out) const override {
    const Gap& gap = gaps_[i];
    const MatrixEllipsoid a = a_[i], b = b_[i];
    const Answer answer = with_numbers(a, b, gap, status_of(gap), gap.gap_error);
    return write_answer(answer, a, b, further_, out);
  }
  void clear() override { a_.clear(), b_.clear(); }

 private:
  BodyColumns columns_a_, columns_b_;
  ContactColumns further_;
  std::vector<Ellipsoid> a_, b_;
  std::vector<Gap> gaps_;
};

using OneAnswer = Answer (*)(const MatrixEllipsoid&, const MatrixEllipsoid&);

struct Method {
  std::string_view name;
  OneAnswer answer;
};

constexpr std::array<Method, 4> kMethods{
    {{"common-normal", by_common_normal},
     {"perram-wertheim", by_other_definition<perram_wertheim_gap>},
     {"midpoint-potential", by_other_definition<midpoint_potential_gap>},
     {"trace", by_trace}}};

tables::BindRows one_by_one(OneAnswer answer, MixedTerms mixed_terms,
                            const ContactColumns& further) {
  return tables::row_by_row([=](const tables::Header& header) -> tables::RowFunction {
    return [answer, further, columns_a = BodyColumns(header, "a", mixed_terms),
            columns_b = BodyColumns(header, "b", mixed_terms)](const tables::RowCursor& row,
                                                               tables::RowText& out) {
      const MatrixEllipsoid a = columns_a.read(row), b = columns_b.read(row);
      return write_answer(answer(a, b), a, b, further, out);
    };
  });
}

/// @param name  one of method_names()
tables::BindRows bind_method(std::string_view name, MixedTerms mixed_terms,
                             const ContactColumns& further) {
  const Method& method = *std::ranges::find(kMethods, name, &Method::name);
  return [=](const tables::Header& header) -> tables::MakeRows {
    const BodyColumns a(header, "a", mixed_terms), b(header, "b", mixed_terms);
    if (method.answer == by_common_normal && a.has_axes() && b.has_axes())
      return [a, b, further] { return std::make_unique<CommonNormalRows>(a, b, further); };
    return one_by_one(method.answer, mixed_terms, further)(header);
  };
}

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method& method : kMethods) names.emplace_back(method.name);
  return names;
}

}  // namespace

void add_contact(tables::Program& program) {
  struct Options : QuadricOptions {
    std::string method{kMethods.front().name};
    std::string columns;
  };
  const auto describe = [](tables::Command& command, Options& own) {
    command.option("--method", own.method, "How contact is defined (default: common-normal)")
        .one_of(method_names());
    add_columns_option(command, own.columns, contact_column_groups());
  };
  const auto task = [](const Options& options) {
    const ContactColumns further(contact_column_groups(), options.columns);
    tables::RowTask rows{
        .output_columns = {kOutputColumns.begin(), kOutputColumns.end()},
        .verdict_column = "status",
        .bind = bind_method(options.method, mixed_terms_named(options.mixed_terms), further)};
    further.append_names(rows.output_columns);
    return rows;
  };
  add_row_command<Options>(
      program, {.name = "contact",
                .description = "Signed gap, normal and witness points of pairs of ellipsoids",
                .help = std::string(kBodyColumnsHelp) + kHelp +
                        further_columns_help(contact_column_groups()) + kStatusHelp,
                .describe = describe,
                .task = task});
}

}  // namespace tangency::inline v0::tool
