// SPDX-License-Identifier: MIT
/// @file
/// Where on their bodies contacts are: the distribution of contact vectors in body axes, shares of
/// short, intermediate and long ones, and of pairs of them; as calculated and as measured
/// [Ouadfel1998, section 7.2].
///
/// The model, of spheroids: contact vectors have the density per solid angle S(beta) = (1/4 pi)
/// (1 + a1 P2(cos beta)), beta from the axis of symmetry. a1 is a^cv along that axis, a principal
/// value and no modulus; it is from -1 to 2, else the density is negative somewhere. Signs, units
/// and errors are those of contact_arrays.hpp and spheroid.hpp. Nothing is kept between calls: any
/// number of threads may call.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <tangency/dem/micromechanics/contact_arrays.hpp>
#include <tangency/dem/micromechanics/fabric.hpp>
#include <tangency/dem/micromechanics/spheroid.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// S(beta), per solid angle (eq. 7.8).
double local_density(double a1, double beta);
/// G(beta): the share of contact vectors within beta of one end of the axis (eq. 7.13).
///
/// (1) is the integral of local_density over the cap; G(pi - beta) = 1 - G(beta)
double local_distribution(double a1, double beta);
/// The beta whose G is g.
/// @param a1  -1 to 2
/// @param g   0 to 1; std::invalid_argument otherwise, as of a1
///
/// (2) local_distribution(a1, local_angle(a1, g)) is g
double local_angle(double a1, double g);

/// H(l): the share of contact vectors that are longer (eq. 7.19); 1 and 0 beyond all lengths. Of a
/// sphere, all of one length, 1 below it and 0 from it on.
double longer_share(const Spheroid& s, double a1, double length);

/// Of short, intermediate and long contact vectors: thirds of the way from the shortest to the
/// longest semi-axis. They add up to 1.
using LengthShares = std::array<double, 3>;
/// Of contacts between two classes, the order of bodies left out: short-short, short-intermediate,
/// short-long, intermediate-intermediate, intermediate-long, long-long.
using PairShares = std::array<double, 6>;

/// Calculated (eq. 7.20); empty of a sphere. A share of contact *sides*, two a contact.
std::optional<LengthShares> length_shares(const Spheroid& s, double a1);
/// If contacts stood equally dense on the surface: shares of area.
std::optional<LengthShares> length_shares_by_area(const Spheroid& s);
/// f_x^2 and 2 f_x f_y: of contacts that do not choose their pairs (eq. 7.21).
PairShares pair_shares(const LengthShares& shares);
/// 0, 1, 2: short, intermediate, long, by the length of the surface in that direction: overlap does
/// not enter. Of any ellipsoid; empty of a sphere.
/// @param semi_axes  of each body, finite and > 0
/// @param direction  in body axes, of any length but 0
std::optional<std::size_t> length_class(const Vec3& semi_axes, const Vec3& direction);

/// a1 of contacts equally dense on the surface: the projection of that density on P2.
///
/// (3) equals quadrature over the surface, near the sphere too
double area_law_a1(const Spheroid& s);

/// Of one side of a contact: what does it depend on? A correlation coefficient, and its deviation
/// if there were no dependence. NaN where one of both does not vary.
struct LocalCorrelations {
  /// Of P2(cos beta) with the number of contacts of the side's body.
  Estimate coordination;
  /// Of P2(cos beta) with the squares of the components x, y, z of the body's axis of symmetry.
  std::array<Estimate, 3> orientation{};
};

/// What only a body of revolution has.
struct SpheroidStatistics {
  Estimate a1;  ///< 5 <P2(cos beta)>: a^cv along the axis of symmetry
  /// Means over the sides of what the models say of their bodies.
  double area_law_a1 = 0.0;
  /// shares of lengths: by the model with the measured a1, and by area
  LengthShares calculated{}, by_area{};
  PairShares calculated_pairs{};  ///< pair_shares(calculated)
  /// The largest distances of the measured G from that of the model with the measured a1, and from
  /// A(beta)/A(pi). Scatter alone makes 0.4/sqrt(sides).
  double off_model = 0.0, off_area = 0.0;  ///< 0 where the measured G is the predicted one
  LocalCorrelations correlations;          ///< on what the place of a contact depends
};

/// Measured, of all contact sides of bodies of one shape.
struct ContactStatistics {
  std::size_t sides = 0;                       ///< of bodies of that shape
  std::size_t contacts = 0;                    ///< between two of them
  OrientationFit local;                        ///< a^cv, b^cv in body axes
  std::array<Estimate, 3> length{};            ///< shares of sides
  std::array<Estimate, 6> pairs{};             ///< shares of `contacts`; NaN without
  std::optional<SpheroidStatistics> spheroid;  ///< empty of triaxial bodies
};
/// Empty of spheres, which have no body axes, and without a side.
/// @param bodies  the bodies, by index
/// @param contacts  in space, else std::invalid_argument
/// @param shape     of the bodies that count; a packing of several is asked once for each
///
/// (4) exchanging a and b, the order of contacts, turning the packing, units, and the numbers of
///     bodies change nothing but rounding
std::optional<ContactStatistics> contact_statistics_of(const ContactArrays& contacts,
                                                       const BodyArrays& bodies, Shape shape);

/// The measured G at angles: half the share of sides whose axis is within beta, up to pi/2.
/// @param bodies  the bodies, by index
/// @param beta  angles to the axis, rad
/// @param contacts  in space, else std::invalid_argument
/// @param shape     prolate or oblate, else empty
std::vector<double> measured_distribution(const ContactArrays& contacts, const BodyArrays& bodies,
                                          Shape shape, std::span<const double> beta);

}  // namespace tangency::inline v0::micromechanics
