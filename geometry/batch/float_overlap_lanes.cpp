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

/// By short loops over all packs, of which the machine works at several at a time; then over those
/// that have undecided lanes.
HWY_ATTR LaneOverlaps float_overlap_lanes(const LaneBlock& block) {
  const std::size_t lanes = float_lanes();
  const std::size_t packs = (static_cast<std::size_t>(block.count) + lanes - 1) / lanes;
  FloatPairColumns rows;
  FloatPairs pairs[kPacks];
  FloatStart starts[kPacks];
  FloatVec3 normals[kPacks];
  load_rows(block, packs * lanes, rows);
  for (std::size_t k = 0; k < packs; ++k) scale(block, rows, k * lanes, pairs[k]);
  for (std::size_t k = 0; k < packs; ++k) starts[k] = FloatStart(pairs[k]);
  std::size_t open[kPacks], count = packs;
  for (std::size_t k = 0; k < packs; ++k) open[k] = k;
  for (int step = 0; step < block.yes_no_steps; ++step)
    for (std::size_t k = 0; k < packs; ++k) starts[k].step();
  LaneOverlaps answers{0, 0};
  for (int step = block.yes_no_steps;; ++step) {
    for (std::size_t j = 0; j < count; ++j) normals[open[j]] = starts[open[j]].normal();
    std::size_t left = 0;
    for (std::size_t j = 0; j < count; ++j) {
      const std::size_t k = open[j], first = k * lanes;
      const FloatAnswer now = proven(pairs[k], normals[k]);
      const std::uint64_t meet = bits(now.meet);
      answers.meet |= meet << first;
      answers.decided |= (bits(now.apart) | meet) << first;
      const bool is_open = (bits(pairs[k].in_range) & ~(answers.decided >> first)) != 0;
      open[left] = k;
      left += static_cast<std::size_t>(is_open);
    }
    if (step == block.yes_no_steps) answers.mostly_open = 2 * left > packs;
    count = left;
    if (count == 0 || step == kSteps) return answers;
    for (std::size_t j = 0; j < count; ++j) starts[open[j]].step();
  }
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
