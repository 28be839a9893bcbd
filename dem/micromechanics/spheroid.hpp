// SPDX-License-Identifier: MIT
/// @file
/// The surface of a spheroid by the angle from its axis of symmetry [Ouadfel1998, section 7.2], and
/// what shape a body's semi-axes make.
///
/// beta is the angle of a contact vector (from the centre to a point of the surface) to the axis of
/// symmetry, gamma that of the normal there; both from 0 to pi, radians. Lengths have any one unit.
/// The closed forms hold for long (prolate) and flat (oblate) bodies alike, lose no digits near the
/// sphere, and are tested to aspect ratios of 1e4 both ways. Semi-axes must be finite and > 0, else
/// std::invalid_argument. Functions keep no state: any number of threads may call.
#pragma once

#include <cstddef>
#include <optional>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// By its semi-axes: on the axis of symmetry, and across. Prolate: along > across. In the plane the
/// ellipse with these semi-axes.
struct Spheroid {
  double along = 1.0, across = 1.0;  ///< semi-axes along the axis of revolution and across it
};

/// @throws std::invalid_argument unless both semi-axes are finite and > 0
void require_sound(const Spheroid& s);

/// Which semi-axes are equal.
enum class Shape { sphere, prolate, oblate, triaxial };

/// Chosen: semi-axes within this relative distance count as equal; growth and text files round.
inline constexpr double kEqualAxes = 1e-9;
/// Are two semi-axes equal but for rounding?
bool are_equal_axes(double one, double other);

/// Which semi-axes are equal, but for rounding.
Shape shape_of(const Vec3& semi_axes);

/// A body of revolution: its spheroid, and which of its body axes is that of symmetry.
struct Symmetry {
  Spheroid spheroid;     ///< its semi-axes
  std::size_t axis = 0;  ///< which body axis is the axis of revolution
};
/// Empty of spheres and of three different semi-axes.
std::optional<Symmetry> symmetry_of(const Vec3& semi_axes);

/// Contacts a body on average at which as many frictionless contacts as motions hold a packing: two
/// for each motion that moves a contact. A smooth body of revolution feels no moment about its
/// axis: spheres 6, spheroids 10, others 12; in the plane disks 4, others 6. The published text has
/// 12 for spheroids [Ouadfel1998, section 5.3.1].
///
/// (1) is twice the rank of the contacts' rigidity matrix, a body
int isostatic_coordination(Shape shape, int dimensions = 3);

/// l(beta): from the centre to the surface [Ouadfel1998, eq. 7.15].
double contact_length(const Spheroid& s, double beta);
/// The beta from 0 to pi/2 that has the length; empty of a sphere and of lengths no contact has.
std::optional<double> angle_of_length(const Spheroid& s, double length);

/// A(beta): the area of the surface within beta of one end of the axis (eq. 7.23-7.24).
///
/// (2) equals the quadrature of area_per_solid_angle; A(pi) is the whole surface
double surface_within(const Spheroid& s, double beta);
/// l^2 / cos(deviation).
double area_per_solid_angle(const Spheroid& s, double beta);

/// gamma: tan(gamma) = (along/across)^2 tan(beta) (eq. 7.29).
double normal_angle(const Spheroid& s, double beta);
/// gamma - beta: of the normal from the contact vector, positive of prolate bodies below pi/2.
double deviation(const Spheroid& s, double beta);
/// The largest, atan(along/across) - atan(across/along), at tan(beta) = across/along; negative of
/// oblate bodies.
double largest_deviation(const Spheroid& s);

/// The mean over the surface of the distance from the centre to the tangent plane: 3 V/A.
double mean_support_height(const Spheroid& s);

}  // namespace tangency::inline v0::micromechanics
