// SPDX-License-Identifier: MIT
// Each stage is a short loop over the block: the chain of operations of one pack is long, and the
// processor works at the next ones meanwhile.
#include <cstddef>
#include <cstdint>

#include <tangency/geometry/batch/gap_lanes.hpp>
#include <tangency/geometry/power_of_two.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/batch/mixed_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#define TANGENCY_PACK_REGISTERS 2
#include <tangency/geometry/batch/gap_proofs-inl.hpp>
#include <tangency/geometry/batch/mixed_columns-inl.hpp>
#include <tangency/geometry/batch/mixed_proofs-inl.hpp>
#include <tangency/geometry/batch/pack_bodies-inl.hpp>
#include <tangency/geometry/batch/perram_wertheim_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

constexpr int kPerramWertheimSteps = 1;  // measured
// A body that is smaller, of L, is left to the next tier: M is a normal float down to there.
constexpr double kSmallestOfSize = 0x1p-40;

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
/// Four columns of four rows.
HWY_INLINE void transpose(const double* r0, const double* r1, const double* r2, const double* r3,
                          std::size_t c, Column<double>* to, std::size_t i) {
  const auto two_rows = [](const double* low, const double* high) HWY_ATTR {
    const __m256d first = _mm256_castpd128_pd256(_mm_load_pd(low));
    return _mm256_insertf128_pd(first, _mm_load_pd(high), 1);
  };
  const __m256d a = two_rows(r0 + c, r2 + c), b = two_rows(r1 + c, r3 + c);
  const __m256d e = two_rows(r0 + c + 2, r2 + c + 2), f = two_rows(r1 + c + 2, r3 + c + 2);
  _mm256_store_pd(to[c].entry + i, _mm256_unpacklo_pd(a, b));
  _mm256_store_pd(to[c + 1].entry + i, _mm256_unpackhi_pd(a, b));
  _mm256_store_pd(to[c + 2].entry + i, _mm256_unpacklo_pd(e, f));
  _mm256_store_pd(to[c + 3].entry + i, _mm256_unpackhi_pd(e, f));
}
HWY_INLINE void load_four(const double* r0, const double* r1, const double* r2, const double* r3,
                          BodyColumns& to, std::size_t i) {
  Column<double>* const columns = to.column;
  transpose(r0, r1, r2, r3, 0, columns, i);
  transpose(r0, r1, r2, r3, 4, columns, i);
  transpose(r0, r1, r2, r3, 8, columns, i);
}
#else
HWY_INLINE void load_four(const double* r0, const double* r1, const double* r2, const double* r3,
                          BodyColumns& to, std::size_t i) {
  Column<double>* const columns = to.column;
  for (std::size_t c = 0; c < 12; ++c) {
    double* column = columns[c].entry + i;
    column[0] = r0[c], column[1] = r1[c], column[2] = r2[c], column[3] = r3[c];
  }
}
#endif

/// One of the bodies of each pair; those of the next block are asked for meanwhile.
HWY_INLINE void load_rows_of(const LaneBlock& block, const ShapeRow* rows,
                             std::uint32_t IndexedPair::*which, BodyColumns& to) {
  const auto row = [&](const IndexedPair* pairs, std::size_t i)
                       HWY_ATTR { return rows[pairs[i].*which].centre; };
  for (std::size_t i = 0; i < kPairs; i += 4) {
    const IndexedPair* here = block.pairs;
    load_four(row(here, i), row(here, i + 1), row(here, i + 2), row(here, i + 3), to, i);
    if (block.next_pairs == nullptr) continue;
    for (std::size_t k = i; k < i + 4; ++k) {
      const double* const next = row(block.next_pairs, k);
      __builtin_prefetch(next);
      __builtin_prefetch(next + 8);
    }
  }
}

/// The bodies in float, in the unit of the pair.
/// @return  is any of them one that this tier may settle?
HWY_INLINE bool scale(const LaneBlock& block, MixedColumns& work, std::size_t i) {
  const PackVec3 d = block.separations != nullptr ? load_vectors(block.separations + 3 * i)
                                                  : work.b.centre(i) - work.a.centre(i);
  store(d, work.d, i);
  const Pack a = work.a.largest(i), b = work.b.largest(i);
  const Pack size = largest_component(d) + (a + b);
  const Pack inverse = inverse_power(size);
  store(inverse_power(inverse), work.unit, i);
  const FloatPack by = to_float(inverse), by2 = by * by;
  store(to_float(d) * by, work.float_d, i);
  store(to_float(work.a.shape(i)) * by2, work.float_a.shape, i);
  store(to_float(work.b.shape(i)) * by2, work.float_b.shape, i);
  store(to_float(work.a.reach(i)) * by2, work.float_a.reach, i);
  store(to_float(work.b.reach(i)) * by2, work.float_b.reach, i);
  store(to_float(a) * by, work.float_a.largest, i);
  store(to_float(b) * by, work.float_b.largest, i);
  store(to_float(work.a.least_radius(i) + work.b.least_radius(i)) * by, work.radii, i);
  const Pack part = size * all(kSmallestOfSize);
  const PackMask in_range = (size <= all(kLargestModerate)) & (a >= part) & (b >= part);
  const Pack no_number = {hn::NaN(D()), hn::NaN(D())};
  store(to_float(chosen(in_range, size * inverse, no_number)), work.size, i);
  store(to_float(multiply_add(all(block.tolerance_of_size), size * inverse,
                              all(block.tolerance) * inverse)),
        work.tolerance, i);
  return !none(in_range);
}

