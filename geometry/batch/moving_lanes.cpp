// SPDX-License-Identifier: MIT
#include <tangency/geometry/batch/moving_lanes.hpp>

#include <cstddef>

#include <tangency/geometry/power_of_two.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/batch/moving_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#define TANGENCY_PACK_REGISTERS 1
#include <tangency/geometry/batch/packs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

// The least radius of curvature is a lower bound: two quotients are rounded.
constexpr double kBelow = 1.0 - 0x1p-40;

HWY_INLINE Pack sum_of_squares(const Pack& a, const Pack& b) { return multiply_add(a, a, b * b); }

/// The columns of R(q/|q|): (Q) of docs/derivations/gap-batch.md.
struct PackRotation {
  PackVec3 x, y, z;
  Pack square;  ///< |q|^2
};

HWY_INLINE PackRotation rotation(const PackQuaternion& q) {
  const Pack wx = sum_of_squares(q.w, q.x), yz = sum_of_squares(q.y, q.z);
  const Pack wy = sum_of_squares(q.w, q.y), zx = sum_of_squares(q.z, q.x);
  const Pack wz = sum_of_squares(q.w, q.z), xy = sum_of_squares(q.x, q.y);
  const Pack square = wx + yz, once = all(1.0) / square, twice = once + once;
  const auto less = [&](const Pack& a, const Pack& b, const Pack& c, const Pack& d) HWY_ATTR {
    return multiply_take(c, d, a * b) * twice;  // 2 (a b - c d)
  };
  const auto more = [&](const Pack& a, const Pack& b, const Pack& c, const Pack& d)
                        HWY_ATTR { return multiply_add(c, d, a * b) * twice; };
  return {{(wx - yz) * once, more(q.x, q.y, q.w, q.z), less(q.x, q.z, q.w, q.y)},
          {less(q.x, q.y, q.w, q.z), (wy - zx) * once, more(q.y, q.z, q.w, q.x)},
          {more(q.x, q.z, q.w, q.y), less(q.y, q.z, q.w, q.x), (wz - xy) * once},
          square};
}

/// One register of rows.
HWY_INLINE void fill_rows(const double* semi_axes, const double* orientations, std::size_t count,
                          LaneBody* to) {
  const PackVec3 axes = load_vectors(semi_axes);
  const PackRotation turn = rotation(load_quaternions(orientations));
  const Pack largest = larger(larger(axes.x, axes.y), axes.z);
  const Pack smallest = smaller(smaller(axes.x, axes.y), axes.z);
  // Each axis by itself: the larger of a number and NaN may be either.
  const auto in_range = [](const Pack& a) HWY_ATTR {
    return (a >= all(kSmallestModerate)) & (a <= all(kLargestModerate));
  };
  const PackMask moderate =
      in_range(axes.x) & in_range(axes.y) & in_range(axes.z) & in_range(turn.square);
  const Pack nothing = all(0.0), no_number = {hn::NaN(D())};
  const PackVec3 first = turn.x * axes.x, second = turn.y * axes.y, third = turn.z * axes.z;
  const Pack columns[16] = {nothing,
                            nothing,
                            nothing,
                            chosen(moderate, largest, no_number),
                            all(kBelow) * (smallest * (smallest / largest)),
                            first.x,
                            first.y,
                            first.z,
                            second.x,
                            second.y,
                            second.z,
                            third.x,
                            third.y,
                            third.z,
                            nothing,
                            nothing};
  HWY_ALIGN double quarter[4][4 * kMostLanes];  // four columns of each row, row after row
  for (std::size_t k = 0; k < 4; ++k) {
    const Pack* c = columns + 4 * k;
    hn::StoreInterleaved4(c[0].low, c[1].low, c[2].low, c[3].low, D(), quarter[k]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    double* row = reinterpret_cast<double*>(to + i);
    for (std::size_t k = 0; k < 4; ++k)
      __builtin_memcpy(row + 4 * k, quarter[k] + 4 * i, 4 * sizeof(double));
  }
}

HWY_ATTR void fill_moving_lanes(const double* semi_axes, const double* orientations,
                                std::size_t count, LaneBody* to) {
  const std::size_t lanes = pack_lanes();
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    fill_rows(semi_axes + 3 * i, orientations + 4 * i, lanes, to + i);
  if (i == count) return;
  double axes[3 * kMostLanes], turns[4 * kMostLanes];
  for (std::size_t k = 0; k < lanes; ++k) {
    const std::size_t from = i + k < count ? i + k : i;
    for (std::size_t c = 0; c < 3; ++c) axes[3 * k + c] = semi_axes[3 * from + c];
    for (std::size_t c = 0; c < 4; ++c) turns[4 * k + c] = orientations[4 * from + c];
  }
  fill_rows(axes, turns, count - i, to + i);
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::detail {
namespace {
HWY_EXPORT(fill_moving_lanes);
}  // namespace

void fill_moving_lanes(const double* semi_axes, const double* orientations, std::size_t count,
                       LaneBody* to) noexcept {
  HWY_DYNAMIC_DISPATCH(fill_moving_lanes)(semi_axes, orientations, count, to);
}

}  // namespace tangency::inline v0::detail
#endif
