// SPDX-License-Identifier: MIT
#include <tangency/geometry/gap_batch.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include <tangency/geometry/batch/float_lanes.hpp>
#include <tangency/geometry/batch/gap_lanes.hpp>
#include <tangency/geometry/batch/gap_writers.hpp>
#include <tangency/geometry/batch/pair_task.hpp>
#include <tangency/geometry/batch/parts.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency::inline v0 {
namespace {

using detail::kBlock;
using detail::LaneBlock;
using detail::OpenPairs;
using detail::PairTask;
using detail::PlainRows;
using detail::ToBounded;
using detail::ToColumns;
using detail::ToFloats;
using detail::ToGaps;
using detail::Workspace;

/// Is any answer written where a previous normal stands?
bool meet(const GapColumns& columns, std::span<const Vec3> normals) {
  const auto first = reinterpret_cast<std::uintptr_t>(normals.data());
  const std::uintptr_t last = first + normals.size_bytes();
  const auto meets = [&](const auto& column) {
    const auto begin = reinterpret_cast<std::uintptr_t>(column.data());
    return begin < last && first < begin + column.size_bytes();
  };
  return meets(columns.gap) || meets(columns.gap_error) || meets(columns.normal) ||
         meets(columns.arm_a) || meets(columns.arm_b) || meets(columns.point);
}

/// Pairs first to last. What the first tier leaves open it may settle from the normal that it came
/// to; else the next tier may, and else the single call does.
template <class Write>
class Run {
 public:
  /// @param plain  as of gather()
  Run(const PairTask& task, const Write& write, PlainRows* plain)
      : task_(task), write_(write), plain_(plain) {}

  void operator()(std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += kBlock) {
      const std::size_t count = std::min(kBlock, end - first);
      if (task_.indexed()) task_.require_indices(first, count);
      gather(task_, first, count, work_, plain_);
      task_.has_cutoff() ? sort(first, count) : answer(first, count);
    }
    if (near_.count != 0) answer_near();
    if (again_.count != 0) answer_again();
    if (open_.count != 0) answer_open();
  }

 private:
  struct FirstTier {
    std::uint64_t settled;
    bool by_doubles;  ///< what is not is for the single call
  };
  FirstTier ask(LaneBlock& block) const {
    if (task_.in_floats()) return {detail::float_gap_lanes(block), false};
    if (!task_.polish) {
      const std::uint64_t settled = detail::mixed_gap_lanes(block);
      if (block.within_float) return {settled, false};
    }
    return {detail::gap_lanes(block), true};
  }

  /// use(i) of the pairs of a block that are not in `done`.
  template <class Use>
  static void for_others(std::uint64_t done, std::size_t count, const Use& use) {
    std::uint64_t left = ~done;
    if (count < kBlock) left &= (std::uint64_t{1} << count) - 1;
    for (; left != 0; left &= left - 1) use(static_cast<std::size_t>(std::countr_zero(left)));
  }

  void answer(std::size_t first, std::size_t count) {
    write_.aim(work_, first, count);
    const FirstTier tier = ask(work_.block);
    write_.lanes(task_, work_, first, count);
    for_others(tier.settled, count, [&](std::size_t i) {
      if (tier.by_doubles)
        single(first + i, work_.start(i));
      else
        hand_on(work_, i, first + i, work_.start(i), again_);
    });
  }

  /// Those beyond the cutoff are answered; the others are, a block of them at a time.
  void sort(std::size_t first, std::size_t count) {
    const std::uint64_t far = detail::far_lanes(work_.block, task_.cutoff, work_.gap);
    write_.beyond(work_.gap, first, count);  // the others are written over
    for_others(far, count, [&](std::size_t i) {
      near_.add(work_, i, first + i, work_.start(i), work_.start(i));
      if (near_.full()) answer_near();
    });
  }

  void answer_near() {
    near_.complete(task_, plain_);
    const FirstTier tier = ask(near_.work.block);
    answer(near_, tier.settled, [&](std::size_t k) {
      if (tier.by_doubles)
        single(near_.place[k], near_.previous[k]);
      else
        hand_on(near_.work, k, near_.place[k], near_.previous[k], again_);
    });
  }

  void single(std::size_t i, const Vec3& previous) const {
    write_.single(task_, i, task_.follows() ? &previous : nullptr);
  }

  /// A pair that the first tier left open: to itself where that may help, else to the next.
  void hand_on(const Workspace& from, std::size_t i, std::size_t place, const Vec3& previous,
               OpenPairs& again) {
    const auto has = [&](std::uint64_t bits) { return (bits >> i & 1) != 0; };
    const Vec3& nearer = from.nearer_normals[i];
    if (has(from.block.promising) && &from != &again.work) {
      again.add(from, i, place, previous, nearer);
      if (again.full()) answer_again();
      return;
    }
    // Branches are followed from where the caller was.
    const bool start_there = has(from.block.nearer) && !from.block.branches;
    open_.add(from, i, place, previous, start_there ? nearer : previous);
    if (open_.full()) answer_open();
  }

