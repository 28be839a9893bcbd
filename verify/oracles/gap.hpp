// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Oracle: the signed gap of two solid ellipsoids, to 100 digits.
///
///     g(A,B) = max over unit n of f(n) = n.d - h_A(n) - h_B(n),   d = c_B - c_A,
///
/// h the support functions. Found by Newton ascent in 150 digits, which ends only where the
/// gradient of f on the sphere is below 1e-130 L and f is at no saddle, L = |d| + largest semi-axis
/// of A + that of B. Error of `gap` below 1e-140 L.
///
/// Why an answer is the global one (GapTruth::global):
///
///  (1) gap > -rho, rho = a_min^2/a_max of A plus that of B. rho is at most the sum of the radii of
///      curvature of any two normal sections, so F = f + rho has F'' + F <= 0 along great circles:
///      from a stationary point with F > 0, F(t) <= F(0) cos t < F(0). So stationary is global.
///  (2) Separate bodies: the normal n ~ ((1-s) M_A + s M_B)^-1 d of the greatest Perram-Wertheim
///      function F has f(n) = (1 - 1/sqrt F) n.d > 0 [PerramWertheim1985], and ascent never goes
///      down: it ends in (1).
///  (3) Two spheres: f differs from n.d by a constant.
///  (4) Deeper pairs: the enclosure (gap_enclosure.hpp) has discarded every normal outside caps on
///      which f is concave, and the highest of their stationary points is taken. Where maxima tie
///      along a curve this proves no more than `unproven`.
///
/// Identities: (a) signed_gap(b, a).gap == signed_gap(a, b).gap up to the error; (b) so under a
/// common motion, and under a common scaling in proportion; (c) p_B - p_A = gap n, that is d +
/// arm_b
/// - arm_a = gap n, to 1e-130 L.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <tangency/verify/oracles/real_ellipsoid.hpp>

namespace tangency::inline v0::verify {

/// Chosen: isolates nearly all pairs, and takes some 0.1 s where it does not.
constexpr std::size_t kMostGapBoxes = 50000;

struct GapTruth {
  Real gap;
  Real3 normal;        ///< unit, from A to B
  Real3 arm_a, arm_b;  ///< witness points relative to their body's centre: p_A - c_A, p_B - c_B
  bool global;         ///< proven: no normal has a greater f
  double unproven;     ///< the global gap is proven to be at most gap + unproven; 0 where `global`;
                       ///< infinite where nothing was tried
};

/// The stationary answer that an ascent from `start` (not 0, any length) leads to; `global` by (1)
/// alone. Throws std::invalid_argument unless both are ellipsoids, std::runtime_error if the ascent
/// does not arrive.
GapTruth stationary_gap(const RealEllipsoid& a, const RealEllipsoid& b,
                        const std::array<double, 3>& start);

/// The global answer. Where several normals tie, one of them. Throws as above.
GapTruth signed_gap(const RealEllipsoid& a, const RealEllipsoid& b);
GapTruth signed_gap(const RawEllipsoid& a, const RawEllipsoid& b);

/// The global answer and after it, best first, every maximum whose gap is lower by up to `within`
/// >= 0 (in the unit of length); none is left out if the first is `global`, and only the first is
/// marked so. Where normals tie along a curve some of them. Throws as above.
/// `most_boxes` is the budget of (4).
std::vector<GapTruth> highest_gaps(const RealEllipsoid& a, const RealEllipsoid& b, double within,
                                   std::size_t most_boxes = kMostGapBoxes);

}  // namespace tangency::inline v0::verify
