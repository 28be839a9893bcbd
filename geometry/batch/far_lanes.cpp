// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include <tangency/geometry/batch/float_lanes.hpp>
#include <tangency/geometry/power_of_two.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/batch/far_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#define TANGENCY_PACK_REGISTERS 2
#include <tangency/geometry/batch/float_proofs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

constexpr std::size_t kPacks = LaneBlock::kPairs / (TANGENCY_FLOAT_REGISTERS * hn::MaxLanes(F()));

/// Where a bound is looked for first: along a normal of a moment ago, or from centre to centre.
struct FarStart {
  FloatVec3 normal;
  FloatMask fresh;
};
HWY_INLINE FarStart first_normal(const LaneBlock& block, std::size_t i, const FloatPairs& pairs) {
  const FloatVec3 straight = normalised(pairs.d);
  if (block.normals == nullptr) return {straight, all<FloatPack>(0.0) <= all<FloatPack>(0.0)};
  const FloatVec3 previous = to_float(load_normals(block.normals + 3 * i));
  const FloatMask fresh = is_nothing(previous);
  return {chosen(fresh, straight, normalised(previous)), fresh};
}

/// (k): lanes whose gap is above the cutoff; of the others `least` keeps what it was.
HWY_INLINE FloatMask far_at(const FloatPairs& pairs, const FloatLook& at, const Pack& cutoff,
                            Pack& least) {
  const FloatOff off = value_off(pairs, at.inverse_h_a, at.inverse_h_b, at.gap, kToNearest);
  const Pack bound = to_double(at.gap - off.value_error) * (all(1.0) / to_double(pairs.scale));
  const PackMask far = to_double(off.in_reach) & (bound > cutoff);
  least = chosen(far, bound, least);
  return to_float(far);
}

/// A step uphill, of the mean radius of curvature; for a bound any unit vector does (k).
HWY_INLINE FloatVec3 uphill(const FloatPairs& pairs, const FloatVec3& n, const FloatLook& at) {
  const auto twice_radius =
      [](const FloatSymmetric3& shape, const FloatVec3& point, const FloatPack& inverse_h)
          HWY_ATTR { return (trace(shape) - dot(point, point)) * inverse_h; };
  const FloatPack radii = twice_radius(pairs.shape_a, at.point_a, at.inverse_h_a) +
                          twice_radius(pairs.shape_b, at.point_b, at.inverse_h_b);
  const FloatPack scale = multiply_add(all<FloatPack>(0.5), radii, at.gap);
  return normalised(multiply_add(scale, n, at.across));
}

/// By short loops over all packs, of which the machine works at several at a time; then over those
/// that may have more far lanes.
HWY_ATTR std::uint64_t far_lanes(const LaneBlock& block, double cutoff, double* least) {
  const std::size_t lanes = float_lanes();
  const std::size_t packs = (static_cast<std::size_t>(block.count) + lanes - 1) / lanes;
  FloatPairColumns rows;
  FloatPairs pairs[kPacks];
  FloatVec3 normals[kPacks];
  Pack bounds[kPacks];
  FloatMask open[kPacks];
  load_rows(block, packs * lanes, rows);
  for (std::size_t k = 0; k < packs; ++k) scale(block, rows, k * lanes, pairs[k]);
  std::uint64_t found = 0;
  for (std::size_t k = 0; k < packs; ++k) {
    bounds[k] = all(0.0);
    const FarStart start = first_normal(block, k * lanes, pairs[k]);
    const FloatLook at = look(pairs[k], start.normal);
    const FloatMask far = far_at(pairs[k], at, all(cutoff), bounds[k]);
    normals[k] = uphill(pairs[k], start.normal, at);
    open[k] = without(start.fresh & pairs[k].in_range, far);
    found |= bits(far) << (k * lanes);
  }
  for (std::size_t k = 0; k < packs; ++k) {
    if (!none(open[k])) {
      Pack bound = bounds[k];
      const FloatLook at = look(pairs[k], normals[k]);
      const FloatMask far = open[k] & far_at(pairs[k], at, all(cutoff), bound);
      bounds[k] = chosen(to_double(far), bound, bounds[k]);
      found |= bits(far) << (k * lanes);
    }
    store(bounds[k], least + k * lanes);
  }
  return found;
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::detail {
namespace {
HWY_EXPORT(far_lanes);
}  // namespace

std::uint64_t far_lanes(const LaneBlock& block, double cutoff, double* least) noexcept {
  return HWY_DYNAMIC_DISPATCH(far_lanes)(block, cutoff, least);
}

}  // namespace tangency::inline v0::detail
#endif
