// SPDX-License-Identifier: MIT
/// @file
/// Numbers of many pairs at once, one pair in each lane, in double and in float. Compiled once for
/// each instruction set, each copy in a namespace of its own and with internal linkage: the guard
/// is Highway's toggle. No function of another header may be called from here: compiled for this
/// instruction set it could be the copy that the linker keeps for all.
#if defined(TANGENCY_PACK_NUMBERS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_PACK_NUMBERS_INL
#undef TANGENCY_PACK_NUMBERS_INL
#else
#define TANGENCY_PACK_NUMBERS_INL
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<double>;
using F = hn::ScalableTag<float>;
using Register = hn::Vec<D>;

/// A number of each pair, in TANGENCY_PACK_REGISTERS registers. With two the chains of operations
/// of one do not wait for each other; with one more pairs in a row are on their way. Which is
/// quicker differs: each *_lanes.cpp says how many it measured to be best.
struct Pack {
  Register low;
#if TANGENCY_PACK_REGISTERS == 2
  Register high;
#endif
};
struct PackMask {
  hn::Mask<D> low;
#if TANGENCY_PACK_REGISTERS == 2
  hn::Mask<D> high;
#endif
};

// Without vectors a register is one number, of either kind.
#undef TANGENCY_FLOAT_REGISTERS
#if TANGENCY_PACK_REGISTERS == 2 && HWY_TARGET == HWY_SCALAR
#define TANGENCY_FLOAT_REGISTERS 2
#else
#define TANGENCY_FLOAT_REGISTERS 1
#endif

/// The same in float, in one register: as many pairs as a Pack of two registers has.
struct FloatPack {
  hn::Vec<F> low;
#if TANGENCY_FLOAT_REGISTERS == 2
  hn::Vec<F> high;
#endif
};
struct FloatMask {
  hn::Mask<F> low;
#if TANGENCY_FLOAT_REGISTERS == 2
  hn::Mask<F> high;
#endif
};

#if TANGENCY_PACK_REGISTERS == 2
#define TANGENCY_PARTS(low, high) low, high
#else
#define TANGENCY_PARTS(low, high) low
#endif
#undef TANGENCY_FLOAT_PARTS
#if TANGENCY_FLOAT_REGISTERS == 2
#define TANGENCY_FLOAT_PARTS(low, high) low, high
#else
#define TANGENCY_FLOAT_PARTS(low, high) low
#endif

/// The most numbers that a register of any machine with this instruction set has.
constexpr std::size_t kMostLanes = HWY_MAX_BYTES / sizeof(double);

HWY_INLINE std::size_t register_lanes() { return hn::Lanes(D()); }
HWY_INLINE std::size_t pack_lanes() { return TANGENCY_PACK_REGISTERS * hn::Lanes(D()); }
HWY_INLINE std::size_t float_lanes() { return TANGENCY_FLOAT_REGISTERS * hn::Lanes(F()); }

/// x in every lane of a P, rounded to its numbers.
template <class P = Pack>
HWY_INLINE P all(double x) {
  if constexpr (std::is_same_v<P, Pack>) {
    return {TANGENCY_PARTS(hn::Set(D(), x), hn::Set(D(), x))};
  } else {
    const auto y = static_cast<float>(x);
    return {TANGENCY_FLOAT_PARTS(hn::Set(F(), y), hn::Set(F(), y))};
  }
}

#define TANGENCY_PACK_1(name, call)                                   \
  HWY_INLINE Pack name(const Pack& a) {                               \
    return {TANGENCY_PARTS(hn::call(a.low), hn::call(a.high))};       \
  }                                                                   \
  HWY_INLINE FloatPack name(const FloatPack& a) {                     \
    return {TANGENCY_FLOAT_PARTS(hn::call(a.low), hn::call(a.high))}; \
  }