HWY_INLINE FloatVec3 perram_wertheim_normal(const MixedColumns& work, std::size_t i) {
  // Of bodies that are small beside their distance the determinants would leave the range.
  const FloatPack axes = load(work.float_a.largest, i) + load(work.float_b.largest, i);
  const FloatPack by = rough_inverse(axes), by2 = by * by;
  const FloatPerramWertheim form(load(work.float_a.shape, i) * by2,
                                 load(work.float_b.shape, i) * by2, load(work.float_d, i));
  FloatPack l = form.first_guess();
  for (int k = 0; k < kPerramWertheimSteps; ++k) l = next(form.at(l));
  const FloatVec3 direction = form.direction(l);
  return normalised(direction * rough_inverse(largest_component(direction)));
}

HWY_INLINE FloatMask every_lane() { return all<FloatPack>(0.0) <= all<FloatPack>(0.0); }

/// Where the search starts.
/// @return  lanes that have no normal of a moment ago
HWY_INLINE FloatMask first_normal(const LaneBlock& block, MixedColumns& work, std::size_t i) {
  if (block.normals == nullptr) {
    store(perram_wertheim_normal(work, i), work.start, i);
    return every_lane();
  }
  const FloatVec3 previous = to_float(load_normals(block.normals + 3 * i));
  FloatVec3 start = normalised(previous);
  const FloatMask fresh = is_nothing(previous);
  if (!none(fresh)) start = chosen(fresh, perram_wertheim_normal(work, i), start);
  store(start, work.start, i);
  return fresh;
}

HWY_INLINE FloatSymmetric3 chosen(const FloatMask& yes, const FloatSymmetric3& s,
                                  const FloatSymmetric3& t) {
  return {chosen(yes, s.xx, t.xx), chosen(yes, s.yy, t.yy), chosen(yes, s.zz, t.zz),
          chosen(yes, s.yz, t.yz), chosen(yes, s.zx, t.zx), chosen(yes, s.xy, t.xy)};
}

/// Where no step is taken before the last one, that is none either.
HWY_INLINE void take_no_step(MixedColumns& work, std::size_t i) {
  const FloatPack nothing = all<FloatPack>(0.0);
  store(FloatSymmetric3{nothing, nothing, nothing, nothing, nothing, nothing}, work.adjugate, i);
  store(nothing, work.inverse_determinant, i);
}

/// newton_step() of gap_proofs-inl.hpp, and what is kept of it for the last one, of all lanes or of
/// some.
HWY_INLINE void step(MixedColumns& work, std::size_t i, const FloatMask* some) {
  const FloatSymmetric3 shape_a = load(work.float_a.shape, i),
                        shape_b = load(work.float_b.shape, i);
  const FloatVec3 n = load(work.start, i);
  const FloatSupport a = glance(shape_a, n), b = glance(shape_b, n);
  const FloatVec3 rest = (load(work.float_d, i) - a.point) - b.point;
  const FloatPack gap = dot(n, rest);
  const FloatSymmetric3 k = newton_matrix(shape_a, shape_b, a, b, load(work.size, i), gap, n);
  const FloatSymmetric3 adj = adjugate(k);
  const FloatPack inverse = quick_inverse(determinant(k, adj));
  const FloatVec3 r = multiply_take(gap, n, rest);
  const FloatVec3 better = normalised(multiply_add(inverse, adj * r, n));
  if (some == nullptr) {
    store(adj, work.adjugate, i);
    store(inverse, work.inverse_determinant, i);
    store(better, work.start, i);
  } else {
    store(chosen(*some, adj, load(work.adjugate, i)), work.adjugate, i);
    store(chosen(*some, inverse, load(work.inverse_determinant, i)), work.inverse_determinant, i);
    store(chosen(*some, better, n), work.start, i);
  }
}

/// The step that all lanes take, but for those of a coarse tolerance, which are mostly good enough.
HWY_INLINE void step_but_for_coarse(const LaneBlock& block, MixedColumns& work, std::size_t i) {
  const FloatPack size = load(work.size, i);
  const FloatMask coarse = load(work.tolerance, i) >= all<FloatPack>(block.coarse) * size;
  const FloatMask asked = without(every_lane(), coarse);
  if (!none(asked)) step(work, i, &asked);
}

/// 1 / |m| by its series, where |m|^2 - 1 is below 2^-20 (2^-19 after a step).
HWY_INLINE Pack inverse_length(const PackVec3& m) {
  const Pack w = dot(m, m) - all(1.0);
  return multiply_add(multiply_add(all(0.375), w, all(-0.5)), w, all(1.0));
}

