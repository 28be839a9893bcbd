// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/speed_accuracy/methods.hpp>

#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>

#include <tangency/geometry/batch/gap_lanes.hpp>
#include <tangency/geometry/normals/perram_wertheim.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/trace_contact.hpp>

namespace tangency::speed_accuracy {
namespace {

using bench::Columns;
using detail::LaneBlock;
using verify::CallAnswer;

constexpr std::size_t kBlock = LaneBlock::kPairs;

// What calls answer, as an Answer. Another method that answers one pair at a time needs a function
// here, unless its answer is one of these, and a line in add_singles().

using bench::to_answer;

/// A gap without a bound.
Answer estimate(double gap, const Vec3& normal, const Vec3& arm_a, const Vec3& arm_b) {
  CallAnswer answer = to_answer(Gap{gap, normal, arm_a, arm_b, 0, GapStatus::ok, {}});
  answer.gap_error.reset();
  return answer;
}

Answer to_answer(const OtherGap& gap) {
  if (gap.status != OtherGapStatus::ok) return {};
  return estimate(gap.gap, gap.normal, gap.arm_a, gap.arm_b);
}

/// `ok` or no answer: the scheme has nothing to say of pairs that do not overlap.
Answer to_answer(const TraceContact& contact) {
  if (contact.status != TraceStatus::ok) return {};
  return estimate(contact.gap, contact.normal, contact.arm_a, contact.arm_b);
}

Answer to_answer(const OverlapAnswer& answer) { return CallAnswer{.overlaps = answer.overlaps}; }

Answer to_answer(const Answer& answer) { return answer; }

/// The gap at the Perram-Wertheim normal after some steps: where the searches start, and never
/// above the signed gap. No answer for bodies that its polynomials do not fit.
Answer start_alone(const Ellipsoid& a, const Ellipsoid& b, int steps) {
  if (!a.moderate() || !b.moderate()) return {};
  const Vec3 d = b.centre() - a.centre();
  const detail::PerramWertheimForm form(a, b, d);
  const Vec3 n = form.normal_direction(form.maximise(steps)).stableNormalized();
  const Vec3 arm_a = a.support_point(n), arm_b = -b.support_point(n);
  return estimate(n.dot(d - arm_a + arm_b), n, arm_a, arm_b);
}

/// Adds call(i) for every pair.
template <class Call>
Method& add_single(std::vector<Method>& all, const Pairs& pairs, const char* name,
                   const char* option, const Call& call) {
  using Result = std::invoke_result_t<Call, std::size_t>;
  const auto results = std::make_shared<std::vector<Result>>(pairs.size());
  Method method{name, option, {}, 0, {}, false, {}, {}};
  method.run = [call, results] {
    for (std::size_t i = 0; i < results->size(); ++i) (*results)[i] = call(i);
  };
  method.answers = [results] {
    std::vector<Answer> answers;
    for (const Result& result : *results) answers.push_back(to_answer(result));
    return answers;
  };
  all.push_back(std::move(method));
  return all.back();
}

void add_singles(std::vector<Method>& all, const Pairs& pairs) {
  const Pairs& p = pairs;
  add_single(all, p, "signed_gap", "", [&p](std::size_t i) {
    return signed_gap(p.a(i), p.b(i));
  }).promises = true;
  add_single(all, p, "follow_gap", "", [&p](std::size_t i) {
    return follow_gap(p.a(i), p.b(i), p.b(i).centre(), p.previous_normal[i]);
  }).promises = true;
  add_single(all, p, "overlaps", "", [&p](std::size_t i) {
    return overlap_answer(p.a(i), p.b(i));
  }).promises = true;
  add_single(all, p, "perram_wertheim_gap", "", [&p](std::size_t i) {
    return perram_wertheim_gap(p.a(i), p.b(i));
  }).definition = Definition::perram_wertheim;
  add_single(all, p, "midpoint_potential_gap", "", [&p](std::size_t i) {
    return midpoint_potential_gap(p.a(i), p.b(i));
  }).definition = Definition::midpoint_potential;
  add_single(all, p, "trace_contact", "", [&p](std::size_t i) {
    return trace_contact(p.a(i), p.b(i));
  }).definition = Definition::trace;
  for (int steps = 1; steps <= 6; ++steps) {
    add_single(all, p, "start alone", "", [&p, steps](std::size_t i) {
      return start_alone(p.a(i), p.b(i), steps);
    }).steps = steps;
  }
}

struct NamedAccuracy {
  const char* name;
  Accuracy accuracy;
};

/// The tolerances in lengths are parts of the smallest semi-axis of the family.
std::vector<NamedAccuracy> accuracies(double least) {
  return {{"fast", Accuracy::fast()},
          {"standard", Accuracy::standard()},
          {"certified", Accuracy::certified()},
          {"within 1e-3", Accuracy::within(1e-3 * least)},
          {"within 1e-6", Accuracy::within(1e-6 * least)},
          {"within 1e-9", Accuracy::within(1e-9 * least)}};
}

/// The lanes of a batch over all pairs of a family, block by block.
struct Lanes {
  explicit Lanes(const Pairs& of_pairs)
      : pairs(&of_pairs),
        columns(of_pairs.size()),
        list(of_pairs.list),
        normals(of_pairs.previous_normal) {
    list.resize(columns.gap.size(), list.front());
    normals.resize(columns.gap.size(), normals.front());
    settled.resize(columns.gap.size() / kBlock);
  }

