// SPDX-License-Identifier: MIT
/// @file
/// How far the published scheme of curves came: trace_contact.hpp.
#pragma once

namespace tangency {

enum class TraceStatus {
  ok,
  not_overlapping,   ///< the exact relation is not `overlap`: apart, touching, nested or equal
  concentric,        ///< no direction from centre to centre, no cone
  no_arc,            ///< no curve of the search has an arc in B: too shallow, or B holds the poles
  several_arcs,      ///< the first curve that meets B has more than one arc in it
  no_tangent_plane,  ///< the corners span half of A or more
  no_overlap_on_the_line,  ///< the shortest P_i Q_j is not from A's last point to B's first
};

/// As docs/trace.md writes it: "ok", "not_overlapping", ...
const char* to_string(TraceStatus status) noexcept;

/// Which cone the first limits came from. Published: the one through the circle where the bounding
/// spheres meet, if they do, with a half-angle below 90 degrees; used first where it exists. The
/// common part of the two balls may stick out of it or fill it (nested balls): its own cone is
/// tried next. The whole sphere of directions where A's centre is in B's bounding ball.
enum class TraceCone { published, common_part, whole };

}  // namespace tangency
