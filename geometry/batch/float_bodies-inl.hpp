// SPDX-License-Identifier: MIT
/// @file
/// Pairs in float, one in each lane, scaled to a size in [1, 2). Compiled once for each instruction
/// set.
#if defined(TANGENCY_FLOAT_BODIES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_FLOAT_BODIES_INL
#undef TANGENCY_FLOAT_BODIES_INL
#else
#define TANGENCY_FLOAT_BODIES_INL
#endif

#include <cstddef>
#include <cstdint>

#include <tangency/geometry/batch/columns-inl.hpp>
#include <tangency/geometry/batch/float_rows.hpp>
#include <tangency/geometry/batch/pack_bodies-inl.hpp>
#include <tangency/geometry/power_of_two.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

/// A body of each pair: FloatRow by columns.
struct FloatRowColumns {
  ColumnsOf<double, 3> centre;
  Column<float> largest, least_radius;
  ColumnsOf<float, 6> shape;
  Column<float> widest;
};
struct FloatPairColumns {
  FloatRowColumns a, b;
};

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
// Straight-line code for eight rows: of loops over them g++ makes vectors of addresses. Halves of
// registers of AVX-512 are stored as they are: to insert them would cost more than to store them.
constexpr std::size_t kRowsAtOnce = 8;

/// Four floats of each of two rows.
HWY_INLINE __m256 load_two(const float* low, const float* high) {
  const __m256 first = _mm256_castps128_ps256(_mm_load_ps(low));
  return _mm256_insertf128_ps(first, _mm_load_ps(high), 1);
}
/// Two columns of doubles of four rows.
struct TwoColumns {
  __m256d first, second;
};
HWY_INLINE TwoColumns load_doubles(const float* r0, const float* r1, const float* r2,
                                   const float* r3) {
  const __m256d even = _mm256_castps_pd(load_two(r0, r2));
  const __m256d odd = _mm256_castps_pd(load_two(r1, r3));
  return {_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd)};
}
/// Four columns of floats of eight rows, of which each register holds rows k and k + 4.
struct FourColumns {
  __m256 first, second, third, fourth;
};
HWY_INLINE FourColumns transposed(__m256 r0, __m256 r1, __m256 r2, __m256 r3) {
  const auto pairs = [](__m256 v) HWY_ATTR { return _mm256_castps_pd(v); };
  const auto floats = [](__m256d v) HWY_ATTR { return _mm256_castpd_ps(v); };
  const __m256d low01 = pairs(_mm256_unpacklo_ps(r0, r1)),
                low23 = pairs(_mm256_unpacklo_ps(r2, r3));
  const __m256d high01 = pairs(_mm256_unpackhi_ps(r0, r1)),
                high23 = pairs(_mm256_unpackhi_ps(r2, r3));
  return {floats(_mm256_unpacklo_pd(low01, low23)), floats(_mm256_unpackhi_pd(low01, low23)),
          floats(_mm256_unpacklo_pd(high01, high23)), floats(_mm256_unpackhi_pd(high01, high23))};
}

HWY_INLINE void load_rows(const float* r0, const float* r1, const float* r2, const float* r3,
                          const float* r4, const float* r5, const float* r6, const float* r7,
                          FloatRowColumns& to, std::size_t i) {
  const auto put = [&](__m256 v, Column<float>& column)
                       HWY_ATTR { _mm256_store_ps(column.entry + i, v); };
  const auto put_doubles = [&](__m256d low, __m256d high, Column<double>& column) HWY_ATTR {
    _mm256_store_pd(column.entry + i, low);
    _mm256_store_pd(column.entry + i + 4, high);
  };
  Column<double>* const centre = to.centre.column;
  const TwoColumns xy = load_doubles(r0, r1, r2, r3), more_xy = load_doubles(r4, r5, r6, r7);
  put_doubles(xy.first, more_xy.first, centre[0]);
  put_doubles(xy.second, more_xy.second, centre[1]);
  const TwoColumns z = load_doubles(r0 + 4, r1 + 4, r2 + 4, r3 + 4);
  const TwoColumns more_z = load_doubles(r4 + 4, r5 + 4, r6 + 4, r7 + 4);
  put_doubles(z.first, more_z.first, centre[2]);
  // Two floats of each row: of rows 0 1 2 3 and 4 5 6 7.
  const __m256 low = _mm256_castpd_ps(_mm256_permute2f128_pd(z.second, more_z.second, 0x20));
  const __m256 high = _mm256_castpd_ps(_mm256_permute2f128_pd(z.second, more_z.second, 0x31));
  put(_mm256_shuffle_ps(low, high, 0x88), to.largest);
  put(_mm256_shuffle_ps(low, high, 0xdd), to.least_radius);
  Column<float>* const shape = to.shape.column;
  const FourColumns m = transposed(load_two(r0 + 8, r4 + 8), load_two(r1 + 8, r5 + 8),
                                   load_two(r2 + 8, r6 + 8), load_two(r3 + 8, r7 + 8));
  put(m.first, shape[0]);
  put(m.second, shape[1]);
  put(m.third, shape[2]);
  put(m.fourth, shape[3]);
  const FourColumns rest = transposed(load_two(r0 + 12, r4 + 12), load_two(r1 + 12, r5 + 12),
                                      load_two(r2 + 12, r6 + 12), load_two(r3 + 12, r7 + 12));
  put(rest.first, shape[4]);
  put(rest.second, shape[5]);
  put(rest.third, to.widest);
}
HWY_INLINE void load_rows(const FloatRow* rows, const IndexedPair* pairs,
                          std::uint32_t IndexedPair::*which, FloatRowColumns& to, std::size_t i) {
  const auto row = [&](std::size_t k) HWY_ATTR {
    return reinterpret_cast<const float*>(rows + pairs[i + k].*which);
  };
  load_rows(row(0), row(1), row(2), row(3), row(4), row(5), row(6), row(7), to, i);
}
#elif HWY_MAX_BYTES == 16
constexpr std::size_t kRowsAtOnce = 4;

