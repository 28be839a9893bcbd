// SPDX-License-Identifier: MIT
/// @file
/// Bodies and pairs as the lanes read them, and where their answers go. Internal.
#pragma once

#include <cstdint>

#include <tangency/geometry/batch/float_rows.hpp>
#include <tangency/geometry/indexed_pair.hpp>

namespace tangency::inline v0::detail {

/// A body as the lanes read it: two lines of cache, for random access.
struct alignas(64) LaneBody {
  double centre[3];
  double largest;       ///< semi-axis; NaN where the body is not moderate(): no lane then settles
  double least_radius;  ///< of curvature, rounded down
  double factor[9];     ///< the columns a_k R e_k, one after the other: see LaneBlock
  double unused[2];
};
static_assert(sizeof(LaneBody) == 16 * sizeof(double) && alignof(LaneBody) == 64);

/// A body as the first tier of the gap reads it.
struct alignas(32) ShapeRow {
  double centre[3];
  double largest;  ///< as LaneBody's, or NaN
  double least_radius;
  double reach;     ///< of the matrix of |M_ij|: its largest sum of a row, rounded up
  double shape[6];  ///< xx yy zz yz zx xy of M, each rounded as (N) says
};
static_assert(sizeof(ShapeRow) == 12 * sizeof(double));

/// Of L: a gap_error that the lanes in float prove of ordinary pairs. Chosen: 16 roundings of
/// float.
inline constexpr double kFloatTolerance = 0x1p-20;

/// Of (a_min / a_max)^2: gaps of a body below it are left to the single call. Chosen: far below any
/// body that is in use, and as flat as a normal in doubles still tells a face from what is beside
/// it. Of flatter ones a lane could settle, in what is asked for, what the single call does not.
inline constexpr double kThinnestInLanes = 0x1p-80;

/// In u L: a lane is settled where its gap_error is at most this and the tolerance.
inline constexpr double kLaneErrorBound = 16.0;

/// In u a_max: what the factor of a body of moving_lanes.hpp may do to its support beyond what
/// that of an Ellipsoid does, (Q) of docs/derivations/gap-batch.md.
inline constexpr double kOfRotation = 10.0;

/// Up to 64 pairs, and where their answers go. Every array has kPairs entries, of which those from
/// `count` on must be readable numbers or indices of some body, and may be written to.
struct LaneBlock {
  static constexpr int kPairs = 64;

  const LaneBody* bodies_a = nullptr;  ///< first of the array that index a counts in
  const LaneBody* bodies_b = nullptr;
  const ShapeRow* rows_a = nullptr;  ///< the same bodies; read by mixed_gap_lanes() alone
  const ShapeRow* rows_b = nullptr;
  const FloatRow* floats_a = nullptr;  ///< the same bodies, for float_lanes.hpp alone
  const FloatRow* floats_b = nullptr;
  const IndexedPair* pairs = nullptr;
  const IndexedPair* next_pairs = nullptr;  ///< of the next block, to be fetched meanwhile; or null
  int count = 0;
  /// x y z of each pair; null: the rounded difference of the centres.
  const double* separations = nullptr;
  /// Where to start, of any length, or 0, which is anywhere; null: all are.
  const double* normals = nullptr;
  /// Is the true separation that of the centres, not their rounded difference?
  bool centres_are_exact = false;
  /// What gap_error may be beyond rounding: a part of L, and a length.
  double tolerance_of_size = 0.0, tolerance = 0.0;
  /// 0 where each entry of `factor` is one of Ellipsoid::rotation() times a semi-axis, rounded
  /// once; kOfRotation where it is what moving_lanes.hpp makes.
  double factor_error = 0.0;
  /// Of Newton's method before anything is proven; and of lanes that have a normal, no more. A
  /// moment ago a normal was good to some 1e-4; the start of a cold search is to 1e-2.
  int first_steps = 2, followed_steps = 1;
  /// Of L: pairs of a tolerance from here on take one step less at first, which is mostly enough.
  /// Measured.
  double coarse = 0x1p-24;
  /// Of float_overlap_lanes() before anything is proven: no yes or no depends on it, but its time,
  /// and what is left open.
  int yes_no_steps = 0;
  bool polish = false;  ///< one step more than the gap needs, for the normal's sake
  /// May a normal of a moment ago be followed to where more than one of them may be best? Asked
  /// afresh a lane settles nothing there.
  bool branches = false;

  std::uint64_t local = 0;  ///< answer: bit i, pair i is settled as the value of its branch alone
  // Of pairs that mixed_gap_lanes() leaves open: is there a better start for the next lanes, and
  // may this tier itself settle the pair from there?
  std::uint64_t nearer = 0, promising = 0;
  bool within_float = false;  ///< answer of mixed_gap_lanes(): is any pair one that it may settle?
  double* nearer_normals = nullptr;  ///< x y z of each; read by no lane
  double* gap = nullptr;             ///< null, here and below: not wanted
  double* gap_error = nullptr;
  double* normal = nullptr;  ///< x y z of each
  double* arm_a = nullptr;
  double* arm_b = nullptr;
};

}  // namespace tangency::inline v0::detail
