// SPDX-License-Identifier: MIT
/// @file
/// What a normal, the value in double there and a step in float prove about the gap, one pair in
/// each lane: section 5 of docs/derivations/gap-batch.md, whose names stand here. Lengths are in
/// the pair's own unit. Compiled once for each instruction set.
#if defined(TANGENCY_MIXED_PROOFS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef TANGENCY_MIXED_PROOFS_INL
#undef TANGENCY_MIXED_PROOFS_INL
#else
#define TANGENCY_MIXED_PROOFS_INL
#endif

#include <tangency/geometry/batch/packs-inl.hpp>
#include <tangency/geometry/floating_point.hpp>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::detail::HWY_NAMESPACE {
namespace {

// (V'), over u: of q/h, of the semi-axes and of |gap|; of the last two more where the separation is
// that of the centres, exactly.
constexpr double kOfReachOverH = 3.55, kOfAxes = 7.6, kOfValue = 9.1, kOfCentres = 1.02;
// (R'), over u.
constexpr double kOfRest = 8.0;
// (E): of T |delta| in e, and of T |delta|^2 in the value, the fourth order of (T) in it.
constexpr double kOfStep = 0x1p-19;
// (T): of sum a^3/h^2 |delta|^3 in the value and of sum a^3/h^2 |delta|^2 in e.
constexpr double kThird = 0.55, kSecond = 1.2;
// The largest a |delta| / h, |delta|^2 and |n.delta| that (T) and (E) hold for.
constexpr double kTurnOfBody = 0x1p-8, kTurn2 = 0x1p-22, kAlong = 0x1p-20;
// (F): what roundings in float may do to the sign's and the ball's differences, relative.
constexpr double kOfFloatSum = 0x1p-21;
// The square of the longest step that is taken further, without a proof. Chosen: Newton's method.
constexpr double kLongest2 = 0x1p-4;
// Of u L, what a better normal may still gain: as in gap_proofs-inl.hpp.
constexpr double kWorthAnother = 1.0;

struct FloatBody {
  FloatSymmetric3 shape;
  FloatPack largest, reach;
  FloatPack inverse_h;
  FloatVec3 point;
};

/// What is known at a normal.
struct FloatPoint {
  FloatBody a, b;
  FloatVec3 normal, rest;
  FloatPack gap;
  FloatPack radii, size, tolerance;
};

struct FloatProof {
  FloatPack beyond;  ///< to be added to the value: it is then in the middle of what is proven
  FloatPack error;
  FloatMask settled;    ///< and no better normal would make `error` much smaller
  FloatMask nearer;     ///< does the step lead on, and to a pair that is not deep?
  FloatMask promising;  ///< nearer, and is the value good enough where the step is small enough?
};

/// (Hess h) v
HWY_INLINE FloatVec3 bend(const FloatBody& body, const FloatVec3& v) {
  const FloatVec3 flat = multiply_take(dot(body.point, v), body.point, body.shape * v);
  return flat * body.inverse_h;
}

/// (L): the value at n + step and how far the maximum is above it.
HWY_INLINE FloatProof prove(const FloatPoint& at, const FloatVec3& step, bool centres_are_exact,
                            double factor_error) {
  const auto c = [](double x) HWY_ATTR { return all<FloatPack>(x); };
  const FloatPack size = absolute(at.gap);
  const FloatVec3 left =
      multiply_take(at.gap, step, (at.rest - bend(at.a, step)) - bend(at.b, step));
  const FloatPack second = c(0.5) * dot(at.rest + left, step);
  const FloatPack step2 = dot(step, step), length = root(step2), along = dot(at.normal, step);

  const FloatPack thin_a = at.a.largest * at.a.inverse_h, thin_b = at.b.largest * at.b.inverse_h;
  const FloatPack thin = larger(thin_a, thin_b), axes = at.a.largest + at.b.largest;
  const FloatPack over_h = multiply_add(at.a.reach, at.a.inverse_h, at.b.reach * at.b.inverse_h);
  const FloatPack cubes =
      multiply_add(at.a.largest * thin_a, thin_a, (at.b.largest * thin_b) * thin_b);
  const FloatPack most = over_h + size;  // T

  const double more = centres_are_exact ? kOfCentres : 0.0;
  const FloatPack value_error =
      c(kUnitRoundoff) *
      multiply_add(c(kOfReachOverH), over_h,
                   multiply_add(c(kOfAxes + factor_error + more), axes, c(kOfValue + more) * size));
  const FloatPack step_error = step2 * multiply_add(c(kThird) * length, cubes, c(kOfStep) * most);
  const FloatPack known = multiply_add(c(0.51) * size, along * along, value_error + step_error);

  const FloatPack rest_error = c(kOfRest * kUnitRoundoff) * multiply_add(thin, over_h, axes + size);
  const FloatPack left_error =
      multiply_add(c(kOfStep) * most, length, multiply_add(c(kSecond) * cubes, step2, rest_error));
  const FloatPack half_left2 = multiply_add(c(0.57), dot(left, left),  //
                                            c(4.6) * (left_error * left_error));
  const FloatPack sum = size + (at.radii + absolute(second));
  const FloatPack ball = multiply_take(c(kOfFloatSum), sum, ((at.gap + second) + at.radii) - known);
  const FloatPack half = c(0.5) * (half_left2 * rough_inverse(ball));

  const FloatPack beyond = second + half, answer = at.gap + beyond;
  const FloatPack error = known + half;
  const auto within = [&](double roundings_of_size) HWY_ATTR {
    return multiply_add(c(roundings_of_size * kUnitRoundoff), at.size, at.tolerance) *
           c(1.0 - 0x1p-20);
  };
  const FloatMask in_reach =
      (thin * length <= c(kTurnOfBody)) & (step2 <= c(kTurn2)) & (absolute(along) <= c(kAlong));
  const FloatPack doubt = multiply_add(c(kOfFloatSum), size + absolute(beyond), error);
  const FloatPack most_error = within(kLaneErrorBound + factor_error);
  const FloatMask nearer = (step2 <= c(kLongest2)) & (at.gap + at.radii > c(0.0));
  const FloatMask settled = in_reach & (ball > c(0.0)) & (absolute(answer) > doubt) &
                            (error <= most_error) & (half + half <= within(kWorthAnother));
  return {beyond, error, settled, nearer, nearer & (value_error < most_error)};
}

}  // namespace
}  // namespace tangency::inline v0::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
