// SPDX-License-Identifier: MIT
/// @file
/// The contact of two overlapping ellipsoids by the published scheme of curves, kept to be compared
/// with: an approximation, not the signed gap. [Ouadfel1998, section 4.3 and appendix B]
///
/// On A, theta (around a pole) and phi (from it) are the angles of x = r_x cos theta sin phi,
/// y = r_y sin theta sin phi, z = r_z cos phi along its principal axes. Steps:
///   1. a cone from A's centre through the circle where the bounding spheres meet; theta_1 and
///      theta_2, between which A's surface lies in it;
///   2. the curve theta = (theta_1 + theta_2)/2 cut with B, a quartic in tan of half an angle;
///   where
///      it has no arc in B, the curves at the quarters, then at the eighths, and so on to 1/1024;
///   3. the ends phi_1, phi_2 of the arc in B; the curve phi = (phi_1 + phi_2)/2 cut with B, the
///      ends theta_1, theta_2 of its arc;
///   4. the corners C1, ..., C4 at these four limits: they are coplanar, and their plane's normal,
///      outwards from A, is the contact's; on the line along it through their centroid, with A's
///      surface at P1, P2 and B's at Q1, Q2, the depth is the shortest |P_i Q_j|.
///
/// docs/trace.md says what the thesis leaves open, what was done there, and by how much the answers
/// differ from the signed gap.
///
/// (1) p_B - p_A = gap n, and both points are on their surfaces.
/// (2) A common motion carries everything along; a common scaling scales gap and points.
/// (3) All that leaves the solids as they are (see Ellipsoid) leaves the answer: equal semi-axes
///     may be labelled in any way.
/// (4) For two spheres it is the signed gap.
/// It is *not* symmetric: trace_contact(b, a) parametrises B and is another approximation.
#pragma once

#include <array>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/tier.hpp>

namespace tangency::inline v0 {

/// The contact of an ordered pair (A, B). The numbers are 0 unless `ok`.
struct TraceContact {
  TraceStatus status;  ///< the numbers are those of a contact where it is `ok`
  double gap;          ///< < 0: minus the published depth, in the unit of length of the bodies
  Vec3 normal;         ///< unit, from A to B
  Vec3 arm_a;          ///< P relative to A's centre
  Vec3 arm_b;          ///< Q relative to B's centre
  std::array<Vec3, 4> corners;  ///< C1, ..., C4 relative to A's centre
  TraceCone cone;               ///< which cone the normal is from
  bool other_pole;              ///< the pole is not A's shortest axis: the cone held that
  int curves;  ///< theta-curves cut, whole levels: 1 where the middle one has an arc

  /// The published reference point, the middle of PQ, relative to A's centre; B's contact vector is
  /// this minus d = c_B - c_A.
  Vec3 contact_vector_a(const Vec3& separation) const noexcept {
    return 0.5 * (arm_a + (arm_b + separation));
  }
  /// The contact point less B's centre. @param separation  c_B - c_A
  Vec3 contact_vector_b(const Vec3& separation) const noexcept {
    return 0.5 * ((arm_a - separation) + arm_b);
  }
};

/// Rounding of the gap: a quarter of u L in the median, u = 2^-53, L = |d| + both largest
/// semi-axes; at most 64 u L for aspect ratios to 5 and 1e6 u L to 1000 (bench_trace measures it).
/// What is beyond is the scheme's own error, not the program's. The exact relation is asked first,
/// which may allocate; nothing else does. In any floating-point environment.
TraceContact trace_contact(const Ellipsoid& a, const Ellipsoid& b) noexcept;
/// The same with the separation d = c_B - c_A given, in place of the centres.
TraceContact trace_contact(const Ellipsoid& a, const Ellipsoid& b, const Vec3& separation) noexcept;

}  // namespace tangency::inline v0
