// SPDX-License-Identifier: MIT
/// @file
/// Numbers, vectors and symmetric matrices of many pairs at once, one pair in each lane; what
/// *_lanes.cpp computes with. Compiled once for each instruction set, each copy in a namespace of
/// its own and with internal linkage: the guard is Highway's toggle. No function of another header
/// may be called from here: compiled for this instruction set it could be the copy that the linker
/// keeps for all.
#if defined(TANGENCY_PACKS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_PACKS_INL
#undef TANGENCY_PACKS_INL
#else
#define TANGENCY_PACKS_INL
#endif

#include <hwy/highway.h>

#include <tangency/geometry/batch/lane_block.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<double>;
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

#if TANGENCY_PACK_REGISTERS == 2
#define TANGENCY_PARTS(low, high) low, high
#else
#define TANGENCY_PARTS(low, high) low
#endif

/// The most numbers that a register of any machine with this instruction set has.
constexpr std::size_t kMostLanes = HWY_MAX_BYTES / sizeof(double);

HWY_INLINE std::size_t register_lanes() { return hn::Lanes(D()); }
HWY_INLINE std::size_t pack_lanes() { return TANGENCY_PACK_REGISTERS * hn::Lanes(D()); }

HWY_INLINE Pack all(double x) { return {TANGENCY_PARTS(hn::Set(D(), x), hn::Set(D(), x))}; }

#define TANGENCY_PACK_1(name, call)                             \
  HWY_INLINE Pack name(const Pack& a) {                         \
    return {TANGENCY_PARTS(hn::call(a.low), hn::call(a.high))}; \
  }
#define TANGENCY_PACK_2(type, name, call)                                      \
  HWY_INLINE type name(const Pack& a, const Pack& b) {                         \
    return {TANGENCY_PARTS(hn::call(a.low, b.low), hn::call(a.high, b.high))}; \
  }
#define TANGENCY_PACK_3(name, call)                                                           \
  HWY_INLINE Pack name(const Pack& a, const Pack& b, const Pack& c) {                         \
    return {TANGENCY_PARTS(hn::call(a.low, b.low, c.low), hn::call(a.high, b.high, c.high))}; \
  }
TANGENCY_PACK_1(operator-, Neg)
TANGENCY_PACK_1(absolute, Abs)
TANGENCY_PACK_1(root, Sqrt)
TANGENCY_PACK_2(Pack, operator+, Add)
TANGENCY_PACK_2(Pack, operator-, Sub)
TANGENCY_PACK_2(Pack, operator*, Mul)
TANGENCY_PACK_2(Pack, operator/, Div)
TANGENCY_PACK_2(Pack, larger, Max)
TANGENCY_PACK_2(Pack, smaller, Min)
TANGENCY_PACK_2(PackMask, operator<, Lt)
TANGENCY_PACK_2(PackMask, operator>, Gt)
TANGENCY_PACK_2(PackMask, operator<=, Le)
TANGENCY_PACK_2(PackMask, operator>=, Ge)
TANGENCY_PACK_3(multiply_add, MulAdd)      // a b + c, rounded once where the machine can
TANGENCY_PACK_3(multiply_take, NegMulAdd)  // c - a b
#undef TANGENCY_PACK_1
#undef TANGENCY_PACK_2
#undef TANGENCY_PACK_3