  /// @param aim  what is asked of a block
  template <class Aim>
  void run(bool following, bool arms, const Aim& aim) {
    Columns& c = columns;
    for (std::size_t first = 0; first < pairs->size(); first += kBlock) {
      LaneBlock block{};
      block.bodies_a = block.bodies_b = pairs->array->lanes();
      block.pairs = &list[first];
      block.count = static_cast<int>(std::min(kBlock, pairs->size() - first));
      block.normals = following ? normals[first].data() : nullptr;
      block.centres_are_exact = true;
      aim(block);
      block.gap = &c.gap[first];
      block.gap_error = &c.gap_error[first];
      block.normal = c.normal[first].data();
      if (arms) block.arm_a = c.arm_a[first].data(), block.arm_b = c.arm_b[first].data();
      settled[first / kBlock] = detail::gap_lanes(block);
    }
  }
  bool settles(std::size_t i) const { return (settled[i / kBlock] >> i % kBlock & 1) != 0; }

  const Pairs* pairs;
  Columns columns;
  std::vector<IndexedPair> list;
  std::vector<Vec3> normals;
  std::vector<std::uint64_t> settled;  ///< bits by block
};

/// Pairs that a batch call's last lanes leave open.
std::vector<std::size_t> left_by_lanes(const Pairs& pairs, const Accuracy& accuracy,
                                       bool following) {
  Lanes lanes(pairs);
  lanes.run(following, false, [&](LaneBlock& block) {
    block.tolerance_of_size = accuracy.of_size;
    block.tolerance = accuracy.length;
    block.polish = accuracy.normals;
    block.centres_are_exact = !following;  // as of a batch call
  });
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (!lanes.settles(i)) left.push_back(i);
  return left;
}

void add_batch(std::vector<Method>& all, const Pairs& pairs, const NamedAccuracy& named,
               bool following, std::int64_t level) {
  const Pairs& p = pairs;
  const std::size_t count = p.size();
  const auto columns = std::make_shared<Columns>(count);
  const auto call = [&p, following, accuracy = named.accuracy](const GapColumns& to) {
    if (following)
      follow_gaps(*p.array, {p.list, {}}, p.previous_normal, to, accuracy);
    else
      signed_gaps(*p.array, {p.list, {}}, to, accuracy);
  };
  Method method{following ? "follow_gaps" : "signed_gaps", named.name, {}, level, {}, true, {}, {}};
  method.run = [columns, call, count] { call(columns->usual(count)); };
  method.answers = [columns, call, count] {
    call(columns->arms(count));  // of the same answers: they depend on the pair alone
    std::vector<Answer> answers;
    for (std::size_t i = 0; i < count; ++i) answers.push_back(columns->answer(i));
    return answers;
  };
  method.left = [&p, following, accuracy = named.accuracy] {
    return left_by_lanes(p, accuracy, following);
  };
  all.push_back(std::move(method));
}

/// Answers by float columns.
struct FloatColumns {
  explicit FloatColumns(std::size_t pairs)
      : gap(pairs), gap_error(pairs), normal(pairs), arm_a(pairs), arm_b(pairs), status(pairs) {}
  /// What is timed of double columns too.
  FloatGapColumns usual() { return {gap, gap_error, normal, {}, {}, status}; }
  /// Where the gap is beyond the range of floats: none.
  Answer answer(std::size_t i) const {
    if (!std::isfinite(gap[i])) return {};
    return to_answer(Gap{gap[i], normal[i].cast<double>(), arm_a[i].cast<double>(),
                         arm_b[i].cast<double>(), gap_error[i], status[i], GapTier::fast});
  }