#define TANGENCY_PACK_2(type, float_type, name, call)                                \
  HWY_INLINE type name(const Pack& a, const Pack& b) {                               \
    return {TANGENCY_PARTS(hn::call(a.low, b.low), hn::call(a.high, b.high))};       \
  }                                                                                  \
  HWY_INLINE float_type name(const FloatPack& a, const FloatPack& b) {               \
    return {TANGENCY_FLOAT_PARTS(hn::call(a.low, b.low), hn::call(a.high, b.high))}; \
  }
#define TANGENCY_PACK_3(name, call)                                                             \
  HWY_INLINE Pack name(const Pack& a, const Pack& b, const Pack& c) {                           \
    return {TANGENCY_PARTS(hn::call(a.low, b.low, c.low), hn::call(a.high, b.high, c.high))};   \
  }                                                                                             \
  HWY_INLINE FloatPack name(const FloatPack& a, const FloatPack& b, const FloatPack& c) {       \
    return {                                                                                    \
        TANGENCY_FLOAT_PARTS(hn::call(a.low, b.low, c.low), hn::call(a.high, b.high, c.high))}; \
  }
TANGENCY_PACK_1(operator-, Neg)
TANGENCY_PACK_1(absolute, Abs)
TANGENCY_PACK_1(root, Sqrt)
TANGENCY_PACK_2(Pack, FloatPack, operator+, Add)
TANGENCY_PACK_2(Pack, FloatPack, operator-, Sub)
TANGENCY_PACK_2(Pack, FloatPack, operator*, Mul)
TANGENCY_PACK_2(Pack, FloatPack, operator/, Div)
TANGENCY_PACK_2(Pack, FloatPack, larger, Max)
TANGENCY_PACK_2(Pack, FloatPack, smaller, Min)
TANGENCY_PACK_2(PackMask, FloatMask, operator<, Lt)
TANGENCY_PACK_2(PackMask, FloatMask, operator>, Gt)
TANGENCY_PACK_2(PackMask, FloatMask, operator<=, Le)
TANGENCY_PACK_2(PackMask, FloatMask, operator>=, Ge)
TANGENCY_PACK_3(multiply_add, MulAdd)      // a b + c, rounded once where the machine can
TANGENCY_PACK_3(multiply_take, NegMulAdd)  // c - a b
#undef TANGENCY_PACK_1
#undef TANGENCY_PACK_2
#undef TANGENCY_PACK_3

