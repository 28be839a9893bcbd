// SPDX-License-Identifier: MIT
#include <tangency/geometry/gap_batch.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include <tangency/geometry/batch/body_rows.hpp>
#include <tangency/geometry/batch/gap_lanes.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>

namespace tangency {
namespace {

using detail::LaneBlock;
using detail::LaneBody;

static_assert(detail::kLaneErrorBound == kOrdinaryGapErrorBound,
              "lanes, which share no header with baseline code, promise what one pair does");

constexpr std::size_t kBlock = LaneBlock::kPairs;
// Bodies, 128 bytes each: a megabyte stays near the processor. Chosen.
constexpr std::size_t kNear = 8192;
// Of L: with a tolerance from here on a step of Newton's method less is mostly enough. Measured.
constexpr double kCoarse = 0x1p-24;

/// The pairs of one call, wherever their bodies are.
struct Task {
  const BodyArray* bodies = nullptr;     ///< null: moving bodies or plain pairs
  const MovingBodies* moving = nullptr;  ///< null: the bodies above or plain pairs
  const LaneBody* lanes = nullptr;       ///< of the bodies
  std::size_t body_count = 0;
  const IndexedPair* pairs = nullptr;
  const Ellipsoid *plain_a = nullptr, *plain_b = nullptr;
  const char* call = nullptr;
  const Vec3* separations = nullptr;
  const Vec3* previous_normals = nullptr;
  bool answers_over_normals = false;  ///< else what a lane leaves open is still there
  std::size_t count = 0;
  Accuracy accuracy;

  bool indexed() const { return bodies != nullptr || moving != nullptr; }
  const Ellipsoid& a(std::size_t i) const { return bodies ? (*bodies)[pairs[i].a] : plain_a[i]; }
  const Ellipsoid& b(std::size_t i) const { return bodies ? (*bodies)[pairs[i].b] : plain_b[i]; }

  /// What a lane cannot prove: a separation that is not finite is never proven by one.
  /// @param previous_normal  null, or 0: the pair is asked afresh
  Gap single(std::size_t i, const Vec3* previous_normal) const {
    require_finite_separation(i);
    if (moving != nullptr) return single(i, made(pairs[i].a), made(pairs[i].b), previous_normal);
    return single(i, a(i), b(i), previous_normal);
  }

  Gap single(std::size_t i, const Ellipsoid& a, const Ellipsoid& b,
             const Vec3* previous_normal) const {
    if (separations != nullptr || previous_normal == nullptr)
      return single(a, b, separations ? separations + i : nullptr, previous_normal);
    const Vec3 d = b.centre() - a.centre();
    if (!d.allFinite()) return signed_gap(a, b);  // that of the centres, which overflows
    return single(a, b, &d, previous_normal);
  }

  static Gap single(const Ellipsoid& a, const Ellipsoid& b, const Vec3* separation,
                    const Vec3* previous_normal) {
    if (separation == nullptr) return signed_gap(a, b);
    if (previous_normal == nullptr || *previous_normal == Vec3::Zero())
      return signed_gap(a, b, *separation);
    return follow_gap(a, b, *separation, *previous_normal);
  }

  Ellipsoid made(std::size_t body) const {
    try {
      return (*moving)[body];
    } catch (const InvalidEllipsoid& invalid) {
      contract::no_ellipsoid(call, body, invalid.what());
    }
  }

  bool overlaps(std::size_t i) const {
    if (separations == nullptr) return tangency::overlaps(a(i), b(i));
    require_finite_separation(i);
    return tangency::overlaps(a(i).moved_to(Vec3::Zero()), b(i).moved_to(separations[i]));
  }

  std::optional<bool> overlaps_by_filter(std::size_t i) const {
    if (separations == nullptr) return tangency::overlaps_by_filter(a(i), b(i));
    require_finite_separation(i);
    return tangency::overlaps_by_filter(a(i).moved_to(Vec3::Zero()), b(i).moved_to(separations[i]));
  }

  void require_finite_separation(std::size_t i) const {
    if (separations != nullptr) contract::require_finite(call, "separation", separations[i]);
  }