  /// Answers what is settled of a block of open pairs; else(k) the others.
  template <class Else>
  void answer(OpenPairs& pairs, std::uint64_t settled, const Else& others) {
    const Workspace& work = pairs.work;
    for (std::size_t k = 0; k < pairs.count; ++k) {
      if ((settled >> k & 1) == 0) {
        others(k);
        continue;
      }
      const bool local = (work.block.local >> k & 1) != 0;
      write_.lane(task_, pairs.place[k],
                  task_.wanted({work.gap[k], work.normal[k], work.arm_a[k], work.arm_b[k],
                                work.gap_error[k], local ? GapStatus::local : GapStatus::ok,
                                GapTier::fast}));
    }
    pairs.count = 0;
  }

  void answer_again() {
    again_.complete(task_, plain_);
    again_.work.block.followed_steps = 2;  // one was not enough
    answer(again_, detail::mixed_gap_lanes(again_.work.block), [&](std::size_t k) {
      hand_on(again_.work, k, again_.place[k], again_.previous[k], again_);
    });
  }

  void answer_open() {
    open_.complete(task_, plain_);
    answer(open_, detail::gap_lanes(open_.work.block),
           [&](std::size_t k) { single(open_.place[k], open_.previous[k]); });
  }

  const PairTask& task_;
  const Write& write_;
  PlainRows* plain_;
  Workspace work_;
  OpenPairs near_, again_, open_;
};

/// Apart, so that calls for indexed pairs do without the stack that it takes.
template <class Write>
[[gnu::noinline]] void run_plain(const PairTask& task, const Write& write, std::size_t first,
                                 std::size_t last) {
  PlainRows plain;
  Run(task, write, &plain)(first, last);
}

template <class Write>
void run(PairTask task, Accuracy accuracy, int threads, const Write& write) noexcept {
  assert(accuracy.of_size >= 0.0 && accuracy.length >= 0.0 && accuracy.cutoff >= 0.0);
  task.tolerance_of_size = accuracy.of_size;
  task.tolerance = accuracy.length;
  task.polish = accuracy.normals;
  task.cutoff = accuracy.cutoff;
  task.require_floats();
  detail::in_ranges(task.count, threads, kBlock, [&](std::size_t first, std::size_t last) {
    in_default_environment([&] {
      task.indexed() ? Run(task, write, nullptr)(first, last) : run_plain(task, write, first, last);
    });
  });
}

template <class Columns>
void require_columns(const char* call, const Columns& columns, std::size_t count) {
  const auto require = [&](const char* name, const auto& column) {
    if (!column.empty()) contract::require_length(call, name, column.size(), count);
  };
  require("gap", columns.gap);
  require("gap_error", columns.gap_error);
  require("normal", columns.normal);
  require("arm_a", columns.arm_a);
  require("arm_b", columns.arm_b);
  require("status", columns.status);
  require("tier", columns.tier);
  require("point", columns.point);
}

template <class Bodies>
PairTask followed(const Bodies& bodies, const PairList& list, std::span<const Vec3> normals) {
  contract::require_length("follow_gaps", "previous_normals", normals.size(), list.pairs.size());
  PairTask task("follow_gaps", bodies, list);
  task.previous_normals = normals.data();
  return task;
}

template <class Bodies>
void follow(const Bodies& bodies, const PairList& list, std::span<const Vec3> previous_normals,
            const GapColumns& answers, Accuracy accuracy, int threads) noexcept {
  require_columns("follow_gaps", answers, list.pairs.size());
  PairTask task = followed(bodies, list, previous_normals);
  task.answers_over_normals = meet(answers, previous_normals);
  run(task, accuracy, threads, ToColumns{answers});
}

template <class Bodies>
void follow(const Bodies& bodies, const PairList& list, std::span<const Vec3f> previous_normals,
            const FloatGapColumns& answers, Accuracy accuracy, int threads) noexcept {
  require_columns("follow_gaps", answers, list.pairs.size());
  contract::require_length("follow_gaps", "previous_normals", previous_normals.size(),
                           list.pairs.size());
  PairTask task("follow_gaps", bodies, list);
  task.previous_floats = previous_normals.data();
  run(task, accuracy, threads, ToFloats{answers});
}

template <class Bodies>
void bound(const Bodies& bodies, const PairList& list, const BoundedColumns& answers,
           Accuracy accuracy, int threads) noexcept {
  require_columns("bounded_gaps", answers.answers, list.pairs.size());
  if (!answers.above.empty())
    contract::require_length("bounded_gaps", "above", answers.above.size(), list.pairs.size());
  run(PairTask("bounded_gaps", bodies, list), accuracy, threads,
      ToBounded{{answers.answers}, answers.above});
}

}  // namespace

