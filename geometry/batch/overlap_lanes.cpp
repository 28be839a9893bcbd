// SPDX-License-Identifier: MIT
#include <cstddef>

#include <tangency/geometry/batch/gap_lanes.hpp>
#include <tangency/geometry/power_of_two.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/batch/overlap_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#define TANGENCY_PACK_REGISTERS 1
#include <tangency/geometry/batch/pack_bodies-inl.hpp>
#include <tangency/geometry/batch/perram_wertheim_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

constexpr double kPolynomial = 720 * 0x1p-52;  // E1 of relation-filter.md: (W) of gap-batch.md
constexpr int kSteps = 8;                      // chosen: measured pairs need 1 to 3

struct PackAnswer {
  PackMask apart, meet;
};

/// What the polynomials prove at one l, by the wide yardstick D+ = t^3, N+ = d^2 t^2.
HWY_INLINE PackAnswer proven(const PackPerramWertheimAt& p, const Pack& trace_a,
                             const Pack& trace_b, const Pack& d2) {
  const Pack& l = p.l;
  const Pack t = multiply_add(l, trace_b, trace_a), t2 = t * t;
  const Pack most_det = t2 * t, most_num = d2 * t2;
  const Pack more = all(1.0) + l;
  const Pack apart = multiply_take(more, p.det, l * p.num);
  const Pack square = p.det * p.det, cross = multiply_take(p.num, p.det1, p.num1 * p.det);
  const Pack in_a = multiply_take(p.num, p.det, square) - cross;
  const Pack in_b = multiply_add(l, cross, square);
  const Pack bound = all(13.0 * kPolynomial) * most_det;
  const Pack least_apart = all(kPolynomial) * multiply_add(l, most_num, more * most_det);
  const PackMask finite = multiply_add(more, most_num, most_det) < all(0x1p500);
  return {finite & (apart > least_apart), finite & (in_a > bound * (most_det + most_num)) &
                                              (in_b > bound * multiply_add(l, most_num, most_det))};
}

struct PackShape {
  PackVec3 centre;
  Pack largest;
  PackSymmetric3 shape;
};

/// What of LaneBody this question needs, with M = S S'.
HWY_INLINE PackShape load_shape(const Rows* rows) {
  return load_rows<16>(rows, [](const auto& column) HWY_ATTR {
    const auto vector = [&](std::size_t c) HWY_ATTR {
      return PackVec3{column(c), column(c + 1), column(c + 2)};
    };
    return PackShape{vector(0), column(3), square_of_factor(vector(5), vector(8), vector(11))};
  });
}

/// All lanes from index i on.
HWY_INLINE void decide(const LaneBlock& block, std::size_t i, LaneOverlaps& answers) {
  const PairRows rows = find_rows(block, i, block.bodies_a, block.bodies_b);
  const PackShape body_a = load_shape(rows.a), body_b = load_shape(rows.b);
  const PackVec3 d = separation(block, i, body_a.centre, body_b.centre);
  const PackSymmetric3 &a = body_a.shape, &b = body_b.shape;
  const PackPerramWertheim form(a, b, d);
  const Pack trace_a = trace(a), trace_b = trace(b), d2 = dot(d, d);
  // False for NaN, which is how bodies that are not moderate() stay out.
  PackMask open = (body_a.largest + body_b.largest > all(0.0)) &
                  (largest_component(d) <= all(kLargestModerate));
  PackMask decided = without(open, open), meet = decided;
  Pack l = form.first_guess();
  for (int step = 0; step < kSteps; ++step) {
    const PackPerramWertheimAt at = form.at(l);
    const PackAnswer answer = proven(at, trace_a, trace_b, d2);
    meet = meet | (open & answer.meet);
    decided = decided | (open & (answer.apart | answer.meet));
    open = without(open, decided);
    if (none(open)) break;
    l = next(at);
  }
  answers.decided |= bits(decided) << i;
  answers.meet |= bits(meet) << i;
}

HWY_ATTR LaneOverlaps overlap_lanes(const LaneBlock& block) {
  LaneOverlaps answers{0, 0};
  for (std::size_t i = 0; i < static_cast<std::size_t>(block.count); i += pack_lanes()) {
    decide(block, i, answers);
  }
  return answers;
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::detail {
namespace {
HWY_EXPORT(overlap_lanes);
}  // namespace

LaneOverlaps overlap_lanes(const LaneBlock& block) noexcept {
  return HWY_DYNAMIC_DISPATCH(overlap_lanes)(block);
}

}  // namespace tangency::inline v0::detail
#endif
