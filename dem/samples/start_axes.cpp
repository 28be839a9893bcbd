// SPDX-License-Identifier: MIT
#include <tangency/dem/samples/start_axes.hpp>

#include <cmath>
#include <numbers>

#include <tangency/dem/lanes/elementary.hpp>

namespace tangency::inline v0::dem {
namespace {

/// About z, by twice the angle of which these are.
Quaternion about_z(const CosineSine& half) { return {half.cosine, 0.0, 0.0, half.sine}; }

/// Takes z to a unit vector, or to its opposite where that is nearer.
Quaternion z_to(const Vec3& unit) {
  const Vec3 d = unit[2] < 0.0 ? Vec3(-unit) : unit;
  return Quaternion(1.0 + d[2], -d[1], d[0], 0.0).normalized();
}

/// In the plane: takes x to a unit vector, or to its opposite where that is nearer.
Quaternion x_to(const Vec3& unit) {
  const Vec3 d = unit[0] < 0.0 ? Vec3(-unit) : unit;
  return Quaternion(1.0 + d[0], 0.0, 0.0, d[1]).normalized();
}

/// Takes x to z, z to y and y to x.
Quaternion from_x_to_z() { return {0.5, -0.5, -0.5, -0.5}; }

}  // namespace

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

Quaternion uniform_rotation(std::mt19937_64& random, int dimensions) {
  if (dimensions == 2) return about_z(cosine_sine(std::numbers::pi * uniform(random)));
  const double u = uniform(random);
  const CosineSine first = cosine_sine(2.0 * std::numbers::pi * uniform(random));
  const CosineSine second = cosine_sine(2.0 * std::numbers::pi * uniform(random));
  const double s = std::sqrt(1.0 - u), t = std::sqrt(u);
  return {t * second.cosine, s * first.sine, s * first.cosine, t * second.sine};
}

int directed_axis(const Shape& shape) {
  return shape.elongation == 1.0 && shape.flatness > 1.0 ? 2 : 0;
}

Quaternion StartAxes::draw(std::mt19937_64& random, int axis, int dimensions) const {
  if (rule == Rule::random) return uniform_rotation(random, dimensions);
  const Vec3 along = direction.stableNormalized();
  if (dimensions == 2) {
    const double angle = rule == Rule::cone     ? half_angle * (2.0 * uniform(random) - 1.0)
                         : rule == Rule::across ? 0.5 * std::numbers::pi
                                                : 0.0;
    return x_to(along) * about_z(cosine_sine(0.5 * angle));
  }
  double versine = rule == Rule::across ? 1.0 : 0.0;  // 1 - cos of the angle to the direction
  if (rule == Rule::cone) {
    const double sine = cosine_sine(0.5 * half_angle).sine;
    versine = uniform(random) * 2.0 * sine * sine;
  }
  const CosineSine azimuth = cosine_sine(2.0 * std::numbers::pi * uniform(random));
  const double tilt = std::sqrt(0.5 * versine);  // sine of half the angle
  const Quaternion tilted(std::sqrt(1.0 - 0.5 * versine), -azimuth.sine * tilt,
                          azimuth.cosine * tilt, 0.0);
  const Quaternion spun =
      z_to(along) * tilted * about_z(cosine_sine(std::numbers::pi * uniform(random)));
  if (axis == 2) return spun;
  return spun * from_x_to_z();
}

}  // namespace tangency::inline v0::dem
