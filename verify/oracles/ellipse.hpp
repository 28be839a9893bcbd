// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Oracles for two ellipses in the plane, for the stored doubles.
///
/// Relation and crossings: after a shear x -> x + k y both boundaries are a_i y^2 + b_i(x) y +
/// c_i(x) = 0 in integers. Their resultant R in x and the leading coefficient s of their first
/// subresultant decide:
///
///  (1) R = 0 identically <=> the same boundary: an ellipse is irreducible.
///  (2) Where s has no root in common with R, each root x of R belongs to just one common point,
///      whose y = -(a_1 c_2 - a_2 c_1) / s is real with x and whose multiplicity is the root's.
///      Only finitely many k break this, but for concentric homothetic ellipses, where s is 0 for
///      all k: these have no common point.
///  (3) A point of odd multiplicity is a crossing: overlap. With none of these, the boundaries only
///      touch, or meet nowhere: a centre inside the other tells nested from disjoint, and the
///      smaller area is the one inside.
///
/// The kernel knows the same from the inertia of members of the pencil of the two forms.
#pragma once

#include <array>
#include <vector>

#include <tangency/verify/oracles/real_ellipsoid.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::inline v0::verify {

/// The solid { centre + semi_axes[0] y_1 u/|u| + semi_axes[1] y_2 v/|u| : |y| <= 1 }, u =
/// direction, v = u turned by a quarter. Requires finite numbers, semi-axes > 0 and u != 0.
struct RawEllipse {
  std::array<double, 2> centre;
  std::array<double, 2> semi_axes;
  std::array<double, 2> direction = {1, 0};
};

struct EllipseTruth {
  ExactRelation relation;
  int crossings;                    ///< distinct real points; -1 for equal ellipses
  std::vector<int> multiplicities;  ///< of these, ascending
};

/// Throws std::invalid_argument unless both are ellipses.
EllipseTruth exact_ellipse_relation(const RawEllipse& a, const RawEllipse& b);

using Real2 = std::array<Real, 2>;

/// All common points of the boundaries, relative to A's centre, each once, to 100 digits (a
/// multiple one to the 100th part of its multiplicity).
std::vector<Real2> ellipse_crossings(const RawEllipse& a, const RawEllipse& b);

/// The same by GSL's complex roots of the quartic in the tangent of the half angle, in double:
/// those whose imaginary part is below `imaginary` of 1 + |root|.
std::vector<std::array<double, 2>> ellipse_crossings_by_gsl(const RawEllipse& a,
                                                            const RawEllipse& b, double imaginary);

/// Area of the common region by quadrature (tanh-sinh, 50 digits) over the widths of its slices, to
/// 1e-18 of itself.
Real common_area(const RawEllipse& a, const RawEllipse& b);

/// The same in double, with GSL: around the arcs between ellipse_crossings_by_gsl(), by quadrature
/// of (x dy - y dx) / 2 (Green). For crossings that are well apart.
double common_area_by_gsl(const RawEllipse& a, const RawEllipse& b, double imaginary);

/// max over unit n of n.d - h_A(n) - h_B(n), and every n that reaches it.
struct PlaneGapTruth {
  Real gap;
  bool every_normal;           ///< concentric circles: `normals` is empty then
  std::vector<Real2> normals;  ///< unit, from A to B, in descending order; to 40 digits
};

/// Ascents in 150 digits from every local maximum of a dense sample of normals; maxima within 1e-60
/// of the size tie. Those nearer to each other than the sample are found as mirror images of one
/// another in d or in an axis of a body: but for these symmetries nothing makes them tie.
PlaneGapTruth plane_gap_truth(const RawEllipse& a, const RawEllipse& b);
Real plane_gap(const RawEllipse& a, const RawEllipse& b);

}  // namespace tangency::inline v0::verify