/// f and its gradient at the normal, in double.
HWY_INLINE void evaluate(MixedColumns& work, std::size_t i) {
  const PackVec3 m = to_double(load(work.start, i));
  const PackSupport a = glance(work.a.shape(i), m), b = glance(work.b.shape(i), m);
  const PackVec3 rest = (load(work.d, i) - a.point) - b.point;
  const Pack inverse = inverse_length(m);
  const Pack gap = dot(m, rest) * inverse;
  store(gap, work.value, i);
  const Pack unit = load(work.unit, i);
  const FloatPack back = to_float(unit), by = all<FloatPack>(1.0) / back;
  store(to_float(gap) * by, work.gap, i);
  store(to_float(multiply_take(gap * inverse, m, rest)) * by, work.rest, i);
  const auto keep = [&](const PackSupport& of, FloatBodyColumns& to) HWY_ATTR {
    store(to_float(of.inverse_h) * back, to.inverse_h, i);
    store(to_float(of.point) * by, to.point, i);
  };
  keep(a, work.float_a);
  keep(b, work.float_b);
}

HWY_INLINE FloatBody load_body(const FloatBodyColumns& from, std::size_t i) {
  return {load(from.shape, i), load(from.largest, i), load(from.reach, i), load(from.inverse_h, i),
          load(from.point, i)};
}

/// The last step, in float, and what it proves.
/// @return  settled lanes
HWY_INLINE std::uint64_t certify(LaneBlock& block, MixedColumns& work, std::size_t i) {
  const FloatPoint at{load_body(work.float_a, i), load_body(work.float_b, i), load(work.start, i),
                      load(work.rest, i),         load(work.gap, i),          load(work.radii, i),
                      load(work.size, i),         load(work.tolerance, i)};
  const FloatVec3 delta = (load(work.adjugate, i) * at.rest) * load(work.inverse_determinant, i);
  const FloatProof proof = prove(at, delta, block.centres_are_exact, block.factor_error);
  const Pack unit = load(work.unit, i);
  if (block.gap != nullptr)
    store(multiply_add(to_double(proof.beyond), unit, load(work.value, i)), block.gap + i);
  if (block.gap_error != nullptr) store(to_double(proof.error) * unit, block.gap_error + i);
  const PackVec3 m = to_double(at.normal) + to_double(delta);
  const PackVec3 n = m * inverse_length(m);
  store(n, work.normal, i);
  if (block.normal != nullptr) store(n, block.normal + 3 * i);
  const std::uint64_t settled = bits(proof.settled);
  if (settled != bits(every_lane())) {
    store(n, block.nearer_normals + 3 * i);
    block.nearer |= bits(without(proof.nearer, proof.settled)) << i;
    block.promising |= bits(without(proof.promising, proof.settled)) << i;
  }
  return settled;
}

HWY_ATTR std::uint64_t mixed_gap_lanes(LaneBlock& block) {
  MixedColumns work;
  const std::size_t lanes = pack_lanes(), count = static_cast<std::size_t>(block.count);
  load_rows_of(block, block.rows_a, &IndexedPair::a, work.a);
  load_rows_of(block, block.rows_b, &IndexedPair::b, work.b);
  block.within_float = false;
  for (std::size_t i = 0; i < kPairs; i += lanes) block.within_float |= scale(block, work, i);
  if (!block.within_float) return 0;
  const bool coarse = block.followed_steps == 1 && block.tolerance_of_size + block.tolerance > 0.0;
  if (block.normals == nullptr) {
    for (std::size_t i = 0; i < kPairs; i += lanes) first_normal(block, work, i);
    for (std::size_t i = 0; i < kPairs; i += lanes) step(work, i, nullptr);
  } else {
    for (std::size_t i = 0; i < kPairs; i += lanes) {
      const FloatMask fresh = first_normal(block, work, i);
      if (coarse) take_no_step(work, i);
      if (!none(fresh)) step(work, i, &fresh);
    }
  }
  if (coarse) {
    for (std::size_t i = 0; i < kPairs; i += lanes) step_but_for_coarse(block, work, i);
  } else {
    for (int k = 0; k < block.followed_steps; ++k)
      for (std::size_t i = 0; i < kPairs; i += lanes) step(work, i, nullptr);
  }
  for (std::size_t i = 0; i < kPairs; i += lanes) evaluate(work, i);
  std::uint64_t settled = 0;
  for (std::size_t i = 0; i < count; i += lanes) settled |= certify(block, work, i) << i;
  for (std::size_t i = 0; i < count; i += lanes) write_arms(block, i, load(work.normal, i));
  return settled;
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::detail {
namespace {
HWY_EXPORT(mixed_gap_lanes);
}  // namespace

std::uint64_t mixed_gap_lanes(LaneBlock& block) noexcept {
  block.local = block.nearer = block.promising = 0;
  return HWY_DYNAMIC_DISPATCH(mixed_gap_lanes)(block);
}

}  // namespace tangency::inline v0::detail
#endif
