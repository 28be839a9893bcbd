// SPDX-License-Identifier: MIT
#include <tangency/dem/micromechanics/spheroid.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "spheroid_integrals.hpp"

namespace tangency::inline v0::micromechanics {
namespace {

using std::numbers::pi;

bool sound(double semi_axis) { return semi_axis > 0.0 && std::isfinite(semi_axis); }

}  // namespace

void require_sound(const Spheroid& s) {
  if (!sound(s.along) || !sound(s.across))
    throw std::invalid_argument("spheroid: semi-axes " + std::to_string(s.along) + ", " +
                                std::to_string(s.across) + ": must be finite and > 0");
}

bool are_equal_axes(double one, double other) {
  return std::abs(one - other) <= kEqualAxes * std::max(one, other);
}

Shape shape_of(const Vec3& semi_axes) {
  for (const double r : {semi_axes[0], semi_axes[1], semi_axes[2]})
    if (!sound(r))
      throw std::invalid_argument("semi_axes: " + std::to_string(r) + ": must be finite and > 0");
  std::array<double, 3> r{semi_axes[0], semi_axes[1], semi_axes[2]};
  std::ranges::sort(r);
  if (are_equal_axes(r[0], r[2])) return Shape::sphere;
  const bool short_pair = are_equal_axes(r[0], r[1]), long_pair = are_equal_axes(r[1], r[2]);
  if (short_pair && (!long_pair || r[2] - r[1] >= r[1] - r[0])) return Shape::prolate;
  return long_pair ? Shape::oblate : Shape::triaxial;
}

std::optional<Symmetry> symmetry_of(const Vec3& semi_axes) {
  const Shape shape = shape_of(semi_axes);
  if (shape == Shape::sphere || shape == Shape::triaxial) return std::nullopt;
  Eigen::Index axis = 0;
  if (shape == Shape::prolate)
    semi_axes.maxCoeff(&axis);
  else
    semi_axes.minCoeff(&axis);
  const double one = semi_axes[(axis + 1) % 3], other = semi_axes[(axis + 2) % 3];
  const double across = 0.5 * (one + other);
  return Symmetry{{semi_axes[axis], across}, static_cast<std::size_t>(axis)};
}

int isostatic_coordination(Shape shape, int dimensions) {
  if (dimensions != 2 && dimensions != 3)
    throw std::invalid_argument("dimensions = " + std::to_string(dimensions) + ": must be 2 or 3");
  if (dimensions == 2) return shape == Shape::sphere ? 4 : 6;
  if (shape == Shape::sphere) return 6;
  return shape == Shape::triaxial ? 12 : 10;
}

double contact_length(const Spheroid& s, double beta) {
  require_sound(s);
  return 1.0 / std::hypot(std::cos(beta) / s.along, std::sin(beta) / s.across);
}

std::optional<double> angle_of_length(const Spheroid& s, double length) {
  require_sound(s);
  if (s.along == s.across || !(length > 0.0)) return std::nullopt;
  const double relative = length / s.along, ratio = s.across / s.along, kappa = kappa_of(ratio);
  const double from_across = (relative - ratio) * (relative + ratio) / kappa;
  const double from_along = (1.0 - relative) * (1.0 + relative) / kappa;
  if (!(from_across >= 0.0 && from_along >= 0.0)) return std::nullopt;
  return std::atan2(ratio * std::sqrt(from_along), std::sqrt(from_across));
}

double surface_within(const Spheroid& s, double beta) {
  require_sound(s);
  const double c = std::cos(beta), ratio = s.across / s.along;
  // The height along the axis, in semi-axes, of the point at beta, and 1 less its square.
  const double size = std::hypot(ratio * c, std::sin(beta));
  const double height = ratio * c / size, across = std::sin(beta) / size;
  return 2.0 * pi * s.along * s.across * (half_zone(ratio) - zone(ratio, height, across * across));
}

double area_per_solid_angle(const Spheroid& s, double beta) {
  const double length = contact_length(s, beta), squared = length * length;
  const double normal =
      std::hypot(std::cos(beta) / (s.along * s.along), std::sin(beta) / (s.across * s.across));
  return normal * squared * squared;
}

double normal_angle(const Spheroid& s, double beta) {
  require_sound(s);
  const double ratio = s.along / s.across;
  return std::atan2(ratio * ratio * std::sin(beta), std::cos(beta));
}

double deviation(const Spheroid& s, double beta) {
  require_sound(s);
  const double c = std::cos(beta), across = std::sin(beta), ratio = s.across / s.along;
  return std::atan2(kappa_of(ratio) * across * c, ratio * ratio * c * c + across * across);
}

double largest_deviation(const Spheroid& s) {
  require_sound(s);
  return std::atan(0.5 * kappa_of(s.across / s.along) * s.along / s.across);
}

double mean_support_height(const Spheroid& s) {
  require_sound(s);
  return s.across / half_zone(s.across / s.along);
}

}  // namespace tangency::inline v0::micromechanics