/// Columns of the first and of the second double of two rows.
HWY_INLINE void transpose(const double* r0, const double* r1, Column<double>& first,
                          Column<double>& second, std::size_t i) {
  const Register a = hn::Load(D(), r0), b = hn::Load(D(), r1);
  hn::Store(hn::InterleaveLower(D(), a, b), D(), first.entry + i);
  hn::Store(hn::InterleaveUpper(D(), a, b), D(), second.entry + i);
}
struct FourColumns {
  hn::Vec<F> first, second, third, fourth;
};
/// Four columns of floats of four rows.
HWY_INLINE FourColumns transposed(const float* r0, const float* r1, const float* r2,
                                  const float* r3) {
  const auto load = [](const float* row) HWY_ATTR { return hn::Load(F(), row); };
  const auto low02 = hn::InterleaveLower(F(), load(r0), load(r2)),
             low13 = hn::InterleaveLower(F(), load(r1), load(r3));
  const auto high02 = hn::InterleaveUpper(F(), load(r0), load(r2)),
             high13 = hn::InterleaveUpper(F(), load(r1), load(r3));
  return {hn::InterleaveLower(F(), low02, low13), hn::InterleaveUpper(F(), low02, low13),
          hn::InterleaveLower(F(), high02, high13), hn::InterleaveUpper(F(), high02, high13)};
}

HWY_INLINE void load_rows(const FloatRow& r0, const FloatRow& r1, const FloatRow& r2,
                          const FloatRow& r3, FloatRowColumns& to, std::size_t i) {
  const auto put = [&](hn::Vec<F> v, Column<float>& column)
                       HWY_ATTR { hn::Store(v, F(), column.entry + i); };
  Column<double>* const centre = to.centre.column;
  transpose(r0.centre, r1.centre, centre[0], centre[1], i);
  transpose(r2.centre, r3.centre, centre[0], centre[1], i + 2);
  double* const z = centre[2].entry + i;
  z[0] = r0.centre[2], z[1] = r1.centre[2], z[2] = r2.centre[2], z[3] = r3.centre[2];
  const auto floats = [](const FloatRow& row) { return reinterpret_cast<const float*>(&row); };
  const float *const row0 = floats(r0), *const row1 = floats(r1), *const row2 = floats(r2),
                     *const row3 = floats(r3);
  const FourColumns sizes = transposed(row0 + 4, row1 + 4, row2 + 4, row3 + 4);
  put(sizes.third, to.largest);
  put(sizes.fourth, to.least_radius);
  Column<float>* const shape = to.shape.column;
  const FourColumns m = transposed(row0 + 8, row1 + 8, row2 + 8, row3 + 8);
  put(m.first, shape[0]);
  put(m.second, shape[1]);
  put(m.third, shape[2]);
  put(m.fourth, shape[3]);
  const FourColumns rest = transposed(row0 + 12, row1 + 12, row2 + 12, row3 + 12);
  put(rest.first, shape[4]);
  put(rest.second, shape[5]);
  put(rest.third, to.widest);
}
HWY_INLINE void load_rows(const FloatRow* rows, const IndexedPair* pairs,
                          std::uint32_t IndexedPair::*which, FloatRowColumns& to, std::size_t i) {
  const auto row = [&](std::size_t k)
                       HWY_ATTR -> const FloatRow& { return rows[pairs[i + k].*which]; };
  load_rows(row(0), row(1), row(2), row(3), to, i);
}
#else
constexpr std::size_t kRowsAtOnce = 1;