HWY_INLINE PackMask operator&(const PackMask& a, const PackMask& b) {
  return {TANGENCY_PARTS(hn::And(a.low, b.low), hn::And(a.high, b.high))};
}
HWY_INLINE PackMask operator|(const PackMask& a, const PackMask& b) {
  return {TANGENCY_PARTS(hn::Or(a.low, b.low), hn::Or(a.high, b.high))};
}
/// a and not b
HWY_INLINE PackMask without(const PackMask& a, const PackMask& b) {
  return {TANGENCY_PARTS(hn::AndNot(b.low, a.low), hn::AndNot(b.high, a.high))};
}
HWY_INLINE PackMask none_of_them() { return all(0.0) < all(0.0); }
HWY_INLINE bool none(const PackMask& m) {
#if TANGENCY_PACK_REGISTERS == 2
  if (!hn::AllFalse(D(), m.high)) return false;
#endif
  return hn::AllFalse(D(), m.low);
}
HWY_INLINE Pack chosen(const PackMask& yes, const Pack& a, const Pack& b) {
  return {TANGENCY_PARTS(hn::IfThenElse(yes.low, a.low, b.low),
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

/// 1 / x to a relative 2^-13.
HWY_INLINE Pack rough_inverse(const Pack& x) {
#if HWY_TARGET == HWY_AVX3
  return {
      TANGENCY_PARTS(Register{_mm512_rcp14_pd(x.low.raw)}, Register{_mm512_rcp14_pd(x.high.raw)})};
#else
  return all(1.0) / x;
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

struct PackVec3 {
  Pack x, y, z;
};

HWY_INLINE Pack dot(const PackVec3& a, const PackVec3& b) {
  return multiply_add(a.z, b.z, multiply_add(a.y, b.y, a.x * b.x));
}
HWY_INLINE PackVec3 operator*(const PackVec3& v, const Pack& s) {
  return {v.x * s, v.y * s, v.z * s};
}
HWY_INLINE PackVec3 operator-(const PackVec3& v) { return {-v.x, -v.y, -v.z}; }
HWY_INLINE PackVec3 operator-(const PackVec3& a, const PackVec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE PackVec3 operator+(const PackVec3& a, const PackVec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
/// s v + w
HWY_INLINE PackVec3 multiply_add(const Pack& s, const PackVec3& v, const PackVec3& w) {
  return {multiply_add(s, v.x, w.x), multiply_add(s, v.y, w.y), multiply_add(s, v.z, w.z)};
}
/// w - s v
HWY_INLINE PackVec3 multiply_take(const Pack& s, const PackVec3& v, const PackVec3& w) {
  return {multiply_take(s, v.x, w.x), multiply_take(s, v.y, w.y), multiply_take(s, v.z, w.z)};
}
HWY_INLINE Pack largest_component(const PackVec3& v) {
  return larger(larger(absolute(v.x), absolute(v.y)), absolute(v.z));
}
HWY_INLINE PackVec3 normalised(const PackVec3& v) { return v * inverse_root(dot(v, v)); }
HWY_INLINE PackVec3 chosen(const PackMask& yes, const PackVec3& v, const PackVec3& w) {
  return {chosen(yes, v.x, w.x), chosen(yes, v.y, w.y), chosen(yes, v.z, w.z)};
}

struct PackSymmetric3 {
  Pack xx, yy, zz, yz, zx, xy;
};

HWY_INLINE PackVec3 operator*(const PackSymmetric3& s, const PackVec3& v) {
  return {dot({s.xx, s.xy, s.zx}, v), dot({s.xy, s.yy, s.yz}, v), dot({s.zx, s.yz, s.zz}, v)};
}
HWY_INLINE Pack trace(const PackSymmetric3& s) { return s.xx + s.yy + s.zz; }
/// tr(A B)
HWY_INLINE Pack trace_of_product(const PackSymmetric3& a, const PackSymmetric3& b) {
  const Pack off = dot({a.yz, a.zx, a.xy}, {b.yz, b.zx, b.xy});
  return multiply_add(all(2.0), off, dot({a.xx, a.yy, a.zz}, {b.xx, b.yy, b.zz}));
}
/// a b - c d
HWY_INLINE Pack minor(const Pack& a, const Pack& b, const Pack& c, const Pack& d) {
  return multiply_take(c, d, a * b);
}
HWY_INLINE PackVec3 cross(const PackVec3& a, const PackVec3& b) {
  return {minor(a.y, b.z, a.z, b.y), minor(a.z, b.x, a.x, b.z), minor(a.x, b.y, a.y, b.x)};
}
HWY_INLINE PackSymmetric3 adjugate(const PackSymmetric3& s) {
  return {minor(s.yy, s.zz, s.yz, s.yz), minor(s.zz, s.xx, s.zx, s.zx),
          minor(s.xx, s.yy, s.xy, s.xy), minor(s.zx, s.xy, s.xx, s.yz),
          minor(s.xy, s.yz, s.yy, s.zx), minor(s.yz, s.zx, s.zz, s.xy)};
}
HWY_INLINE PackSymmetric3 operator*(const PackSymmetric3& s, const Pack& w) {
  return {s.xx * w, s.yy * w, s.zz * w, s.yz * w, s.zx * w, s.xy * w};
}
/// w S + T
HWY_INLINE PackSymmetric3 multiply_add(const Pack& w, const PackSymmetric3& s,
                                       const PackSymmetric3& t) {
  return {multiply_add(w, s.xx, t.xx), multiply_add(w, s.yy, t.yy), multiply_add(w, s.zz, t.zz),
          multiply_add(w, s.yz, t.yz), multiply_add(w, s.zx, t.zx), multiply_add(w, s.xy, t.xy)};
}
/// S + w v v'
HWY_INLINE PackSymmetric3 with_square(const PackSymmetric3& s, const Pack& w, const PackVec3& v) {
  const PackVec3 p = v * w;
  return {multiply_add(p.x, v.x, s.xx), multiply_add(p.y, v.y, s.yy), multiply_add(p.z, v.z, s.zz),
          multiply_add(p.y, v.z, s.yz), multiply_add(p.z, v.x, s.zx), multiply_add(p.x, v.y, s.xy)};
}

HWY_INLINE Pack load(const double* from) {
  return {TANGENCY_PARTS(hn::LoadU(D(), from), hn::LoadU(D(), from + register_lanes()))};
}
HWY_INLINE void store(const Pack& p, double* to) {
  hn::StoreU(p.low, D(), to);
#if TANGENCY_PACK_REGISTERS == 2
  hn::StoreU(p.high, D(), to + register_lanes());
#endif
}
/// Are all components 0, of either sign?
HWY_INLINE PackMask is_nothing(const PackVec3& v) { return largest_component(v) <= all(0.0); }

/// x y z of one pair after the other
HWY_INLINE PackVec3 load_vectors(const double* from) {
  PackVec3 v;
  hn::LoadInterleaved3(D(), from, v.x.low, v.y.low, v.z.low);
#if TANGENCY_PACK_REGISTERS == 2
  hn::LoadInterleaved3(D(), from + 3 * register_lanes(), v.x.high, v.y.high, v.z.high);
#endif
  return v;
}
HWY_INLINE void store(const PackVec3& v, double* to) {
  hn::StoreInterleaved3(v.x.low, v.y.low, v.z.low, D(), to);
#if TANGENCY_PACK_REGISTERS == 2
  hn::StoreInterleaved3(v.x.high, v.y.high, v.z.high, D(), to + 3 * register_lanes());
#endif
}

#if TANGENCY_PACK_REGISTERS == 1
/// (x, y, z) is a vector, as Eigen stores it.
struct PackQuaternion {
  Pack x, y, z, w;
};

HWY_INLINE PackQuaternion load_quaternions(const double* from) {
  PackQuaternion q;
  hn::LoadInterleaved4(D(), from, q.x.low, q.y.low, q.z.low, q.w.low);
  return q;
}
#endif

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
