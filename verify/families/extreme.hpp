// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Pairs at the extremes of shape, size, place and gap, whose true gap only an oracle knows: a
/// small gap becomes what the rounding of B's centre makes of it.
#pragma once

#include <span>
#include <string>

#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/pair.hpp>

namespace tangency::inline v0::verify {

/// How the pairs of a family are drawn. Normals: a third uniform, a third along an axis of a body,
/// a third near one (1e-12 to 1 rad). Gaps: log-uniform from 1e-16 of the smallest semi-axis to
/// 1e6 times the largest; a third below 0, there from `least_overlap` of rho to rho.
struct ExtremeFamily {
  enum class Shape {
    needles,   ///< one long axis, the other two within a factor of 2
    discs,     ///< one short axis, the other two within a factor of 2
    triaxial,  ///< log-uniform
    mixed,     ///< a needle and a disc, or triaxial
  };
  std::string name;
  Shape shape;
  double aspect;          ///< of every body
  double size_ratio = 3;  ///< B's size over A's is log-uniform in [1/size_ratio, size_ratio]
  double scale = 1;       ///< of all lengths
  double origin = 0;      ///< distance of A's centre from the origin over `scale`
  double least_overlap = 1e-16;
  /// > 0: ordinary contacts instead, of uniform normals and gaps of either sign that are
  /// log-uniform from this to `largest_gap` of the smallest semi-axis
  double least_gap = 0;
  double largest_gap = 0;
};

std::span<const ExtremeFamily> extreme_families();

/// Ordinary contacts of slender bodies: gaps of 1e-3 to 1e-1 of the smallest semi-axis.
std::span<const ExtremeFamily> slender_contacts();

EllipsoidPair drawn(Draw& draw, const ExtremeFamily& family);

using ExtremePairs = Sequence<ExtremeFamily>;

/// Overlapping pairs: shapes log-uniform, B's shortest semi-axis 0.3 to 3 times A's.
struct DeepFamily {
  std::string name;
  double aspect;             ///< of every body at most
  double least_depth = 0;    ///< 0 to 1: the centres' distance over that where the pair touches at
  double largest_depth = 1;  ///< a random normal; 0 is concentric
  double within = 0;         ///< > 0: only pairs that a manufactured overlap of at most this share
                             ///< of the smallest semi-axis gives; else 0
};

std::span<const DeepFamily> deep_families();

EllipsoidPair drawn(Draw& draw, const DeepFamily& family);

using DeepPairs = Sequence<DeepFamily>;

/// What exact arithmetic finds hardest: every number of a body drawn log-uniformly from 2^-range to
/// 2^range, and B one sixth of the time another such body, else A with a centre, a semi-axis or a
/// quaternion nudged by one unit in the last place, with semi-axes grown by powers of two, or
/// doubled and moved. Touching and nested pairs are frequent among them.
struct HeaviestFamily {
  int range;  ///< 1 to 1074, of exponents
};

EllipsoidPair drawn(Draw& draw, const HeaviestFamily& family);

using HeaviestPairs = Sequence<HeaviestFamily>;

}  // namespace tangency::inline v0::verify
