// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Two equal spheroids in contact, and the three motions that take B out of it: the displacement
/// profiles of [Ouadfel1998, section 4.4.1].
///
/// The contacts are manufactured: B is put where the normal n and the overlap are the chosen ones,
/// so that the expected curves below come from the support functions at n and from no solver. The
/// overlap is small against the radii of curvature, so n is the global answer (gap.hpp).
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::inline v0::verify {

/// A contact of two spheroids, A at the origin. Unit of length: the short semi-axis.
struct DisplacementContact {
  std::string_view name;  ///< "side-side", "side-end", "end-end" or "skew"
  Ellipsoid a, b;
  Vec3 normal;         ///< unit, from A to B
  double overlap;      ///< initial, > 0
  Vec3 tangent;        ///< unit, normal to `normal`: the direction of tangential motion
  Vec3 rotation_axis;  ///< unit: B turns about it and its own centre
};

/// @param short_over_long  b/a of the prolate spheroids, in (0, 1]
/// @param overlap          initial, > 0 and below 2 (b/a)^2 short semi-axes, the sum of the
///                         smallest radii of curvature
std::vector<DisplacementContact> displacement_contacts(double short_over_long, double overlap);

enum class Motion { normal, tangential, rotation };
constexpr std::array<Motion, 3> kMotions = {Motion::normal, Motion::tangential, Motion::rotation};
std::string_view to_string(Motion motion);

/// B after a motion: a length along the normal (away from A) or the tangent, or an angle in
/// radians.
Ellipsoid displaced(const DisplacementContact& contact, Motion motion, double amount);

/// The overlap after a small motion s: overlap + slope s + curvature s^2 / 2 + O(s^3).
///
/// (1) normal: slope -1, curvature 0, and no further term.
/// (2) tangential: slope 0, curvature -1/rho_t, 1/rho_t = t' (Hess h_A + Hess h_B - overlap P)^-1 t
///     in the tangent plane.
/// (3) rotation: slope n . ((p_B - c_B) x axis).
struct OverlapExpansion {
  double slope, curvature;
};
OverlapExpansion expected_overlap(const DisplacementContact& contact, Motion motion);

/// What the thesis gives: overlap - s for the normal motion, overlap + z - sqrt(z^2 + s^2), z the
/// distance of the centres, for the tangential one, which is right for spheres only (an erratum),
/// and a straight line, here of the right slope, for the rotation.
double published_overlap(const DisplacementContact& contact, Motion motion, double amount);

}  // namespace tangency::inline v0::verify
