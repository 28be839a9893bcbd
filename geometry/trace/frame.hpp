// SPDX-License-Identifier: MIT
/// @file
/// Where the scheme of curves starts (scheme.hpp): the principal frame of A that carries
/// (theta, phi), the cones about the line of centres, the pole that the cone does not hold, and the
/// limits of theta on A in the cone. docs/derivations/trace-contact.md
///
/// Frames may be of either handedness: only the angles' meaning depends on it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/tier.hpp>

namespace tangency::inline v0::detail {

template <class Real>
using TraceVector = Eigen::Matrix<Real, 3, 1>;

template <class Real>
struct TraceBody {
  TraceVector<Real> semi_axes;
  Eigen::Matrix<Real, 3, 3> rotation;
};

template <class Real>
TraceBody<Real> trace_body(const Ellipsoid& body) noexcept {
  return {body.semi_axes().cast<Real>(), body.rotation().cast<Real>()};
}

template <class Real>
constexpr Real kPi = std::numbers::pi_v<Real>;

/// Principal axes of A as columns, the third one the pole, and their semi-axes; of any handedness.
template <class Real>
struct Frame {
  Eigen::Matrix<Real, 3, 3> axes;
  TraceVector<Real> radii;
};

/// Columns by decreasing length of the semi-axes, in the stored order where they are equal.
template <class Real>
Frame<Real> sorted_frame(const TraceBody<Real>& body) {
  std::array<int, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&r = body.semi_axes](int i, int j) { return r[i] != r[j] ? r[i] > r[j] : i < j; });
  Frame<Real> frame;
  for (int k = 0; k < 3; ++k) {
    const int i = order[static_cast<std::size_t>(k)];
    frame.axes.col(k) = body.rotation.col(i);
    frame.radii[k] = body.semi_axes[i];
  }
  return frame;
}

/// The unit vector along u x v; nothing where u and v are parallel up to what rounding leaves of
/// the product: half of the digits, chosen. |u| = 1.
template <class Real>
std::optional<TraceVector<Real>> across(const TraceVector<Real>& u, const TraceVector<Real>& v) {
  const TraceVector<Real> product = u.cross(v);
  const Real length = product.norm();
  if (!(length > std::sqrt(std::numeric_limits<Real>::epsilon()) * v.norm())) return std::nullopt;
  return TraceVector<Real>(product / length);
}

/// The first of: across u and d, across u and an axis that B's semi-axes single out.
template <class Real>
std::optional<TraceVector<Real>> across_pair(const TraceVector<Real>& u, const TraceVector<Real>& d,
                                             const TraceBody<Real>& b) {
  if (const auto w = across(u, d)) return w;
  const Frame<Real> other = sorted_frame(b);
  for (const int k : {0, 2}) {
    if (other.radii[k] == other.radii[1]) continue;
    if (const auto w = across(u, TraceVector<Real>(other.axes.col(k)))) return w;
  }
  return std::nullopt;
}

/// Where equal semi-axes leave the frame free, one axis is put across the pair's plane.
template <class Real>
void turn_to_pair(Frame<Real>& frame, const TraceBody<Real>& b, const TraceVector<Real>& d) {
  auto& axes = frame.axes;
  const auto& r = frame.radii;
  if (r[0] == r[2]) {
    const TraceVector<Real> x = d.normalized();
    axes.col(2) = across_pair(x, x, b).value_or(x.unitOrthogonal());
    axes.col(0) = x;
    axes.col(1) = axes.col(2).cross(axes.col(0));
  } else if (r[1] == r[2]) {
    const TraceVector<Real> x = axes.col(0);
    axes.col(2) = across_pair(x, d, b).value_or(axes.col(2));
    axes.col(1) = axes.col(2).cross(axes.col(0));
  } else if (r[0] == r[1]) {
    const TraceVector<Real> z = axes.col(2);
    axes.col(1) = across_pair(z, d, b).value_or(axes.col(1));
    axes.col(0) = axes.col(1).cross(axes.col(2));
  }
}

