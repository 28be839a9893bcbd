// SPDX-License-Identifier: MIT
/// @file
/// M = S S' of bodies, one in each lane of a vector of any length, each entry rounded as (N) of
/// docs/derivations/gap-batch.md says; and constants of the rows. Compiled once for each
/// instruction set.
#if defined(TANGENCY_SHAPE_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_SHAPE_ROWS_INL
#undef TANGENCY_SHAPE_ROWS_INL
#else
#define TANGENCY_SHAPE_ROWS_INL
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

// Three roundings of a sum of absolute values; an upper bound.
constexpr double kAboveSum = 1.0 + 0x1p-50;
// (a_min / a_max)^2, below which the first tier would mostly be in vain: measured.
constexpr double kFlattest = 0x1p-11;
// The stored radius of a FloatRow is below and the stored reach above the true ones by this much at
// least, so that sums and products of them are too. Chosen.
constexpr double kBelowFloat = 1.0 - 0x1p-21, kAboveFloat = 1.0 + 0x1p-21;

/// The same number in every lane.
template <class V>
HWY_INLINE V every(double x) {
  return hwy::HWY_NAMESPACE::Set(hwy::HWY_NAMESPACE::DFromV<V>(), x);
}

/// The power of two at or below x, of normal numbers.
template <class V>
HWY_INLINE V power_of(V x) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::DFromV<V> d;
  const hn::RebindToUnsigned<decltype(d)> words;
  const auto exponent = hn::Set(words, 0x7ff0000000000000u);
  return hn::BitCast(d, hn::And(hn::BitCast(words, x), exponent));
}

// With p the power of two at or below the largest semi-axis, a number that is added and taken off
// again, or not, rounds what stands between to a multiple of a power of two. Of such multiples sums
// are exact, and what they leave of a product is small enough for one rounding more not to matter.
//
// With fused multiply-adds products are rounded, to multiples of 2^-49 p^2; else the entries are
// split at 2^-25 p, so that products of the high parts are exact.

#if HWY_NATIVE_FMA
template <class V>
struct Factor {
  V whole;
};
template <class V>
HWY_INLINE V rounder_of(V largest) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V p = power_of(largest);
  return hn::Mul(every<V>(12.0), hn::Mul(p, p));
}
template <class V>
HWY_INLINE Factor<V> factor(V x, V) {
  return {x};
}
#else
template <class V>
struct Factor {
  V whole, high, low;
};
template <class V>
HWY_INLINE V rounder_of(V largest) {
  return hwy::HWY_NAMESPACE::Mul(every<V>(0x1.8p27), power_of(largest));
}
template <class V>
HWY_INLINE Factor<V> factor(V x, V rounder) {
  namespace hn = hwy::HWY_NAMESPACE;
  const V high = hn::Sub(hn::Add(x, rounder), rounder);
  return {x, high, hn::Sub(x, high)};
}
#endif

/// A row of S.
template <class V>
struct FactorRow {
  Factor<V> first, second, third;
};

/// The inner product of two rows, as (N) says.
template <class V>
HWY_INLINE V inner(const FactorRow<V>& r, const FactorRow<V>& s, [[maybe_unused]] V rounder) {
  namespace hn = hwy::HWY_NAMESPACE;
#if HWY_NATIVE_FMA
  const V one = hn::MulAdd(r.first.whole, s.first.whole, rounder);
  const V two = hn::MulAdd(r.second.whole, s.second.whole, one);
  const V three = hn::MulAdd(r.third.whole, s.third.whole, two);
  const V first = hn::MulSub(r.first.whole, s.first.whole, hn::Sub(one, rounder));
  const V second = hn::MulSub(r.second.whole, s.second.whole, hn::Sub(two, one));
  const V third = hn::MulSub(r.third.whole, s.third.whole, hn::Sub(three, two));
  return hn::Add(hn::Sub(three, rounder), hn::Add(hn::Add(first, second), third));
#else
  const auto high = [](const Factor<V>& a, const Factor<V>& b)
                        HWY_ATTR { return hn::Mul(a.high, b.high); };
  const auto low = [](const Factor<V>& a, const Factor<V>& b) HWY_ATTR {
    return hn::Add(hn::Mul(a.high, b.low), hn::Mul(a.low, b.whole));
  };
  const V highs =
      hn::Add(hn::Add(high(r.first, s.first), high(r.second, s.second)), high(r.third, s.third));
  const V lows =
      hn::Add(hn::Add(low(r.first, s.first), low(r.second, s.second)), low(r.third, s.third));
  return hn::Add(highs, lows);
#endif
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
