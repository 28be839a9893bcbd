// SPDX-License-Identifier: MIT
#include <tangency/geometry/methods/gap_lanes.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/methods/gap_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <tangency/geometry/methods/pack_bodies-inl.hpp>
#include <tangency/geometry/methods/perram_wertheim_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::methods::HWY_NAMESPACE {
namespace {

constexpr double kUnitRoundoff = 0x1p-53;
constexpr double kLargest = 0x1p60, kSmallest = 0x1p-60;  // as for one pair: gap.cpp
// Of u L: below this no step can tell. Chosen: a sixteenth of what is published.
constexpr double kEnough = 1.0;
constexpr int kPerramWertheimSteps = 2;  // measured: more do not shorten what follows
constexpr double kSteady = 0.02;         // of l: measured, as good as one step more
constexpr int kSteps = 8;                // chosen: measured pairs need 1 to 4

struct PackPair : PackBodies {
  Pack d_error;  ///< of d, over u
  Pack size;     ///< L, and no more
};

/// What is evaluated at a normal.
struct PackPoint {
  Pack inverse_h_a, inverse_h_b;
  PackVec3 point_a, point_b;  ///< support points
  PackVec3 beyond_a, rest;
  Pack gap;
};

struct PackSupport {
  Pack inverse_h;
  PackVec3 point;
};

HWY_INLINE PackSupport support(const PackBody& body, const PackVec3& n) {
  const PackVec3* s = body.factor;
  const PackVec3 y{dot(s[0], n), dot(s[1], n), dot(s[2], n)};
  const Pack inverse = inverse_root(dot(y, y));
  const PackVec3 k = y * inverse;
  return {inverse, multiply_add(k.z, s[2], multiply_add(k.y, s[1], s[0] * k.x))};
}

HWY_INLINE PackPoint evaluate(const PackPair& pair, const PackVec3& n) {
  const PackSupport a = support(pair.a, n), b = support(pair.b, n);
  const PackVec3 beyond_a = pair.d - a.point, rest = beyond_a - b.point;
  return {a.inverse_h, b.inverse_h, a.point, b.point, beyond_a, rest, dot(n, rest)};
}

/// What that proves.
struct PackProof {
  Pack error;
  PackMask settled;
  PackMask best;  ///< settled, and no better normal would make `error` much smaller
};

/// docs/derivations/gap-batch.md, whose names for the bounds stand here.
HWY_INLINE PackProof prove(const PackPair& pair, const PackVec3& n, const PackPoint& at) {
  const Pack u = all(kUnitRoundoff), above0 = all(0.0), size = absolute(at.gap);
  const Pack axes = pair.a.largest + pair.b.largest;
  // (V)
  Pack roundings = multiply_add(all(12.9), axes, pair.d_error);
  roundings = multiply_add(all(2.02), largest_component(at.beyond_a), roundings);
  const Pack value_error = u * multiply_add(all(9.61), size, roundings);
  const Pack ball = (at.gap - value_error) + (pair.a.least_radius + pair.b.least_radius);
  // (R)
  const Pack radii = multiply_add(pair.a.largest * pair.a.largest, at.inverse_h_a,
                                  (pair.b.largest * pair.b.largest) * at.inverse_h_b);
  const Pack rest_error = u * multiply_add(all(8.01), radii, all(32.0) * (axes + size));
  const PackVec3 across = multiply_take(at.gap, n, at.rest);
  // (B), with room for the roughness of the inverse.
  const Pack reach2 = all(1.02) * multiply_add(rest_error, rest_error, dot(across, across));
  const Pack above = reach2 * rough_inverse(ball);
  const Pack error = (value_error + above) * all(1.0 + 0x1p-50);
  const PackMask settled = (size > error) &
                           (error <= all(kLaneErrorBound * kUnitRoundoff) * pair.size) &
                           (ball > above0);
  return {error, settled, settled & (above <= all(kEnough * kUnitRoundoff) * pair.size)};
}

/// Newton's method for n.d - h_A - h_B on the sphere: the step in the tangent plane, and whether
/// the Hessian there is definite.
struct PackStep {
  PackVec3 move;
  PackMask definite;
};

HWY_INLINE PackStep newton_step(const PackSymmetric3& shape_a, const PackSymmetric3& shape_b,
                                const Pack& size, const PackVec3& n, const PackPoint& at) {
  // H = Hess (h_A + h_B) = (M - x x') / h of both; H n = 0. With K = H + gap (I - n n') + L n n'
  // the step is K^-1 r, as r is normal to n.
  const Pack wa = at.inverse_h_a, wb = at.inverse_h_b;
  PackSymmetric3 k = multiply_add(wb, shape_b, shape_a * wa);
  k = with_square(k, -wa, at.point_a);
  k = with_square(k, -wb, at.point_b);
  k = with_square(k, size - at.gap, n);
  k.xx = k.xx + at.gap;
  k.yy = k.yy + at.gap;
  k.zz = k.zz + at.gap;
  const PackSymmetric3 adj = adjugate(k);
  const Pack determinant = dot({k.xx, k.xy, k.zx}, {adj.xx, adj.xy, adj.zx});
  const PackVec3 r = multiply_take(at.gap, n, at.rest);
  return {(adj * r) * (all(1.0) / determinant),
          (determinant > all(0.0)) & (trace(k) - size > all(0.0))};
}

HWY_INLINE PackPair load_pair(const LaneBlock& block, std::size_t i) {
  PackPair pair{load_bodies(block, i), {}, {}};
  const Pack reach = largest_component(pair.d);
  pair.d_error = block.centres_are_exact ? all(1.75) * reach : all(0.0);
  pair.size = reach + (pair.a.largest + pair.b.largest);
  return pair;
}

HWY_INLINE PackVec3 first_normal(const LaneBlock& block, std::size_t i, const PackPair& pair,
                                 const PackSymmetric3& shape_a, const PackSymmetric3& shape_b) {
  if (block.normals != nullptr) return normalised(load_vectors(block.normals + 3 * i));
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

/// All lanes from index i on; the settled ones as bits.
HWY_INLINE std::uint64_t solve(LaneBlock& block, std::size_t i) {
  const PackPair pair = load_pair(block, i);
  const PackSymmetric3 shape_a = shape(pair.a), shape_b = shape(pair.b);
  PackVec3 n = first_normal(block, i, pair, shape_a, shape_b);
  // False for NaN, which is how bodies that are not moderate() stay out.
  PackMask going = (pair.size <= all(kLargest)) & (largest_component(pair.d) >= all(kSmallest));
  const PackMask in_range = going;
  const bool cold = block.normals == nullptr;
  PackPoint at = evaluate(pair, n);
  PackProof proof;
  for (int step = 0; step < kSteps; ++step) {
    const PackStep step_from_n = newton_step(shape_a, shape_b, pair.size, n, at);
    // A lane that is done keeps its normal, so that no answer depends on its neighbours.
    going = going & step_from_n.definite;
    n = chosen(going, normalised(n + step_from_n.move), n);
    at = evaluate(pair, n);
    if (step == 0 && cold) continue;  // not there yet, as good as ever
    proof = prove(pair, n, at);
    going = without(going, proof.best);
    if (none(going)) break;
  }
  if (block.gap != nullptr) store(at.gap, block.gap + i);
  if (block.gap_error != nullptr) store(proof.error, block.gap_error + i);
  if (block.normal != nullptr) store(n, block.normal + 3 * i);
  if (block.arm_a != nullptr) store(at.point_a, block.arm_a + 3 * i);
  if (block.arm_b != nullptr) store(-at.point_b, block.arm_b + 3 * i);
  return bits(proof.settled & in_range);
}

HWY_ATTR std::uint64_t gap_lanes(LaneBlock& block) {
  std::uint64_t settled = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(block.count); i += pack_lanes()) {
    settled |= solve(block, i) << i;
  }
  return settled;
}

}  // namespace
}  // namespace tangency::methods::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::methods {
namespace {
HWY_EXPORT(gap_lanes);
}  // namespace

std::uint64_t gap_lanes(LaneBlock& block) noexcept {
  return HWY_DYNAMIC_DISPATCH(gap_lanes)(block);
}

}  // namespace tangency::methods
#endif
