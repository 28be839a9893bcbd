// SPDX-License-Identifier: MIT
/// @file
/// Bodies against walls, balls and points for many pairs in one call: the questions of
/// primitives.hpp and closest_point.hpp, several times as fast. Conventions are those there. What a
/// vector instruction or a few operations in double do not prove is redone as a single pair inside
/// the call, so that a body may touch and may be as thin as it likes.
///
/// Pairs are (body, other): pairs[i].a is an index of a body, pairs[i].b one of a wall, ball or
/// point. Separations, where given, lead from the body's centre to the ball's or the point, and to
/// some point of the wall's plane.
///
/// (1) Every number is within its error of the true one, and its sign is right where the single
///     call's is.
/// (2) Errors of bodies of moderate aspect and near to the origin are some 20 u L and less, not the
///     2 u |gap| of the single calls; arms are as good as a double-precision normal makes them.
/// (3) To the bit, an answer does not depend on its position, the order and number of the pairs, or
///     the threads.
///
/// Lengths that do not match, indices that are none, separations that are not finite and, of
/// MovingBodies, bodies that are none end the process as in gap_batch.hpp. Nothing is allocated but
/// for threads.
#pragma once

#include <span>

#include <tangency/geometry/body_array.hpp>
#include <tangency/geometry/closest_point.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/geometry/pair_list.hpp>
#include <tangency/geometry/primitives.hpp>

namespace tangency::inline v0 {

/// Answers by columns, as the fields of WallGap. Each span is as long as the list of pairs, or
/// empty: not asked for.
struct WallColumns {
  std::span<double> gap = {};        ///< WallGap::gap
  std::span<double> gap_error = {};  ///< WallGap::gap_error
  std::span<Vec3> normal = {};       ///< WallGap::normal
  std::span<Vec3> arm_body = {};     ///< WallGap::arm_body
  std::span<Vec3> arm_wall = {};     ///< WallGap::arm_wall
  std::span<GapStatus> status = {};  ///< WallGap::status
};

/// As the fields of ClosestPoint.
struct PointColumns {
  std::span<double> distance = {};        ///< ClosestPoint::distance
  std::span<double> distance_error = {};  ///< ClosestPoint::distance_error
  std::span<Vec3> normal = {};            ///< ClosestPoint::normal
  std::span<Vec3> arm = {};               ///< ClosestPoint::arm
  std::span<GapStatus> status = {};       ///< ClosestPoint::status
};

/// signed_gap(body, wall) of every pair. Of moving bodies without centres separations have to be
/// given, here and below.
/// @param bodies  the bodies, by index
/// @param list  the pairs, with separations where they are given
/// @param answers  where the answers go
/// @param walls    as the single calls have them; sheets, balls and points below alike
/// @param threads  as for the gaps of pairs
void signed_gaps(const BodyArray& bodies, std::span<const Plane> walls, const PairList& list,
                 const WallColumns& answers, int threads = 1) noexcept;
/// @overload
void signed_gaps(const MovingBodies& bodies, std::span<const Plane> walls, const PairList& list,
                 const WallColumns& answers, int threads = 1) noexcept;
/// @overload
void signed_gaps(const BodyArray& bodies, std::span<const Sheet> sheets, const PairList& list,
                 const WallColumns& answers, int threads = 1) noexcept;
/// @overload
void signed_gaps(const MovingBodies& bodies, std::span<const Sheet> sheets, const PairList& list,
                 const WallColumns& answers, int threads = 1) noexcept;

/// signed_gap(body, ball) of every pair: a ball of radius 0 is a point.
void signed_gaps(const BodyArray& bodies, std::span<const Sphere> balls, const PairList& list,
                 const GapColumns& answers, int threads = 1) noexcept;
/// @overload
void signed_gaps(const MovingBodies& bodies, std::span<const Sphere> balls, const PairList& list,
                 const GapColumns& answers, int threads = 1) noexcept;

/// closest_point(body, point) of every pair.
void closest_points(const BodyArray& bodies, std::span<const Vec3> points, const PairList& list,
                    const PointColumns& answers, int threads = 1) noexcept;
/// @overload
void closest_points(const MovingBodies& bodies, std::span<const Vec3> points, const PairList& list,
                    const PointColumns& answers, int threads = 1) noexcept;

}  // namespace tangency::inline v0
