// SPDX-License-Identifier: MIT
#include <tangency/geometry/bodies/surface_projection.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tangency/geometry/floating_point.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0::detail {
namespace {

constexpr int kSteps = 200;  // chosen: docs/derivations/primitives.md, section 2, expects 90
constexpr double kBoundRounding = 0x1p-50;  // above the rounding of c - f, 3 u (c + f)
constexpr double kCoarse = 0x1p-50;         // | |w| - 1 | where double arithmetic has done its part
constexpr double kFine = 0x1p-96;  // the same in double-double, a few units above its rounding

double value(double x) { return x; }
double value(const DoubleDouble& x) { return x.high; }

/// The equation's coefficients c_i = r_i y_i and f_i.
template <class Real>
struct Secular {
  std::array<Real, 3> c, f;

  std::array<Real, 3> at(const Real& t) const {
    const auto w = [&](std::size_t i) {
      return value(c[i]) == 0.0 ? Real(0.0) : c[i] / (t + f[i]);
    };
    return {w(0), w(1), w(2)};
  }

  /// A root from `t`, of | |w| - 1 | <= tolerance. Never below the bounds r_i |y_i| - f_i.
  Real root(Real t, double least, double tolerance) const {
    using std::sqrt;
    for (int step = 0; step < kSteps; ++step) {
      const std::array<Real, 3> w = at(t);
      const Real square = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
      const Real excess = sqrt(square) - Real(1.0);
      if (std::abs(value(excess)) <= tolerance) break;
      Real slope(0.0);
      for (std::size_t i = 0; i < 3; ++i) {
        if (value(w[i]) != 0.0) slope = slope + w[i] * w[i] / (t + f[i]);
      }
      const Real next = t + excess * square / slope;
      t = value(next) >= least ? next : Real(least);
    }
    return t;
  }
};

/// w where y lies in the symmetry plane across the smallest axes, inside the focal curve: the tie.
bool tied(const Secular<DoubleDouble>& secular, const DoubleDoubleVector& y, std::size_t k,
          DoubleDoubleVector& w) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (value(secular.f[i]) == 0.0 && value(y[i]) != 0.0) return false;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    w[i] = value(y[i]) == 0.0 ? DoubleDouble() : secular.c[i] / secular.f[i];
  }
  const DoubleDouble rest = DoubleDouble(1.0) - dot(w, w);
  if (value(rest) < 0.0) return false;
  w[k] = sqrt(rest);
  return true;
}

/// The unit vector w = diag(1/a) x of the closest point x.
DoubleDoubleVector unit_coordinates(const Vec3& a, const DoubleDoubleVector& y) {
  int least = 0;
  a.minCoeff(&least);
  const double smallest = a[least];
  Secular<DoubleDouble> fine;
  Secular<double> coarse;
  double bound = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double ai = a[static_cast<int>(i)];
    const DoubleDouble ratio = DoubleDouble(ai) / DoubleDouble(smallest);
    fine.c[i] = ratio * y[i];
    fine.f[i] = two_sum(ai, -smallest) * (ratio + DoubleDouble(1.0));
    coarse.c[i] = fine.c[i].high;
    coarse.f[i] = fine.f[i].high;
    // |w_i| <= 1 at the root. Where rounding hides the difference it bounds nothing.
    const double c = std::abs(coarse.c[i]), f = coarse.f[i];
    bound = std::max(bound, (c - f) - kBoundRounding * (c + f));
  }
  DoubleDoubleVector w;
  if (tied(fine, y, static_cast<std::size_t>(least), w)) return w;
  const double start = coarse.root(bound, bound, kCoarse);
  w = fine.at(fine.root(start, bound, kFine));
  return DoubleDouble(1.0) / length(w) * w;
}

}  // namespace

SeenFromCentre seen_from_centre(const Ellipsoid& body, const DoubleDoubleVector& separation,
                                int shift) noexcept {
  const int exponent =
      std::max(exponent_of(rounded(separation)), exponent_of(body.semi_axes()) - shift);
  const Vec3 axes = scaled_by_power(body.semi_axes(), -(exponent + shift));
  return {axes.cwiseMax(kThinnestAxisSeen), scaled_by_power(separation, -exponent),
          exponent + shift};
}

SeenFromCentre seen_from_centre(const Ellipsoid& body, const Vec3& point) noexcept {
  constexpr int kBelowOverflow = 2;
  // The difference of two huge coordinates may overflow in the caller's unit.
  const int shift = (point - body.centre()).allFinite() ? 0 : kBelowOverflow;
  const Vec3 to = scaled_by_power(point, -shift), from = scaled_by_power(body.centre(), -shift);
  return seen_from_centre(
      body, {two_sum(to[0], -from[0]), two_sum(to[1], -from[1]), two_sum(to[2], -from[2])}, shift);
}

SurfaceProjection project_on_surface(const Vec3& semi_axes,
                                     const DoubleDoubleVector& from) noexcept {
  DoubleDoubleVector y = from;
  for (DoubleDouble& component : y) {
    if (std::abs(component.high) < kLeastComponent) component = {};
  }
  const DoubleDoubleVector w = unit_coordinates(semi_axes, y);
  DoubleDoubleVector gradient, point;
  for (std::size_t i = 0; i < 3; ++i) {
    const DoubleDouble a = semi_axes[static_cast<int>(i)];
    gradient[i] = w[i] / a;
    point[i] = a * w[i];
  }
  // n . y - h(n) at n = v / |v|, v = diag(1/a) w, of support 1.
  const DoubleDouble scale = DoubleDouble(1.0) / length(gradient);
  return {scale * (dot(gradient, y) - DoubleDouble(1.0)), scale * gradient, point};
}

ClosestOnSurface closest_on_surface(const Ellipsoid& body, const SeenFromCentre& seen) noexcept {
  const DoubleDoubleMatrix r = double_double_rotation(body.orientation());
  const SurfaceProjection found =
      project_on_surface(seen.semi_axes, turned_back(r, seen.separation));
  return {found.distance, rounded(turned(r, found.normal)),
          scaled_by_power(rounded(turned(r, found.point)), seen.exponent)};
}

double size_of(const SeenFromCentre& seen) noexcept {
  return rounded(seen.separation).norm() + seen.semi_axes.maxCoeff();
}

double error_of_distance(double distance, double size, int exponent) noexcept {
  // Scaling rounds what becomes subnormal, of distance and error.
  constexpr double kSubnormal = 2.0 * std::numeric_limits<double>::denorm_min();
  return std::scalbn(2.0 * kUnitRoundoff * std::abs(distance) + 0x1p-80 * size, exponent) +
         kSubnormal;
}

}  // namespace tangency::inline v0::detail
