// SPDX-License-Identifier: MIT
#include <tangency/geometry/batch/pair_task.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include <tangency/geometry/batch/body_rows.hpp>
#include <tangency/geometry/batch/shape_rows.hpp>
#include <tangency/geometry/numbers/contract.hpp>
#include <tangency/geometry/relation.hpp>

namespace tangency::inline v0::detail {
namespace {

static_assert(kLaneErrorBound == kOrdinaryGapErrorBound,
              "lanes, which share no header with baseline code, promise what one pair does");

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Bodies, 128 bytes each: a megabyte stays near the processor. Chosen.
constexpr std::size_t kNear = 8192;

const Vec3* data_or_null(std::span<const Vec3> vectors) {
  return vectors.empty() ? nullptr : vectors.data();
}

Gap single_gap(const Ellipsoid& a, const Ellipsoid& b, const Vec3* separation,
               const Vec3* previous_normal) {
  if (separation == nullptr) return signed_gap(a, b);
  if (previous_normal == nullptr || *previous_normal == Vec3::Zero())
    return signed_gap(a, b, *separation);
  return follow_gap(a, b, *separation, *previous_normal);
}

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

/// The bodies of the pairs of a block.
/// @param place  of each plain pair in the list
template <class Place>
void find_bodies(const PairTask& task, std::size_t count, const Place& place, LaneBlock& block,
                 PlainRows* plain) {
  if (task.indexed()) {
    block.bodies_a = block.bodies_b = task.lanes;
    block.rows_a = block.rows_b = task.rows;
    block.floats_a = block.floats_b = task.floats;
    return;
  }
  for (std::size_t k = 0; k < count; ++k) {
    fill(plain->bodies_a[k], task.plain_a[place(k)]);
    fill(plain->bodies_b[k], task.plain_b[place(k)]);
  }
  fill_shape_rows(plain->bodies_a, count, plain->rows_a);
  fill_shape_rows(plain->bodies_b, count, plain->rows_b);
  if (task.in_floats() || task.has_cutoff()) {
    fill_float_rows(plain->bodies_a, plain->rows_a, count, plain->floats_a);
    fill_float_rows(plain->bodies_b, plain->rows_b, count, plain->floats_b);
  }
  block.bodies_a = plain->bodies_a, block.bodies_b = plain->bodies_b;
  block.rows_a = plain->rows_a, block.rows_b = plain->rows_b;
  block.floats_a = plain->floats_a, block.floats_b = plain->floats_b;
}

void aim(const PairTask& task, LaneBlock& block) {
  block.tolerance_of_size = task.tolerance_of_size;
  block.tolerance = task.tolerance;
  block.polish = task.polish;
  block.branches = task.moving != nullptr;
  block.centres_are_exact = task.separations == nullptr && !task.follows();
  block.factor_error = task.moving != nullptr ? kOfRotation : 0.0;
}

}  // namespace

Ellipsoid made_body(const char* call, const MovingBodies& bodies, std::size_t body) noexcept {
  try {
    return bodies[body];
  } catch (const InvalidEllipsoid& invalid) {
    contract::no_ellipsoid(call, body, invalid.what());
  }
}

void require_separations(const char* call, const PairList& list,
                         bool bodies_have_centres) noexcept {
  if (!list.separations.empty() || !bodies_have_centres)
    contract::require_length(call, "separations", list.separations.size(), list.pairs.size());
}

PairTask::PairTask(const char* of_call, const BodyArray& of_bodies, const PairList& list) noexcept
    : call(of_call),
      bodies(&of_bodies),
      lanes(of_bodies.lanes()),
      rows(of_bodies.rows()),
      floats(of_bodies.floats()),
      body_count(of_bodies.size()),
      pairs(list.pairs.data()),
      separations(data_or_null(list.separations)),
      count(list.pairs.size()) {
  require_separations(call, list, true);
}

PairTask::PairTask(const char* of_call, const MovingBodies& of_bodies,
                   const PairList& list) noexcept
    : call(of_call),
      moving(&of_bodies),
      lanes(of_bodies.lanes()),
      rows(of_bodies.rows()),
      floats(of_bodies.floats()),
      body_count(of_bodies.size()),
      pairs(list.pairs.data()),
      separations(data_or_null(list.separations)),
      count(list.pairs.size()) {
  require_separations(call, list, of_bodies.has_centres());
}

PairTask::PairTask(const char* of_call, std::span<const Ellipsoid> a, std::span<const Ellipsoid> b,
                   std::span<const Vec3> given_separations) noexcept
    : call(of_call),
      plain_a(a.data()),
      plain_b(b.data()),
      separations(data_or_null(given_separations)),
      count(a.size()) {
  contract::require_length(call, "b", b.size(), count);
  if (!given_separations.empty())
    contract::require_length(call, "separations", given_separations.size(), count);
}

Vec3 PairTask::separation(std::size_t i) const noexcept {
  if (separations != nullptr) return separations[i];
  if (!indexed()) return plain_b[i].centre() - plain_a[i].centre();
  return Vec3::Map(lanes[pairs[i].b].centre) - Vec3::Map(lanes[pairs[i].a].centre);
}

Gap PairTask::single(std::size_t i, const Vec3* previous_normal) const noexcept {
  require_finite_separation(i);
  if (moving != nullptr) {
    return single(i, made_body(call, *moving, pairs[i].a), made_body(call, *moving, pairs[i].b),
                  previous_normal);
  }
  return single(i, a(i), b(i), previous_normal);
}

Gap PairTask::single(std::size_t i, const Ellipsoid& a, const Ellipsoid& b,
                     const Vec3* previous_normal) const noexcept {
  if (separations != nullptr || previous_normal == nullptr)
    return single_gap(a, b, separations != nullptr ? separations + i : nullptr, previous_normal);
  const Vec3 d = b.centre() - a.centre();
  if (!d.allFinite()) return signed_gap(a, b);  // that of the centres, which overflows
  return single_gap(a, b, &d, previous_normal);
}

BoundedGap PairTask::bounded(std::size_t i) const noexcept {
  require_finite_separation(i);
  const auto ask = [&](const Ellipsoid& a, const Ellipsoid& b) {
    return separations != nullptr ? bounded_gap(a, b, separations[i]) : bounded_gap(a, b);
  };
  if (moving == nullptr) return ask(a(i), b(i));
  return ask(made_body(call, *moving, pairs[i].a), made_body(call, *moving, pairs[i].b));
}

bool PairTask::overlaps(std::size_t i) const noexcept {
  if (separations == nullptr) return tangency::overlaps(a(i), b(i));
  require_finite_separation(i);
  return tangency::overlaps(a(i), b(i), separations[i]);
}

std::optional<bool> PairTask::overlaps_by_filter(std::size_t i) const noexcept {
  if (separations == nullptr) return tangency::overlaps_by_filter(a(i), b(i));
  require_finite_separation(i);
  return tangency::overlaps_by_filter(a(i), b(i), separations[i]);
}

/// The difference is rounded by half of what nextafter() takes off.
Gap PairTask::wanted(const Gap& gap) const noexcept {
  if (!has_cutoff()) return gap;
  const double least = std::nextafter(gap.gap - gap.gap_error, -kInfinity);
  return least > cutoff ? beyond(least) : gap;
}

void PairTask::require_finite_separation(std::size_t i) const noexcept {
  if (separations != nullptr) contract::require_finite(call, "separation", separations[i]);
}

void PairTask::require_floats() const noexcept {
  if (body_count > 0 && floats == nullptr && (in_floats() || has_cutoff()))
    contract::no_floats(call);
}

/// The two indices of a pair are one number p of 64 bits: where neither half has its highest bit,
/// p + room has that of each half that is no index. Four instructions a pair, or two where the
/// compiler takes two at once.
void PairTask::require_indices(std::size_t first, std::size_t n) const noexcept {
  static_assert(sizeof(IndexedPair) == sizeof(std::uint64_t));
  constexpr std::uint64_t kHalf = std::uint64_t{1} << 31, kBoth = (kHalf << 1) + 1;
  const std::size_t size = body_count;
  const auto is_inside = [&](const IndexedPair& pair) { return pair.a < size && pair.b < size; };
  if (size > kHalf) {
    if (!std::all_of(pairs + first, pairs + first + n, is_inside)) name_outside(first, n);
    return;
  }
  const std::uint64_t room = kBoth * (kHalf - size);
  std::uint64_t outside = 0;
  const auto look_at = [&](std::size_t some) {
    for (std::size_t i = 0; i < some; ++i) {
      const auto both = std::bit_cast<std::uint64_t>(pairs[first + i]);
      outside |= (both + room) | both;
    }
  };
  n == kBlock ? look_at(kBlock) : look_at(n);  // a constant number is taken two at once
  if ((outside & (kBoth * kHalf)) != 0) name_outside(first, n);
}

void PairTask::name_outside(std::size_t first, std::size_t n) const noexcept {
  for (std::size_t i = first; i < first + n; ++i) {
    if (pairs[i].a >= body_count) contract::outside(call, i, 'a', pairs[i].a, body_count);
    if (pairs[i].b >= body_count) contract::outside(call, i, 'b', pairs[i].b, body_count);
  }
  std::abort();  // never: the caller saw one
}

void OpenPairs::add(const Workspace& from, std::size_t i, std::size_t at, const Vec3& given,
                    const Vec3& start) noexcept {
  const LaneBlock& block = from.block;
  const auto here = static_cast<std::uint32_t>(count);
  place[count] = at;
  previous[count] = given;
  work.normals[count] = start;
  work.pairs[count] = block.bodies_a == block.bodies_b ? block.pairs[i] : IndexedPair{here, here};
  if (block.separations != nullptr) work.separations[count] = Vec3::Map(block.separations + 3 * i);
  ++count;
}

void OpenPairs::complete(const PairTask& task, PlainRows* plain) noexcept {
  LaneBlock& block = work.block;
  aim(task, block);
  block.count = static_cast<int>(count);
  block.next_pairs = nullptr;
  find_bodies(
      task, count, [&](std::size_t k) { return place[k]; }, block, plain);
  block.pairs = work.pairs;
  block.separations = task.separations != nullptr ? work.separations[0].data() : nullptr;
  block.normals = work.normals[0].data();
  block.nearer_normals = work.nearer_normals[0].data();
  std::fill(work.pairs + count, work.pairs + kBlock, work.pairs[0]);
  std::fill(work.separations + count, work.separations + kBlock, work.separations[0]);
  std::fill(work.normals + count, work.normals + kBlock, work.normals[0]);
  work.take_answers();
}

void Workspace::take_answers() noexcept {
  block.gap = gap;
  block.gap_error = gap_error;
  block.normal = normal[0].data();
  block.arm_a = arm_a[0].data();
  block.arm_b = arm_b[0].data();
}

void gather(const PairTask& task, std::size_t first, std::size_t count, Workspace& work,
            PlainRows* plain) noexcept {
  LaneBlock& block = work.block;
  block.count = static_cast<int>(count);
  block.next_pairs = nullptr;
  block.nearer_normals = work.nearer_normals[0].data();
  find_bodies(
      task, count, [&](std::size_t k) { return first + k; }, block, plain);
  if (task.indexed()) {
    block.pairs = block_of(task.pairs, first, count, work.pairs);
    if (task.body_count > kNear && first + 2 * kBlock <= task.count)
      block.next_pairs = task.pairs + first + kBlock;
  } else {
    block.pairs = work.pairs;
    for (std::uint32_t i = 0; i < kBlock; ++i) {
      work.pairs[i] = i < count ? IndexedPair{i, i} : IndexedPair{0, 0};
    }
  }
  aim(task, block);
  block.separations = nullptr;
  block.normals = nullptr;
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
  if (task.previous_floats != nullptr) {
    for (std::size_t i = 0; i < count; ++i)
      work.normals[i] = task.previous_floats[first + i].cast<double>();
    std::fill(work.normals + count, work.normals + kBlock, work.normals[0]);
    block.normals = work.normals[0].data();
  }
}

}  // namespace tangency::inline v0::detail
