// SPDX-License-Identifier: MIT
/// @file
/// Hertz's and Mindlin's answer of many touching pairs of ellipsoids at once, one pair in each lane
/// of a vector register. The instruction set is chosen when the program runs. Internal.
///
/// What hertz_contact() of contact_curvature() says, from the rows that the batch of gaps reads.
/// docs/derivations/hertz-lanes.md has the formulas and the bounds. No function may stand here: the
/// file is read by code for every instruction set (docs/decisions/0006-lanes.md).
#pragma once

#include <cstdint>

#include <tangency/geometry/batch/lane_block.hpp>
#include <tangency/geometry/indexed_pair.hpp>

namespace tangency::inline v0::dem {

/// In place of B's index: a body without curvature, which is what a wall is.
inline constexpr std::uint32_t kFlatBody = 0xffffffff;

/// The smallest ratio of two relative curvatures that lanes answer: that of two equal bodies 128
/// times as long as thick, side by side. Chosen: the fit down to 2^-20 needs half as many terms
/// more.
inline constexpr double kLeastCurvatureRatio = 0x1p-14;

/// Up to 64 pairs, and where their answers go. Every array has kPairs entries (three times as many
/// numbers where it says x y z), of which those from `count` on must be readable, indices of some
/// body, and may be written to. The answers must not lie where the questions are.
struct HertzBlock {
  static constexpr int kPairs = 64;

  const tangency::detail::LaneBody* bodies;  ///< what the indices of pairs count in
  const IndexedPair* pairs;                  ///< b may be kFlatBody
  int count;
  const double* normal;           ///< x y z, unit to rounding, from a to b
  const double* overlap;          ///< length; the pair touches where it is > 0
  const double* contact_modulus;  ///< E* of both bodies, force/area
  const double* shear_modulus;    ///< G, force/area
  const double* poisson_ratio;    ///< nu, in [0, 0.5]

  double* force;      ///< P, a push
  double* stiffness;  ///< dP / d overlap at these curvatures
  double* energy;     ///< stored by the overlap
  double* along;      ///< shear force over displacement along `direction`
  double* across;     ///< the same at right angles
  double* direction;  ///< x y z: unit, tangent, along the longer axis of the contact ellipse
};

/// Bit i of the result: pair i has its answer; of another nothing may be used, and hertz_contact()
/// answers it. Those are pairs that touch whose curvatures have a ratio below kLeastCurvatureRatio,
/// or a geometric mean outside [2^-50, 2^50], and what is no number.
///
/// (1) A pair with overlap <= 0, or none, has an answer: 0 in every place.
/// (2) Of given relative curvatures the answers are hertz_contact()'s to a relative 48 u, u =
///     2^-53.
/// (3) The curvatures are contact_curvature()'s to what that promises; of the smaller one with the
///     error of docs/derivations/hertz-lanes.md where two thin bodies are nearly parallel.
/// (4) Where the curvatures are equal `direction` is any tangent, and along and across agree to
///     rounding.
/// (5) An answer depends on its pair alone. Its last bits depend on the instruction set.
///
/// Assumes rounding to nearest. May be called by several threads for blocks that share no answers.
std::uint64_t hertz_lanes(const HertzBlock& block) noexcept;

}  // namespace tangency::inline v0::dem
