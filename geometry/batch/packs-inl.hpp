// SPDX-License-Identifier: MIT
/// @file
/// Vectors and symmetric matrices of many pairs at once, one pair in each lane, in double and in
/// float; what *_lanes.cpp computes with. Compiled once for each instruction set, as
/// pack_numbers-inl.hpp.
#if defined(TANGENCY_PACKS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_PACKS_INL
#undef TANGENCY_PACKS_INL
#else
#define TANGENCY_PACKS_INL
#endif

#include <tangency/geometry/batch/lane_block.hpp>
#include <tangency/geometry/batch/pack_numbers-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

template <class P>
struct Vec3Of {
  P x, y, z;
};
using PackVec3 = Vec3Of<Pack>;
using FloatVec3 = Vec3Of<FloatPack>;

template <class P>
HWY_INLINE P dot(const Vec3Of<P>& a, const Vec3Of<P>& b) {
  return multiply_add(a.z, b.z, multiply_add(a.y, b.y, a.x * b.x));
}
template <class P>
HWY_INLINE Vec3Of<P> operator*(const Vec3Of<P>& v, const P& s) {
  return {v.x * s, v.y * s, v.z * s};
}
template <class P>
HWY_INLINE Vec3Of<P> operator-(const Vec3Of<P>& v) {
  return {-v.x, -v.y, -v.z};
}
template <class P>
HWY_INLINE Vec3Of<P> operator-(const Vec3Of<P>& a, const Vec3Of<P>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class P>
HWY_INLINE Vec3Of<P> operator+(const Vec3Of<P>& a, const Vec3Of<P>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
/// s v + w
template <class P>
HWY_INLINE Vec3Of<P> multiply_add(const P& s, const Vec3Of<P>& v, const Vec3Of<P>& w) {
  return {multiply_add(s, v.x, w.x), multiply_add(s, v.y, w.y), multiply_add(s, v.z, w.z)};
}
/// w - s v
template <class P>
HWY_INLINE Vec3Of<P> multiply_take(const P& s, const Vec3Of<P>& v, const Vec3Of<P>& w) {
  return {multiply_take(s, v.x, w.x), multiply_take(s, v.y, w.y), multiply_take(s, v.z, w.z)};
}
template <class P>
HWY_INLINE P largest_component(const Vec3Of<P>& v) {
  return larger(larger(absolute(v.x), absolute(v.y)), absolute(v.z));
}
template <class P>
HWY_INLINE Vec3Of<P> normalised(const Vec3Of<P>& v) {
  return v * inverse_root(dot(v, v));
}
template <class M, class P>
HWY_INLINE Vec3Of<P> chosen(const M& yes, const Vec3Of<P>& v, const Vec3Of<P>& w) {
  return {chosen(yes, v.x, w.x), chosen(yes, v.y, w.y), chosen(yes, v.z, w.z)};
}

template <class P>
struct Symmetric3Of {
  P xx, yy, zz, yz, zx, xy;
};
using PackSymmetric3 = Symmetric3Of<Pack>;
using FloatSymmetric3 = Symmetric3Of<FloatPack>;

template <class P>
HWY_INLINE Vec3Of<P> operator*(const Symmetric3Of<P>& s, const Vec3Of<P>& v) {
  return {dot({s.xx, s.xy, s.zx}, v), dot({s.xy, s.yy, s.yz}, v), dot({s.zx, s.yz, s.zz}, v)};
}
template <class P>
HWY_INLINE P trace(const Symmetric3Of<P>& s) {
  return s.xx + s.yy + s.zz;
}
/// tr(A B)
template <class P>
HWY_INLINE P trace_of_product(const Symmetric3Of<P>& a, const Symmetric3Of<P>& b) {
  const P off = dot<P>({a.yz, a.zx, a.xy}, {b.yz, b.zx, b.xy});
  return multiply_add(all<P>(2.0), off, dot<P>({a.xx, a.yy, a.zz}, {b.xx, b.yy, b.zz}));
}
/// a b - c d
template <class P>
HWY_INLINE P minor(const P& a, const P& b, const P& c, const P& d) {
  return multiply_take(c, d, a * b);
}
template <class P>
HWY_INLINE Vec3Of<P> cross(const Vec3Of<P>& a, const Vec3Of<P>& b) {
  return {minor(a.y, b.z, a.z, b.y), minor(a.z, b.x, a.x, b.z), minor(a.x, b.y, a.y, b.x)};
}
template <class P>
HWY_INLINE Symmetric3Of<P> adjugate(const Symmetric3Of<P>& s) {
  return {minor(s.yy, s.zz, s.yz, s.yz), minor(s.zz, s.xx, s.zx, s.zx),
          minor(s.xx, s.yy, s.xy, s.xy), minor(s.zx, s.xy, s.xx, s.yz),
          minor(s.xy, s.yz, s.yy, s.zx), minor(s.yz, s.zx, s.zz, s.xy)};
}
template <class P>
HWY_INLINE P determinant(const Symmetric3Of<P>& s, const Symmetric3Of<P>& its_adjugate) {
  return dot<P>({s.xx, s.xy, s.zx}, {its_adjugate.xx, its_adjugate.xy, its_adjugate.zx});
}
template <class P>
HWY_INLINE Symmetric3Of<P> operator*(const Symmetric3Of<P>& s, const P& w) {
  return {s.xx * w, s.yy * w, s.zz * w, s.yz * w, s.zx * w, s.xy * w};
}
/// w S + T
template <class P>
HWY_INLINE Symmetric3Of<P> multiply_add(const P& w, const Symmetric3Of<P>& s,
                                        const Symmetric3Of<P>& t) {
  return {multiply_add(w, s.xx, t.xx), multiply_add(w, s.yy, t.yy), multiply_add(w, s.zz, t.zz),
          multiply_add(w, s.yz, t.yz), multiply_add(w, s.zx, t.zx), multiply_add(w, s.xy, t.xy)};
}
/// S + w v v'
template <class P>
HWY_INLINE Symmetric3Of<P> with_square(const Symmetric3Of<P>& s, const P& w, const Vec3Of<P>& v) {
  const Vec3Of<P> p = v * w;
  return {multiply_add(p.x, v.x, s.xx), multiply_add(p.y, v.y, s.yy), multiply_add(p.z, v.z, s.zz),
          multiply_add(p.y, v.z, s.yz), multiply_add(p.z, v.x, s.zx), multiply_add(p.x, v.y, s.xy)};
}
/// S S' of S by its columns.
template <class P>
HWY_INLINE Symmetric3Of<P> square_of_factor(const Vec3Of<P>& p, const Vec3Of<P>& q,
                                            const Vec3Of<P>& r) {
  const Vec3Of<P> x{p.x, q.x, r.x}, y{p.y, q.y, r.y}, z{p.z, q.z, r.z};
  return {dot(x, x), dot(y, y), dot(z, z), dot(y, z), dot(z, x), dot(x, y)};
}

/// Are all components 0, of either sign?
template <class P>
HWY_INLINE auto is_nothing(const Vec3Of<P>& v) {
  return largest_component(v) <= all<P>(0.0);
}

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

/// Normals of the caller's, of any length: times a power of two each, which is exact and brings the
/// largest component into [1, 2), so that no square under- or overflows, in float either. 0 stays
/// 0.
HWY_INLINE PackVec3 load_normals(const double* from) {
  const PackVec3 v = load_vectors(from);
  return v * inverse_power(largest_component(v));
}

#if TANGENCY_PACK_REGISTERS == 2
HWY_INLINE FloatVec3 to_float(const PackVec3& v) {
  return {to_float(v.x), to_float(v.y), to_float(v.z)};
}
HWY_INLINE PackVec3 to_double(const FloatVec3& v) {
  return {to_double(v.x), to_double(v.y), to_double(v.z)};
}
HWY_INLINE FloatSymmetric3 to_float(const PackSymmetric3& s) {
  return {to_float(s.xx), to_float(s.yy), to_float(s.zz),
          to_float(s.yz), to_float(s.zx), to_float(s.xy)};
}
#endif

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