HWY_INLINE PackMask operator&(const PackMask& a, const PackMask& b) {
  return {TANGENCY_PARTS(hn::And(a.low, b.low), hn::And(a.high, b.high))};
}
HWY_INLINE FloatMask operator&(const FloatMask& a, const FloatMask& b) {
  return {TANGENCY_FLOAT_PARTS(hn::And(a.low, b.low), hn::And(a.high, b.high))};
}
HWY_INLINE PackMask operator|(const PackMask& a, const PackMask& b) {
  return {TANGENCY_PARTS(hn::Or(a.low, b.low), hn::Or(a.high, b.high))};
}
HWY_INLINE FloatMask operator|(const FloatMask& a, const FloatMask& b) {
  return {TANGENCY_FLOAT_PARTS(hn::Or(a.low, b.low), hn::Or(a.high, b.high))};
}
/// a and not b
HWY_INLINE PackMask without(const PackMask& a, const PackMask& b) {
  return {TANGENCY_PARTS(hn::AndNot(b.low, a.low), hn::AndNot(b.high, a.high))};
}
HWY_INLINE FloatMask without(const FloatMask& a, const FloatMask& b) {
  return {TANGENCY_FLOAT_PARTS(hn::AndNot(b.low, a.low), hn::AndNot(b.high, a.high))};
}
template <class P = Pack>
HWY_INLINE auto none_of_them() {
  return all<P>(0.0) < all<P>(0.0);
}
HWY_INLINE bool none(const PackMask& m) {
#if TANGENCY_PACK_REGISTERS == 2
  if (!hn::AllFalse(D(), m.high)) return false;
#endif
  return hn::AllFalse(D(), m.low);
}
HWY_INLINE bool none(const FloatMask& m) {
#if TANGENCY_FLOAT_REGISTERS == 2
  if (!hn::AllFalse(F(), m.high)) return false;
#endif
  return hn::AllFalse(F(), m.low);
}
HWY_INLINE Pack chosen(const PackMask& yes, const Pack& a, const Pack& b) {
  return {TANGENCY_PARTS(hn::IfThenElse(yes.low, a.low, b.low),
                         hn::IfThenElse(yes.high, a.high, b.high))};
}
HWY_INLINE FloatPack chosen(const FloatMask& yes, const FloatPack& a, const FloatPack& b) {
  return {TANGENCY_FLOAT_PARTS(hn::IfThenElse(yes.low, a.low, b.low),
                               hn::IfThenElse(yes.high, a.high, b.high))};
}
/// Bit k is lane k.
HWY_INLINE std::uint64_t bits(const PackMask& m) {
  std::uint8_t low[8] = {};
  hn::StoreMaskBits(D(), m.low, low);
#if TANGENCY_PACK_REGISTERS == 2
  std::uint8_t high[8] = {};
  hn::StoreMaskBits(D(), m.high, high);
  return std::uint64_t{low[0]} | std::uint64_t{high[0]} << register_lanes();
#else
  return low[0];
#endif
}
HWY_INLINE std::uint64_t bits(const FloatMask& m) {
#if HWY_TARGET == HWY_AVX3
  return m.low.raw;
#else
  std::uint8_t low[8] = {};
  hn::StoreMaskBits(F(), m.low, low);
#if TANGENCY_FLOAT_REGISTERS == 2
  std::uint8_t high[8] = {};
  hn::StoreMaskBits(F(), m.high, high);
  return std::uint64_t{low[0]} | std::uint64_t{high[0]} << hn::Lanes(F());
#else
  return std::uint64_t{low[0]} | std::uint64_t{low[1]} << 8;
#endif
#endif
}

#if TANGENCY_PACK_REGISTERS == 2
/// Rounded.
HWY_INLINE FloatPack to_float(const Pack& p) {
  const hn::Rebind<float, D> half;
#if HWY_TARGET == HWY_SCALAR
  return {hn::DemoteTo(half, p.low), hn::DemoteTo(half, p.high)};
#else
  return {hn::Combine(F(), hn::DemoteTo(half, p.high), hn::DemoteTo(half, p.low))};
#endif
}
/// Exactly.
HWY_INLINE Pack to_double(const FloatPack& p) {
#if HWY_TARGET == HWY_SCALAR
  return {hn::PromoteTo(D(), p.low), hn::PromoteTo(D(), p.high)};
#else
  return {hn::PromoteTo(D(), hn::LowerHalf(p.low)),
          hn::PromoteTo(D(), hn::UpperHalf(hn::Half<F>(), p.low))};
#endif
}
HWY_INLINE FloatMask to_float(const PackMask& m) {
#if HWY_TARGET == HWY_SCALAR
  using M = hn::Mask<F>;
  return {M::FromBool(m.low.bits != 0), M::FromBool(m.high.bits != 0)};
#elif HWY_TARGET == HWY_AVX3
  return {{static_cast<__mmask16>(m.low.raw | m.high.raw << 8)}};
#else
  const auto halves = [](const hn::Mask<D>& of)
                          HWY_ATTR { return hn::BitCast(F(), hn::VecFromMask(D(), of)); };
  return {hn::MaskFromVec(hn::ConcatEven(F(), halves(m.high), halves(m.low)))};
#endif
}
HWY_INLINE PackMask to_double(const FloatMask& m) {
#if HWY_TARGET == HWY_SCALAR
  using M = hn::Mask<D>;
  return {M::FromBool(m.low.bits != 0), M::FromBool(m.high.bits != 0)};
#elif HWY_TARGET == HWY_AVX3
  return {{static_cast<__mmask8>(m.low.raw)}, {static_cast<__mmask8>(m.low.raw >> 8)}};
#else
  const hn::RebindToSigned<F> narrow;
  const hn::RebindToSigned<D> wide;
  const auto whole = hn::BitCast(narrow, hn::VecFromMask(F(), m.low));
  const auto mask = [&](const auto& half) HWY_ATTR {
    return hn::MaskFromVec(hn::BitCast(D(), hn::PromoteTo(wide, half)));
  };
  return {mask(hn::LowerHalf(whole)), mask(hn::UpperHalf(hn::Half<decltype(narrow)>(), whole))};
#endif
}
#endif