  /// Are the bodies of pairs first to first + n in the array? The two indices of a pair are one
  /// number p of 64 bits: where neither half has its highest bit, p + room has that of each half
  /// that is no index. Four instructions a pair, or two where the compiler takes two at once.
  void require_indices(std::size_t first, std::size_t n) const {
    static_assert(sizeof(IndexedPair) == sizeof(std::uint64_t));
    constexpr std::uint64_t kHalf = std::uint64_t{1} << 31, kBoth = (kHalf << 1) + 1;
    const std::size_t size = body_count;
    if (size > kHalf) return find_outside(first, n);
    const std::uint64_t room = kBoth * (kHalf - size);
    std::uint64_t outside = 0;
    const auto look_at = [&](std::size_t some) {
      for (std::size_t i = 0; i < some; ++i) {
        const auto both = std::bit_cast<std::uint64_t>(pairs[first + i]);
        outside |= (both + room) | both;
      }
    };
    n == kBlock ? look_at(kBlock) : look_at(n);  // a constant number is taken two at once
    if ((outside & (kBoth * kHalf)) != 0) find_outside(first, n);
  }
  void find_outside(std::size_t first, std::size_t n) const {
    const std::size_t size = body_count;
    for (std::size_t i = first; i < first + n; ++i) {
      if (pairs[i].a >= size) contract::outside(call, i, 'a', pairs[i].a, size);
      if (pairs[i].b >= size) contract::outside(call, i, 'b', pairs[i].b, size);
    }
  }
};

/// A block of pairs and copies of what belongs to them, so that the answers may be written where
/// the questions were.
struct Workspace {
  LaneBlock block;
  IndexedPair pairs[kBlock];
  Vec3 separations[kBlock], normals[kBlock];
  LaneBody plain_a[kBlock], plain_b[kBlock];
  double gap[kBlock], gap_error[kBlock];
  Vec3 normal[kBlock], arm_a[kBlock], arm_b[kBlock];

  /// The answers are to stand here.
  void take_answers() {
    block.gap = gap;
    block.gap_error = gap_error;
    block.normal = normal[0].data();
    block.arm_a = arm_a[0].data();
    block.arm_b = arm_b[0].data();
  }
};

/// A copy of what stands at `first` of an array, filled up with its first entry.
const IndexedPair* copied(const IndexedPair* from, std::size_t first, std::size_t count,
                          IndexedPair* copy) {
  std::copy_n(from + first, count, copy);
  std::fill(copy + count, copy + kBlock, from[first]);
  return copy;
}
/// As numbers, which a compiler copies by whole registers.
const Vec3* copied(const Vec3* from, std::size_t first, std::size_t count, Vec3* copy) {
  std::copy_n(from[first].data(), 3 * count, copy->data());
  std::fill(copy + count, copy + kBlock, from[first]);
  return copy;
}
/// What stands there itself where that is a full block.
template <class T>
const T* block_of(const T* from, std::size_t first, std::size_t count, T* copy) {
  return count == kBlock ? from + first : copied(from, first, count, copy);
}

void aim(const Task& task, LaneBlock& block) {
  const Accuracy& accuracy = task.accuracy;
  block.tolerance_of_size = accuracy.of_size;
  block.tolerance = accuracy.length;
  block.polish = accuracy.normals;
  // A moment ago the normal was good to some 1e-4; the start of a cold search is to 1e-2.
  block.first_steps = 2;
  block.followed_steps = 1;
  block.branches = task.moving != nullptr;
  block.factor_error = task.moving != nullptr ? detail::kOfRotation : 0.0;
  block.coarse = kCoarse;
}

void gather(const Task& task, std::size_t first, std::size_t count, Workspace& work) {
  LaneBlock& block = work.block;
  block.count = static_cast<int>(count);
  block.next_pairs = nullptr;
  if (task.indexed()) {
    block.bodies_a = block.bodies_b = task.lanes;
    block.shapes_a = block.shapes_b = task.bodies != nullptr ? task.bodies->shapes() : nullptr;
    block.pairs = block_of(task.pairs, first, count, work.pairs);
    if (task.body_count > kNear && first + 2 * kBlock <= task.count)
      block.next_pairs = task.pairs + first + kBlock;
  } else {
    block.bodies_a = work.plain_a;
    block.bodies_b = work.plain_b;
    block.pairs = work.pairs;
    for (std::uint32_t i = 0; i < kBlock; ++i) {
      work.pairs[i] = i < count ? IndexedPair{i, i} : IndexedPair{0, 0};
    }
    for (std::size_t i = 0; i < count; ++i) {
      detail::fill(work.plain_a[i], task.plain_a[first + i]);
      detail::fill(work.plain_b[i], task.plain_b[first + i]);
    }
  }
  aim(task, block);
  block.separations = nullptr;
  block.normals = nullptr;
  block.centres_are_exact = task.separations == nullptr && task.previous_normals == nullptr;
  if (task.separations != nullptr) {
    block.separations = block_of(task.separations, first, count, work.separations)->data();
  }
  if (task.previous_normals != nullptr) {
    const Vec3* const from = task.previous_normals;
    const Vec3* const normals = task.answers_over_normals
                                    ? copied(from, first, count, work.normals)
                                    : block_of(from, first, count, work.normals);
    block.normals = normals->data();
  }
}

/// Is any answer written where a previous normal stands?
bool meet(const GapColumns& columns, std::span<const Vec3> normals) {
  const auto first = reinterpret_cast<std::uintptr_t>(normals.data());
  const std::uintptr_t last = first + normals.size_bytes();
  const auto meets = [&](const auto& column) {
    const auto begin = reinterpret_cast<std::uintptr_t>(column.data());
    return begin < last && first < begin + column.size_bytes();
  };
  return meets(columns.gap) || meets(columns.gap_error) || meets(columns.normal) ||
         meets(columns.arm_a) || meets(columns.arm_b);
}

/// Writes the answers of one block to columns: a full block directly.
struct ToColumns {
  const GapColumns& to;

