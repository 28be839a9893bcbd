// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/hunt/verdict.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <exception>
#include <limits>
#include <string_view>
#include <vector>

#include <tangency/verify/answers/claims.hpp>
#include <tangency/verify/grade/judge.hpp>
#include <tangency/verify/hunt/near_tie.hpp>

namespace tangency::inline v0::verify {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Chosen: badness counts decades from here.
constexpr double kDecades = 20;

// Decades of a share above 1e-20, 0 to 40.
double decades(double share) {
  return share > 0 ? std::clamp(std::log10(share) + kDecades, 0.0, 2 * kDecades) : 0;
}

std::string where(std::string_view said, Relation truth) {
  return std::string(said) + " where " + std::string(name(truth));
}

// The kind of a wrong yes, no or word; nothing where it is right. External touches have no yes or
// no.
std::string word_fault(const Answer& answer, Relation truth) {
  const bool touch = truth == Relation::external_touch, meet = interiors_meet(truth);
  if (answer.relation && *answer.relation != truth) return where(name(*answer.relation), truth);
  if (answer.overlaps && *answer.overlaps != meet && !(*answer.overlaps && touch)) {
    return where(*answer.overlaps ? "overlaps 1" : "overlaps 0", truth);
  }
  if (answer.relation || answer.overlaps || !answer.gap || touch) return {};
  if (*answer.gap > 0 && meet) return where("gap above 0", truth);
  if (*answer.gap < 0 && !meet) return where("gap below 0", truth);
  return {};
}

// How far an answered gap is above the true one: within `half` of `off`.
struct Off {
  double off, half;
};

// Nothing where an end of the gap is not proven.
std::optional<Off> off_by(const GapBracket& bracket) {
  if (!(bracket.most_excess - bracket.least_excess < kInfinity)) return std::nullopt;
  const long double middle =
      bracket.least_excess + (bracket.most_excess - bracket.least_excess) / 2;
  const auto off = static_cast<double>(-middle);
  const long double half = std::max(bracket.most_excess + off, -off - bracket.least_excess);
  // A unit more for the roundings here.
  return Off{off, static_cast<double>(half) * (1 + 0x1p-50)};
}

Off off_by(const PairTruth& truth, double answered) {
  return {Real(answered - truth.gap).convert_to<double>(),
          0x1p-104 * truth.size.convert_to<double>()};
}

std::array<double, 3> plain(const Real3& v) {
  return {v[0].convert_to<double>(), v[1].convert_to<double>(), v[2].convert_to<double>()};
}

// The true normals as judge_normal() takes them.
struct KnownNormals {
  TruthTable table;
  explicit KnownNormals(const PairTruth& truth) : table{CorpusKind::pairs, {}, {{}}, {}, {}, true} {
    TruthRow& row = table.rows.front();
    for (const TrueNormals& n : truth.normals) {
      row.every_normal |= n.set == TrueNormals::Set::all;
      Maximiser one{plain(n.normal), std::nullopt};
      if (n.set == TrueNormals::Set::circle) one.axis = plain(n.axis);
      table.maximisers.push_back(one);
    }
    row.normals = table.maximisers.size();
  }
  KnownNormals(const std::array<double, 3>& one)
      : table{CorpusKind::pairs, {}, {{}}, {{one, std::nullopt}}, {}, true} {
    table.rows.front().normals = 1;
  }
  NormalVerdict judged(const std::array<double, 3>& n) const {
    return judge_normal(table, table.rows.front(), n);
  }
};

// The gap's or the certificate's part of a verdict.
class GapPart {
 public:
  GapPart(const Answer& answer, const Off& off, double size)
      : answer_(answer), off_(off.off), half_(off.half), size_(size) {}

  // (least, most) that the error over L may be.
  double least() const { return std::max(0.0, std::abs(off_) - half_) / size_; }
  double most() const { return (std::abs(off_) + half_) / size_; }
  // Of the bound's breaking; a local one holds from above alone.
  bool is_broken() const {
    return breaks_bound(off_ > 0 ? std::max(0.0, off_ - half_) : std::min(0.0, off_ + half_),
                        *answer_.gap_error, answer_.is_local);
  }
  bool may_be_broken() const {
    return breaks_bound(off_ + half_, *answer_.gap_error, answer_.is_local) ||
           breaks_bound(off_ - half_, *answer_.gap_error, answer_.is_local);
  }
  // The error over the bound.
  double ratio() const {
    if (answer_.is_local && off_ < 0) return 0;
    return std::abs(off_) / std::max(*answer_.gap_error, std::numeric_limits<double>::min());
  }

