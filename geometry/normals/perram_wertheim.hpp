// SPDX-License-Identifier: MIT
/// @file
/// The Perram-Wertheim form of a pair: what the yes/no filter decides with, and whence the searches
/// for the gap start.
///
/// With M_A, M_B the shape matrices, J their adjugates, X the mixed adjugate and l = s/(1-s),
///     D(l) = det(M_A + l M_B),  N(l) = d' adj(M_A + l M_B) d,  F(l) = l N / ((1 + l) D).
/// F has one maximum on l > 0 [PerramWertheim1985]; max F > 1 <=> the solids are apart. There, with
/// v = (M_A + l M_B)^-1 d, both level functions agree at c_A + M_A v, where the normals oppose.
#pragma once

#include <limits>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/numbers/two_lanes.hpp>

namespace tangency::inline v0::detail {

/// Of maximise(), where Newton's method on the normal follows; measured: more do not shorten it.
inline constexpr int kPerramWertheimSteps = 2;

/// D and N at one l by their terms, and what Euler's operator l d/dl makes of them once and twice.
struct PerramWertheimAt {
  double l;
  double d0, d1, d2, d3;
  double n0, n1, n2;

  double det() const noexcept { return (d0 + d1) + (d2 + d3); }
  double det1() const noexcept { return d1 + (2.0 * d2 + 3.0 * d3); }
  double det2() const noexcept { return d1 + (4.0 * d2 + 9.0 * d3); }
  double num() const noexcept { return n0 + n1 + n2; }
  double num1() const noexcept { return n1 + 2.0 * n2; }
  double num2() const noexcept { return n1 + 4.0 * n2; }
};

/// The search for the maximiser of F on l > 0: Newton's method on log l, kept within a bracket.
class PerramWertheimSearch {
 public:
  /// The next l. Requires F at the last one (or at the first guess).
  double next(const PerramWertheimAt& at) noexcept {
    // First and second derivative of log F with respect to log l.
    const double s = 1.0 / (1.0 + at.l), n = 1.0 / at.num(), d = 1.0 / at.det();
    const double p = n * at.num1(), q = d * at.det1();
    const double slope = s + p - q;
    const double curvature = (n * at.num2() - p * p) - (d * at.det2() - q * q) - at.l * s * s;
    (slope > 0.0 ? low_ : high_) = at.l;
    // exp(x) by (1 + x/2) / (1 - x/2), |x| <= 1.8, a factor of up to 19: no more is needed of a
    // step. With x = -slope / curvature that is one quotient.
    constexpr double kLongest = 0.9;
    const double most = (1.0 + kLongest) / (1.0 - kLongest);
    double factor = slope > 0.0 ? most : 1.0 / most;
    if (-2.0 * kLongest * curvature > (slope < 0.0 ? -slope : slope)) {
      factor = (2.0 * curvature - slope) / (2.0 * curvature + slope);
    }
    const double l = at.l * factor;
    return low_ < l && l < high_ ? l : between(at.l, slope);
  }

 private:
  /// Halfway, on a logarithmic scale, to the end of the bracket that the slope points to.
  double between(double l, double slope) const noexcept;

  double low_ = 0.0;
  double high_ = std::numeric_limits<double>::infinity();
};

/// D and N of a pair of moderate() bodies as polynomials in l, by their coefficients.
class PerramWertheimForm {
 public:
  PerramWertheimForm(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept {
    const TwoLanesSymmetric3 adjugates(a.shape_adjugate(), b.shape_adjugate());
    const TwoLanes inner = trace_of_product(adjugates, {b.shape(), a.shape()});
    const TwoLanesVec3 outer_d = adjugates * d;
    const TwoLanes outer = dot(outer_d, d);
    direction_[0] = outer_d.of_a();
    direction_[1] = mixed_adjugate(a.shape(), b.shape()) * d;
    direction_[2] = outer_d.of_b();
    det_[0] = a.shape_determinant();
    det_[1] = inner[0];
    det_[2] = inner[1];
    det_[3] = b.shape_determinant();
    num_[0] = outer[0];
    num_[1] = direction_[1].dot(d);
    num_[2] = outer[1];
  }

  /// A first guess at the maximiser of F: where the outer coefficients balance; at coinciding
  /// centres, where F vanishes, that of det alone.
  double first_guess() const noexcept;

  PerramWertheimAt at(double l) const noexcept {
    const double ll = l * l;
    return {l,       det_[0],     l * det_[1], ll * det_[2], l * ll * det_[3],
            num_[0], l * num_[1], ll * num_[2]};
  }

  /// Newton steps towards the maximiser of F from the first guess, at most `steps`; stops early
  /// where the last step changed l by less than a hundredth.
  double maximise(int steps) const noexcept;

  /// A multiple > 0 of (M_A + l M_B)^-1 d, the direction of the normal at l, namely det(l) times
  /// it.
  Vec3 normal_direction(double l) const noexcept {
    return direction_[0] + l * (direction_[1] + l * direction_[2]);
  }

 private:
  Vec3 direction_[3];  ///< J_A d, X d, J_B d
  double det_[4];
  double num_[3];
};

}  // namespace tangency::inline v0::detail
