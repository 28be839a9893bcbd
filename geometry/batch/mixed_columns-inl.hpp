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

#include <tangency/geometry/batch/columns-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

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
