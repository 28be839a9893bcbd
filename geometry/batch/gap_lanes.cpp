// SPDX-License-Identifier: MIT
#include <tangency/geometry/batch/gap_lanes.hpp>

#include <cstddef>

#include <tangency/geometry/gap/error_bounds.hpp>
#include <tangency/geometry/power_of_two.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/batch/gap_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#define TANGENCY_PACK_REGISTERS 2
#include <tangency/geometry/batch/pack_bodies-inl.hpp>
#include <tangency/geometry/batch/perram_wertheim_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::detail::HWY_NAMESPACE {
namespace {

// Of u L, what a better normal may still gain; half of it is in doubt. Chosen: no more than
// rounding is. With 4.0 following moderate shapes takes 15 % less time and errs twice as much.
constexpr double kWorthAStep = 1.0;
constexpr int kPerramWertheimSteps = 2;  // measured: more do not shorten what follows
constexpr double kSteady = 0.02;         // of l: measured, as good as one step more
constexpr int kSteps = 7;  // of Newton's with proofs; chosen: measured pairs need 1 to 4

struct PackBody {
  PackVec3 centre;
  Pack largest, least_radius;
  PackVec3 factor[3];
};

struct PackPair {
  PackBody a, b;
  PackVec3 d;
  Pack d_error;  ///< of d, over u
  Pack size;     ///< L, and no more
  Pack tolerance;
  double factor_error;  ///< LaneBlock's
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

/// The same from M = S S', quicker and only good enough to see where to go.
HWY_INLINE PackSupport glance(const PackSymmetric3& shape, const PackVec3& n) {
  const PackVec3 point = shape * n;
  const Pack inverse = inverse_root(dot(n, point));
  return {inverse, point * inverse};
}

HWY_INLINE PackPoint point_of(const PackPair& pair, const PackVec3& n, const PackSupport& a,
                              const PackSupport& b) {
  const PackVec3 beyond_a = pair.d - a.point, rest = beyond_a - b.point;
  return {a.inverse_h, b.inverse_h, a.point, b.point, beyond_a, rest, dot(n, rest)};
}

/// What that proves.
struct PackProof {
  Pack gap;  ///< in the middle of what is proven
  Pack error;
  PackMask settled;
  PackMask best;  ///< settled, and no better normal would make `error` much smaller
};

/// docs/derivations/gap-batch.md, whose names for the bounds stand here.
HWY_INLINE PackProof prove(const PackPair& pair, const PackVec3& n, const PackPoint& at) {
  const Pack u = all(kUnitRoundoff), above0 = all(0.0), size = absolute(at.gap);
  const Pack axes = pair.a.largest + pair.b.largest;
  // (V)
  Pack roundings = multiply_add(all(13.0 + pair.factor_error), axes, pair.d_error);
  roundings = multiply_add(all(kOfReach), largest_component(at.beyond_a), roundings);
  const Pack value_error = u * multiply_add(all(10.8), size, roundings);
  const Pack ball = (at.gap - value_error) + (pair.a.least_radius + pair.b.least_radius);
  // (R)
  const Pack thin_a = pair.a.largest * at.inverse_h_a, thin_b = pair.b.largest * at.inverse_h_b;
  const Pack radii = multiply_add(pair.a.largest, thin_a, pair.b.largest * thin_b);
  const Pack rest_error =
      u * multiply_add(all(8.01 + 1.01 * pair.factor_error), radii, all(32.0) * (axes + size));
  const PackVec3 across = multiply_take(at.gap, n, at.rest);
  // (B), with room for the roughness of the inverse.
  const Pack error2 = all(5.1) * (rest_error * rest_error);
  const Pack above = multiply_add(all(0.57), dot(across, across), error2) * rough_inverse(ball);
  const Pack half = all(0.5) * above, gap = at.gap + half;
  const Pack error = (value_error + half) * all(1.0 + 0x1p-50);
  const auto within = [&](double roundings_of_size) HWY_ATTR {
    return multiply_add(all(roundings_of_size * kUnitRoundoff), pair.size, pair.tolerance);
  };
  const PackMask settled = (absolute(gap) > error) &
                           (error <= within(kLaneErrorBound + pair.factor_error)) &
                           (ball > above0) & (larger(thin_a, thin_b) <= all(kThinnestAlongNormal));
  return {gap, error, settled, settled & (above <= within(kWorthAStep))};
}

HWY_INLINE PackPoint chosen(const PackMask& yes, const PackPoint& a, const PackPoint& b) {
  return {chosen(yes, a.inverse_h_a, b.inverse_h_a),
          chosen(yes, a.inverse_h_b, b.inverse_h_b),
          chosen(yes, a.point_a, b.point_a),
          chosen(yes, a.point_b, b.point_b),
          chosen(yes, a.beyond_a, b.beyond_a),
          chosen(yes, a.rest, b.rest),
          chosen(yes, a.gap, b.gap)};
}
/// `best` is that of b: it is not asked for any more.
HWY_INLINE PackProof chosen(const PackMask& yes, const PackProof& a, const PackProof& b) {
  return {chosen(yes, a.gap, b.gap), chosen(yes, a.error, b.error), a.settled | b.settled, b.best};
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
  return {(adj * r) * quick_inverse(determinant),
          (determinant > all(0.0)) & (trace(k) - size > all(0.0))};
}

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
  PackPoint at;
  PackProof proof;
  for (int k = 0;; ++k) {
    at = point_of(pair, n, support(pair.a, n), support(pair.b, n));
    proof = prove(pair, n, at);
    going = without(going, proof.best);
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
    const PackProof also = prove(pair, better, there);
    n = chosen(also.settled, better, n);
    at = chosen(also.settled, there, at);
    proof = chosen(also.settled, also, proof);
  }
  if (block.gap != nullptr) store(proof.gap, block.gap + i);
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
