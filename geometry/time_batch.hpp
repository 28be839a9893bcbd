// SPDX-License-Identifier: MIT
/// @file
/// Times of contact of many pairs in one call: the question of time_of_contact.hpp for all pairs of
/// a frame that may meet within it. Conventions are those there; how a body moves: motion.hpp.
///
/// Most pairs are answered without a single call: balls that do not meet in the whole frame; then
/// the gap in vector instructions (gap_batch.hpp), whose normal mostly separates a pair for the
/// whole frame; then steps of conservative advancement for many pairs side by side. What those do
/// not prove is redone as a single pair inside the call (docs/derivations/time-of-contact.md).
///
/// (1) `time` is never after the first contact. `none`, `touching_at_start`, and for `contact` the
///     overlap at `latest` <= time + tolerance, are proven as those of the single call are, and the
///     statuses are the same but where that says `grazing` or `not_converged`: there an overlap, or
///     that there is none, may be proven here.
/// (2) To the bit, an answer does not depend on its position, the order and number of the pairs, or
///     the threads. It may depend, within the tolerance, on the instruction set of the machine.
/// (3) A pair given with a separation is answered as bodies whose centres are that far apart.
#pragma once

#include <span>

#include <tangency/geometry/body_array.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/geometry/pair_list.hpp>
#include <tangency/geometry/time_of_contact.hpp>

namespace tangency::inline v0 {

/// Answers by columns. Each span is as long as the list of pairs, or empty: not asked for.
struct TimeColumns {
  std::span<ContactTimeStatus> status = {};  ///< TimeOfContact::status
  std::span<double> time = {};               ///< as TimeOfContact's, and so are the next two
  std::span<double> latest = {};      ///< latest - time bounds the error of `time` for `contact`
  std::span<double> resolution = {};  ///< length
  /// Unit, from A to B: of the gap at a moment near `time`, at or before `latest`, for `contact`,
  /// and at `time` for `grazing` and `not_converged`. 0 for `none` and `touching_at_start`.
  std::span<Vec3> normal = {};
};

/// The time of contact of every pair in 0 <= t <= horizon.
///
/// Does not allocate but for threads, and as the single call does. Lengths that do not match,
/// indices that are none, separations that are not finite and, of MovingBodies, bodies that are
/// none end the process as in gap_batch.hpp.
/// @param bodies  the bodies, by index
/// @param list  the pairs, with separations where they are given
/// @param answers  where the answers go
/// @param motions    of each body; finite
/// @param horizon    time, finite and >= 0 (asserted)
/// @param tolerance  time, > 0 (asserted)
/// @param threads    that may work on it, the calling one among them
void times_of_contact(const BodyArray& bodies, std::span<const Motion> motions,
                      const PairList& list, double horizon, double tolerance,
                      const TimeColumns& answers, int threads = 1) noexcept;
/// The same of moving bodies. Separations have to be given where the bodies have no centres.
void times_of_contact(const MovingBodies& bodies, std::span<const Motion> motions,
                      const PairList& list, double horizon, double tolerance,
                      const TimeColumns& answers, int threads = 1) noexcept;

}  // namespace tangency::inline v0
