// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Oracles for one body inside another, in space and in the plane, for the stored doubles: the
/// clearance c = min over unit n of phi(n) = h_outer(n) - h_inner(n) - n.(c_inner - c_outer), and
/// the margin s, the largest factor by which the inner body can be scaled about its centre and
/// stays in the outer one.
///
/// From above: phi at any n. From below, by distances instead of normals: for a point p of the
/// outer body, whose shape matrix is diag(a^2) about its centre, and any t in [0, a_min^2)
///
///  (1)  (distance of p from the boundary)^2 >= t (1 - sum of p_i^2 / (a_i^2 - t)),
///
/// the dual of the distance; a branch and bound over the inner body's boundary, in CGAL's interval
/// arithmetic, holds it against what is to be shown. The kernel searches the sphere of normals.
///
///  (2)  With the outer body mapped to the unit ball, e the inner centre there and W = U diag(w) U'
///  the
///       inner shape: s^2 >= 1/v - sum of (U'e)_i^2 / (v - w_i) for v > max w, and s <= (1 - e.m) /
///       sqrt(m'Wm) for unit m, both in 150 digits from the eigenvalues of W. The kernel has no
///       eigenvalues.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <tangency/verify/oracles/ellipse.hpp>
#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::inline v0::verify {

/// phi(n / |n|). n of any length but 0.
Real clearance_at(const RawEllipsoid& inner, const RawEllipsoid& outer,
                  const std::array<double, 3>& n);
Real clearance_at(const RawEllipse& inner, const RawEllipse& outer, const std::array<double, 2>& n);

/// The least phi that a descent by Newton's method from n comes upon, to 40 digits.
Real clearance_near(const RawEllipsoid& inner, const RawEllipsoid& outer,
                    const std::array<double, 3>& n);
Real clearance_near(const RawEllipse& inner, const RawEllipse& outer,
                    const std::array<double, 2>& n);

/// Is the clearance proven to be at least `least`? False where it is not, and where the budget
/// ends. Requires 0 < least; aspect ratios and ratios of sizes to 1e60.
bool clearance_is_at_least(const RawEllipsoid& inner, const RawEllipsoid& outer, double least,
                           std::size_t most_boxes = 100'000);
bool clearance_is_at_least(const RawEllipse& inner, const RawEllipse& outer, double least,
                           std::size_t most_boxes = 100'000);

struct MarginTruth {
  Real low, high;  ///< by (2); to 60 digits the same
};
MarginTruth margin_truth(const RawEllipsoid& inner, const RawEllipsoid& outer);
MarginTruth margin_truth(const RawEllipse& inner, const RawEllipse& outer);

}  // namespace tangency::inline v0::verify