  std::vector<float> gap, gap_error;
  std::vector<Vec3f> normal, arm_a, arm_b;
  std::vector<GapStatus> status;
};

/// Batch calls by float columns, `standard`.
void add_float_batch(std::vector<Method>& all, const Pairs& pairs, bool following,
                     std::int64_t level) {
  const Pairs& p = pairs;
  const auto columns = std::make_shared<FloatColumns>(p.size());
  const auto previous = std::make_shared<std::vector<Vec3f>>();
  for (const Vec3& normal : p.previous_normal) previous->push_back(normal.cast<float>());
  const auto call = [&p, following, previous](const FloatGapColumns& to) {
    if (following)
      follow_gaps(*p.array, {p.list, {}}, *previous, to);
    else
      signed_gaps(*p.array, {p.list, {}}, to);
  };
  Method method{following ? "follow_gaps" : "signed_gaps", "float", {}, level, {}, true, {}, {}};
  method.run = [columns, call] { call(columns->usual()); };
  method.answers = [columns, call] {
    call({.arm_a = columns->arm_a, .arm_b = columns->arm_b});
    std::vector<Answer> answers;
    for (std::size_t i = 0; i < columns->gap.size(); ++i) answers.push_back(columns->answer(i));
    return answers;
  };
  method.left = [&p, following] { return left_by_lanes(p, Accuracy::standard(), following); };
  all.push_back(std::move(method));
}

/// What gap_lanes() settles after so many steps of Newton's method, then more where the sign or
/// that the answer is global is not proven by then: however wide the error. Pairs that the lanes
/// leave to the single call have no answer.
void add_lanes(std::vector<Method>& all, const Pairs& pairs, int steps, bool following,
               std::int64_t level) {
  const auto lanes = std::make_shared<Lanes>(pairs);
  const auto solve = [lanes, steps, following](bool arms) {
    lanes->run(following, arms, [&](LaneBlock& block) {
      block.tolerance = std::numeric_limits<double>::infinity();
      block.followed_steps = steps;
      block.first_steps = following ? steps + 1 : steps;
      block.coarse = std::numeric_limits<double>::quiet_NaN();  // no pair is: a step is a step
    });
  };
  Method method{"gap_lanes", following ? "following" : "cold", steps, level, {}, true, {}, {}};
  method.run = [solve] { solve(false); };
  method.answers = [solve, lanes, count = pairs.size()] {
    solve(true);
    std::vector<Answer> answers;
    for (std::size_t i = 0; i < count; ++i)
      answers.push_back(lanes->settles(i) ? Answer(lanes->columns.answer(i)) : Answer());
    return answers;
  };
  all.push_back(std::move(method));
}

void add_batch_overlaps(std::vector<Method>& all, const Pairs& pairs, std::int64_t level) {
  const std::size_t count = pairs.size();
  const std::shared_ptr<bool[]> meet(new bool[count]);
  Method method{"overlaps", "", {}, level, {}, true, {}, {}};
  method.run = [&pairs, meet, count] {
    overlaps(*pairs.array, {pairs.list, {}}, std::span(meet.get(), count));
  };
  method.answers = [meet, count] {
    std::vector<Answer> answers;
    for (std::size_t i = 0; i < count; ++i)
      answers.push_back(to_answer(OverlapAnswer{meet.get()[i], Tier::filter}));
    return answers;
  };
  all.push_back(std::move(method));
}

}  // namespace

std::string_view to_string(Definition definition) {
  switch (definition) {
    case Definition::common_normal:
      return "common normal";
    case Definition::perram_wertheim:
      return "perram-wertheim";
    case Definition::midpoint_potential:
      return "midpoint potential";
    case Definition::trace:
      return "trace";
  }
  return "";
}

std::string level_name(std::int64_t level) {
  return level == 0 ? "single" : hwy::TargetName(level);
}

std::vector<Method> methods_on(const Pairs& pairs, std::span<const std::int64_t> levels) {
  std::vector<Method> all;
  add_singles(all, pairs);
  for (const std::int64_t level : levels) {
    for (const bool following : {false, true}) {
      for (const NamedAccuracy& named : accuracies(std::ranges::min(pairs.smallest)))
        add_batch(all, pairs, named, following, level);
      add_float_batch(all, pairs, following, level);
      for (int steps = 0; steps <= 4; ++steps) add_lanes(all, pairs, steps, following, level);
    }
    add_batch_overlaps(all, pairs, level);
  }
  return all;
}

}  // namespace tangency::speed_accuracy
