// SPDX-License-Identifier: MIT
#include <tangency/geometry/batch/moving_lanes.hpp>

#include <cstddef>

#include <tangency/geometry/power_of_two.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/batch/moving_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#define TANGENCY_PACK_REGISTERS 1
#include <tangency/geometry/batch/packs-inl.hpp>
#include <tangency/geometry/batch/shape_rows-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

// The least radius of curvature is a lower bound: two quotients are rounded.
constexpr double kBelow = 1.0 - 0x1p-40;

HWY_INLINE Pack sum_of_squares(const Pack& a, const Pack& b) { return multiply_add(a, a, b * b); }

/// The columns of R(q/|q|): (Q) of docs/derivations/gap-batch.md.
struct PackRotation {
  PackVec3 x, y, z;
  Pack square;  ///< |q|^2
};

HWY_INLINE PackRotation rotation(const PackQuaternion& q) {
  const Pack wx = sum_of_squares(q.w, q.x), yz = sum_of_squares(q.y, q.z);
  const Pack wy = sum_of_squares(q.w, q.y), zx = sum_of_squares(q.z, q.x);
  const Pack wz = sum_of_squares(q.w, q.z), xy = sum_of_squares(q.x, q.y);
  const Pack square = wx + yz, once = all(1.0) / square, twice = once + once;
  const auto less = [&](const Pack& a, const Pack& b, const Pack& c, const Pack& d) HWY_ATTR {
    return multiply_take(c, d, a * b) * twice;  // 2 (a b - c d)
  };
  const auto more = [&](const Pack& a, const Pack& b, const Pack& c, const Pack& d)
                        HWY_ATTR { return multiply_add(c, d, a * b) * twice; };
  return {{(wx - yz) * once, more(q.x, q.y, q.w, q.z), less(q.x, q.z, q.w, q.y)},
          {less(q.x, q.y, q.w, q.z), (wy - zx) * once, more(q.y, q.z, q.w, q.x)},
          {more(q.x, q.z, q.w, q.y), less(q.y, q.z, q.w, q.x), (wz - xy) * once},
          square};
}

/// Two floats in the place of one double.
HWY_INLINE Pack floats_beside(const Pack& first, const Pack& second) {
  const hn::Rebind<float, D> half;
  const hn::RebindToUnsigned<decltype(half)> narrow;
  const hn::RebindToUnsigned<D> wide;
  const auto bits = [&](const Pack& p) HWY_ATTR {
    return hn::PromoteTo(wide, hn::BitCast(narrow, hn::DemoteTo(half, p.low)));
  };
  const auto both = hn::Or(bits(first), hn::ShiftLeft<32>(bits(second)));
  return {hn::BitCast(D(), both)};
}

/// Four columns to rows that are `stride` doubles apart: what load_columns() of pack_bodies-inl.hpp
/// undoes. The last of a block may be fewer rows than lanes.
HWY_INLINE void store_four(const Pack* column, std::size_t count, std::size_t stride, double* to) {
#if HWY_TARGET == HWY_AVX3
  if (count == kMostLanes) {
    const __m512d c0 = column[0].low.raw, c1 = column[1].low.raw;
    const __m512d c2 = column[2].low.raw, c3 = column[3].low.raw;
    const __m512d even01 = _mm512_unpacklo_pd(c0, c1), odd01 = _mm512_unpackhi_pd(c0, c1);
    const __m512d even23 = _mm512_unpacklo_pd(c2, c3), odd23 = _mm512_unpackhi_pd(c2, c3);
    const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i second = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    const auto two_rows = [&](std::size_t i, __m512d rows) HWY_ATTR {
      _mm256_storeu_pd(to + i * stride, _mm512_castpd512_pd256(rows));
      _mm256_storeu_pd(to + (i + 4) * stride, _mm512_extractf64x4_pd(rows, 1));
    };
    two_rows(0, _mm512_permutex2var_pd(even01, first, even23));
    two_rows(1, _mm512_permutex2var_pd(odd01, first, odd23));
    two_rows(2, _mm512_permutex2var_pd(even01, second, even23));
    two_rows(3, _mm512_permutex2var_pd(odd01, second, odd23));
    return;
  }
#endif
  HWY_ALIGN double rows[4 * kMostLanes];  // row after row
  hn::StoreInterleaved4(column[0].low, column[1].low, column[2].low, column[3].low, D(), rows);
  for (std::size_t i = 0; i < count; ++i)
    __builtin_memcpy(to + i * stride, rows + 4 * i, 4 * sizeof(double));
}

template <std::size_t columns>
HWY_INLINE void store_rows(const Pack (&column)[columns], std::size_t count, double* to) {
  static_assert(columns % 4 == 0);
  for (std::size_t c = 0; c < columns; c += 4) store_four(column + c, count, columns, to + c);
}

HWY_INLINE PackSymmetric3 shape_of(const PackVec3& first, const PackVec3& second,
                                   const PackVec3& third, const Pack& largest) {
  const Register rounder = rounder_of(largest.low);
  const auto row = [&](const Pack& p, const Pack& q, const Pack& r) HWY_ATTR {
    return FactorRow<Register>{factor(p.low, rounder), factor(q.low, rounder),
                               factor(r.low, rounder)};
  };
  const FactorRow<Register> x = row(first.x, second.x, third.x),
                            y = row(first.y, second.y, third.y),
                            z = row(first.z, second.z, third.z);
  const auto product = [&](const FactorRow<Register>& r, const FactorRow<Register>& q)
                           HWY_ATTR { return Pack{inner(r, q, rounder)}; };
  return {product(x, x), product(y, y), product(z, z), product(z, y), product(z, x), product(x, y)};
}

