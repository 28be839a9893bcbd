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
namespace tangency::detail::HWY_NAMESPACE {
namespace {

constexpr int kPerramWertheimSteps = 2;  // measured: more do not shorten what follows
constexpr double kSteady = 0.02;         // of l: measured, as good as one step more
// The cosine of how far a normal may turn on its branch. Chosen: a step turns it by 1e-4 rad.
constexpr double kSameBranch = 0.99;
constexpr int kSteps = 7;  // of Newton's with proofs; chosen: measured pairs need 1 to 4

/// LaneBody by columns.
HWY_INLINE PackBody load_body(const Rows* rows) {
  return load_rows<16>(rows, [](const auto& column) HWY_ATTR {
    const auto vector = [&](std::size_t c) HWY_ATTR {
      return PackVec3{column(c), column(c + 1), column(c + 2)};
    };
    return PackBody{vector(0), column(3), column(4), {vector(5), vector(8), vector(11)}};
  });
}

/// M = S S'
HWY_INLINE PackSymmetric3 shape(const PackBody& body) {
  const PackVec3 &p = body.factor[0], &q = body.factor[1], &r = body.factor[2];
  const PackVec3 x{p.x, q.x, r.x}, y{p.y, q.y, r.y}, z{p.z, q.z, r.z};
  return {dot(x, x), dot(y, y), dot(z, z), dot(y, z), dot(z, x), dot(x, y)};
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
  if (block.normals == nullptr)
    return {perram_wertheim_normal(pair, shape_a, shape_b), all(0.0) <= all(0.0)};
  const PackVec3 previous = load_vectors(block.normals + 3 * i);
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

/// All lanes from index i on; the settled ones as bits.
HWY_INLINE std::uint64_t solve(LaneBlock& block, std::size_t i) {
  const PackPair pair = load_pair(block, i);
  const PackSymmetric3 shape_a = shape(pair.a), shape_b = shape(pair.b);
  const PackStart start = first_normal(block, i, pair, shape_a, shape_b);
  PackVec3 n = start.normal;
  // False for NaN, which is how bodies that are not moderate() stay out.
  PackMask going =
      (pair.size <= all(kLargestModerate)) & (largest_component(pair.d) >= all(kSmallestModerate));
  const PackMask in_range = going;
  const PackMask coarse = pair.tolerance >= all(block.coarse) * pair.size;
  const auto first_step = [&](const PackMask& asked) HWY_ATTR {
    if (none(asked)) return;
    const PackPoint at = point_of(pair, n, glance(shape_a, n), glance(shape_b, n));
    PackMask moving = asked;
    move(newton_step(shape_a, shape_b, pair.size, n, at), moving, n);
    going = moving | without(going, asked);
  };
  // A moment ago the normal was good to some 1e-4, the start of a cold search is to 1e-2: one step
  // more. A coarse answer takes one less.
  first_step(without(going & start.fresh, coarse));
  first_step(without(going, without(coarse, start.fresh)));
  PackMask local = all(0.0) < all(0.0);  // settled as the value of a branch, if at all
  const auto proof_at = [&](const PackVec3& normal, const PackPoint& there) HWY_ATTR {
    const PackBounds off = bounds(pair, normal, there);
    PackProof found = prove(pair, there, off);
    if (!block.branches) return found;
    local = in_range & deep(pair, there.gap + off.value_error);
    if (none(local)) return found;
    const PackStep step = newton_step(shape_a, shape_b, pair.size, normal, there);
    return chosen(local, prove_branch(pair, there, off, step), found);
  };
  PackPoint at;
  PackProof proof;
  for (int k = 0;; ++k) {
    at = point_of(pair, n, support(pair.a, n), support(pair.b, n));
    proof = proof_at(n, at);
    going = without(going, proof.best);
    if (k == kSteps - 1) going = without(going, start.fresh);  // which had one before
    if (none(going) || k == kSteps) break;
    move(newton_step(shape_a, shape_b, pair.size, n, at), going, n);
  }
  if (block.polish) {
    const PackMask local_before = local;
    PackMask all_lanes = in_range;
    PackVec3 better = n;
    move(newton_step(shape_a, shape_b, pair.size, n, at), all_lanes, better);
    const PackPoint there =
        point_of(pair, better, support(pair.a, better), support(pair.b, better));
    const PackProof also = proof_at(better, there);
    n = chosen(also.settled, better, n);
    at = chosen(also.settled, there, at);
    proof = chosen(also.settled, also, proof);
    local = chosen(also.settled, local, local_before);
  }
  local = local & proof.settled;
  if (!none(local)) {
    // Asked afresh it is the global gap that is wanted; and a branch is followed, not jumped to.
    const PackMask stayed = without(dot(n, start.normal) >= all(kSameBranch), start.fresh);
    const PackMask sound = stayed & meet(pair, shape_a, shape_b, at, local);
    proof.settled = without(proof.settled, without(local, sound));
    local = local & sound;
    block.local |= bits(local) << i;
  }
  if (block.gap != nullptr) store(proof.gap, block.gap + i);
  if (block.gap_error != nullptr) store(proof.error, block.gap_error + i);
  if (block.normal != nullptr) store(n, block.normal + 3 * i);
  if (block.arm_a != nullptr) store(at.point_a, block.arm_a + 3 * i);
  if (block.arm_b != nullptr) store(-at.point_b, block.arm_b + 3 * i);
  return bits(proof.settled & in_range);
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
}  // namespace tangency::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::detail {
namespace {
HWY_EXPORT(gap_lanes);
}  // namespace

std::uint64_t gap_lanes(LaneBlock& block) noexcept {
  return HWY_DYNAMIC_DISPATCH(gap_lanes)(block);
}

}  // namespace tangency::detail
#endif