void signed_gaps(const BodyArray& bodies, const PairList& list, const GapColumns& answers,
                 Accuracy accuracy, int threads) noexcept {
  require_columns("signed_gaps", answers, list.pairs.size());
  run(PairTask("signed_gaps", bodies, list), accuracy, threads, ToColumns{answers});
}

void signed_gaps(const BodyArray& bodies, const PairList& list, std::span<Gap> answers,
                 Accuracy accuracy, int threads) noexcept {
  contract::require_length("signed_gaps", "answers", answers.size(), list.pairs.size());
  run(PairTask("signed_gaps", bodies, list), accuracy, threads, ToGaps{answers});
}

void signed_gaps(const MovingBodies& bodies, const PairList& list, const GapColumns& answers,
                 Accuracy accuracy, int threads) noexcept {
  require_columns("signed_gaps", answers, list.pairs.size());
  run(PairTask("signed_gaps", bodies, list), accuracy, threads, ToColumns{answers});
}

void signed_gaps(const BodyArray& bodies, const PairList& list, const FloatGapColumns& answers,
                 Accuracy accuracy, int threads) noexcept {
  require_columns("signed_gaps", answers, list.pairs.size());
  run(PairTask("signed_gaps", bodies, list), accuracy, threads, ToFloats{answers});
}

void signed_gaps(const MovingBodies& bodies, const PairList& list, const FloatGapColumns& answers,
                 Accuracy accuracy, int threads) noexcept {
  require_columns("signed_gaps", answers, list.pairs.size());
  run(PairTask("signed_gaps", bodies, list), accuracy, threads, ToFloats{answers});
}

void signed_gaps(std::span<const Ellipsoid> a, std::span<const Ellipsoid> b, std::span<Gap> answers,
                 Accuracy accuracy, int threads) noexcept {
  signed_gaps(a, b, std::span<const Vec3>(), answers, accuracy, threads);
}

void signed_gaps(std::span<const Ellipsoid> a, std::span<const Ellipsoid> b,
                 std::span<const Vec3> separations, std::span<Gap> answers, Accuracy accuracy,
                 int threads) noexcept {
  const PairTask task("signed_gaps", a, b, separations);
  contract::require_length("signed_gaps", "answers", answers.size(), a.size());
  run(task, accuracy, threads, ToGaps{answers});
}

void follow_gaps(const BodyArray& bodies, const PairList& list,
                 std::span<const Vec3> previous_normals, const GapColumns& answers,
                 Accuracy accuracy, int threads) noexcept {
  follow(bodies, list, previous_normals, answers, accuracy, threads);
}

void follow_gaps(const MovingBodies& bodies, const PairList& list,
                 std::span<const Vec3> previous_normals, const GapColumns& answers,
                 Accuracy accuracy, int threads) noexcept {
  follow(bodies, list, previous_normals, answers, accuracy, threads);
}

void follow_gaps(const BodyArray& bodies, const PairList& list,
                 std::span<const Vec3f> previous_normals, const FloatGapColumns& answers,
                 Accuracy accuracy, int threads) noexcept {
  follow(bodies, list, previous_normals, answers, accuracy, threads);
}

void follow_gaps(const MovingBodies& bodies, const PairList& list,
                 std::span<const Vec3f> previous_normals, const FloatGapColumns& answers,
                 Accuracy accuracy, int threads) noexcept {
  follow(bodies, list, previous_normals, answers, accuracy, threads);
}

void follow_gaps(const BodyArray& bodies, const PairList& list,
                 std::span<const Vec3> previous_normals, std::span<Gap> answers, Accuracy accuracy,
                 int threads) noexcept {
  contract::require_length("follow_gaps", "answers", answers.size(), list.pairs.size());
  run(followed(bodies, list, previous_normals), accuracy, threads, ToGaps{answers});
}

void bounded_gaps(const BodyArray& bodies, const PairList& list, const BoundedColumns& answers,
                  Accuracy accuracy, int threads) noexcept {
  bound(bodies, list, answers, accuracy, threads);
}

void bounded_gaps(const MovingBodies& bodies, const PairList& list, const BoundedColumns& answers,
                  Accuracy accuracy, int threads) noexcept {
  bound(bodies, list, answers, accuracy, threads);
}

void gap_derivatives(const BodyArray& bodies, const PairList& list, std::span<const Gap> gaps,
                     std::span<GapDerivatives> answers, int threads) noexcept {
  const PairTask task("gap_derivatives", bodies, list);
  contract::require_length("gap_derivatives", "gaps", gaps.size(), task.count);
  contract::require_length("gap_derivatives", "answers", answers.size(), task.count);
  task.require_indices(0, task.count);
  detail::in_ranges(task.count, threads, kBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const Ellipsoid &a = task.a(i), &b = task.b(i);
      answers[i] = task.separations != nullptr ? gap_derivatives(a, b, task.separations[i], gaps[i])
                                               : gap_derivatives(a, b, gaps[i]);
    }
  });
}

}  // namespace tangency::inline v0
