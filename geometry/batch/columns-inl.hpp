// SPDX-License-Identifier: MIT
/// @file
/// Numbers of a block of pairs by columns, which is how the stages of *_lanes.cpp hand them on.
/// Compiled once for each instruction set.
#if defined(TANGENCY_COLUMNS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_COLUMNS_INL
#undef TANGENCY_COLUMNS_INL
#else
#define TANGENCY_COLUMNS_INL
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

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
