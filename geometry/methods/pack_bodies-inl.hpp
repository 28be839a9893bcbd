// SPDX-License-Identifier: MIT
/// @file
/// Bodies of many pairs at once, one pair in each lane. Compiled once for each instruction set.
#if defined(TANGENCY_PACK_BODIES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_PACK_BODIES_INL
#undef TANGENCY_PACK_BODIES_INL
#else
#define TANGENCY_PACK_BODIES_INL
#endif

#include <tangency/geometry/methods/packs-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::methods::HWY_NAMESPACE {
namespace {

/// LaneBody by columns.
struct PackBody {
  PackVec3 centre;
  Pack largest, least_radius;
  PackVec3 factor[3];
};

/// Where the bodies of the lanes of one register start.
struct Rows {
  const double* lane[HWY_MAX_BYTES / sizeof(double)];
};

/// Four columns of LaneBody: a transposition, which is what a gather instruction does slowly.
HWY_INLINE void load_columns(const Rows& rows, int c, Register* column) {
  const double* const* lane = rows.lane;
#if HWY_TARGET == HWY_AVX3
  const auto two_rows = [=](int k) HWY_ATTR {
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
  for (int k = 0; k < 4; k += 2) {
    const auto two_rows = [=](int r) HWY_ATTR {
      const __m256d low = _mm256_castpd128_pd256(_mm_load_pd(lane[r] + c + k));
      return _mm256_insertf128_pd(low, _mm_load_pd(lane[r + 2] + c + k), 1);
    };
    const __m256d even = two_rows(0), odd = two_rows(1);
    column[k] = Register{_mm256_unpacklo_pd(even, odd)};
    column[k + 1] = Register{_mm256_unpackhi_pd(even, odd)};
  }
#elif HWY_MAX_BYTES == 16
  for (int k = 0; k < 4; k += 2) {
    const Register r0 = hn::Load(D(), lane[0] + c + k), r1 = hn::Load(D(), lane[1] + c + k);
    column[k] = hn::InterleaveLower(D(), r0, r1);
    column[k + 1] = hn::InterleaveUpper(D(), r0, r1);
  }
#else
  for (int k = 0; k < 4; ++k) {
    HWY_ALIGN double values[HWY_MAX_BYTES / sizeof(double)];
    for (std::size_t r = 0; r < register_lanes(); ++r) values[r] = lane[r][c + k];
    column[k] = hn::Load(D(), values);
  }
#endif
}

HWY_INLINE PackBody load_body(const Rows& low_rows, const Rows& high_rows) {
  Register low[16], high[16];
  for (int c = 0; c < 16; c += 4) {
    load_columns(low_rows, c, low + c);
    load_columns(high_rows, c, high + c);
  }
  const auto pack = [&](int c) HWY_ATTR { return Pack{low[c], high[c]}; };
  const auto vec = [&](int c) HWY_ATTR { return PackVec3{pack(c), pack(c + 1), pack(c + 2)}; };
  return {vec(0), pack(3), pack(4), {vec(5), vec(8), vec(11)}};
}

/// The bodies of the pairs from i on, and the separation.
struct PackBodies {
  PackBody a, b;
  PackVec3 d;  ///< c_B - c_A, rounded, or what is given in its place
};

HWY_INLINE PackBodies load_bodies(const LaneBlock& block, std::size_t i) {
  Rows a[2], b[2];
  for (std::size_t half = 0; half < 2; ++half) {
    for (std::size_t k = 0; k < register_lanes(); ++k) {
      const LaneIndices pair = block.pairs[i + half * register_lanes() + k];
      a[half].lane[k] = block.bodies_a[pair.a].centre;
      b[half].lane[k] = block.bodies_b[pair.b].centre;
    }
  }
  if (block.next_pairs != nullptr) {
    // Spread over the block: there are few slots for lines that are under way.
    for (std::size_t k = i; k < i + pack_lanes(); ++k) {
      const LaneIndices pair = block.next_pairs[k];
      __builtin_prefetch(block.bodies_a[pair.a].centre);
      __builtin_prefetch(block.bodies_a[pair.a].centre + 8);
      __builtin_prefetch(block.bodies_b[pair.b].centre);
      __builtin_prefetch(block.bodies_b[pair.b].centre + 8);
    }
  }
  PackBodies bodies;
  bodies.a = load_body(a[0], a[1]);
  bodies.b = load_body(b[0], b[1]);
  bodies.d = block.separations != nullptr ? load_vectors(block.separations + 3 * i)
                                          : bodies.b.centre - bodies.a.centre;
  return bodies;
}

/// M = S S'
HWY_INLINE PackSymmetric3 shape(const PackBody& body) {
  const PackVec3 &p = body.factor[0], &q = body.factor[1], &r = body.factor[2];
  const PackVec3 x{p.x, q.x, r.x}, y{p.y, q.y, r.y}, z{p.z, q.z, r.z};
  return {dot(x, x), dot(y, y), dot(z, z), dot(y, z), dot(z, x), dot(x, y)};
}

}  // namespace
}  // namespace tangency::methods::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
