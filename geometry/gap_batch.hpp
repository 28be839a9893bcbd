// SPDX-License-Identifier: MIT
/// @file
/// The signed gap, and the yes/no question, for many pairs in one call: the answers of gap.hpp and
/// relation.hpp several times as fast, by vector instructions that are chosen when the program
/// runs. Conventions and promises are those of gap.hpp; what a lane does not prove is redone as a
/// single pair inside the call.
///
/// (1) Every gap is within its gap_error of the true one, or of its branch's where it is `local`,
///     and status and sign are those of the single call, whose gap therefore differs by no more
///     than both errors. Less is proven of a `local` answer of follow_gaps() on MovingBodies that
///     a lane gives: a local maximum of that value lies next to its normal, the true gap is at
///     least gap - gap_error, and the interiors meet. The normal is within 0.15 rad of the previous
///     one; that the ascent of the single call ends on the same maximum is measured, not proven.
/// (2) To the bit, an answer does not depend on its position, the order and number of the pairs,
///     or the thread. It may depend, within its error, on the instruction set of the machine.
/// (3) Yes/no answers are the same everywhere.
/// (4) Of signed_gaps() and follow_gaps(), for bodies of aspect ratios to 100, gap_error is at most
///     16 u L (gap.hpp), of MovingBodies 26 u L, and the tolerance of the Accuracy asked for.
/// (5) Indexed bodies and plain pairs of the same numbers have the same answers, to the bit.
/// (6) bounded_gaps() enclose the true gap in [gap - gap_error, gap + above], and what no lane
///     settles is to the bit that of bounded_gap().
/// (7) point is the midpoint of the two witness points, from A's centre.
/// (8) Float columns have the answers of the double ones, rounded, and what is proven of the gap
///     stays proven: FloatGapColumns.
/// (9) With a cutoff a pair is `beyond` only where its gap is proven to be above it, and always
///     where it is above by more than twice the gap_error that it would have. Every other answer
///     is to the bit what it is without a cutoff.
#pragma once

#include <limits>
#include <span>

#include <tangency/geometry/body_array.hpp>
#include <tangency/geometry/bounded_gap.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/gap_columns.hpp>
#include <tangency/geometry/gap_derivatives.hpp>
#include <tangency/geometry/indexed_pair.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/geometry/overlap_batch.hpp>
#include <tangency/geometry/pair_list.hpp>

namespace tangency::inline v0 {

/// How good a gap has to be: a point on the curve of speed against accuracy that
/// docs/speed-accuracy.md measures. Sign, status and gap_error are proven at every point of it;
/// what is near enough to a touch that the sign could be in doubt is solved to rounding.
struct Accuracy {
  double of_size = 0.0;  ///< tolerance in parts of L, at least 0
  double length = 0.0;   ///< tolerance in the unit of length of the bodies, at least 0
  /// Normal and points to rounding too? Else the normal is as good as the gap needs, within
  /// 2 sqrt(gap_error / (gap - gap_error + rho)) rad of the true one.
  bool normals = false;
  /// Length, at least 0: no answer is wanted of pairs whose gap is above it. They cost little, and
  /// their status is GapStatus::beyond. Their normal is 0: who follows it asks afresh.
  double cutoff = std::numeric_limits<double>::infinity();

