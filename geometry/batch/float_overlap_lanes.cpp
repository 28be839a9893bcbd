// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>

#include <tangency/geometry/batch/float_lanes.hpp>
#include <tangency/geometry/power_of_two.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/batch/float_overlap_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#define TANGENCY_PACK_REGISTERS 2
#include <tangency/geometry/batch/float_proofs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

constexpr int kSteps = 2;  // of Perram and Wertheim; chosen: measured pairs need 0 to 1
constexpr std::size_t kPacks = LaneBlock::kPairs / (TANGENCY_FLOAT_REGISTERS * hn::MaxLanes(F()));

struct FloatAnswer {
  FloatMask apart, meet;
};

/// (o)
HWY_INLINE FloatAnswer proven(const FloatPairs& pairs, const FloatVec3& n) {
  const FloatLook at = look(pairs, n);
  const FloatBounds off = bounds(pairs, at, kInAnyMode);
  return {off.sound & (at.gap > off.value_error),
          off.sound & (at.gap + off.above < -off.value_error)};
}

/// By short loops over all packs, of which the machine works at several at a time.
HWY_ATTR LaneOverlaps float_overlap_lanes(const LaneBlock& block) {
  const std::size_t lanes = float_lanes();
  const std::size_t packs = (static_cast<std::size_t>(block.count) + lanes - 1) / lanes;
  FloatPairs pairs[kPacks];
  FloatStart starts[kPacks];
  for (std::size_t k = 0; k < packs; ++k) pairs[k] = load_pairs(block, k * lanes);
  for (std::size_t k = 0; k < packs; ++k) starts[k] = FloatStart(pairs[k]);
  LaneOverlaps answers{0, 0};
  for (std::size_t k = 0; k < packs; ++k) {
    FloatMask apart = none_of_them<FloatPack>(), meet = apart;
    for (int step = 0;; ++step) {
      const FloatAnswer now = proven(pairs[k], starts[k].normal());
      apart = apart | now.apart;
      meet = meet | now.meet;
      if (none(without(pairs[k].in_range, apart | meet)) || step == kSteps) break;
      starts[k].step();
    }
    answers.decided |= bits(apart | meet) << (k * lanes);
    answers.meet |= bits(meet) << (k * lanes);
  }
  return answers;
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::detail {
namespace {
HWY_EXPORT(float_overlap_lanes);
}  // namespace

LaneOverlaps float_overlap_lanes(const LaneBlock& block) noexcept {
  return HWY_DYNAMIC_DISPATCH(float_overlap_lanes)(block);
}

}  // namespace tangency::inline v0::detail
#endif
