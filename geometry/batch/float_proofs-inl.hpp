// SPDX-License-Identifier: MIT
/// @file
/// What a normal proves about the gap of a pair in float, one pair in each lane: "6. Single
/// precision" in docs/derivations/gap-batch.md, whose names stand here. Lengths are scaled as
/// FloatPairs. Compiled once for each instruction set.
#if defined(TANGENCY_FLOAT_PROOFS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_FLOAT_PROOFS_INL
#undef TANGENCY_FLOAT_PROOFS_INL
#else
#define TANGENCY_FLOAT_PROOFS_INL
#endif

#include <tangency/geometry/batch/float_bodies-inl.hpp>
#include <tangency/geometry/batch/perram_wertheim_lanes-inl.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

// Of one rounding of float, relative: to nearest, and in any mode.
constexpr double kToNearest = 0x1p-24, kInAnyMode = 0x1p-23;
// (v), over u: of the largest row sum of |M| over h, and of |gap|.
constexpr double kOfWidest = 3.6, kOfGap = 7.7;
// (r), over u: of L, and of the row sum over h times a / h.
constexpr double kOfSize = 18.2, kOfBend = 7.7;
// Over u: of the differences that the ball is made of.
constexpr double kOfBall = 12.0;
// The largest a / h of (v). Chosen: beyond it float tells little.
constexpr double kThinnest = 128.0;
// What the roundings of a bound itself may do to it, relative: (f).
constexpr double kOfBounds = 1.0 + 0x1p-18;

/// What is evaluated at a normal.
struct FloatLook {
  FloatPack inverse_h_a, inverse_h_b, gap;
  FloatVec3 point_a, point_b;  ///< support points
  FloatVec3 across;            ///< what leads from one to the other, across the normal
};

struct FloatHeight {
  FloatPack h, inverse_h;
  FloatVec3 point;
};

HWY_INLINE FloatHeight support(const FloatSymmetric3& shape, const FloatVec3& n) {
  const FloatVec3 point = shape * n;
  const FloatPack square = dot(n, point), inverse = inverse_root(square);
  return {square * inverse, inverse, point * inverse};
}

HWY_INLINE FloatLook look(const FloatPairs& pairs, const FloatVec3& n) {
  const FloatHeight a = support(pairs.shape_a, n), b = support(pairs.shape_b, n);
  const FloatPack gap = (dot(n, pairs.d) - a.h) - b.h;
  const FloatVec3 rest = (pairs.d - a.point) - b.point;
  return {a.inverse_h, b.inverse_h, gap, a.point, b.point, multiply_take(gap, n, rest)};
}

/// How far the value is off, where `in_reach`.
struct FloatOff {
  FloatPack over_h, thin, value_error;
  FloatMask in_reach;
};

/// (v)
/// @param u  kToNearest or kInAnyMode
HWY_INLINE FloatOff value_off(const FloatPairs& pairs, const FloatPack& inverse_h_a,
                              const FloatPack& inverse_h_b, const FloatPack& gap, double u) {
  const auto c = [](double x) HWY_ATTR { return all<FloatPack>(x); };
  const FloatPack over_h = multiply_add(pairs.widest_a, inverse_h_a, pairs.widest_b * inverse_h_b);
  const FloatPack thin = larger(pairs.largest_a * inverse_h_a, pairs.largest_b * inverse_h_b);
  const FloatPack value_error =
      c(u * kOfBounds) *
      multiply_add(c(kOfWidest), over_h, multiply_add(c(kOfGap), absolute(gap), pairs.roundings));
  return {over_h, thin, value_error, (thin <= c(kThinnest)) & pairs.in_range};
}

/// What that proves: the gap is at least the value less `value_error`, and where `sound` no more
/// above the value than `above` and `value_error`.
struct FloatBounds {
  FloatPack value_error, above;
  FloatMask sound;
};

/// (r), (b).
/// @param u  as of value_off()
HWY_INLINE FloatBounds bounds(const FloatPairs& pairs, const FloatLook& at, double u) {
  const auto c = [](double x) HWY_ATTR { return all<FloatPack>(x); };
  const FloatOff off = value_off(pairs, at.inverse_h_a, at.inverse_h_b, at.gap, u);
  const FloatPack rest_error = multiply_add(c(u * kOfBend) * off.thin, off.over_h, c(u * kOfSize));
  const FloatPack half_reach2 =
      multiply_add(c(0.57), dot(at.across, at.across), c(5.1) * (rest_error * rest_error));
  const FloatPack ball = (at.gap - off.value_error) + (pairs.radii - c(u * kOfBall));
  return {off.value_error, half_reach2 * rough_inverse(ball), (ball > c(0.0)) & off.in_reach};
}

/// A search for the Perram-Wertheim normal.
class FloatStart {
 public:
  FloatStart() = default;
  HWY_INLINE explicit FloatStart(const FloatPairs& pairs)
      : form_(pairs.shape_a, pairs.shape_b, pairs.d), l_(form_.first_guess()) {}

  HWY_INLINE void step() { l_ = next(form_.at(l_)); }
  HWY_INLINE FloatVec3 normal() const {
    const FloatVec3 direction = form_.direction(l_);
    // Its square could underflow.
    return normalised(direction * rough_inverse(largest_component(direction)));
  }

 private:
  FloatPerramWertheim form_;
  FloatPack l_;
};

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
