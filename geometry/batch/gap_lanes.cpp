// SPDX-License-Identifier: MIT
#include <tangency/geometry/batch/gap_lanes.hpp>

#include <cstddef>

#include <tangency/geometry/power_of_two.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/batch/gap_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#define TANGENCY_PACK_REGISTERS 2
#include <tangency/geometry/batch/gap_proofs-inl.hpp>
#include <tangency/geometry/batch/pack_bodies-inl.hpp>
#include <tangency/geometry/batch/perram_wertheim_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

constexpr int kPerramWertheimSteps = 2;  // measured: more do not shorten what follows
constexpr double kSteady = 0.02;         // of l: measured, as good as one step more
// The cosine of how far a normal may turn on its branch. Chosen: a step turns it by 1e-4 rad.
constexpr double kSameBranch = 0.99;
constexpr int kSteps = 7;  // of Newton's with proofs; chosen: measured pairs need 1 to 4

/// M = S S'
HWY_INLINE PackSymmetric3 shape(const PackBody& body) {
  return square_of_factor(body.factor[0], body.factor[1], body.factor[2]);
}

HWY_INLINE PackPair load_pair(const LaneBlock& block, std::size_t i) {
  const PairRows rows = find_rows(block, i, block.bodies_a, block.bodies_b);
  PackPair pair{load_body(rows.a), load_body(rows.b), {}, {}, {}, {}, block.factor_error};
  pair.d = separation(block, i, pair.a.centre, pair.b.centre);
  const Pack reach = largest_component(pair.d);
  pair.d_error = block.centres_are_exact ? all(1.75) * reach : all(0.0);
  pair.size = reach + (pair.a.largest + pair.b.largest);
  pair.tolerance = multiply_add(all(block.tolerance_of_size), pair.size, all(block.tolerance));
  return pair;
}

HWY_INLINE PackVec3 perram_wertheim_normal(const PackPair& pair, const PackSymmetric3& shape_a,
                                           const PackSymmetric3& shape_b) {
  const PackPerramWertheim form(shape_a, shape_b, pair.d);
  Pack l = form.first_guess();
  PackMask moving = absolute(l) >= all(0.0);
  for (int k = 0; k < kPerramWertheimSteps; ++k) {
    const Pack better = next(form.at(l));
    const PackMask far = absolute(better - l) > all(kSteady) * l;
    l = chosen(moving, better, l);
    moving = moving & far;
    if (none(moving)) break;
  }
  const PackVec3 direction = form.direction(l);
  // Its square could underflow.
  return normalised(direction * rough_inverse(largest_component(direction)));
}

/// Where the search starts, and which lanes have no normal of a moment ago.
struct PackStart {
  PackVec3 normal;
  PackMask fresh;
};

HWY_INLINE PackStart first_normal(const LaneBlock& block, std::size_t i, const PackPair& pair,
                                  const PackSymmetric3& shape_a, const PackSymmetric3& shape_b) {
  PackVec3 previous{all(0.0), all(0.0), all(0.0)};
  if (block.normals != nullptr) previous = load_normals(block.normals + 3 * i);
  PackStart start{normalised(previous), is_nothing(previous)};
  if (!none(start.fresh)) {
    const PackVec3 normal = perram_wertheim_normal(pair, shape_a, shape_b);
    start.normal = chosen(start.fresh, normal, start.normal);
  }
  return start;
}

/// A lane that is done keeps its normal, so that no answer depends on its neighbours.
HWY_INLINE void move(const PackStep& step, PackMask& going, PackVec3& n) {
  going = going & step.definite;
  n = chosen(going, normalised(n + step.move), n);
}

struct PackAnswer {
  PackProof proof;
  PackVec3 n;
  PackPoint at;
};

HWY_INLINE void write(const PackAnswer& answer, const LaneBlock& to, std::size_t i) {
  if (to.gap != nullptr) store(answer.proof.gap, to.gap + i);
  if (to.gap_error != nullptr) store(answer.proof.error, to.gap_error + i);
  if (to.normal != nullptr) store(answer.n, to.normal + 3 * i);
  if (to.arm_a != nullptr) store(answer.at.point_a, to.arm_a + 3 * i);
  if (to.arm_b != nullptr) store(-answer.at.point_b, to.arm_b + 3 * i);
}

/// The lanes of `which` alone.
HWY_INLINE void write_some(const PackAnswer& answer, std::uint64_t which, const LaneBlock& to,
                           std::size_t i) {
  constexpr std::size_t kLanes = TANGENCY_PACK_REGISTERS * kMostLanes;
  double gap[kLanes], gap_error[kLanes], normal[3 * kLanes], arm_a[3 * kLanes], arm_b[3 * kLanes];
  LaneBlock here = to;
  here.gap = gap, here.gap_error = gap_error;
  here.normal = normal, here.arm_a = arm_a, here.arm_b = arm_b;
  write(answer, here, 0);
  const auto copy = [](const double* from, double* column, std::size_t count) HWY_ATTR {
    if (column == nullptr) return;
    for (std::size_t c = 0; c < count; ++c) column[c] = from[c];
  };
  for (std::size_t k = 0; k < pack_lanes(); ++k) {
    if ((which >> k & 1) == 0) continue;
    copy(gap + k, to.gap != nullptr ? to.gap + i + k : nullptr, 1);
    copy(gap_error + k, to.gap_error != nullptr ? to.gap_error + i + k : nullptr, 1);
    copy(normal + 3 * k, to.normal != nullptr ? to.normal + 3 * (i + k) : nullptr, 3);
    copy(arm_a + 3 * k, to.arm_a != nullptr ? to.arm_a + 3 * (i + k) : nullptr, 3);
    copy(arm_b + 3 * k, to.arm_b != nullptr ? to.arm_b + 3 * (i + k) : nullptr, 3);
  }
}

