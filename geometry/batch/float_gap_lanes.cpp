// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include <tangency/geometry/batch/float_lanes.hpp>
#include <tangency/geometry/power_of_two.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/batch/float_gap_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#define TANGENCY_PACK_REGISTERS 2
#include <tangency/geometry/batch/float_proofs-inl.hpp>
#include <tangency/geometry/batch/gap_proofs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

constexpr int kStartSteps = 1;  // of Perram and Wertheim: measured, as in mixed_lanes.cpp
constexpr int kSteps = 2;       // of Newton's method; chosen: measured pairs need 0 to 1
constexpr std::size_t kPacks = LaneBlock::kPairs / (TANGENCY_FLOAT_REGISTERS * hn::MaxLanes(F()));

struct FloatAnswer {
  FloatVec3 normal;
  FloatLook at;
  FloatPack gap;  ///< in the middle of what is proven
  FloatPack error;
  FloatMask settled;
};

/// (g)
HWY_INLINE FloatAnswer answer_at(const LaneBlock& block, const FloatPairs& pairs,
                                 const FloatVec3& n) {
  const auto c = [](double x) HWY_ATTR { return all<FloatPack>(x); };
  const FloatLook at = look(pairs, n);
  const FloatBounds off = bounds(pairs, at, kToNearest);
  const FloatPack half = c(0.5) * off.above, gap = at.gap + half;
  const FloatPack error = (off.value_error + half) * c(kOfBounds);
  const FloatPack tolerance =
      multiply_add(c(block.tolerance_of_size), pairs.size, c(block.tolerance) * pairs.scale) *
      c(1.0 - 0x1p-20);
  return {n, at, gap, error, off.sound & (absolute(gap) > error) & (error <= tolerance)};
}

/// Newton's method for n.d - h_A - h_B on the sphere, as newton_step() of gap_proofs-inl.hpp.
HWY_INLINE FloatVec3 stepped(const FloatPairs& pairs, const FloatAnswer& from) {
  const FloatVec3& n = from.normal;
  const FloatLook& at = from.at;
  const FloatSymmetric3 k =
      newton_matrix<FloatPack>(pairs.shape_a, pairs.shape_b, {at.inverse_h_a, at.point_a},
                               {at.inverse_h_b, at.point_b}, pairs.size, at.gap, n);
  const FloatSymmetric3 adj = adjugate(k);
  const FloatVec3 move = (adj * at.across) * quick_inverse(determinant(k, adj));
  return normalised(n + move);
}

HWY_INLINE FloatLook chosen(const FloatMask& yes, const FloatLook& a, const FloatLook& b) {
  return {chosen(yes, a.inverse_h_a, b.inverse_h_a),
          chosen(yes, a.inverse_h_b, b.inverse_h_b),
          chosen(yes, a.gap, b.gap),
          chosen(yes, a.point_a, b.point_a),
          chosen(yes, a.point_b, b.point_b),
          chosen(yes, a.across, b.across)};
}

/// Lanes that are settled keep their answer, so that none depends on its neighbours.
HWY_INLINE FloatAnswer kept(const FloatAnswer& settled, const FloatAnswer& later) {
  const FloatMask& yes = settled.settled;
  return {chosen(yes, settled.normal, later.normal), chosen(yes, settled.at, later.at),
          chosen(yes, settled.gap, later.gap), chosen(yes, settled.error, later.error),
          yes | later.settled};
}

HWY_INLINE FloatVec3 first_normal(const LaneBlock& block, std::size_t i, const FloatPairs& pairs) {
  const auto fresh_normal = [&]() HWY_ATTR {
    FloatStart start(pairs);
    for (int k = 0; k < kStartSteps; ++k) start.step();
    return start.normal();
  };
  if (block.normals == nullptr) return fresh_normal();
  const FloatVec3 previous = to_float(load_normals(block.normals + 3 * i));
  const FloatMask fresh = is_nothing(previous);
  const FloatVec3 given = normalised(previous);
  return none(fresh) ? given : chosen(fresh, fresh_normal(), given);
}

/// In double, in the caller's unit; the normal's length, and support points of that normal, right
/// to rounding.
HWY_INLINE void write(const LaneBlock& to, std::size_t i, const FloatPairs& pairs,
                      const FloatAnswer& answer) {
  const Pack back = all(1.0) / to_double(pairs.scale);
  if (to.gap != nullptr) store(to_double(answer.gap) * back, to.gap + i);
  if (to.gap_error != nullptr) store(to_double(answer.error) * back, to.gap_error + i);
  const PackVec3 n = normalised(to_double(answer.normal));
  if (to.normal != nullptr) store(n, to.normal + 3 * i);
  write_arms(to, i, n);
}

/// By short loops over all packs, of which the machine works at several at a time.
HWY_ATTR std::uint64_t float_gap_lanes(LaneBlock& block) {
  const std::size_t lanes = float_lanes();
  const std::size_t packs = (static_cast<std::size_t>(block.count) + lanes - 1) / lanes;
  FloatPairColumns rows;
  load_rows(block, packs * lanes, rows);
  FloatPairs pairs[kPacks];
  FloatVec3 normals[kPacks];
  for (std::size_t k = 0; k < packs; ++k) scale(block, rows, k * lanes, pairs[k]);
  for (std::size_t k = 0; k < packs; ++k) normals[k] = first_normal(block, k * lanes, pairs[k]);
  std::uint64_t settled = 0;
  for (std::size_t k = 0; k < packs; ++k) {
    FloatAnswer answer = answer_at(block, pairs[k], normals[k]);
    for (int step = 0; step < kSteps; ++step) {
      if (none(without(pairs[k].in_range, answer.settled))) break;
      answer = kept(answer, answer_at(block, pairs[k], stepped(pairs[k], answer)));
    }
    write(block, k * lanes, pairs[k], answer);
    settled |= bits(answer.settled) << (k * lanes);
  }
  return settled;
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::detail {
namespace {
HWY_EXPORT(float_gap_lanes);
}  // namespace

std::uint64_t float_gap_lanes(LaneBlock& block) noexcept {
  block.local = block.nearer = block.promising = 0;
  return HWY_DYNAMIC_DISPATCH(float_gap_lanes)(block);
}

}  // namespace tangency::inline v0::detail
#endif
