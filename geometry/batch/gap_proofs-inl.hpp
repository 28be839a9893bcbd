// SPDX-License-Identifier: MIT
/// @file
/// What a normal proves about the gap of a pair, one pair in each lane:
/// docs/derivations/gap-batch.md. Compiled once for each instruction set.
#if defined(TANGENCY_GAP_PROOFS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_GAP_PROOFS_INL
#undef TANGENCY_GAP_PROOFS_INL
#else
#define TANGENCY_GAP_PROOFS_INL
#endif

#include <cstddef>

#include <tangency/geometry/batch/newton_lanes-inl.hpp>
#include <tangency/geometry/batch/pack_bodies-inl.hpp>
#include <tangency/geometry/batch/packs-inl.hpp>
#include <tangency/geometry/gap/error_bounds.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

// Of u L, what a better normal may still gain; half of it is in doubt. Chosen: no more than
// rounding is. With 4.0 following moderate shapes takes 15 % less time and errs twice as much.
constexpr double kWorthAStep = 1.0;
struct PackBody {
  PackVec3 centre;
  Pack largest, least_radius;
  PackVec3 factor[3];
};

/// LaneBody by columns.
HWY_INLINE PackBody load_body(const Rows* rows) {
  return load_rows<16>(rows, [](const auto& column) HWY_ATTR {
    const auto vector = [&](std::size_t c) HWY_ATTR {
      return PackVec3{column(c), column(c + 1), column(c + 2)};
    };
    return PackBody{vector(0), column(3), column(4), {vector(5), vector(8), vector(11)}};
  });
}

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

HWY_INLINE PackSupport support(const PackBody& body, const PackVec3& n) {
  const PackVec3* s = body.factor;
  const PackVec3 y{dot(s[0], n), dot(s[1], n), dot(s[2], n)};
  const Pack inverse = inverse_root(dot(y, y));
  const PackVec3 k = y * inverse;
  return {inverse, multiply_add(k.z, s[2], multiply_add(k.y, s[1], s[0] * k.x))};
}

/// Writes the arms that are asked for, of pairs i and on: support points by the factors.
HWY_INLINE void write_arms(const LaneBlock& to, std::size_t i, const PackVec3& n) {
  if (to.arm_a == nullptr && to.arm_b == nullptr) return;
  const PairRows rows = find_rows(to, i, to.bodies_a, to.bodies_b);
  if (to.arm_a != nullptr) store(support(load_body(rows.a), n).point, to.arm_a + 3 * i);
  if (to.arm_b != nullptr) store(-support(load_body(rows.b), n).point, to.arm_b + 3 * i);
}

HWY_INLINE PackPoint point_of(const PackPair& pair, const PackVec3& n, const PackSupport& a,
                              const PackSupport& b) {
  const PackVec3 beyond_a = pair.d - a.point, rest = beyond_a - b.point;
  return {a.inverse_h, b.inverse_h, a.point, b.point, beyond_a, rest, dot(n, rest)};
}

/// How far what was evaluated can be off: docs/derivations/gap-batch.md, whose names stand here.
struct PackBounds {
  Pack value_error;  ///< (V)
  Pack radii;        ///< a^2 / h of both: at least the largest radius of curvature along n
  Pack thin;         ///< a / h, the larger
  Pack half_reach2;  ///< half of the square of the tangential rest and its error, (R), and more
};

HWY_INLINE PackBounds bounds(const PackPair& pair, const PackVec3& n, const PackPoint& at) {
  const Pack u = all(kUnitRoundoff), size = absolute(at.gap);
  const Pack axes = pair.a.largest + pair.b.largest;
  // (V)
  Pack roundings = multiply_add(all(13.0 + pair.factor_error), axes, pair.d_error);
  roundings = multiply_add(all(kOfReach), largest_component(at.beyond_a), roundings);
  // (R)
  const Pack thin_a = pair.a.largest * at.inverse_h_a, thin_b = pair.b.largest * at.inverse_h_b;
  const Pack radii = multiply_add(pair.a.largest, thin_a, pair.b.largest * thin_b);
  const Pack rest_error =
      u * multiply_add(all(8.01 + 1.01 * pair.factor_error), radii, all(32.0) * (axes + size));
  const PackVec3 across = multiply_take(at.gap, n, at.rest);
  // (B), with room for the roughness of the inverse that it meets.
  const Pack error2 = all(5.1) * (rest_error * rest_error);
  return {u * multiply_add(all(10.8), size, roundings), radii, larger(thin_a, thin_b),
          multiply_add(all(0.57), dot(across, across), error2)};
}

/// What that proves.
struct PackProof {
  Pack gap;  ///< in the middle of what is proven
  Pack error;
  PackMask settled;
  PackMask best;  ///< no better normal would make `error` much smaller
};

/// @param ball  the maximum is no further above the value than reach^2 / (2 ball) where `sound`
HWY_INLINE PackProof proof_of(const PackPair& pair, const PackPoint& at, const PackBounds& bounds,
                              const Pack& ball, const PackMask& sound) {
  const Pack above = bounds.half_reach2 * rough_inverse(ball);
  const Pack half = all(0.5) * above, gap = at.gap + half;
  const Pack error = (bounds.value_error + half) * all(1.0 + 0x1p-50);
  const auto within = [&](double roundings_of_size) HWY_ATTR {
    return multiply_add(all(roundings_of_size * kUnitRoundoff), pair.size, pair.tolerance);
  };
  const PackMask settled = (absolute(gap) > error) &
                           (error <= within(kLaneErrorBound + pair.factor_error)) &
                           (ball > all(0.0)) & sound;
  return {gap, error, settled, settled & (above <= within(kWorthAStep))};
}