  void aim(Workspace& work, std::size_t first, std::size_t count) const {
    if (count < kBlock) return work.take_answers();
    const auto numbers = [&](std::span<double> c) { return c.empty() ? nullptr : &c[first]; };
    const auto vectors = [&](std::span<Vec3> c) { return c.empty() ? nullptr : c[first].data(); };
    work.block.gap = numbers(to.gap);
    work.block.gap_error = numbers(to.gap_error);
    work.block.normal = vectors(to.normal);
    work.block.arm_a = vectors(to.arm_a);
    work.block.arm_b = vectors(to.arm_b);
  }

  void lanes(const Workspace& work, std::size_t first, std::size_t count) const {
    if (!to.tier.empty()) std::fill_n(&to.tier[first], count, GapTier::fast);
    if (!to.status.empty()) {
      std::fill_n(&to.status[first], count, GapStatus::ok);
      for (std::uint64_t local = work.block.local; local != 0; local &= local - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(local));
        if (i < count) to.status[first + i] = GapStatus::local;
      }
    }
    if (count == kBlock) return;
    const auto copy = [&](const auto* from, const auto& column) {
      if (!column.empty()) std::copy_n(from, count, &column[first]);
    };
    copy(work.gap, to.gap);
    copy(work.gap_error, to.gap_error);
    copy(work.normal, to.normal);
    copy(work.arm_a, to.arm_a);
    copy(work.arm_b, to.arm_b);
  }

  void single(const Gap& gap, std::size_t i) const {
    if (!to.gap.empty()) to.gap[i] = gap.gap;
    if (!to.gap_error.empty()) to.gap_error[i] = gap.gap_error;
    if (!to.normal.empty()) to.normal[i] = gap.normal;
    if (!to.arm_a.empty()) to.arm_a[i] = gap.arm_a;
    if (!to.arm_b.empty()) to.arm_b[i] = gap.arm_b;
    if (!to.status.empty()) to.status[i] = gap.status;
    if (!to.tier.empty()) to.tier[i] = gap.tier;
  }
};

struct ToGaps {
  std::span<Gap> to;

