// SPDX-License-Identifier: MIT
/// @file
/// Answers of the calls of gap_batch.hpp by columns, of doubles and of floats.
#pragma once

#include <span>

#include <tangency/geometry/tier.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

/// Answers by columns. Each span is as long as the list of pairs, or empty: not asked for.
struct GapColumns {
  std::span<double> gap = {};        ///< Gap::gap
  std::span<double> gap_error = {};  ///< Gap::gap_error
  std::span<Vec3> normal = {};       ///< Gap::normal
  std::span<Vec3> arm_a = {};        ///< Gap::arm_a
  std::span<Vec3> arm_b = {};        ///< Gap::arm_b
  std::span<GapStatus> status = {};  ///< Gap::status
  std::span<GapTier> tier = {};      ///< Gap::tier
  /// The contact point less A's centre: arm_a + half of what leads from there to B's witness point.
  /// Off by no more than half of both arms' contact_bounds() and 8 u L; of MovingBodies, whose arms
  /// (for a body of largest semi-axis a) may err by 8 u a^2/h + 6 u a more, by half of that too.
  std::span<Vec3> point = {};
};

/// A vector in space, of floats. Like Vec3 it needs no more alignment than a number.
using Vec3f = Eigen::Vector3f;

/// Answers by columns of floats, for callers who keep their numbers in float: to the bit those of
/// GapColumns, each rounded to the nearest float but for what is said here. Poses in float go with
/// them, as strided columns of MovingBodies; bodies so given mean the numbers that they have.
///
/// The sign of gap is that of the double one, and so of the exact relation: where the nearest float
/// would be 0 and the gap is not, the smallest float of its sign stands there, 2^-149, a subnormal
/// (which is 0 to a caller whose processor flushes those). 0 is an external touch.
///
/// Of a pair `beyond` a cutoff the gap is the lower bound rounded down instead: no higher than the
/// true gap, finite, and by its rounding perhaps 0 or not above the cutoff.
struct FloatGapColumns {
  /// Gap::gap. Infinite, of its sign, beyond the range of floats.
  std::span<float> gap = {};
  /// Gap::gap_error of this gap: that of the double one and what its rounding lost, together
  /// rounded up. Beyond what it is in double, and what an Accuracy asks for, by no more than
  /// 2^-24 |gap| + 2^-148, but for 2^-22 of the sum. Infinite where the gap is, and beyond the
  /// range of floats.
  std::span<float> gap_error = {};
  std::span<Vec3f> normal = {};      ///< Gap::normal, within 2^-24 rad of the double one
  std::span<Vec3f> arm_a = {};       ///< Gap::arm_a
  std::span<Vec3f> arm_b = {};       ///< Gap::arm_b
  std::span<GapStatus> status = {};  ///< Gap::status
  std::span<GapTier> tier = {};      ///< Gap::tier
  std::span<Vec3f> point = {};       ///< GapColumns::point
};

/// GapColumns with how much more than `gap` the true gap may be.
struct BoundedColumns {
  GapColumns answers;  ///< gap, error, normal, points, status and tier, as BoundedGap has them
  std::span<double> above = {};  ///< BoundedGap::above
};

}  // namespace tangency::inline v0
