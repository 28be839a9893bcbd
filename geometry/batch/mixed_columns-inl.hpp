// SPDX-License-Identifier: MIT
/// @file
/// A block of pairs by columns, as the stages of mixed_lanes.cpp hand it on: small enough for the
/// nearest cache. Compiled once for each instruction set.
#if defined(TANGENCY_MIXED_COLUMNS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_MIXED_COLUMNS_INL
#undef TANGENCY_MIXED_COLUMNS_INL
#else
#define TANGENCY_MIXED_COLUMNS_INL
#endif

#include <cstddef>

#include <tangency/geometry/batch/packs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

constexpr std::size_t kPairs = LaneBlock::kPairs;

template <class T>
struct alignas(64) Column {
  T entry[kPairs];
};

template <class T, std::size_t count>
struct ColumnsOf {
  Column<T> column[count];
};

HWY_INLINE Pack load(const Column<double>& from, std::size_t i) { return load(from.entry + i); }
HWY_INLINE FloatPack load(const Column<float>& from, std::size_t i) { return load(from.entry + i); }
template <class T>
HWY_INLINE auto load(const ColumnsOf<T, 3>& from, std::size_t i) {
  const Column<T>* c = from.column;
  using P = decltype(load(*c, i));
  return Vec3Of<P>{load(c[0], i), load(c[1], i), load(c[2], i)};
}
template <class T>
HWY_INLINE auto load(const ColumnsOf<T, 6>& from, std::size_t i) {
  const Column<T>* c = from.column;
  using P = decltype(load(*c, i));
  return Symmetric3Of<P>{load(c[0], i), load(c[1], i), load(c[2], i),
                         load(c[3], i), load(c[4], i), load(c[5], i)};
}
template <class P, class T>
HWY_INLINE void store(const P& p, Column<T>& to, std::size_t i) {
  store(p, to.entry + i);
}
template <class P, class T>
HWY_INLINE void store(const Vec3Of<P>& v, ColumnsOf<T, 3>& to, std::size_t i) {
  store(v.x, to.column[0], i);
  store(v.y, to.column[1], i);
  store(v.z, to.column[2], i);
}
template <class P, class T>
HWY_INLINE void store(const Symmetric3Of<P>& s, ColumnsOf<T, 6>& to, std::size_t i) {
  store(s.xx, to.column[0], i);
  store(s.yy, to.column[1], i);
  store(s.zz, to.column[2], i);
  store(s.yz, to.column[3], i);
  store(s.zx, to.column[4], i);
  store(s.xy, to.column[5], i);
}

/// A body of each pair: ShapeRow by columns, in its order.
struct BodyColumns {
  Column<double> column[sizeof(ShapeRow) / sizeof(double)];

  HWY_INLINE PackVec3 centre(std::size_t i) const {
    return {number(0, i), number(1, i), number(2, i)};
  }
  HWY_INLINE Pack largest(std::size_t i) const { return number(3, i); }
  HWY_INLINE Pack least_radius(std::size_t i) const { return number(4, i); }
  HWY_INLINE Pack reach(std::size_t i) const { return number(5, i); }
  HWY_INLINE PackSymmetric3 shape(std::size_t i) const {
    return {number(6, i), number(7, i), number(8, i), number(9, i), number(10, i), number(11, i)};
  }
  HWY_INLINE Pack number(std::size_t c, std::size_t i) const { return load(column[c], i); }
};
static_assert(sizeof(BodyColumns) == sizeof(ShapeRow) * kPairs);

/// A body of each pair in the pair's own unit.
struct FloatBodyColumns {
  ColumnsOf<float, 6> shape;
  Column<float> largest, reach;
  Column<float> inverse_h;    ///< at the normal
  ColumnsOf<float, 3> point;  ///< of support there
};

struct MixedColumns {
  BodyColumns a, b;
  ColumnsOf<double, 3> d;
  ColumnsOf<double, 3> normal;  ///< that is answered
  Column<double> value;         ///< f at the normal below

  // In the pair's own unit, the power of two with L in [1, 2).
  Column<double> unit;
  FloatBodyColumns float_a, float_b;
  ColumnsOf<float, 3> float_d;
  Column<float> size;   ///< L, NaN where float does not reach
  Column<float> radii;  ///< of curvature, the least ones' sum
  Column<float> tolerance;
  ColumnsOf<float, 3> start;     ///< the normal that is looked at
  ColumnsOf<float, 6> adjugate;  ///< of K where the last step was taken
  Column<float> inverse_determinant;
  Column<float> gap;
  ColumnsOf<float, 3> rest;  ///< r
};

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
