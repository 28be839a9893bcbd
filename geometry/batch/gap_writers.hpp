// SPDX-License-Identifier: MIT
/// @file
/// Where the answers of a batch call go, in each form that a caller may ask for: blocks of lanes,
/// single lanes of what was open, and single calls. Internal.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <tangency/geometry/batch/float_answers.hpp>
#include <tangency/geometry/batch/pair_task.hpp>
#include <tangency/geometry/gap_columns.hpp>

namespace tangency::inline v0::detail {

/// The contact point, from A's centre.
inline Vec3 midpoint(const Vec3& d, const Vec3& arm_a, const Vec3& arm_b) {
  return arm_a + 0.5 * ((d + arm_b) - arm_a);
}

/// The same of an answer; 0 of a pair beyond the cutoff.
inline Vec3 contact_point(const PairTask& task, std::size_t i, const Gap& gap) {
  if (gap.status == GapStatus::beyond) return Vec3::Zero();
  return midpoint(task.separation(i), gap.arm_a, gap.arm_b);
}

/// Status and tier of a block that lanes answered.
template <class Columns>
void write_proofs(const LaneBlock& block, const Columns& to, std::size_t first, std::size_t count) {
  if (!to.tier.empty()) std::fill_n(&to.tier[first], count, GapTier::fast);
  if (to.status.empty()) return;
  std::fill_n(&to.status[first], count, GapStatus::ok);
  for (std::uint64_t local = block.local; local != 0; local &= local - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(local));
    if (i < count) to.status[first + i] = GapStatus::local;
  }
}

/// Contact points of a block that lanes answered.
template <class Columns>
void write_points(const PairTask& task, const LaneBlock& block, const Columns& to,
                  std::size_t first, std::size_t count) {
  if (to.point.empty()) return;
  using Point = typename decltype(Columns::point)::value_type;
  for (std::size_t i = 0; i < count; ++i) {
    const auto arm = [&](const double* arms) { return Eigen::Map<const Vec3>(arms + 3 * i); };
    const Vec3 point = midpoint(task.separation(first + i), arm(block.arm_a), arm(block.arm_b));
    to.point[first + i] = point.cast<typename Point::Scalar>();
  }
}

/// What a block of pairs beyond the cutoff has in all columns but the gap's.
template <class Columns>
void write_beyond(const Columns& to, std::size_t first, std::size_t count) {
  const auto fill = [&](const auto& column, const auto& value) {
    if (!column.empty()) std::fill_n(&column[first], count, value);
  };
  const auto clear = [&](const auto& vectors) {
    if (!vectors.empty()) std::fill_n(vectors[first].data(), 3 * count, 0);
  };
  using Number = typename decltype(Columns::gap_error)::value_type;
  fill(to.gap_error, std::numeric_limits<Number>::infinity());
  fill(to.status, GapStatus::beyond);
  fill(to.tier, GapTier::fast);
  clear(to.normal);
  clear(to.arm_a);
  clear(to.arm_b);
  clear(to.point);
}

/// Writes the answers of one block to columns: a full block directly.
struct ToColumns {
  const GapColumns& to;

  void aim(Workspace& work, std::size_t first, std::size_t count) const {
    if (count < kBlock) return work.take_answers();
    const auto numbers = [&](std::span<double> c) { return c.empty() ? nullptr : &c[first]; };
    const auto vectors = [&](std::span<Vec3> c, Vec3* else_here) {
      if (!c.empty()) return c[first].data();
      return to.point.empty() ? nullptr : else_here->data();
    };
    work.block.gap = numbers(to.gap);
    work.block.gap_error = numbers(to.gap_error);
    work.block.normal = to.normal.empty() ? nullptr : to.normal[first].data();
    work.block.arm_a = vectors(to.arm_a, work.arm_a);
    work.block.arm_b = vectors(to.arm_b, work.arm_b);
  }

  void lanes(const PairTask& task, const Workspace& work, std::size_t first,
             std::size_t count) const {
    write_proofs(work.block, to, first, count);
    write_points(task, work.block, to, first, count);
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

  /// As if all pairs of a block were beyond.
  void beyond(const double* least, std::size_t first, std::size_t count) const {
    if (!to.gap.empty()) std::copy_n(least, count, &to.gap[first]);
    write_beyond(to, first, count);
  }

  void lane(const PairTask& task, std::size_t i, const Gap& gap) const { write(task, i, gap); }
  void single(const PairTask& task, std::size_t i, const Vec3* previous_normal) const {
    write(task, i, task.wanted(task.single(i, previous_normal)));
  }

  void write(const PairTask& task, std::size_t i, const Gap& gap) const {
    if (!to.gap.empty()) to.gap[i] = gap.gap;
    if (!to.gap_error.empty()) to.gap_error[i] = gap.gap_error;
    if (!to.normal.empty()) to.normal[i] = gap.normal;
    if (!to.arm_a.empty()) to.arm_a[i] = gap.arm_a;
    if (!to.arm_b.empty()) to.arm_b[i] = gap.arm_b;
    if (!to.status.empty()) to.status[i] = gap.status;
    if (!to.tier.empty()) to.tier[i] = gap.tier;
    if (!to.point.empty()) to.point[i] = contact_point(task, i, gap);
  }
};

/// The same of enclosures.
struct ToBounded {
  ToColumns columns;
  std::span<double> above;