/// The branch that each of the asked lanes is on, which have a normal of a moment ago, from another
/// near it; those that are settled as bits. A branch is followed and not jumped to, and bodies that
/// are apart are never said to overlap. Out of line, as it would take registers from what every
/// pack needs.
HWY_NOINLINE std::uint64_t follow_deep(LaneBlock& block, std::size_t i, const PackVec3& from,
                                       const PackMask& asked) {
  const PackPair pair = load_pair(block, i);
  const PackSymmetric3 shape_a = shape(pair.a), shape_b = shape(pair.b);
  const auto look = [&](const PackVec3& n) HWY_ATTR {
    return point_of(pair, n, support(pair.a, n), support(pair.b, n));
  };
  PackAnswer answer{{}, from, {}};
  PackMask going = asked, enough = none_of_them();
  for (int k = 0;; ++k) {
    answer.at = look(answer.n);
    const PackStep step = newton_step(shape_a, shape_b, pair.size, answer.n, answer.at);
    answer.proof = prove_branch(pair, answer.at, bounds(pair, answer.n, answer.at), step);
    // A normal to rounding is a step more than the gap needs.
    const PackMask needed = answer.proof.best;
    going = without(going, block.polish ? enough : needed);
    enough = needed;
    if (none(going) || k == kSteps) break;
    move(step, going, answer.n);
  }
  const PackVec3 previous = normalised(load_normals(block.normals + 3 * i));
  const PackMask stayed = dot(answer.n, previous) >= all(kSameBranch);
  PackMask settled = asked & answer.proof.settled & stayed;
  if (none(settled)) return 0;
  settled = settled & meet(pair, shape_a, shape_b, answer.at, settled);
  const std::uint64_t which = bits(settled);
  write_some(answer, which, block, i);
  block.local |= which << i;
  return which;
}

/// All lanes from index i on; the settled ones as bits.
HWY_INLINE std::uint64_t solve(LaneBlock& block, std::size_t i) {
  const PackPair pair = load_pair(block, i);
  const PackSymmetric3 shape_a = shape(pair.a), shape_b = shape(pair.b);
  const PackStart start = first_normal(block, i, pair, shape_a, shape_b);
  PackVec3 n = start.normal;
  const auto thick = [](const PackBody& body) HWY_ATTR {
    return body.least_radius >= all(kThinnestInLanes) * body.largest;
  };
  // False for NaN, which is how bodies that are not moderate() stay out.
  PackMask going = (pair.size <= all(kLargestModerate)) &
                   (largest_component(pair.d) >= all(kSmallestModerate)) & thick(pair.a) &
                   thick(pair.b);
  const PackMask in_range = going;
  const PackMask coarse = pair.tolerance >= all(block.coarse) * pair.size;
  // Of a coarse answer the first step is left out.
  const int late = block.first_steps - block.followed_steps;
  for (int k = none(start.fresh) ? late : 0; k < block.first_steps; ++k) {
    PackMask asked = going;
    if (k == 0) asked = without(asked, start.fresh & coarse);
    if (k < late) asked = asked & start.fresh;
    if (k == late) asked = without(asked, without(coarse, start.fresh));
    if (none(asked)) continue;
    const PackPoint at = point_of(pair, n, glance(shape_a, n), glance(shape_b, n));
    PackMask moving = asked;
    move(newton_step(shape_a, shape_b, pair.size, n, at), moving, n);
    going = moving | without(going, asked);
  }
  PackPoint at;
  PackProof proof;
  PackMask too_deep = none_of_them();
  for (int k = 0;; ++k) {
    at = point_of(pair, n, support(pair.a, n), support(pair.b, n));
    const PackBounds off = bounds(pair, n, at);
    proof = prove(pair, at, off);
    going = without(going, proof.best);
    if (block.branches) {
      too_deep = too_deep | (going & deep(pair, at.gap + off.value_error));
      going = without(going, too_deep);
    }
    if (k == kSteps - 1) going = without(going, start.fresh);  // which had one before
    if (none(going) || k == kSteps) break;
    move(newton_step(shape_a, shape_b, pair.size, n, at), going, n);
  }
  if (block.polish) {
    PackMask all_lanes = in_range;
    PackVec3 better = n;
    move(newton_step(shape_a, shape_b, pair.size, n, at), all_lanes, better);
    const PackPoint there =
        point_of(pair, better, support(pair.a, better), support(pair.b, better));
    const PackProof also = prove(pair, there, bounds(pair, better, there));
    n = chosen(also.settled, better, n);
    at = chosen(also.settled, there, at);
    proof = chosen(also.settled, also, proof);
  }
  write({proof, n, at}, block, i);
  std::uint64_t settled = bits(proof.settled & in_range);
  const PackMask followed = without(too_deep, start.fresh);  // else the global gap is wanted
  if (!none(followed)) {
    const PackVec3 from = n;  // copies, so that only they have to be in memory
    const PackMask asked = followed;
    settled |= follow_deep(block, i, from, asked);
  }
  return settled;
}

HWY_ATTR std::uint64_t gap_lanes(LaneBlock& block) {
  block.local = 0;
  std::uint64_t settled = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(block.count); i += pack_lanes()) {
    settled |= solve(block, i) << i;
  }
  return settled;
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::detail {
namespace {
HWY_EXPORT(gap_lanes);
}  // namespace

std::uint64_t gap_lanes(LaneBlock& block) noexcept {
  return HWY_DYNAMIC_DISPATCH(gap_lanes)(block);
}

}  // namespace tangency::inline v0::detail
#endif
