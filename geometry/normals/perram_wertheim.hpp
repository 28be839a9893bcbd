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
    // step.
    constexpr double kLongest = 0.9;
    double half = slope > 0.0 ? kLongest : -kLongest;
    if (-2.0 * kLongest * curvature > (slope < 0.0 ? -slope : slope)) {
      half = -0.5 * slope / curvature;
    }
    const double l = at.l * ((1.0 + half) / (1.0 - half));
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
  PerramWertheimForm(const Ellipsoid& a, const Ellipsoid& b, const Vec3& d) noexcept
      : a_(a), b_(b), d_(d), mixed_(mixed_adjugate(a.shape(), b.shape())) {
    const Symmetric3 dd = square(d);
    det_[0] = a.shape_determinant();
    det_[1] = trace_of_product(a.shape_adjugate(), b.shape());
    det_[2] = trace_of_product(b.shape_adjugate(), a.shape());
    det_[3] = b.shape_determinant();
    num_[0] = trace_of_product(a.shape_adjugate(), dd);
    num_[1] = trace_of_product(mixed_, dd);
    num_[2] = trace_of_product(b.shape_adjugate(), dd);
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
    return a_.shape_adjugate() * d_ + l * (mixed_ * d_ + l * (b_.shape_adjugate() * d_));
  }

 private:
  const Ellipsoid& a_;
  const Ellipsoid& b_;
  Vec3 d_;
  Symmetric3 mixed_;
  double det_[4];
  double num_[3];
};

}  // namespace tangency::inline v0::detail
