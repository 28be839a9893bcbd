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

#include <tangency/geometry/batch/float_rows.hpp>
#include <tangency/geometry/batch/pack_bodies-inl.hpp>
#include <tangency/geometry/power_of_two.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

struct FloatBodies {
  PackVec3 centre;
  FloatPack largest, least_radius, widest;
  FloatSymmetric3 shape;
};

/// Where the rows of the bodies of a pack start, as floats.
struct FloatRows {
  const float* row[TANGENCY_FLOAT_REGISTERS * hn::MaxLanes(F())];
};

#if HWY_TARGET != HWY_SCALAR
/// A block of four floats from each of some rows: those at `first`, `first` + step and so on, from
/// float c on. So that what is left of a transposition stays within blocks.
HWY_INLINE hn::Vec<F> load_blocks(const FloatRows& rows, std::size_t first, std::size_t step,
                                  std::size_t c) {
  const float* const* row = rows.row + first;
#if HWY_TARGET == HWY_AVX3
  __m512 blocks = _mm512_castps128_ps512(_mm_load_ps(row[0] + c));
  blocks = _mm512_mask_broadcast_f32x4(blocks, 0x00f0, _mm_load_ps(row[step] + c));
  blocks = _mm512_mask_broadcast_f32x4(blocks, 0x0f00, _mm_load_ps(row[2 * step] + c));
  return hn::Vec<F>{_mm512_mask_broadcast_f32x4(blocks, 0xf000, _mm_load_ps(row[3 * step] + c))};
#elif HWY_TARGET == HWY_AVX2
  const __m256 low = _mm256_castps128_ps256(_mm_load_ps(row[0] + c));
  return hn::Vec<F>{_mm256_insertf128_ps(low, _mm_load_ps(row[step] + c), 1)};
#else
  HWY_ALIGN float blocks[hn::MaxLanes(F())];
  for (std::size_t k = 0; 4 * k < float_lanes(); ++k)
    __builtin_memcpy(blocks + 4 * k, row[k * step] + c, 4 * sizeof(float));
  return hn::Load(F(), blocks);
#endif
}

/// Four columns of floats, from float c on.
HWY_INLINE void load_floats(const FloatRows& rows, std::size_t c, FloatPack* column) {
  const auto r0 = load_blocks(rows, 0, 4, c), r1 = load_blocks(rows, 1, 4, c);
  const auto r2 = load_blocks(rows, 2, 4, c), r3 = load_blocks(rows, 3, 4, c);
  const auto pairs = [](const hn::Vec<F>& v) HWY_ATTR { return hn::BitCast(D(), v); };
  const auto low01 = pairs(hn::InterleaveLower(F(), r0, r1));
  const auto low23 = pairs(hn::InterleaveLower(F(), r2, r3));
  const auto high01 = pairs(hn::InterleaveUpper(F(), r0, r1));
  const auto high23 = pairs(hn::InterleaveUpper(F(), r2, r3));
  column[0].low = hn::BitCast(F(), hn::InterleaveLower(D(), low01, low23));
  column[1].low = hn::BitCast(F(), hn::InterleaveUpper(D(), low01, low23));
  column[2].low = hn::BitCast(F(), hn::InterleaveLower(D(), high01, high23));
  column[3].low = hn::BitCast(F(), hn::InterleaveUpper(D(), high01, high23));
}

/// Two columns of doubles, from float c on.
HWY_INLINE void load_doubles(const FloatRows& rows, std::size_t c, Pack* column) {
  const auto half = [&](std::size_t first, Register& even, Register& odd) HWY_ATTR {
    const auto r0 = hn::BitCast(D(), load_blocks(rows, first, 2, c));
    const auto r1 = hn::BitCast(D(), load_blocks(rows, first + 1, 2, c));
    even = hn::InterleaveLower(D(), r0, r1);
    odd = hn::InterleaveUpper(D(), r0, r1);
  };
  half(0, column[0].low, column[1].low);
  half(register_lanes(), column[0].high, column[1].high);
}
#endif

