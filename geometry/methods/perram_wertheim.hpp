// SPDX-License-Identifier: MIT
/// @file
/// The Perram-Wertheim form of a pair: whence the searches for the gap start.
///
/// With M_A, M_B the shape matrices, J their adjugates, X the mixed adjugate and l = s/(1-s),
///     D(l) = det(M_A + l M_B),  N(l) = d' adj(M_A + l M_B) d,  F(l) = l N / ((1 + l) D).
/// F has one maximum on l > 0 [PerramWertheim1985]; max F > 1 <=> the solids are apart. There, with
/// v = (M_A + l M_B)^-1 d, both level functions agree at c_A + M_A v, where the normals oppose.
#pragma once

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::methods {

/// D and N of a pair of moderate() bodies as polynomials in l, by their coefficients.
/// Requires d != 0, so that n_[0] and n_[2] are > 0.
class PerramWertheimForm {
 public:
  PerramWertheimForm(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept;

  /// A first guess at the maximiser of F: where the outer coefficients balance.
  double first_guess() const noexcept;

  /// Safeguarded Newton steps on log l towards the maximiser of F, at most `steps`; stops early
  /// where the last step changed l by less than a hundredth.
  double maximise(double l, int steps) const noexcept;

  /// A multiple > 0 of (M_A + l M_B)^-1 d: the direction of the normal at l.
  Vec3 normal_direction(double l) const noexcept;

 private:
  Vec3 d_;
  const Symmetric3& adjugate_a_;
  const Symmetric3& adjugate_b_;
  Symmetric3 mixed_;
  double det_[4];
  double num_[3];
};

}  // namespace tangency::methods