HWY_INLINE Pack least_radii(const PackPair& pair) {
  return pair.a.least_radius + pair.b.least_radius;
}

/// (B): the value is the global gap's.
HWY_INLINE PackProof prove(const PackPair& pair, const PackPoint& at, const PackBounds& bounds) {
  const Pack ball = (at.gap - bounds.value_error) + least_radii(pair);
  return proof_of(pair, at, bounds, ball, bounds.thin <= all(kThinnestAlongNormal));
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
HWY_INLINE PackMask chosen(const PackMask& yes, const PackMask& a, const PackMask& b) {
  return (a & yes) | without(b, yes);
}
HWY_INLINE PackProof chosen(const PackMask& yes, const PackProof& a, const PackProof& b) {
  return {chosen(yes, a.gap, b.gap), chosen(yes, a.error, b.error),
          chosen(yes, a.settled, b.settled), chosen(yes, a.best, b.best)};
}

/// Newton's method for n.d - h_A - h_B on the sphere: the step in the tangent plane, and whether
/// the Hessian there is definite.
struct PackStep {
  PackVec3 move;
  PackMask definite;
  Pack determinant;  ///< of K below: L times that of H + gap in the tangent plane
  Pack spread;       ///< the trace of H + gap there
};

HWY_INLINE PackStep newton_step(const PackSymmetric3& shape_a, const PackSymmetric3& shape_b,
                                const Pack& size, const PackVec3& n, const PackPoint& at) {
  const PackSymmetric3 k = newton_matrix<Pack>(shape_a, shape_b, {at.inverse_h_a, at.point_a},
                                               {at.inverse_h_b, at.point_b}, size, at.gap, n);
  const PackSymmetric3 adj = adjugate(k);
  const Pack det = determinant(k, adj);
  const PackVec3 r = multiply_take(at.gap, n, at.rest);
  const Pack spread = trace(k) - size;
  return {(adj * r) * quick_inverse(det), (det > all(0.0)) & (spread > all(0.0)), det, spread};
}

// How much more than the stored least radii the true ones may be: both are rounded.
constexpr double kAbove = 1.0 + 0x1p-38;

/// Below minus the least radii of curvature, where (B) proves nothing?
HWY_INLINE PackMask deep(const PackPair& pair, const Pack& gap) {
  return gap + all(kAbove) * least_radii(pair) < all(0.0);
}

/// A sphere, or so nearly one that stored radii do not tell.
HWY_INLINE PackMask is_round(const PackBody& body) {
  return body.least_radius >= all(1.0 - 0x1p-39) * body.largest;
}

/// (D): the value is that of a maximum near n, deep, of bodies that are no spheres.
/// @param step  newton_step() there
HWY_INLINE PackProof prove_branch(const PackPair& pair, const PackPoint& at,
                                  const PackBounds& bounds, const PackStep& step) {
  const Pack least = step.determinant * rough_inverse(pair.size * step.spread);
  const Pack scale = pair.size + bounds.radii;
  const Pack stretch = bounds.thin * bounds.radii, least2 = least * least;
  const PackMask firm = (step.determinant > all(0x1p-23) * (scale * scale * scale)) &
                        (step.spread > all(0.0)) & (bounds.thin <= all(0x1p10));
  const PackMask in_cap = all(300.0) * bounds.half_reach2 * (stretch * stretch) < least2 * least2;
  PackProof found = proof_of(pair, at, bounds, all(0.7) * least, firm & in_cap);
  found.settled = without(found.settled & deep(pair, found.gap + found.error),
                          is_round(pair.a) | is_round(pair.b));
  return found;
}

constexpr int kPoints = 4;  // chosen: of deep pairs of aspect 10 three quarters need one

/// (M): is a point of both interiors at hand? Of lanes that are not asked anything may be said.
HWY_INLINE PackMask meet(const PackPair& pair, const PackSymmetric3& shape_a,
                         const PackSymmetric3& shape_b, const PackPoint& at,
                         const PackMask& asked) {
  const auto inside = [](const PackBody& body, const Pack& level, const Pack& between2) HWY_ATTR {
    return (level <= all(1.0 - 0x1p-8)) &
           (between2 <= all(0x1p-24) * (body.least_radius * body.largest)) &
           (body.largest <= all(0x1p20) * body.least_radius);
  };
  PackMask found = none_of_them();
  Pack ratio = at.inverse_h_a * rough_inverse(at.inverse_h_b);
  for (int k = 0; k < kPoints; ++k) {
    // The point p M_A y, seen from A, and q M_B y, seen from B the other way, for the y that makes
    // them one.
    const Pack p = all(1.0) + ratio, q = all(1.0) + all(1.0) / ratio;
    const PackSymmetric3 sum = multiply_add(p, shape_a, shape_b * q), adj = adjugate(sum);
    const PackVec3 y = (adj * pair.d) * (all(1.0) / determinant(sum, adj));
    const PackVec3 from_a = (shape_a * y) * p, from_b = (shape_b * y) * q;
    const PackVec3 between = (pair.d - from_a) - from_b;
    const Pack level_a = p * dot(y, from_a), level_b = q * dot(y, from_b);
    const Pack between2 = dot(between, between);
    found = found | (inside(pair.a, level_a, between2) & inside(pair.b, level_b, between2));
    if (none(without(asked, found))) break;
    ratio = ratio * root(level_b / level_a);  // towards where both levels are the same
  }
  return found;
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