  void aim(Workspace& work, std::size_t, std::size_t) const { work.take_answers(); }
  void lanes(const Workspace& work, std::size_t first, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i) {
      to[first + i] = {work.gap[i],       work.normal[i], work.arm_a[i], work.arm_b[i],
                       work.gap_error[i], GapStatus::ok,  GapTier::fast};
    }
  }
  void single(const Gap& gap, std::size_t i) const { to[i] = gap; }
};

template <class Write>
void run_here(const Task& task, const Write& write) {
  Workspace work;
  for (std::size_t first = 0; first < task.count; first += kBlock) {
    const std::size_t count = std::min(kBlock, task.count - first);
    if (task.indexed()) task.require_indices(first, count);
    gather(task, first, count, work);
    write.aim(work, first, count);
    std::uint64_t open = ~detail::gap_lanes(work.block);
    if (count < kBlock) open &= (std::uint64_t{1} << count) - 1;
    write.lanes(work, first, count);
    for (; open != 0; open &= open - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(open));
      Vec3 previous = Vec3::Zero();
      if (work.block.normals != nullptr) previous = Vec3::Map(work.block.normals + 3 * i);
      const Vec3* const given = task.previous_normals != nullptr ? &previous : nullptr;
      write.single(task.single(first + i, given), first + i);
    }
  }
}

template <class Write>
void run(const Task& task, const Write& write) noexcept {
  in_default_environment([&] { run_here(task, write); });
}

void bind(Task& task, const BodyArray& bodies) { task.bodies = &bodies; }
void bind(Task& task, const MovingBodies& bodies) { task.moving = &bodies; }

bool has_centres(const BodyArray&) { return true; }
bool has_centres(const MovingBodies& bodies) { return bodies.has_centres(); }

template <class Bodies>
Task task_of(const char* call, const Bodies& bodies, const PairList& list, Accuracy accuracy = {}) {
  assert(accuracy.of_size >= 0.0 && accuracy.length >= 0.0);
  if (!list.separations.empty() || !has_centres(bodies)) {
    contract::require_length(call, "separations", list.separations.size(), list.pairs.size());
  }
  Task task;
  task.call = call;
  bind(task, bodies);
  task.lanes = bodies.lanes();
  task.body_count = bodies.size();
  task.pairs = list.pairs.data();
  task.separations = list.separations.empty() ? nullptr : list.separations.data();
  task.count = list.pairs.size();
  task.accuracy = accuracy;
  return task;
}

template <class Bodies>
Task task_of(const char* call, const Bodies& bodies, const PairList& list, Accuracy accuracy,
             std::span<const Vec3> normals) {
  contract::require_length(call, "previous_normals", normals.size(), list.pairs.size());
  Task task = task_of(call, bodies, list, accuracy);
  task.previous_normals = normals.data();
  return task;
}

void require_columns(const char* call, const GapColumns& columns, std::size_t count) {
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
}

template <class Bodies>
void follow(const Bodies& bodies, const PairList& list, std::span<const Vec3> previous_normals,
            const GapColumns& answers, Accuracy accuracy) noexcept {
  require_columns("follow_gaps", answers, list.pairs.size());
  Task task = task_of("follow_gaps", bodies, list, accuracy, previous_normals);
  task.answers_over_normals = meet(answers, previous_normals);
  run(task, ToColumns{answers});
}

/// What a lane proves, and doubtful(i) for the other pairs.
template <class Answer, class Doubtful>
void run_overlaps(const Task& task, Answer* answers, const Doubtful& doubtful) {
  in_default_environment([&] {
    Workspace work;
    for (std::size_t first = 0; first < task.count; first += kBlock) {
      const std::size_t count = std::min(kBlock, task.count - first);
#ifndef NDEBUG  // 7 % of the quickest call
      task.require_indices(first, count);
#endif
      gather(task, first, count, work);
      const detail::LaneOverlaps lanes = detail::overlap_lanes(work.block);
      Answer* const to = answers + first;  // a copy: bytes are written, which could be anything
      for (std::size_t i = 0; i < count; ++i) {
        const bool decided = (lanes.decided >> i & 1) != 0;
        to[i] = decided ? Answer((lanes.meet >> i & 1) != 0) : doubtful(first + i);
      }
    }
  });
}

}  // namespace

