// SPDX-License-Identifier: MIT
#include <tangency/geometry/ray.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

#include <tangency/geometry/floating_point_environment.hpp>
#include <tangency/geometry/methods/body_frame.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency {
namespace {

using exact::DoubleDouble;
using exact::DoubleDoubleVector;

constexpr double kEpsilon = exact::kDoubleDoubleEpsilon;
// docs/derivations/primitives.md, section 4.
constexpr double kTurned = 64 * kEpsilon;
constexpr double kCrossed = 8 * kEpsilon;
constexpr double kSquared = 16 * kEpsilon;
constexpr double kFarMiss = 0x1p-40;  // chosen: far above the rounding of the double test, 2^-49

/// The line z + t v in the coordinates that make the body the unit ball, and how far it is off.
struct UnitBallLine {
  DoubleDoubleVector z, v;
  DoubleDouble discriminant;  ///< |v|^2 - |z x v|^2: > 0 where the line meets the ball's interior
  double error;               ///< a bound of its error
};

/// Is the line proven to miss the sphere around the body? Lengths as seen, direction in [1, 2).
bool passes_far(const methods::SeenFromCentre& seen, const Vec3& direction) {
  const Vec3 d = exact::rounded(seen.separation);
  const double reach = seen.semi_axes.maxCoeff() * direction.norm();
  return d.cross(direction).norm() - reach > kFarMiss * d.norm() * direction.norm();
}

UnitBallLine unit_ball_line(const methods::SeenFromCentre& seen, const methods::BodyFrame& frame,
                            const Vec3& direction) {
  UnitBallLine line{
      frame.to_body(seen.separation), frame.to_body(exact::exactly(direction)), {}, 0.0};
  const double distance = exact::rounded(seen.separation).norm(), speed = direction.norm();
  double z[3], v[3], dz[3], dv[3];  // absolute values, and bounds of their errors
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = seen.semi_axes[static_cast<int>(i)];
    line.z[i] = line.z[i] / DoubleDouble(a);
    line.v[i] = line.v[i] / DoubleDouble(a);
    z[i] = std::abs(line.z[i].high), dz[i] = kTurned * distance / a;
    v[i] = std::abs(line.v[i].high), dv[i] = kTurned * speed / a;
  }
  DoubleDoubleVector x;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    x[i] = line.z[j] * line.v[k] - line.z[k] * line.v[j];
    const double dx = dz[j] * v[k] + (z[j] + dz[j]) * dv[k] + dz[k] * v[j] +
                      (z[k] + dz[k]) * dv[j] + kCrossed * (z[j] * v[k] + z[k] * v[j]);
    line.error += (2.0 * std::abs(x[i].high) + dx) * dx + (2.0 * v[i] + dv[i]) * dv[i];
  }
  const DoubleDouble vv = exact::dot(line.v, line.v), xx = exact::dot(x, x);
  line.discriminant = vv - xx;
  line.error += kSquared * (vv.high + xx.high);
  return line;
}

RayHit found_hit(const Ellipsoid& body, const Ray& ray, double t_begin, double t_end) {
  assert(ray.origin.allFinite() && ray.direction.allFinite() && ray.direction != Vec3::Zero());
  assert(t_begin <= t_end);
  RayHit hit{
      RayStatus::miss, 0, {{0.0, Vec3::Zero(), Vec3::Zero()}, {0.0, Vec3::Zero(), Vec3::Zero()}}};
  const methods::SeenFromCentre seen = methods::seen_from_centre(body, ray.origin);
  const int turn = std::max({exponent_of(ray.direction[0]), exponent_of(ray.direction[1]),
                             exponent_of(ray.direction[2])});
  const Vec3 direction =
      ray.direction.unaryExpr([=](double x) { return scaled_by_power(x, -turn); });
  if (passes_far(seen, direction)) return hit;

  const methods::BodyFrame frame(body.orientation());
  const UnitBallLine line = unit_ball_line(seen, frame, direction);
  if (line.discriminant.high < -line.error) return hit;
  const bool crosses = line.discriminant.high > line.error;
  const DoubleDouble square = exact::dot(line.v, line.v);
  const DoubleDouble middle = -(exact::dot(line.z, line.v) / square);
  const DoubleDouble half = crosses ? sqrt(line.discriminant) / square : DoubleDouble();

  const auto consider = [&](const DoubleDouble& t) {
    const double rounded = std::scalbn(t.high, seen.exponent - turn);
    if (!(rounded >= t_begin && rounded <= t_end)) return;
    DoubleDoubleVector w = line.z + t * line.v;
    w = DoubleDouble(1.0) / exact::length(w) * w;
    DoubleDoubleVector point, gradient;
    for (std::size_t i = 0; i < 3; ++i) {
      const DoubleDouble a = seen.semi_axes[static_cast<int>(i)];
      point[i] = a * w[i];
      gradient[i] = w[i] / a;
    }
    const Vec3 arm = exact::rounded(frame.to_space(point));
    const DoubleDoubleVector normal = DoubleDouble(1.0) / exact::length(gradient) * gradient;
    hit.points[hit.count++] = {
        rounded, arm.unaryExpr([&](double x) { return std::scalbn(x, seen.exponent); }),
        exact::rounded(frame.to_space(normal))};
  };
  consider(middle - half);
  if (crosses) consider(middle + half);
  if (hit.count > 0) hit.status = crosses ? RayStatus::hit : RayStatus::grazing;
  return hit;
}

}  // namespace

RayHit intersect(const Ellipsoid& body, const Ray& ray, double t_begin, double t_end) noexcept {
  return in_default_environment([&] { return found_hit(body, ray, t_begin, t_end); });
}

}  // namespace tangency