/// The largest sum of absolute values over a row, rounded up.
HWY_INLINE Pack reach_of(const PackSymmetric3& m) {
  const Pack yz = absolute(m.yz), zx = absolute(m.zx), xy = absolute(m.xy);
  return all(kAboveSum) * larger(larger(m.xx + (zx + xy), m.yy + (yz + xy)), m.zz + (yz + zx));
}

/// One register of bodies.
HWY_INLINE void fill_rows(const double* semi_axes, const double* orientations,
                          const double* centres, std::size_t count, const RowsOfBodies& to) {
  const PackVec3 axes = load_vectors(semi_axes);
  const PackRotation turn = rotation(load_quaternions(orientations));
  const Pack largest = larger(larger(axes.x, axes.y), axes.z);
  const Pack smallest = smaller(smaller(axes.x, axes.y), axes.z);
  // Each axis by itself: the larger of a number and NaN may be either.
  const auto in_range = [](const Pack& a) HWY_ATTR {
    return (a >= all(kSmallestModerate)) & (a <= all(kLargestModerate));
  };
  const PackMask moderate =
      in_range(axes.x) & in_range(axes.y) & in_range(axes.z) & in_range(turn.square);
  const Pack nothing = all(0.0), no_number = {hn::NaN(D())};
  const PackVec3 centre =
      centres == nullptr ? PackVec3{nothing, nothing, nothing} : load_vectors(centres);
  const PackVec3 first = turn.x * axes.x, second = turn.y * axes.y, third = turn.z * axes.z;
  const Pack given = chosen(moderate, largest, no_number);
  const Pack least = all(kBelow) * (smallest * (smallest / largest));
  const Pack lane_columns[16] = {centre.x, centre.y, centre.z, given,    least,    first.x,
                                 first.y,  first.z,  second.x, second.y, second.z, third.x,
                                 third.y,  third.z,  nothing,  nothing};
  store_rows(lane_columns, count, reinterpret_cast<double*>(to.lanes));

  const PackSymmetric3 m = shape_of(first, second, third, given);
  const Pack reach = reach_of(m);
  const Pack thick = chosen(least < all(kFlattest) * given, no_number, given);
  const Pack shape_columns[12] = {centre.x, centre.y, centre.z, thick, least, reach,
                                  m.xx,     m.yy,     m.zz,     m.yz,  m.zx,  m.xy};
  store_rows(shape_columns, count, reinterpret_cast<double*>(to.shapes));

  if (to.floats == nullptr) return;
  // Bodies that are not moderate have no M, and else a radius out of the range of float.
  const Pack radius = chosen(moderate, all(kBelowFloat) * least, nothing);
  const Pack not_thin = chosen(least < all(kThinnestInLanes) * given, no_number, given);
  const Pack float_columns[8] = {centre.x,
                                 centre.y,
                                 centre.z,
                                 floats_beside(not_thin, radius),
                                 floats_beside(m.xx, m.yy),
                                 floats_beside(m.zz, m.yz),
                                 floats_beside(m.zx, m.xy),
                                 floats_beside(all(kAboveFloat) * reach, nothing)};
  store_rows(float_columns, count, reinterpret_cast<double*>(to.floats));
}

HWY_ATTR void fill_moving_lanes(const double* semi_axes, const double* orientations,
                                const double* centres, std::size_t count, const RowsOfBodies& to) {
  const std::size_t lanes = pack_lanes();
  const auto from = [&](std::size_t i) {
    return RowsOfBodies{to.lanes + i, to.shapes + i,
                        to.floats == nullptr ? nullptr : to.floats + i};
  };
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    fill_rows(semi_axes + 3 * i, orientations + 4 * i,
              centres == nullptr ? nullptr : centres + 3 * i, lanes, from(i));
  if (i == count) return;
  double axes[3 * kMostLanes], turns[4 * kMostLanes], places[3 * kMostLanes];
  for (std::size_t k = 0; k < lanes; ++k) {
    const std::size_t body = i + k < count ? i + k : i;
    for (std::size_t c = 0; c < 3; ++c) axes[3 * k + c] = semi_axes[3 * body + c];
    for (std::size_t c = 0; c < 4; ++c) turns[4 * k + c] = orientations[4 * body + c];
    for (std::size_t c = 0; c < 3 && centres != nullptr; ++c)
      places[3 * k + c] = centres[3 * body + c];
  }
  fill_rows(axes, turns, centres == nullptr ? nullptr : places, count - i, from(i));
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::detail {
namespace {
HWY_EXPORT(fill_moving_lanes);
}  // namespace

void fill_moving_lanes(const double* semi_axes, const double* orientations, const double* centres,
                       std::size_t count, const RowsOfBodies& to) noexcept {
  HWY_DYNAMIC_DISPATCH(fill_moving_lanes)(semi_axes, orientations, centres, count, to);
}

}  // namespace tangency::inline v0::detail
#endif
