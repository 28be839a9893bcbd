// SPDX-License-Identifier: MIT
/// @file
/// The kernel as a module of WebAssembly: what the playground's page asks of a pair.
///
/// A caller writes the 20 numbers of a pair to pair_numbers(), in the order of the columns of
/// `tangency contact`, and calls answer_pair(). Where that is 1 the answer stands at
/// answer_numbers(), a number a name of answer_names(). Where it is 0 refusal() says why.
///
/// Relations and states are those of `tangency contact` on the same numbers; gaps differ from its
/// own by the sum of both gap_error at most: tests/browser/playground_check.py.
///
/// Lengths in any one unit. One thread, as a page has.
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/tables/number_text.hpp>
#include <tangency/geometry/trace_contact.hpp>

namespace tangency::inline v0::web {
namespace {

constexpr std::size_t kOfBody = 10;  ///< x y z r1 r2 r3 qw qx qy qz
enum State { ok, local, not_applicable, not_converged };

/// In the order of Relation, of Inner and of State.
constexpr const char* kWords =
    "separate,external_touch,overlap,internal_touch,a_in_b,b_in_a,equal\n"
    ",a,b\n"
    "ok,local,not_applicable,not_converged";

constexpr std::size_t kOfPair = 7, kDefinitions = 4, kOfGap = 12;
constexpr const char* kNames =
    "relation,inner,curvature_min,curvature_max,F,F_error,mu\n"
    "common-normal,perram-wertheim,midpoint-potential,trace\n"
    "status,gap,gap_error,nx,ny,nz,pa.x,pa.y,pa.z,pb.x,pb.y,pb.z";

// What a page reads and writes; one at a time.
std::array<double, 2 * kOfBody> pair;
std::array<double, kOfPair + kDefinitions * kOfGap> answer;
std::string why_refused;

/// Writes the numbers of a gap; those that a double cannot hold make it not applicable, as the
/// command says. @param error  nothing for a method that proves none
template <class AnyGap>
void put(const Ellipsoid& a, const Ellipsoid& b, const AnyGap& found, State state,
         std::optional<double> error, double* to) {
  const Vec3 point_a = a.centre() + found.arm_a, point_b = b.centre() + found.arm_b;
  const bool representable = std::isfinite(found.gap) && found.normal.allFinite() &&
                             point_a.allFinite() && point_b.allFinite() &&
                             std::isfinite(error.value_or(0.0));
  const bool answered = state == ok || state == local;
  *to++ = answered && !representable ? not_applicable : state;
  if (!answered || !representable) {
    for (std::size_t i = 1; i < kOfGap; ++i) *to++ = std::nan("");
    return;
  }
  *to++ = found.gap;
  *to++ = error.value_or(std::nan(""));
  for (const Vec3* vector : {&found.normal, &point_a, &point_b})
    for (const double component : *vector) *to++ = component;
}

void put_other(const Ellipsoid& a, const Ellipsoid& b, const OtherGap& found, double* to) {
  const State state = found.status == OtherGapStatus::ok               ? ok
                      : found.status == OtherGapStatus::not_applicable ? not_applicable
                                                                       : not_converged;
  put(a, b, found, state, found.gap_error, to);
}

void put_sizes(const Ellipsoid& a, const Ellipsoid& b, const Gap& gap, double* to) {
  const PrincipalCurvatures curved = contact_curvature(a, b, gap.normal).relative;
  const PerramWertheimFactor factor = perram_wertheim_factor(a, b);
  const bool known = factor.status == OtherGapStatus::ok;
  to[0] = curved.curvature[1], to[1] = curved.curvature[0];
  to[2] = known ? factor.factor : std::nan(""), to[3] = known ? factor.factor_error : std::nan("");
  to[4] = known ? factor.scale : std::nan("");
}

void answer_of(const Ellipsoid& a, const Ellipsoid& b) {
  const RelationAnswer exact = relation(a, b);
  const Gap gap = signed_gap(a, b);
  const TraceContact traced = trace_contact(a, b);
  answer[0] = static_cast<double>(exact.relation);
  answer[1] = static_cast<double>(exact.inner);
  put_sizes(a, b, gap, answer.data() + 2);
  double* to = answer.data() + kOfPair;
  put(a, b, gap, gap.status == GapStatus::ok ? ok : local, gap.gap_error, to);
  put_other(a, b, perram_wertheim_gap(a, b), to += kOfGap);
  put_other(a, b, midpoint_potential_gap(a, b), to += kOfGap);
  put(a, b, traced, traced.status == TraceStatus::ok ? ok : not_applicable, std::nullopt,
      to += kOfGap);
}

/// The body of ten numbers; nothing where they make none, and then why_refused says so.
std::optional<Ellipsoid> body_of(const double* numbers, const char* name) {
  const Vec3 centre(numbers[0], numbers[1], numbers[2]), axes(numbers[3], numbers[4], numbers[5]);
  const Quaternion orientation(numbers[6], numbers[7], numbers[8], numbers[9]);
  const auto fault = Ellipsoid::find_fault(centre, axes, orientation);
  if (!fault) return Ellipsoid(centre, axes, orientation);
  why_refused = std::string(name) + "." + fault->field + " = " + tables::to_text(fault->value) +
                ": " + fault->rule;
  return std::nullopt;
}

}  // namespace
}  // namespace tangency::inline v0::web

using namespace tangency::web;  // NOLINT(google-build-using-namespace): this file is the border

extern "C" {

/// Where the 20 numbers of a pair are written.
[[clang::export_name("pair_numbers")]] double* pair_numbers() { return pair.data(); }

/// Where the answer stands: a number a name of answer_names(), NaN where there is none. A relation,
/// an inner body and a status are the places of their words in the lists of answer_words().
[[clang::export_name("answer_numbers")]] const double* answer_numbers() { return answer.data(); }

/// Names of the first numbers; then, after a line's end each, the definitions of a gap and the
/// names of the numbers that follow once a definition.
[[clang::export_name("answer_names")]] const char* answer_names() { return kNames; }

/// Relations, inner bodies and states, a line each.
[[clang::export_name("answer_words")]] const char* answer_words() { return kWords; }

/// Answers for the pair at pair_numbers(). @return 1; 0 where a body is none: see refusal()
[[clang::export_name("answer_pair")]] int answer_pair() {
  const auto a = body_of(pair.data(), "a");
  const auto b = a ? body_of(pair.data() + kOfBody, "b") : std::nullopt;
  if (!b) return 0;
  answer_of(*a, *b);
  return 1;
}

/// "a.r2 = -1: a semi-axis must be finite and > 0"
[[clang::export_name("refusal")]] const char* refusal() { return why_refused.c_str(); }

}  // extern "C"