  /// gap_error at most 2^-20 L, some 2^-21 L of most pairs: for neighbour lists, previews, stiff
  /// contacts that overlap by more. Answered in single precision where that proves it, as is any
  /// `of_size` that is no smaller; gaps nearer to 0 than their error, and others, in double.
  static constexpr Accuracy fast() { return {0x1p-20, 0.0, false}; }
  /// The gap to rounding, its normal to some 1e-8 rad.
  static constexpr Accuracy standard() { return {}; }
  /// Gap, normal and points to rounding.
  static constexpr Accuracy certified() { return {0.0, 0.0, true}; }
  /// gap_error at most 16 u L more than a length. @param length  at least 0
  static constexpr Accuracy within(double length) { return {0.0, length, false}; }
  /// The same, of gaps up to a length alone, whatever the cutoff was: standard().up_to(0.1).
  /// @param gap  the cutoff, at least 0, asserted by the calls that take it
  constexpr Accuracy up_to(double gap) const { return {of_size, length, normals, gap}; }
};

/// signed_gap() of every pair.
///
/// Here and below a length that does not match, an index that is none and a separation that is not
/// finite end the process with one line on standard error, in every build; in overlap_batch.hpp
/// indices only where asserts are on. So does a body of MovingBodies that is none (a semi-axis that
/// is not finite and > 0, an orientation that is not finite or all 0) where a pair names it: the
/// line says which and why.
/// @param bodies  the bodies, by index
/// @param list  the pairs, with separations where they are given
/// @param answers  where the answers go
/// @param accuracy  how good the answers have to be
/// @param threads  that may work on the list, the calling one among them; each is started for the
///                 call, which some thousands of pairs are worth. Each needs 128 kB of stack (160
///                 of plain pairs), the calling one too.
void signed_gaps(const BodyArray& bodies, const PairList& list, const GapColumns& answers,
                 Accuracy accuracy = {}, int threads = 1) noexcept;
/// @overload
void signed_gaps(const BodyArray& bodies, const PairList& list, std::span<Gap> answers,
                 Accuracy accuracy = {}, int threads = 1) noexcept;
/// The same for moving bodies. Separations have to be given where the bodies have no centres, here
/// and below.
void signed_gaps(const MovingBodies& bodies, const PairList& list, const GapColumns& answers,
                 Accuracy accuracy = {}, int threads = 1) noexcept;
/// The same by float columns, at the cost of the rounding.
void signed_gaps(const BodyArray& bodies, const PairList& list, const FloatGapColumns& answers,
                 Accuracy accuracy = {}, int threads = 1) noexcept;
/// @overload
void signed_gaps(const MovingBodies& bodies, const PairList& list, const FloatGapColumns& answers,
                 Accuracy accuracy = {}, int threads = 1) noexcept;
/// signed_gap() for a[i] and b[i], at the cost of reading whole bodies.
void signed_gaps(std::span<const Ellipsoid> a, std::span<const Ellipsoid> b, std::span<Gap> answers,
                 Accuracy accuracy = {}, int threads = 1) noexcept;
/// @param a,b  the bodies, in this order
/// @param answers  where the answers go
/// @param accuracy  how good the answers have to be
/// @param threads  that may work on the call
/// @param separations  in place of the centres
void signed_gaps(std::span<const Ellipsoid> a, std::span<const Ellipsoid> b,
                 std::span<const Vec3> separations, std::span<Gap> answers, Accuracy accuracy = {},
                 int threads = 1) noexcept;

/// follow_gap() of every pair, and signed_gap() of those whose previous normal is exactly 0; where
/// `separations` is empty, of the rounded c_B - c_A, and signed_gap() where that overflows. Deeper
/// than -rho (gap.hpp) branches of MovingBodies are followed in the lanes too, those of a BodyArray
/// pair by pair.
/// @param bodies  the bodies, by index
/// @param list  the pairs, with separations where they are given
/// @param answers  where the answers go
/// @param accuracy  how good the answers have to be
/// @param threads  that may work on the call
/// @param previous_normals  each 0, or of a largest component in [2^-100, 2^100]; may be the same
///                          memory as answers.normal
void follow_gaps(const BodyArray& bodies, const PairList& list,
                 std::span<const Vec3> previous_normals, const GapColumns& answers,
                 Accuracy accuracy = {}, int threads = 1) noexcept;
/// @overload
void follow_gaps(const MovingBodies& bodies, const PairList& list,
                 std::span<const Vec3> previous_normals, const GapColumns& answers,
                 Accuracy accuracy = {}, int threads = 1) noexcept;
/// @overload
void follow_gaps(const BodyArray& bodies, const PairList& list,
                 std::span<const Vec3> previous_normals, std::span<Gap> answers,
                 Accuracy accuracy = {}, int threads = 1) noexcept;
/// The same by float columns: of the previous normals as the numbers that they are.
void follow_gaps(const BodyArray& bodies, const PairList& list,
                 std::span<const Vec3f> previous_normals, const FloatGapColumns& answers,
                 Accuracy accuracy = {}, int threads = 1) noexcept;
/// @overload
void follow_gaps(const MovingBodies& bodies, const PairList& list,
                 std::span<const Vec3f> previous_normals, const FloatGapColumns& answers,
                 Accuracy accuracy = {}, int threads = 1) noexcept;

/// bounded_gap() of every pair: in lanes where those settle it, and nowhere by a search or by the
/// exact relation. Allocates for threads alone.
void bounded_gaps(const BodyArray& bodies, const PairList& list, const BoundedColumns& answers,
                  Accuracy accuracy = {}, int threads = 1) noexcept;
/// @overload
void bounded_gaps(const MovingBodies& bodies, const PairList& list, const BoundedColumns& answers,
                  Accuracy accuracy = {}, int threads = 1) noexcept;

/// gap_derivatives() of every pair at the answers of signed_gaps() or follow_gaps(), pair by pair:
/// for implicit methods. To the bit as the single call's.
void gap_derivatives(const BodyArray& bodies, const PairList& list, std::span<const Gap> gaps,
                     std::span<GapDerivatives> answers, int threads = 1) noexcept;

}  // namespace tangency::inline v0