  void aim(Workspace& work, std::size_t first, std::size_t count) const {
    columns.aim(work, first, count);
    if (work.block.gap_error == nullptr) work.block.gap_error = work.gap_error;
  }
  void lanes(const PairTask& task, const Workspace& work, std::size_t first,
             std::size_t count) const {
    columns.lanes(task, work, first, count);
    if (!above.empty()) std::copy_n(work.block.gap_error, count, &above[first]);
  }
  void beyond(const double* least, std::size_t first, std::size_t count) const {
    columns.beyond(least, first, count);
    if (!above.empty()) std::fill_n(&above[first], count, std::numeric_limits<double>::infinity());
  }
  void lane(const PairTask& task, std::size_t i, const Gap& gap) const {
    columns.write(task, i, gap);
    if (!above.empty()) above[i] = gap.gap_error;
  }
  void single(const PairTask& task, std::size_t i, const Vec3*) const {
    const BoundedGap found = task.bounded(i);
    const Gap gap = task.wanted(found);
    columns.write(task, i, gap);
    if (!above.empty()) above[i] = gap.status == GapStatus::beyond ? gap.gap_error : found.above;
  }
};

struct ToGaps {
  std::span<Gap> to;

  void aim(Workspace& work, std::size_t, std::size_t) const { work.take_answers(); }
  void lanes(const PairTask&, const Workspace& work, std::size_t first, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i) {
      to[first + i] = {work.gap[i],       work.normal[i], work.arm_a[i], work.arm_b[i],
                       work.gap_error[i], GapStatus::ok,  GapTier::fast};
    }
  }
  void beyond(const double* least, std::size_t first, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i) to[first + i] = detail::beyond(least[i]);
  }
  void lane(const PairTask&, std::size_t i, const Gap& gap) const { to[i] = gap; }
  void single(const PairTask& task, std::size_t i, const Vec3* previous_normal) const {
    to[i] = task.wanted(task.single(i, previous_normal));
  }
};

/// The same of float columns: a block is answered in double, and rounded.
struct ToFloats {
  const FloatGapColumns& to;

  void aim(Workspace& work, std::size_t, std::size_t) const {
    work.take_answers();
    LaneBlock& block = work.block;
    if (to.gap.empty() && to.gap_error.empty()) block.gap = nullptr;
    if (to.gap_error.empty()) block.gap_error = nullptr;
    if (to.normal.empty()) block.normal = nullptr;
    if (to.arm_a.empty() && to.point.empty()) block.arm_a = nullptr;
    if (to.arm_b.empty() && to.point.empty()) block.arm_b = nullptr;
  }

  void lanes(const PairTask& task, const Workspace& work, std::size_t first,
             std::size_t count) const {
    write_proofs(work.block, to, first, count);
    write_points(task, work.block, to, first, count);
    // A constant number of pairs is rounded several at once.
    count == kBlock ? numbers(work, first, kBlock) : numbers(work, first, count);
  }
  void numbers(const Workspace& work, std::size_t first, std::size_t count) const {
    if (!to.gap.empty()) {
      float* const gap = &to.gap[first];
      for (std::size_t i = 0; i < count; ++i) gap[i] = to_float_gap(work.gap[i]);
    }
    if (!to.gap_error.empty()) {
      float* const error = &to.gap_error[first];
      for (std::size_t i = 0; i < count; ++i)
        error[i] = to_float_error(work.gap[i], work.gap_error[i]);
    }
    const auto vectors = [&](const Vec3* from, std::span<Vec3f> column) {
      if (column.empty()) return;
      const double* const numbers = from->data();
      float* const floats = column[first].data();
      for (std::size_t k = 0; k < 3 * count; ++k) floats[k] = static_cast<float>(numbers[k]);
    };
    vectors(work.normal, to.normal);
    vectors(work.arm_a, to.arm_a);
    vectors(work.arm_b, to.arm_b);
  }

  void beyond(const double* least, std::size_t first, std::size_t count) const {
    if (!to.gap.empty()) std::transform(least, least + count, &to.gap[first], to_float_downwards);
    write_beyond(to, first, count);
  }

  void lane(const PairTask& task, std::size_t i, const Gap& gap) const { write(task, i, gap); }
  void single(const PairTask& task, std::size_t i, const Vec3* previous_normal) const {
    write(task, i, task.wanted(task.single(i, previous_normal)));
  }

  void write(const PairTask& task, std::size_t i, const Gap& gap) const {
    const bool bounded = gap.status == GapStatus::beyond;
    if (!to.gap.empty()) to.gap[i] = bounded ? to_float_downwards(gap.gap) : to_float_gap(gap.gap);
    if (!to.gap_error.empty()) to.gap_error[i] = to_float_error(gap.gap, gap.gap_error);
    if (!to.normal.empty()) to.normal[i] = gap.normal.cast<float>();
    if (!to.arm_a.empty()) to.arm_a[i] = gap.arm_a.cast<float>();
    if (!to.arm_b.empty()) to.arm_b[i] = gap.arm_b.cast<float>();
    if (!to.status.empty()) to.status[i] = gap.status;
    if (!to.tier.empty()) to.tier[i] = gap.tier;
    if (!to.point.empty()) to.point[i] = contact_point(task, i, gap).cast<float>();
  }
};

}  // namespace tangency::inline v0::detail