HWY_INLINE void load_rows(const FloatRow* rows, const IndexedPair* pairs,
                          std::uint32_t IndexedPair::*which, FloatRowColumns& to, std::size_t i) {
  const FloatRow& row = rows[pairs[i].*which];
  for (std::size_t c = 0; c < 3; ++c) to.centre.column[c].entry[i] = row.centre[c];
  for (std::size_t c = 0; c < 6; ++c) to.shape.column[c].entry[i] = row.shape[c];
  to.largest.entry[i] = row.largest;
  to.least_radius.entry[i] = row.least_radius;
  to.widest.entry[i] = row.widest;
}
#endif

/// One of the bodies of each of the first `count` pairs; those of the next block are asked for
/// meanwhile.
HWY_INLINE void load_rows_of(const LaneBlock& block, const FloatRow* rows,
                             std::uint32_t IndexedPair::*which, std::size_t count,
                             FloatRowColumns& to) {
  for (std::size_t i = 0; i < count; i += kRowsAtOnce) {
    load_rows(rows, block.pairs, which, to, i);
    if (block.next_pairs == nullptr) continue;
    // Spread over the block: there are few slots for lines that are under way.
    for (std::size_t k = i; k < i + kRowsAtOnce; ++k)
      __builtin_prefetch(rows + block.next_pairs[k].*which);
  }
}

/// Of the first `count` pairs of the block, a multiple of pack_lanes().
HWY_INLINE void load_rows(const LaneBlock& block, std::size_t count, FloatPairColumns& to) {
  load_rows_of(block, block.floats_a, &IndexedPair::a, count, to.a);
  load_rows_of(block, block.floats_b, &IndexedPair::b, count, to.b);
}

/// Pairs times a power of two of each, which is exact: L (gap.hpp), with max|d_i| for |d|, is then
/// in [1, 2) but for its roundings.
struct FloatPairs {
  FloatVec3 d;
  FloatSymmetric3 shape_a, shape_b;
  FloatPack scale;  ///< the power of two
  FloatPack size;   ///< L
  FloatPack largest_a, largest_b, widest_a, widest_b;
  FloatPack radii;      ///< both least radii of curvature, rounded down
  FloatPack roundings;  ///< (v): of the value at any normal, over u
  FloatMask in_range;
};

// (v) of docs/derivations/gap-batch.md, over u.
constexpr double kOfDistance = 4.01, kOfAxes = 4.11;
// Of the scaled body: no rounding of M is an underflow.
constexpr double kLeastWidest = 0x1p-100;

/// Pairs i to i + pack_lanes() of the block. Written in place: g++ would copy a result of this size
/// number by number.
HWY_INLINE void scale(const LaneBlock& block, const FloatPairColumns& rows, std::size_t i,
                      FloatPairs& to) {
  const auto c = [](double x) HWY_ATTR { return all<FloatPack>(x); };
  const FloatVec3 d =
      to_float(separation(block, i, load(rows.a.centre, i), load(rows.b.centre, i)));
  const FloatPack a = load(rows.a.largest, i), b = load(rows.b.largest, i);
  const FloatPack size = largest_component(d) + (a + b);
  const FloatPack scale = inverse_power(size), square = scale * scale;
  const FloatVec3 scaled = d * scale;
  const FloatPack d2 = dot(scaled, scaled), distance = d2 * inverse_root(d2);
  const FloatPack largest_a = a * scale, largest_b = b * scale;
  const FloatPack widest_a = load(rows.a.widest, i) * square;
  const FloatPack widest_b = load(rows.b.widest, i) * square;
  to.d = scaled;
  to.shape_a = load(rows.a.shape, i) * square;
  to.shape_b = load(rows.b.shape, i) * square;
  to.scale = scale;
  to.size = size * scale;
  to.largest_a = largest_a;
  to.largest_b = largest_b;
  to.widest_a = widest_a;
  to.widest_b = widest_b;
  to.radii = (load(rows.a.least_radius, i) + load(rows.b.least_radius, i)) * scale;
  to.roundings = multiply_add(c(kOfDistance), distance, c(kOfAxes) * (largest_a + largest_b));
  // False for NaN, which is how bodies that are not moderate() stay out.
  to.in_range = (size >= c(kSmallestModerate)) & (size <= c(kLargestModerate)) &
                (smaller(widest_a, widest_b) >= c(kLeastWidest));
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