 private:
  const Answer& answer_;
  double off_, half_, size_;
};

std::optional<PairTruth> full_truth(const EllipsoidPair& pair, OracleCounts& counts) {
  // Chosen: a tenth of what the corpora's truth may take. Of 8176 pairs of a hunt 21 stay open in
  // place of 11.
  constexpr std::size_t kMostBoxes = 5000;
  ++counts.gaps;
  try {
    if (auto truth = common_normal_truth(pair, kMostBoxes)) return truth;
  } catch (const std::exception&) {
    // An ascent that did not arrive: the oracle says nothing, which counts as open.
  }
  ++counts.open;
  return std::nullopt;
}

void judge_gap(const EllipsoidPair& pair, const Answer& answer, const GapBracket& bracket,
               const Limits& limits, OracleCounts& counts, Verdict& verdict) {
  if (!answer.gap) return void(verdict.fault = "no gap");
  // Nothing between the bounds can tell on which side of the limit the error is.
  const auto settled = [&](const GapPart& part) {
    return part.most() <= limits.gap_error || part.least() > limits.gap_error;
  };
  std::optional<GapPart> part;
  if (const auto off = off_by(bracket)) part.emplace(answer, *off, bracket.size);
  if (!part || !settled(*part)) {
    const auto truth = full_truth(pair, counts);
    if (!truth) return void(verdict.open = true);
    part.emplace(answer, off_by(*truth, *answer.gap), bracket.size);
  }
  verdict.error = part->most();
  if (part->least() > limits.gap_error) verdict.fault = "gap off";
  verdict.badness = decades(verdict.error);
}

void judge_certificate(const EllipsoidPair& pair, const Answer& answer, const GapBracket& bracket,
                       OracleCounts& counts, Verdict& verdict) {
  if (!answer.gap || !answer.gap_error) return void(verdict.fault = "no gap_error");
  std::optional<GapPart> part;
  // From above alone a local bound needs no upper end of the gap.
  if (answer.is_local && -bracket.least_excess <= *answer.gap_error) return;
  if (const auto off = off_by(bracket)) part.emplace(answer, *off, bracket.size);
  if (!part || (part->may_be_broken() && !part->is_broken())) {
    const auto truth = full_truth(pair, counts);
    if (!truth) return void(verdict.open = true);
    part.emplace(answer, off_by(*truth, *answer.gap), bracket.size);
  }
  verdict.error = part->ratio();
  if (part->is_broken()) verdict.fault = "bound broken";
  verdict.badness = decades(verdict.error);
}

void judge_normals(const EllipsoidPair& pair, const Answer& answer, const GapBracket& bracket,
                   const Limits& limits, OracleCounts& counts, Verdict& verdict) {
  if (!answer.normal) return void(verdict.fault = "no normal");
  double open = bracket.normal_error + 0x1p-51;
  const auto is_off = [&](const NormalVerdict& found) {
    return found.reversed || found.error - open > limits.normal_error;
  };
  NormalVerdict found{kInfinity, true};
  if (open < limits.normal_error / 2) found = KnownNormals(bracket.normal).judged(*answer.normal);
  // Without a near guess, and before a fault is said.
  if (is_off(found)) {
    const auto truth = full_truth(pair, counts);
    if (!truth) return void(verdict.open = true);
    open = 0x1p-51;
    found = KnownNormals(*truth).judged(*answer.normal);
    if (is_off(found) && is_normal_within_rounding(pair, *answer.normal, truth->gap)) {
      const auto& n = *answer.normal;
      found = {std::abs(std::hypot(n[0], n[1], n[2]) - 1), false};
    }
  }
  verdict.error = found.error;
  if (is_off(found)) verdict.fault = found.reversed ? "normal reversed" : "normal off";
  verdict.badness = decades(verdict.error);
}

}  // namespace

Nearness nearness(const GapBracket& bracket) {
  const auto gap = static_cast<double>(bracket.lower);
  const auto finite = [](double v) { return std::isfinite(v); };
  if (!std::ranges::all_of(bracket.normal, finite) || !finite(gap) || !finite(bracket.size)) {
    return {};
  }
  return {bracket.normal, gap, bracket.size};
}

bool has_feature(std::string_view feature, const EllipsoidPair& pair, const Nearness& near,
                 Relation truth) {
  const bool touches = truth == Relation::external_touch || truth == Relation::internal_touch;
  const double gap = near.gap / near.size;
  if (feature == "touching") return touches;
  if (feature == "near") return !touches && std::abs(gap) <= kNearGap;
  if (feature == "nested") return is_nested(truth);
  if (feature == "deep") return gap < -kDeepOverlap;
  assert(feature == "extreme");
  // Chosen: most users keep to one unit of length, and to bodies of some decades in it.
  constexpr double kLargest = 1e6;
  const bool is_usual = near.size <= kLargest && near.size >= 1 / kLargest;
  return !is_usual || (traits(pair, near) & (kLong | kUnequal | kFar)) != 0;
}

Verdict Judge::verdict(const EllipsoidPair& pair, const std::optional<Answer>& answer) {
  ClaimedGap claimed;
  if (answer && goal_ != Goal::relation) claimed = {answer->gap.value_or(0), answer->normal};
  const GapBracket bracket = gap_bracket(pair.a, pair.b, claimed);
  Verdict verdict;
  verdict.near = nearness(bracket);
  if (bracket.relation) {
    ++counts_.brackets;
    verdict.truth = *bracket.relation;
  } else {
    ++counts_.relations;
    verdict.truth = exact_relation(pair.a, pair.b).relation;
  }
  const auto is_left_out = [&](const std::string& feature) {
    return has_feature(feature, pair, verdict.near, verdict.truth);
  };
  if (std::ranges::any_of(not_claimed_, is_left_out)) {
    verdict.not_claimed = true;
    return verdict;
  }
  // Of a wrong word the worst is the one furthest from a touch; of right ones the nearest to it.
  const double apart = decades(std::abs(verdict.near.gap) / verdict.near.size);
  if (!answer) {
    verdict.fault = "no answer";
    return verdict;
  }
  verdict.fault = answer->unreadable ? "unreadable cell" : word_fault(*answer, verdict.truth);
  verdict.badness = verdict.fault.empty() ? 2 * kDecades - apart : apart;
  if (!verdict.fault.empty()) return verdict;
  switch (goal_) {
    case Goal::relation:
      break;
    case Goal::gap:
      judge_gap(pair, *answer, bracket, limits_, counts_, verdict);
      break;
    case Goal::normal:
      judge_normals(pair, *answer, bracket, limits_, counts_, verdict);
      break;
    case Goal::certificate:
      judge_certificate(pair, *answer, bracket, counts_, verdict);
      break;
  }
  return verdict;
}

}  // namespace tangency::inline v0::verify
