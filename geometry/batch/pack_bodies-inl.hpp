// SPDX-License-Identifier: MIT
/// @file
/// Bodies of many pairs at once, one pair in each lane. Compiled once for each instruction set.
#if defined(TANGENCY_PACK_BODIES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_PACK_BODIES_INL
#undef TANGENCY_PACK_BODIES_INL
#else
#define TANGENCY_PACK_BODIES_INL
#endif

#include <cstddef>

#include <tangency/geometry/batch/packs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

/// Where the bodies of the lanes of one register start.
struct Rows {
  const double* lane[kMostLanes];
};

/// Four columns: a transposition, which is what a gather instruction does slowly.
HWY_INLINE void load_columns(const Rows& rows, std::size_t c, Register* column) {
  const double* const* lane = rows.lane;
#if HWY_TARGET == HWY_AVX3
  const auto two_rows = [=](std::size_t k) HWY_ATTR {
    const __m512d low = _mm512_castpd256_pd512(_mm256_load_pd(lane[k] + c));
    return _mm512_insertf64x4(low, _mm256_load_pd(lane[k + 4] + c), 1);
  };
  const __m512d r0 = two_rows(0), r1 = two_rows(1), r2 = two_rows(2), r3 = two_rows(3);
  const __m512d even01 = _mm512_unpacklo_pd(r0, r1), odd01 = _mm512_unpackhi_pd(r0, r1);
  const __m512d even23 = _mm512_unpacklo_pd(r2, r3), odd23 = _mm512_unpackhi_pd(r2, r3);
  const __m512i first = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
  const __m512i second = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
  column[0] = Register{_mm512_permutex2var_pd(even01, first, even23)};
  column[1] = Register{_mm512_permutex2var_pd(odd01, first, odd23)};
  column[2] = Register{_mm512_permutex2var_pd(even01, second, even23)};
  column[3] = Register{_mm512_permutex2var_pd(odd01, second, odd23)};
#elif HWY_TARGET == HWY_AVX2
  for (std::size_t k = 0; k < 4; k += 2) {
    const auto two_rows = [=](std::size_t r) HWY_ATTR {
      const __m256d low = _mm256_castpd128_pd256(_mm_load_pd(lane[r] + c + k));
      return _mm256_insertf128_pd(low, _mm_load_pd(lane[r + 2] + c + k), 1);
    };
    const __m256d even = two_rows(0), odd = two_rows(1);
    column[k] = Register{_mm256_unpacklo_pd(even, odd)};
    column[k + 1] = Register{_mm256_unpackhi_pd(even, odd)};
  }
#elif HWY_MAX_BYTES == 16
  for (std::size_t k = 0; k < 4; k += 2) {
    const Register r0 = hn::Load(D(), lane[0] + c + k), r1 = hn::Load(D(), lane[1] + c + k);
    column[k] = hn::InterleaveLower(D(), r0, r1);
    column[k + 1] = hn::InterleaveUpper(D(), r0, r1);
  }
#else
  for (std::size_t k = 0; k < 4; ++k) {
    HWY_ALIGN double values[kMostLanes];
    for (std::size_t r = 0; r < register_lanes(); ++r) values[r] = lane[r][c + k];
    column[k] = hn::Load(D(), values);
  }
#endif
}

/// Rows of `columns` numbers, a multiple of 4: what `make` makes of a function that gives a column.
template <std::size_t columns, class Make>
HWY_INLINE auto load_rows(const Rows* rows, const Make& make) {
  Register low[columns];
  for (std::size_t c = 0; c < columns; c += 4) load_columns(rows[0], c, low + c);
#if TANGENCY_PACK_REGISTERS == 2
  Register high[columns];
  for (std::size_t c = 0; c < columns; c += 4) load_columns(rows[1], c, high + c);
#endif
  return make([&](std::size_t c) HWY_ATTR { return Pack{TANGENCY_PARTS(low[c], high[c])}; });
}

/// Where the rows of the bodies of the pairs from i on start.
struct PairRows {
  Rows a[TANGENCY_PACK_REGISTERS], b[TANGENCY_PACK_REGISTERS];
};

/// @param a, b  arrays of structures that begin with their row, aligned to cache lines
template <class Body>
HWY_INLINE PairRows find_rows(const LaneBlock& block, std::size_t i, const Body* a, const Body* b) {
  PairRows rows;
  for (std::size_t half = 0; half < TANGENCY_PACK_REGISTERS; ++half) {
    for (std::size_t k = 0; k < register_lanes(); ++k) {
      const IndexedPair pair = block.pairs[i + half * register_lanes() + k];
      rows.a[half].lane[k] = a[pair.a].centre;
      rows.b[half].lane[k] = b[pair.b].centre;
    }
  }
  if (block.next_pairs != nullptr) {
    // Spread over the block: there are few slots for lines that are under way.
    for (std::size_t k = i; k < i + pack_lanes(); ++k) {
      const IndexedPair pair = block.next_pairs[k];
      __builtin_prefetch(a[pair.a].centre);
      __builtin_prefetch(a[pair.a].centre + 8);
      __builtin_prefetch(b[pair.b].centre);
      __builtin_prefetch(b[pair.b].centre + 8);
    }
  }
  return rows;
}

/// c_B - c_A, rounded, or what is given in its place.
HWY_INLINE PackVec3 separation(const LaneBlock& block, std::size_t i, const PackVec3& centre_a,
                               const PackVec3& centre_b) {
  return block.separations != nullptr ? load_vectors(block.separations + 3 * i)
                                      : centre_b - centre_a;
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