/// A cone of directions from A's centre about d.
template <class Real>
struct Cone {
  TraceCone kind;
  Real sine, cosine;  ///< of the half-angle; the whole sphere: 0 and -1
  /// For a unit vector e along d, in some frame: is the pole +-z in the cone?
  bool holds_pole(const TraceVector<Real>& e) const {
    return cosine <= 0 || std::hypot(e.x(), e.y()) <= sine;
  }
};

/// The cones to try, the published one first where it exists.
template <class Real>
struct Cones {
  std::array<Cone<Real>, 2> cone;
  std::size_t count = 0;

  Cones(Real radius_a, Real radius_b, Real distance) {
    const Real along =
        (distance * distance + (radius_a - radius_b) * (radius_a + radius_b)) / (2 * distance);
    const bool spheres_meet = std::abs(radius_a - radius_b) < distance;
    if (spheres_meet && along > 0 && along < radius_a) {
      const Real across_squared = (radius_a - along) * (radius_a + along);
      add({TraceCone::published, std::sqrt(across_squared) / radius_a, along / radius_a});
      // The balls' common part fills the cone where the circle lies before the tangent circle of
      // B's ball, as seen from A's centre.
      if (distance * distance >= radius_a * radius_a + radius_b * radius_b) return;
    }
    if (distance > radius_b) {
      const Real tangent = std::sqrt((distance - radius_b) * (distance + radius_b));
      add({TraceCone::common_part, radius_b / distance, tangent / distance});
    } else {
      add({TraceCone::whole, 0, -1});
    }
  }
  void add(const Cone<Real>& c) { cone[count++] = c; }
};

/// The axis that is the pole, and the direction of d in the frame.
template <class Real>
struct Poled {
  Frame<Real> frame;
  TraceVector<Real> e;
  bool other_pole;
};

template <class Real>
Poled<Real> with_pole(const Frame<Real>& frame, int pole, const TraceVector<Real>& e) {
  const int x = pole == 0 ? 1 : 0, y = pole == 2 ? 1 : 2;
  Poled<Real> result{frame, {e[x], e[y], e[pole]}, pole != 2};
  for (const auto& [to, from] : {std::pair(0, x), std::pair(1, y), std::pair(2, pole)}) {
    result.frame.axes.col(to) = frame.axes.col(from);
    result.frame.radii[to] = frame.radii[from];
  }
  return result;
}

/// The shortest axis as published; where the cone holds it the middle one, then the longest; where
/// it holds all, the one that is farthest from d.
template <class Real>
Poled<Real> choose_pole(const Frame<Real>& frame, const Cone<Real>& cone,
                        const TraceVector<Real>& e) {
  int farthest = 2;
  for (const int pole : {2, 1, 0}) {
    const Poled<Real> poled = with_pole(frame, pole, e);
    if (!cone.holds_pole(poled.e)) return poled;
    if (std::abs(e[pole]) < std::abs(e[farthest])) farthest = pole;
  }
  return with_pole(frame, farthest, e);
}

template <class Real>
struct Interval {
  Real low, high;
  Real middle() const { return low + (high - low) / 2; }
};

/// The angle t + 2 pi k nearest to `near`.
template <class Real>
Real unwrapped(Real t, Real near) {
  return near + std::remainder(t - near, 2 * kPi<Real>);
}

/// Between which theta A's surface is in the cone: a full turn where the cone holds a pole.
template <class Real>
Interval<Real> theta_box(const Poled<Real>& a, const Cone<Real>& cone) {
  // theta has the azimuth's tangent times r_x / r_y: it is in the same quadrant.
  const auto theta_of = [&](Real azimuth) {
    const Real t =
        std::atan2(std::sin(azimuth) / a.frame.radii.y(), std::cos(azimuth) / a.frame.radii.x());
    return unwrapped(t, azimuth);
  };
  const Real centre = std::atan2(a.e.y(), a.e.x());
  if (cone.holds_pole(a.e)) {
    return {theta_of(centre) - kPi<Real>, theta_of(centre) + kPi<Real>};
  }
  const Real half = std::asin(std::min(Real(1), cone.sine / std::hypot(a.e.x(), a.e.y())));
  return {theta_of(centre - half), theta_of(centre + half)};
}

}  // namespace tangency::inline v0::detail
