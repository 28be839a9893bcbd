// SPDX-License-Identifier: MIT
#include <tangency/geometry/batch/shape_rows.hpp>

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/batch/shape_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

// Three roundings of a sum of absolute values; an upper bound.
constexpr double kAbove = 1.0 + 0x1p-50;
// (a_min / a_max)^2, below which the first tier would mostly be in vain: measured.
constexpr double kFlattest = 0x1p-11;

struct Twofold {
  double high, low;
};

/// a b exactly.
HWY_INLINE Twofold two_product(double a, double b) {
  const double product = a * b;
#if HWY_NATIVE_FMA
  return {product, __builtin_fma(a, b, -product)};
#else
  // Halves of 26 and 27 bits [Dekker1971].
  const auto upper = [](double x) HWY_ATTR {
    const double c = (0x1p27 + 1.0) * x;
    return c - (c - x);
  };
  const double ah = upper(a), bh = upper(b), al = a - ah, bl = b - bh;
  return {product, ((ah * bh - product) + ah * bl + al * bh) + al * bl};
#endif
}

/// a + b exactly.
HWY_INLINE Twofold two_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// The inner product of rows i and j of the factor, rounded once.
HWY_INLINE double entry(const double* factor, std::size_t i, std::size_t j) {
  const Twofold x = two_product(factor[i], factor[j]),
                y = two_product(factor[3 + i], factor[3 + j]),
                z = two_product(factor[6 + i], factor[6 + j]);
  const Twofold two = two_sum(x.high, y.high), three = two_sum(two.high, z.high);
  return three.high + ((two.low + three.low) + (x.low + y.low + z.low));
}

HWY_INLINE double magnitude(double x) { return __builtin_fabs(x); }
HWY_INLINE double larger(double a, double b) { return a > b ? a : b; }

HWY_ATTR void fill_shape_rows(const LaneBody* bodies, std::size_t count, ShapeRow* to) {
  for (std::size_t i = 0; i < count; ++i) {
    const LaneBody& body = bodies[i];
    const double* s = body.factor;
    const double xx = entry(s, 0, 0), yy = entry(s, 1, 1), zz = entry(s, 2, 2), yz = entry(s, 1, 2),
                 zx = entry(s, 2, 0), xy = entry(s, 0, 1);
    const double ayz = magnitude(yz), azx = magnitude(zx), axy = magnitude(xy);
    const bool flat = body.least_radius < kFlattest * body.largest;
    to[i] = {{body.centre[0], body.centre[1], body.centre[2]},
             flat ? __builtin_nan("") : body.largest,
             body.least_radius,
             kAbove * larger(larger(xx + (azx + axy), yy + (ayz + axy)), zz + (ayz + azx)),
             {xx, yy, zz, yz, zx, xy}};
  }
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::detail {
namespace {
HWY_EXPORT(fill_shape_rows);
}  // namespace

void fill_shape_rows(const LaneBody* bodies, std::size_t count, ShapeRow* to) noexcept {
  HWY_DYNAMIC_DISPATCH(fill_shape_rows)(bodies, count, to);
}

}  // namespace tangency::inline v0::detail
#endif
