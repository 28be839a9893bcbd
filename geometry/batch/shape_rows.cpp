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

/// A number that is multiplied by several others: without fused multiply-adds by its halves, of 26
/// and 27 bits [Dekker1971].
struct Factor {
#if HWY_NATIVE_FMA
  HWY_INLINE explicit Factor(double x) : value(x) {}
  double value;
#else
  HWY_INLINE explicit Factor(double x) : value(x) {
    const double c = (0x1p27 + 1.0) * x;
    high = c - (c - x);
    low = x - high;
  }
  double value, high, low;
#endif
};

/// a b exactly.
HWY_INLINE Twofold two_product(const Factor& a, const Factor& b) {
  const double product = a.value * b.value;
#if HWY_NATIVE_FMA
  return {product, __builtin_fma(a.value, b.value, -product)};
#else
  return {product, ((a.high * b.high - product) + a.high * b.low + a.low * b.high) + a.low * b.low};
#endif
}

/// a + b exactly.
HWY_INLINE Twofold two_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// The inner product of two rows of the factor, rounded once.
using Row = Factor[3];
HWY_INLINE double inner(const Row& r, const Row& s) {
  const Twofold x = two_product(r[0], s[0]), y = two_product(r[1], s[1]),
                z = two_product(r[2], s[2]);
  const Twofold two = two_sum(x.high, y.high), three = two_sum(two.high, z.high);
  return three.high + ((two.low + three.low) + (x.low + y.low + z.low));
}

HWY_INLINE double magnitude(double x) { return __builtin_fabs(x); }
HWY_INLINE double larger(double a, double b) { return a > b ? a : b; }

HWY_ATTR void fill_shape_rows(const LaneBody* bodies, std::size_t count, ShapeRow* to) {
  for (std::size_t i = 0; i < count; ++i) {
    const LaneBody& body = bodies[i];
    const double* s = body.factor;
    const Row x = {Factor(s[0]), Factor(s[3]), Factor(s[6])},
              y = {Factor(s[1]), Factor(s[4]), Factor(s[7])},
              z = {Factor(s[2]), Factor(s[5]), Factor(s[8])};
    const double xx = inner(x, x), yy = inner(y, y), zz = inner(z, z), yz = inner(y, z),
                 zx = inner(z, x), xy = inner(x, y);
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
