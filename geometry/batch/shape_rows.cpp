// SPDX-License-Identifier: MIT
#include <tangency/geometry/batch/shape_rows.hpp>

#include <cstddef>

#include <tangency/geometry/power_of_two.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/batch/shape_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#define TANGENCY_PACK_REGISTERS 1
#include <tangency/geometry/batch/packs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

// The least radius of curvature is a lower bound: two quotients are rounded. The reach is an upper
// one: three entries and two sums are.
constexpr double kBelow = 1.0 - 0x1p-40, kAbove = 1.0 + 0x1p-40;

/// A number as an unevaluated sum, good to some u^2 of what it was made from.
struct Twofold {
  Pack high, low;
};

/// a b exactly.
HWY_INLINE Twofold two_product(const Pack& a, const Pack& b) {
  const Pack product = a * b;
#if HWY_NATIVE_FMA
  return {product, {hn::MulSub(a.low, b.low, product.low)}};
#else
  const auto upper = [](const Pack& x) HWY_ATTR {
    const Pack c = all(0x1p27 + 1.0) * x;
    return c - (c - x);
  };
  const Pack ah = upper(a), bh = upper(b), al = a - ah, bl = b - bh;
  return {product, (((ah * bh - product) + ah * bl) + al * bh) + al * bl};
#endif
}

/// a + b, with its rounding beside what is `low` already.
HWY_INLINE Twofold sum(const Pack& a, const Pack& b, const Pack& low) {
  const Pack whole = a + b, part = whole - a;
  return {whole, ((a - (whole - part)) + (b - part)) + low};
}
HWY_INLINE Twofold operator+(const Twofold& a, const Twofold& b) {
  return sum(a.high, b.high, a.low + b.low);
}
HWY_INLINE Twofold operator-(const Twofold& a, const Twofold& b) {
  return sum(a.high, -b.high, a.low - b.low);
}
HWY_INLINE Twofold operator*(const Twofold& a, const Twofold& b) {
  const Twofold product = two_product(a.high, b.high);
  return {product.high, product.low + multiply_add(a.high, b.low, a.low * b.high)};
}
HWY_INLINE Twofold twice(const Twofold& a) { return {a.high + a.high, a.low + a.low}; }
HWY_INLINE Twofold inverse(const Twofold& a) {
  const Pack first = all(1.0) / a.high;
  const Twofold back = two_product(first, a.high);
  return {first, first * ((all(1.0) - back.high) - multiply_add(first, a.low, back.low))};
}

/// |q|^2 R(q/|q|), row after row.
struct PackTurn {
  Twofold entry[3][3];
  Twofold square;  ///< |q|^2
};

HWY_INLINE PackTurn turn(const PackQuaternion& q) {
  const Twofold xx = two_product(q.x, q.x), yy = two_product(q.y, q.y), zz = two_product(q.z, q.z),
                ww = two_product(q.w, q.w), xy = two_product(q.x, q.y), zx = two_product(q.z, q.x),
                yz = two_product(q.y, q.z), wx = two_product(q.w, q.x), wy = two_product(q.w, q.y),
                wz = two_product(q.w, q.z);
  return {{{(ww + xx) - (yy + zz), twice(xy - wz), twice(zx + wy)},
           {twice(xy + wz), (ww + yy) - (zz + xx), twice(yz - wx)},
           {twice(zx - wy), twice(yz + wx), (ww + zz) - (xx + yy)}},
          (ww + xx) + (yy + zz)};
}

/// Of M = S S', S = R diag(a), rounded once.
HWY_INLINE Pack entry(const Twofold* s, const Twofold* t) {
  const Twofold x = s[0] * t[0], y = s[1] * t[1], z = s[2] * t[2];
  const Twofold all_three = (x + y) + z;
  return all_three.high + all_three.low;
}

/// One register of rows.
HWY_INLINE void fill_rows(const double* semi_axes, const double* orientations, std::size_t count,
                          ShapeRow* to) {
  const PackVec3 axes = load_vectors(semi_axes);
  const PackTurn turned = turn(load_quaternions(orientations));
  const Twofold once = inverse(turned.square);
  Twofold factor[3][3];
  const Pack axis[3] = {axes.x, axes.y, axes.z};
  for (std::size_t k = 0; k < 3; ++k) {
    const Twofold product = two_product(axis[k], once.high);
    const Twofold scale{product.high, multiply_add(axis[k], once.low, product.low)};
    for (std::size_t i = 0; i < 3; ++i) factor[i][k] = turned.entry[i][k] * scale;
  }
  const Pack xx = entry(factor[0], factor[0]), yy = entry(factor[1], factor[1]),
             zz = entry(factor[2], factor[2]), yz = entry(factor[1], factor[2]),
             zx = entry(factor[2], factor[0]), xy = entry(factor[0], factor[1]);
  const Pack reach_x = xx + (absolute(zx) + absolute(xy)),
             reach_y = yy + (absolute(yz) + absolute(xy)),
             reach_z = zz + (absolute(yz) + absolute(zx));
  const Pack largest = larger(larger(axes.x, axes.y), axes.z);
  const Pack smallest = smaller(smaller(axes.x, axes.y), axes.z);
  // Each axis by itself: the larger of a number and NaN may be either.
  const auto in_range = [](const Pack& a) HWY_ATTR {
    return (a >= all(kSmallestModerate)) & (a <= all(kLargestModerate));
  };
  const PackMask moderate =
      in_range(axes.x) & in_range(axes.y) & in_range(axes.z) & in_range(turned.square.high);
  const Pack nothing = all(0.0), no_number = {hn::NaN(D())};
  const Pack columns[12] = {nothing,
                            nothing,
                            nothing,
                            chosen(moderate, largest, no_number),
                            all(kBelow) * (smallest * (smallest / largest)),
                            all(kAbove) * larger(larger(reach_x, reach_y), reach_z),
                            xx,
                            yy,
                            zz,
                            yz,
                            zx,
                            xy};
  HWY_ALIGN double third[3][4 * kMostLanes];  // four columns of each row, row after row
  for (std::size_t k = 0; k < 3; ++k) {
    const Pack* c = columns + 4 * k;
    hn::StoreInterleaved4(c[0].low, c[1].low, c[2].low, c[3].low, D(), third[k]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    double* row = reinterpret_cast<double*>(to + i);
    for (std::size_t k = 0; k < 3; ++k)
      __builtin_memcpy(row + 4 * k, third[k] + 4 * i, 4 * sizeof(double));
  }
}

HWY_ATTR void fill_shape_rows(const double* semi_axes, const double* orientations,
                              std::size_t count, ShapeRow* to) {
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
HWY_EXPORT(fill_shape_rows);
}  // namespace

void fill_shape_rows(const double* semi_axes, const double* orientations, std::size_t count,
                     ShapeRow* to) noexcept {
  HWY_DYNAMIC_DISPATCH(fill_shape_rows)(semi_axes, orientations, count, to);
}

}  // namespace tangency::inline v0::detail
#endif
