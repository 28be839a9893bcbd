// SPDX-License-Identifier: MIT
// One body after the other, the entries of its matrix two at a time.
#include <tangency/geometry/batch/shape_rows.hpp>

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/batch/shape_rows.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <tangency/geometry/batch/shape_rows-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE double larger(double a, double b) { return a > b ? a : b; }

/// xx yy zz yz zx xy of M, and its largest sum of absolute values over a row.
struct Shape {
  double entry[6], reach;
};

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE Shape shape_of(const double* s, double largest) {
  using V = hn::Vec<hn::CappedTag<double, 1>>;
  const V rounder = rounder_of(every<V>(largest));
  const auto row = [=](std::size_t i) HWY_ATTR {
    const auto entry = [=](std::size_t k)
                           HWY_ATTR { return factor(every<V>(s[3 * k + i]), rounder); };
    return FactorRow<V>{entry(0), entry(1), entry(2)};
  };
  const FactorRow<V> x = row(0), y = row(1), z = row(2);
  const auto product = [=](const FactorRow<V>& r, const FactorRow<V>& q)
                           HWY_ATTR { return hn::GetLane(inner(r, q, rounder)); };
  Shape m = {
      {product(x, x), product(y, y), product(z, z), product(z, y), product(z, x), product(x, y)},
      0.0};
  const auto size = [&m](std::size_t k) HWY_ATTR { return __builtin_fabs(m.entry[k]); };
  m.reach = larger(larger(size(0) + (size(4) + size(5)), size(1) + (size(3) + size(5))),
                   size(2) + (size(3) + size(4)));
  return m;
}
#else
using Two = hn::FixedTag<double, 2>;
using V = hn::Vec<Two>;

HWY_INLINE V lower_and_upper(V a, V b) { return hn::ConcatUpperLower(Two(), b, a); }
HWY_INLINE V lowers(V a, V b) { return hn::InterleaveLower(Two(), a, b); }
HWY_INLINE V uppers(V a, V b) { return hn::InterleaveUpper(Two(), a, b); }

/// use(a, b) of all parts of two rows.
template <class Use>
HWY_INLINE FactorRow<V> both(const FactorRow<V>& a, const FactorRow<V>& b, const Use& use) {
  const auto of = [&use](const Factor<V>& p, const Factor<V>& q) HWY_ATTR {
#if HWY_NATIVE_FMA
    return Factor<V>{use(p.whole, q.whole)};
#else
    return Factor<V>{use(p.whole, q.whole), use(p.high, q.high), use(p.low, q.low)};
#endif
  };
  return {of(a.first, b.first), of(a.second, b.second), of(a.third, b.third)};
}

HWY_INLINE Shape shape_of(const double* s, double largest) {
  const Two d;
  const V rounder = rounder_of(hn::Set(d, largest));
  const auto xy_of = [&](const double* column)
                         HWY_ATTR { return factor(hn::LoadU(d, column), rounder); };
  const auto z_of = [&](const double* column)
                        HWY_ATTR { return factor(hn::Set(d, column[2]), rounder); };
  const FactorRow<V> x_y = {xy_of(s), xy_of(s + 3), xy_of(s + 6)};
  const FactorRow<V> z_z = {z_of(s), z_of(s + 3), z_of(s + 6)};
  const V xx_yy = inner(x_y, x_y, rounder), zx_zy = inner(z_z, x_y, rounder);
  const V zz_xy =
      inner(both(z_z, x_y, [](V a, V b) HWY_ATTR { return lowers(a, b); }),
            both(z_z, x_y, [](V a, V b) HWY_ATTR { return lower_and_upper(a, b); }), rounder);
  Shape m;
  hn::StoreU(xx_yy, d, m.entry);
  hn::StoreU(lower_and_upper(zz_xy, zx_zy), d, m.entry + 2);
  hn::StoreU(lower_and_upper(zx_zy, zz_xy), d, m.entry + 4);
  const V zx = hn::Abs(zx_zy), xy = hn::Abs(uppers(zz_xy, zz_xy)), zy = uppers(zx, zx);
  const V rows = hn::Add(xx_yy, hn::Add(zx, xy));
  const double z = hn::GetLane(hn::Add(zz_xy, hn::Add(zy, zx)));
  m.reach = larger(larger(hn::GetLane(rows), hn::GetLane(uppers(rows, rows))), z);
  return m;
}
#endif

HWY_INLINE void fill(const LaneBody& body, ShapeRow& row) {
  const Shape m = shape_of(body.factor, body.largest);
  const bool flat = body.least_radius < kFlattest * body.largest;
  row = {{body.centre[0], body.centre[1], body.centre[2]},
         flat ? __builtin_nan("") : body.largest,
         body.least_radius,
         kAboveSum * m.reach,
         {m.entry[0], m.entry[1], m.entry[2], m.entry[3], m.entry[4], m.entry[5]}};
}

/// @param body  for its largest semi-axis, which the row of a thin body does not have
HWY_INLINE void fill(const LaneBody& body, const ShapeRow& row, FloatRow& to) {
  // Bodies that are not moderate have no M, and else a radius out of the range of float.
  const double radius = __builtin_isnan(body.largest) ? 0.0 : kBelowFloat * row.least_radius;
  const bool thin = body.least_radius < kThinnestInLanes * body.largest;
  for (std::size_t k = 0; k < 3; ++k) to.centre[k] = row.centre[k];
  to.largest = thin ? __builtin_nanf("") : static_cast<float>(body.largest);
  to.least_radius = static_cast<float>(radius);
  to.widest = static_cast<float>(kAboveFloat * row.reach);
  for (std::size_t k = 0; k < 6; ++k) to.shape[k] = static_cast<float>(row.shape[k]);
  to.unused = 0.0F;
}

HWY_ATTR void fill_shape_rows(const LaneBody* bodies, std::size_t count, ShapeRow* to) {
  for (std::size_t i = 0; i < count; ++i) fill(bodies[i], to[i]);
}

HWY_ATTR void fill_float_rows(const LaneBody* bodies, const ShapeRow* rows, std::size_t count,
                              FloatRow* to) {
  for (std::size_t i = 0; i < count; ++i) fill(bodies[i], rows[i], to[i]);
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::detail {
namespace {
HWY_EXPORT(fill_shape_rows);
HWY_EXPORT(fill_float_rows);
}  // namespace

void fill_shape_rows(const LaneBody* bodies, std::size_t count, ShapeRow* to) noexcept {
  HWY_DYNAMIC_DISPATCH(fill_shape_rows)(bodies, count, to);
}
void fill_float_rows(const LaneBody* bodies, const ShapeRow* rows, std::size_t count,
                     FloatRow* to) noexcept {
  HWY_DYNAMIC_DISPATCH(fill_float_rows)(bodies, rows, count, to);
}

}  // namespace tangency::inline v0::detail
#endif