void signed_gaps(const BodyArray& bodies, const PairList& list, const GapColumns& answers,
                 Accuracy accuracy) noexcept {
  require_columns("signed_gaps", answers, list.pairs.size());
  run(task_of("signed_gaps", bodies, list, accuracy), ToColumns{answers});
}

void signed_gaps(const BodyArray& bodies, const PairList& list, std::span<Gap> answers,
                 Accuracy accuracy) noexcept {
  contract::require_length("signed_gaps", "answers", answers.size(), list.pairs.size());
  run(task_of("signed_gaps", bodies, list, accuracy), ToGaps{answers});
}

void signed_gaps(const MovingBodies& bodies, const PairList& list, const GapColumns& answers,
                 Accuracy accuracy) noexcept {
  require_columns("signed_gaps", answers, list.pairs.size());
  run(task_of("signed_gaps", bodies, list, accuracy), ToColumns{answers});
}

void signed_gaps(std::span<const Ellipsoid> a, std::span<const Ellipsoid> b, std::span<Gap> answers,
                 Accuracy accuracy) noexcept {
  contract::require_length("signed_gaps", "b", b.size(), a.size());
  contract::require_length("signed_gaps", "answers", answers.size(), a.size());
  Task task;
  task.call = "signed_gaps";
  task.plain_a = a.data();
  task.plain_b = b.data();
  task.count = a.size();
  task.accuracy = accuracy;
  run(task, ToGaps{answers});
}

void follow_gaps(const BodyArray& bodies, const PairList& list,
                 std::span<const Vec3> previous_normals, const GapColumns& answers,
                 Accuracy accuracy) noexcept {
  follow(bodies, list, previous_normals, answers, accuracy);
}

void follow_gaps(const MovingBodies& bodies, const PairList& list,
                 std::span<const Vec3> previous_normals, const GapColumns& answers,
                 Accuracy accuracy) noexcept {
  follow(bodies, list, previous_normals, answers, accuracy);
}

void follow_gaps(const BodyArray& bodies, const PairList& list,
                 std::span<const Vec3> previous_normals, std::span<Gap> answers,
                 Accuracy accuracy) noexcept {
  contract::require_length("follow_gaps", "answers", answers.size(), list.pairs.size());
  run(task_of("follow_gaps", bodies, list, accuracy, previous_normals), ToGaps{answers});
}

void gap_derivatives(const BodyArray& bodies, const PairList& list, std::span<const Gap> gaps,
                     std::span<GapDerivatives> answers) noexcept {
  contract::require_length("gap_derivatives", "gaps", gaps.size(), list.pairs.size());
  contract::require_length("gap_derivatives", "answers", answers.size(), list.pairs.size());
  const Task task = task_of("gap_derivatives", bodies, list);
  task.require_indices(0, task.count);
  for (std::size_t i = 0; i < task.count; ++i) {
    const Ellipsoid &a = task.a(i), &b = task.b(i);
    answers[i] = task.separations != nullptr ? gap_derivatives(a, b, task.separations[i], gaps[i])
                                             : gap_derivatives(a, b, gaps[i]);
  }
}

void overlaps(const BodyArray& bodies, const PairList& list, std::span<bool> answers) noexcept {
  contract::require_length("overlaps", "answers", answers.size(), list.pairs.size());
  const Task task = task_of("overlaps", bodies, list);
  run_overlaps(task, answers.data(), [&](std::size_t i) { return task.overlaps(i); });
}

void overlaps_by_filter(const BodyArray& bodies, const PairList& list,
                        std::span<std::optional<bool>> answers) noexcept {
  contract::require_length("overlaps_by_filter", "answers", answers.size(), list.pairs.size());
  const Task task = task_of("overlaps_by_filter", bodies, list);
  run_overlaps(task, answers.data(), [&](std::size_t i) { return task.overlaps_by_filter(i); });
}

}  // namespace tangency