/// FloatRow by columns.
HWY_INLINE FloatBodies load_bodies(const FloatRows& rows) {
#if HWY_TARGET == HWY_SCALAR
  const auto number = [&](std::size_t c) HWY_ATTR {
    double low, high;
    __builtin_memcpy(&low, rows.row[0] + c, sizeof low);
    __builtin_memcpy(&high, rows.row[1] + c, sizeof high);
    return Pack{hn::Set(D(), low), hn::Set(D(), high)};
  };
  const auto floats = [&](std::size_t c) HWY_ATTR {
    return FloatPack{hn::Set(F(), rows.row[0][c]), hn::Set(F(), rows.row[1][c])};
  };
  return {{number(0), number(2), number(4)},
          floats(6),
          floats(7),
          floats(14),
          {floats(8), floats(9), floats(10), floats(11), floats(12), floats(13)}};
#else
  Pack number[4];  // of which the last is two floats in each
  FloatPack shape[8];
  load_doubles(rows, 0, number);
  load_doubles(rows, 4, number + 2);
  load_floats(rows, 8, shape);
  load_floats(rows, 12, shape + 4);
  const auto low = hn::BitCast(F(), number[3].low), high = hn::BitCast(F(), number[3].high);
  return {{number[0], number[1], number[2]},
          {hn::ConcatEven(F(), high, low)},
          {hn::ConcatOdd(F(), high, low)},
          shape[6],
          {shape[0], shape[1], shape[2], shape[3], shape[4], shape[5]}};
#endif
}

/// Of the pairs from i on.
struct FloatPairRows {
  FloatRows a, b;
};

HWY_INLINE FloatPairRows find_float_rows(const LaneBlock& block, std::size_t i) {
  FloatPairRows rows;
  const auto row = [](const FloatRow* from, std::uint32_t index)
                       HWY_ATTR { return reinterpret_cast<const float*>(from + index); };
  const IndexedPair* const pairs = block.pairs + i;
  for (std::size_t k = 0; k < float_lanes(); ++k) {
    rows.a.row[k] = row(block.floats_a, pairs[k].a);
    rows.b.row[k] = row(block.floats_b, pairs[k].b);
  }
  if (block.next_pairs != nullptr) {
    // Spread over the block: there are few slots for lines that are under way.
    const IndexedPair* const next = block.next_pairs + i;
    for (std::size_t k = 0; k < float_lanes(); ++k) {
      __builtin_prefetch(block.floats_a + next[k].a);
      __builtin_prefetch(block.floats_b + next[k].b);
    }
  }
  return rows;
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

/// Pairs i to i + pack_lanes() of the block.
HWY_INLINE FloatPairs load_pairs(const LaneBlock& block, std::size_t i) {
  const auto c = [](double x) HWY_ATTR { return all<FloatPack>(x); };
  const FloatPairRows rows = find_float_rows(block, i);
  const FloatBodies a = load_bodies(rows.a), b = load_bodies(rows.b);
  const FloatVec3 d = to_float(separation(block, i, a.centre, b.centre));
  const FloatPack size = largest_component(d) + (a.largest + b.largest);
  const FloatPack scale = inverse_power(size), square = scale * scale;
  const FloatVec3 scaled = d * scale;
  const FloatPack d2 = dot(scaled, scaled), distance = d2 * inverse_root(d2);
  const FloatPack largest_a = a.largest * scale, largest_b = b.largest * scale;
  const FloatPack widest_a = a.widest * square, widest_b = b.widest * square;
  // False for NaN, which is how bodies that are not moderate() stay out.
  const FloatMask in_range = (size >= c(kSmallestModerate)) & (size <= c(kLargestModerate)) &
                             (smaller(widest_a, widest_b) >= c(kLeastWidest));
  return {scaled,
          a.shape * square,
          b.shape * square,
          scale,
          size * scale,
          largest_a,
          largest_b,
          widest_a,
          widest_b,
          (a.least_radius + b.least_radius) * scale,
          multiply_add(c(kOfDistance), distance, c(kOfAxes) * (largest_a + largest_b)),
          in_range};
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
