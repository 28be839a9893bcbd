// SPDX-License-Identifier: GPL-3.0-or-later
#include "planted_bodies.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>

namespace tangency::testing {

using micromechanics::ScalarHarmonics;
using micromechanics::Spheroid;

double integral(const std::function<double(double)>& f, double from, double to) {
  constexpr std::size_t kIntervals = 2000;
  gsl_set_error_handler_off();
  const std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)> work(
      gsl_integration_workspace_alloc(kIntervals), &gsl_integration_workspace_free);
  gsl_function function;
  function.function = [](double x, void* p) {
    return (*static_cast<const std::function<double(double)>*>(p))(x);
  };
  function.params = const_cast<std::function<double(double)>*>(&f);
  double value = 0.0, error = 0.0;
  const int status = gsl_integration_qag(&function, from, to, 1e-15, 1e-13, kIntervals,
                                         GSL_INTEG_GAUSS61, work.get(), &value, &error);
  // Rounding may forbid the bound asked for; a bad integral is another matter.
  if (status != GSL_SUCCESS && !(error <= 1e-12 * std::abs(value) + 1e-13))
    throw std::runtime_error("quadrature did not converge");
  return value;
}

namespace {

double p2(double cosine) { return 1.5 * cosine * cosine - 0.5; }

int symmetry_axis(const Spheroid& s) { return s.along > s.across ? 0 : 2; }

Vec3 semi_axes_of(const Spheroid& s) {
  Vec3 r = Vec3::Constant(s.across);
  r[symmetry_axis(s)] = s.along;
  return r;
}

Vec3 draw_axis(Random& random, const ScalarHarmonics& axes) {
  const double largest = axes.mean * (1.0 + axes.second.norm() + axes.fourth.norm());
  for (;;) {
    const Vec3 u = random_direction(random);
    if (uniform(random, 0.0, largest) <= axes.value(u)) return u;
  }
}

/// A turn about the axis is drawn evenly.
Quaternion with_axis(Random& random, const Vec3& u, int axis) {
  const Vec3 second = u.cross(random_direction(random)).normalized();
  Mat3 rotation;
  rotation.col(axis) = u;
  rotation.col((axis + 1) % 3) = second;
  rotation.col((axis + 2) % 3) = u.cross(second);
  return Quaternion(rotation);
}

Vec3 draw_local(Random& random, double a1, int axis) {
  const double largest = 1.0 + std::fmax(a1, -0.5 * a1);
  for (;;) {
    const Vec3 v = random_direction(random);
    if (uniform(random, 0.0, largest) <= 1.0 + a1 * p2(v[axis])) return v;
  }
}

/// To the surface in the direction, in body axes.
Vec3 to_surface(const Vec3& r, const Vec3& direction) {
  return direction / direction.cwiseQuotient(r).norm();
}
Vec3 normal_at(const Vec3& r, const Vec3& point) {
  return point.cwiseQuotient(r.cwiseProduct(r)).normalized();
}

void add_bodies(Random& random, const Spheroid& s, const ScalarHarmonics& axes, std::size_t count,
                BodyPacking& made) {
  for (std::size_t body = 0; body < count; ++body) {
    made.orientation.push_back(with_axis(random, draw_axis(random, axes), symmetry_axis(s)));
    made.semi_axes.push_back(semi_axes_of(s));
  }
}

void add_contact(BodyPacking& made, const Vec3& normal, const Vec3& arm, const Vec3& other_arm,
                 std::size_t a, std::size_t b) {
  made.packing.normal.push_back(normal);
  made.packing.force.push_back(normal);
  made.packing.arm.push_back(arm);
  made.packing.branch.push_back(arm - other_arm);
  made.packing.bodies.push_back({static_cast<std::int64_t>(a), static_cast<std::int64_t>(b)});
}

/// A contact of body a with a new sphere, at the direction in its body axes.
void add_sphere(BodyPacking& made, std::size_t a, const Vec3& direction) {
  const Vec3 &r = made.semi_axes[a], point = to_surface(r, direction);
  const Vec3 normal = made.orientation[a] * normal_at(r, point);
  add_contact(made, normal, made.orientation[a] * point, -normal, a, made.semi_axes.size());
  made.orientation.emplace_back(1.0, 0.0, 0.0, 0.0);
  made.semi_axes.push_back(Vec3::Ones());
}

}  // namespace

micromechanics::ScalarHarmonics planted_axes(Random& random, const HarmonicSpread& spread) {
  return {0.25 / std::numbers::pi, random_second(random, spread.second),
          random_fourth(random, spread.fourth)};
}

BodyPacking draw_among_spheres(Random& random, const Spheroid& s, const ScalarHarmonics& axes,
                               const LocalLaw& law, std::size_t count, std::size_t each) {
  BodyPacking made;
  add_bodies(random, s, axes, count, made);
  const int axis = symmetry_axis(s);
  for (std::size_t a = 0; a < count; ++a) {
    const double a1 = law(made.orientation[a] * Vec3(Vec3::Unit(axis)));
    for (std::size_t i = 0; i < each; ++i) add_sphere(made, a, draw_local(random, a1, axis));
  }
  made.packing.particles = static_cast<std::int64_t>(made.semi_axes.size());
  return made;
}

BodyPacking draw_pairs(Random& random, const Spheroid& s, const ScalarHarmonics& axes,
                       const LocalLaw& law, std::size_t count, std::size_t contacts) {
  BodyPacking made;
  add_bodies(random, s, axes, count, made);
  const int axis = symmetry_axis(s);
  const auto lever = [&](std::size_t body) -> Vec3 {
    const double a1 = law(made.orientation[body] * Vec3(Vec3::Unit(axis)));
    return to_surface(made.semi_axes[body], draw_local(random, a1, axis));
  };
  std::uniform_int_distribution<std::size_t> any(0, count - 1);
  for (std::size_t c = 0; c < contacts; ++c) {
    const std::size_t a = any(random), b = any(random);
    const Vec3 of_a = lever(a), of_b = lever(b);
    add_contact(made, made.orientation[a] * normal_at(made.semi_axes[a], of_a),
                made.orientation[a] * of_a, made.orientation[b] * of_b, a, b);
  }
  made.packing.particles = static_cast<std::int64_t>(count);
  return made;
}

BodyPacking draw_plane(Random& random, const Spheroid& s, double a_e, const LocalLaw& law,
                       std::size_t count, std::size_t each) {
  BodyPacking made;
  made.packing.dimensions = 2;
  const auto draw_angle = [&](double a) {
    for (;;) {
      const double angle = uniform(random, 0.0, 2.0 * std::numbers::pi);
      if (uniform(random, 0.0, 1.0 + std::abs(a)) <= 1.0 + a * std::cos(2.0 * angle)) return angle;
    }
  };
  for (std::size_t body = 0; body < count; ++body) {
    const double half = 0.5 * draw_angle(a_e);
    made.orientation.emplace_back(std::cos(half), 0.0, 0.0, std::sin(half));
    made.semi_axes.emplace_back(s.along, s.across, s.across);
  }
  for (std::size_t a = 0; a < count; ++a) {
    const double a_l = law(made.orientation[a] * Vec3(Vec3::UnitX()));
    for (std::size_t i = 0; i < each; ++i) {
      const double beta = draw_angle(a_l);
      add_sphere(made, a, Vec3(std::cos(beta), std::sin(beta), 0.0));
      made.packing.normal.back()[2] = 0.0;
    }
  }
  made.packing.particles = static_cast<std::int64_t>(made.semi_axes.size());
  return made;
}

}  // namespace tangency::testing
