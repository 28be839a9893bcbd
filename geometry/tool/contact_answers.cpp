// SPDX-License-Identifier: MIT
#include <tangency/geometry/tool/contact_answers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/trace_contact.hpp>

namespace tangency::inline v0::tool {
namespace {

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

}  // namespace

std::vector<std::string> contact_methods() {
  std::vector<std::string> names;
  for (const Method& method : kMethods) names.emplace_back(method.name);
  return names;
}

tables::BindRows bind_contact(std::string_view name, MixedTerms mixed_terms,
                              const ContactColumns& further) {
  const Method& method = *std::ranges::find(kMethods, name, &Method::name);
  return [=](const tables::Header& header) -> tables::MakeRows {
    const BodyColumns a(header, "a", mixed_terms), b(header, "b", mixed_terms);
    if (method.answer == by_common_normal && a.has_axes() && b.has_axes())
      return [a, b, further] { return std::make_unique<CommonNormalRows>(a, b, further); };
    return one_by_one(method.answer, mixed_terms, further)(header);
  };
}

}  // namespace tangency::inline v0::tool