/// The inverse of the power of two at or below x, by the bits of its exponent: of x in [2^-1022,
/// 2^1023), or of 0 and subnormal numbers 2^1023.
HWY_INLINE Pack inverse_power(const Pack& x) {
  const auto of = [](const Register& y) HWY_ATTR {
    const hn::RebindToUnsigned<D> words;
    const auto exponent = hn::And(hn::BitCast(words, y), hn::Set(words, 0x7ff0000000000000u));
    return hn::BitCast(D(), hn::Sub(hn::Set(words, 0x7fe0000000000000u), exponent));
  };
  return {TANGENCY_PARTS(of(x.low), of(x.high))};
}
/// As above, of x in [2^-126, 2^127).
HWY_INLINE FloatPack inverse_power(const FloatPack& x) {
  const auto of = [](const hn::Vec<F>& y) HWY_ATTR {
    const hn::RebindToUnsigned<F> words;
    const auto exponent = hn::And(hn::BitCast(words, y), hn::Set(words, 0x7f800000u));
    return hn::BitCast(F(), hn::Sub(hn::Set(words, 254u << 23), exponent));
  };
  return {TANGENCY_FLOAT_PARTS(of(x.low), of(x.high))};
}

// The approximations of float on x86 are within 1.5 * 2^-12 of themselves, those of AVX-512 within
// 2^-14. Sets without fused multiply-adds do without them, so that they have the same bits, on
// every processor: what reproducible runs rely on (dem/lanes/instruction_set.hpp).
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
#define TANGENCY_APPROXIMATE_FLOATS 1
#else
#define TANGENCY_APPROXIMATE_FLOATS 0
#endif

/// 1 / x to a relative 2^-13.
HWY_INLINE Pack rough_inverse(const Pack& x) {
#if HWY_TARGET == HWY_AVX3
  return {
      TANGENCY_PARTS(Register{_mm512_rcp14_pd(x.low.raw)}, Register{_mm512_rcp14_pd(x.high.raw)})};
#else
  return all(1.0) / x;
#endif
}
/// 1 / x to a relative 2^-11, |x| in [2^-126, 2^126].
HWY_INLINE FloatPack rough_inverse(const FloatPack& x) {
#if TANGENCY_APPROXIMATE_FLOATS
  return {hn::ApproximateReciprocal(x.low)};
#else
  return all<FloatPack>(1.0) / x;
#endif
}

/// 1 / x to a relative 2^-26.
HWY_INLINE Pack quick_inverse(const Pack& x) {
  Pack y = rough_inverse(x);
#if HWY_TARGET == HWY_AVX3
  y = multiply_add(y, multiply_take(x, y, all(1.0)), y);
#endif
  return y;
}
/// 1 / x to a relative 2^-21 in any rounding mode, |x| in [2^-126, 2^126]: (I) of
/// docs/derivations/gap-batch.md.
HWY_INLINE FloatPack quick_inverse(const FloatPack& x) {
  FloatPack y = rough_inverse(x);
#if TANGENCY_APPROXIMATE_FLOATS
  y = multiply_add(y, multiply_take(x, y, all<FloatPack>(1.0)), y);
#endif
  return y;
}

