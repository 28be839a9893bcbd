// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Equality to the bit, which tells -0 from 0 and knows a NaN.
#pragma once

#include <bit>
#include <cstdint>

#include <tangency/geometry/gap.hpp>

namespace tangency::testing {

inline bool same_bits(double x, double y) {
  return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
}
inline bool same_bits(const Vec3& v, const Vec3& w) {
  return same_bits(v[0], w[0]) && same_bits(v[1], w[1]) && same_bits(v[2], w[2]);
}
inline bool same_bits(const Gap& g, const Gap& h) {
  return same_bits(g.gap, h.gap) && same_bits(g.gap_error, h.gap_error) &&
         same_bits(g.normal, h.normal) && same_bits(g.arm_a, h.arm_a) &&
         same_bits(g.arm_b, h.arm_b) && g.status == h.status && g.tier == h.tier;
}

}  // namespace tangency::testing