// Square roots and divisions of a whole register take as long as ten other operations: where an
// approximate 1 / sqrt(x) is at hand, inverse roots start there.
#if HWY_TARGET == HWY_AVX3
#define TANGENCY_APPROXIMATE_INVERSE_ROOT 1
/// Within 2^-14 of itself.
HWY_INLINE Pack approximate_inverse_root(const Pack& x) {
  return {TANGENCY_PARTS(Register{_mm512_rsqrt14_pd(x.low.raw)},
                         Register{_mm512_rsqrt14_pd(x.high.raw)})};
}
#elif HWY_TARGET == HWY_AVX2
#define TANGENCY_APPROXIMATE_INVERSE_ROOT 1
/// Within 2^-11.4 of itself for x in [2^-126, 2^127], elsewhere no number or infinite.
HWY_INLINE Pack approximate_inverse_root(const Pack& x) {
  const auto one = [](__m256d s) HWY_ATTR {
    return Register{_mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(s)))};
  };
  return {TANGENCY_PARTS(one(x.low.raw), one(x.high.raw))};
}
#else
#define TANGENCY_APPROXIMATE_INVERSE_ROOT 0
#endif

/// sqrt(x) to a relative 2^-13.
HWY_INLINE Pack rough_root(const Pack& x) {
#if HWY_TARGET == HWY_AVX3
  return x * approximate_inverse_root(x);
#else
  return root(x);
#endif
}

/// 1 / sqrt(x) to a relative 2.1 u, x in [2^-120, 2^120]: (I) of docs/derivations/gap-batch.md.
HWY_INLINE Pack inverse_root(const Pack& x) {
#if TANGENCY_APPROXIMATE_INVERSE_ROOT
  const Pack y = approximate_inverse_root(x);
  const Pack e = multiply_take(x * y, y, all(1.0));
#if HWY_TARGET == HWY_AVX3
  Pack series = all(0.3125);
#else
  Pack series = multiply_add(all(0.2734375), e, all(0.3125));
#endif
  series = multiply_add(series, e, all(0.375));
  series = multiply_add(series, e, all(0.5));
  return multiply_add(y, series * e, y);
#else
  return all(1.0) / root(x);
#endif
}
#undef TANGENCY_APPROXIMATE_INVERSE_ROOT

/// sqrt(x) to a relative 2^-10, x in [2^-126, 2^127].
HWY_INLINE FloatPack rough_root(const FloatPack& x) {
#if TANGENCY_APPROXIMATE_FLOATS
  return x * FloatPack{hn::ApproximateReciprocalSqrt(x.low)};
#else
  return root(x);
#endif
}

/// 1 / sqrt(x) to a relative 2.1 * 2^-24, in other rounding modes twice that, x in [2^-126, 2^127]:
/// (I) of docs/derivations/gap-batch.md.
HWY_INLINE FloatPack inverse_root(const FloatPack& x) {
  const FloatPack one = all<FloatPack>(1.0);
#if TANGENCY_APPROXIMATE_FLOATS
  const FloatPack y{hn::ApproximateReciprocalSqrt(x.low)};
  const FloatPack e = multiply_take(x * y, y, one);
  FloatPack series = all<FloatPack>(0.5);
#if HWY_TARGET != HWY_AVX3
  series = multiply_add(all<FloatPack>(0.375), e, series);
#endif
  return multiply_add(y, series * e, y);
#else
  return one / root(x);
#endif
}
#undef TANGENCY_APPROXIMATE_FLOATS

HWY_INLINE Pack load(const double* from) {
  return {TANGENCY_PARTS(hn::LoadU(D(), from), hn::LoadU(D(), from + register_lanes()))};
}
HWY_INLINE FloatPack load(const float* from) {
  return {TANGENCY_FLOAT_PARTS(hn::LoadU(F(), from), hn::LoadU(F(), from + hn::Lanes(F())))};
}
HWY_INLINE void store(const Pack& p, double* to) {
  hn::StoreU(p.low, D(), to);
#if TANGENCY_PACK_REGISTERS == 2
  hn::StoreU(p.high, D(), to + register_lanes());
#endif
}
HWY_INLINE void store(const FloatPack& p, float* to) {
  hn::StoreU(p.low, F(), to);
#if TANGENCY_FLOAT_REGISTERS == 2
  hn::StoreU(p.high, F(), to + hn::Lanes(F()));
#endif
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
