// SPDX-License-Identifier: GPL-3.0-or-later
//
// One body on a wall: sliding that becomes rolling, and a spheroid that rocks.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "few_bodies.hpp"

namespace {

using namespace tangency::dem;
using tangency::Vec3;
using namespace tangency::testing;
using std::numbers::pi;

constexpr double kGravity = 9.81;

/// One body on the floor z = 0 of a cell that ends there, pressed in by its own weight.
struct OnTheFloor : FewBodies {
  double dt;  ///< a fifth of sqrt(m/K), as the simulator's own

  OnTheFloor(double mass, const ContactLaw& law)
      : FewBodies(law), dt(0.2 * std::sqrt(mass / law.normal_stiffness)) {
    cell = Cell::box(Vec3::Constant(100.0), 3, {false, false, true});
    motion.gravity = {0.0, 0.0, -kGravity};
  }
};

double mass_of(const Vec3& radii) { return 4.0 / 3.0 * pi * radii.prod(); }

/// Mean speed of a sphere of radius 1 that was thrown along the floor at `speed`, from when it
/// rolls on; `depth` is the overlap by its weight.
double speed_in_the_end(double speed, double mu, double depth) {
  const double mass = mass_of(Vec3::Ones()), stiffness = mass * kGravity / depth;
  OnTheFloor sphere(mass, {stiffness, stiffness, mu, 0.0});
  sphere.add({50.0, 50.0, 1.0 - depth}, Eigen::Quaterniond::Identity(), Vec3::Ones(),
             {speed, 0.0, 0.0});
  sphere.update();
  const double until = 2.0 / 7.0 * speed / (mu * kGravity);
  const auto steps = static_cast<int>(2.0 * until / sphere.dt);
  double mean = 0.0;
  for (int k = 0; k < 2 * steps; ++k) {
    sphere.step(sphere.dt);
    if (k >= steps) mean += sphere.particles.velocity[0][0] / steps;
  }
  // It rolls: the velocity at the floor is that of the spring's swing, (2/7) of it the centre's.
  EXPECT_LT(std::abs(sphere.particles.velocity[0][0] - mean),
            2.0 / 7.0 * mu * kGravity * std::sqrt(3.5 * depth / kGravity) * 1.01);
  return mean;
}

// Friction mu m g slows the centre and turns the sphere, I = (2/5) m r^2, until v = w r: v = (5/7)
// v_0, whatever mu. The arm of friction is r less half the overlap: v / v_0 is off by depth
// (10/49), and by a swing of the shear spring that the mean has not averaged out.
TEST(Rolling, EndsAtFiveSeventhsOfTheSpeedOfTheThrow) {
  for (const double mu : {0.1, 0.4}) {
    const double soft = speed_in_the_end(2.0, mu, 4e-5) / 2.0 - 5.0 / 7.0;
    const double stiff = speed_in_the_end(2.0, mu, 1e-5) / 2.0 - 5.0 / 7.0;
    EXPECT_LT(std::abs(soft), 4e-4);
    EXPECT_LT(std::abs(stiff), 1e-4);
  }
}

TEST(Rolling, OfASphereThatRollsIsUniform) {
  const double depth = 1e-5, mass = mass_of(Vec3::Ones()), stiffness = mass * kGravity / depth;
  OnTheFloor sphere(mass, {stiffness, stiffness, 0.5, 0.0});
  sphere.add({20.0, 50.0, 1.0 - depth}, Eigen::Quaterniond::Identity(), Vec3::Ones(),
             {1.0, 0.0, 0.0}, {0.0, 1.0 / (1.0 - 0.5 * depth), 0.0});
  sphere.update();
  for (int k = 0; k < 20000; ++k) sphere.step(sphere.dt);
  EXPECT_NEAR(sphere.particles.position[0][0], 20.0 + 20000 * sphere.dt, 20000 * sphere.dt * 1e-9);
  EXPECT_LT(sphere.work.sliding, 1e-12);
}

/// Mean time of a swing to and fro of an ellipsoid on its flat side, from zero crossings of its
/// axis. Rolls about y.
double rocking_period(const Vec3& radii, double tilt, double depth) {
  const double mass = mass_of(radii), stiffness = mass * kGravity / depth;
  OnTheFloor body(mass, {stiffness, stiffness, 5.0, 0.0});
  // Where it touches and how high the centre is when tilted about y: h^2 = a^2 sin^2 + c^2 cos^2.
  const double height = std::hypot(radii[0] * std::sin(tilt), radii[2] * std::cos(tilt));
  body.add({50.0, 50.0, height - depth}, Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vec3::UnitY())),
           radii);
  body.update();
  std::vector<double> crossings;
  double before = tilt;
  for (int k = 1; crossings.size() < 5; ++k) {
    body.step(body.dt);
    const Eigen::Quaterniond& q = body.particles.orientation[0];
    const double now = 2.0 * std::atan2(q.y(), q.w());
    if ((now > 0.0) != (before > 0.0)) crossings.push_back((k - now / (now - before)) * body.dt);
    before = now;
  }
  return (crossings.back() - crossings.front()) / 2.0;
}

// Rolling without slip on the plane, h the height of the centre and R the radius of curvature at
// the bottom: kinetic energy (I + m h^2) w^2 / 2, potential m g (R - h) angle^2 / 2, since the
// height of the centre over the floor is the support function, h'' + h = R.
//
// For a tilt A that is not small: with e = a^2 / c^2 - 1 the height is c (1 + e A^2 / 2 - (e / 6 +
// e^2 / 8) A^4) and the arm squared is c^2 (1 + (e + e^2) A^2), which slow an oscillator by A^2
// times 3/8 (2/3 + e/2) and 1/4 c^2 (e + e^2) / (I/m + c^2).
TEST(Rocking, HasThePeriodOfAPendulumOfLengthRLessH) {
  for (const Vec3& radii : {Vec3(1.4, 1.0, 0.7), Vec3(1.0, 1.0, 0.6)}) {
    const double h = radii[2], curvature_radius = radii[0] * radii[0] / h;
    const double over_mass = (radii[0] * radii[0] + h * h) / 5.0 + h * h;
    const double theory = 2.0 * pi * std::sqrt(over_mass / (kGravity * (curvature_radius - h)));
    const double tilt = 0.005, e = curvature_radius / h - 1.0;
    const double slower =
        tilt * tilt * (3.0 / 8.0 * (2.0 / 3.0 + e / 2.0) + 0.25 * h * h * (e + e * e) / over_mass);
    const double soft_depth = 4e-4, depth = 1e-4;
    const double soft = rocking_period(radii, tilt, soft_depth) / theory - 1.0;
    const double stiff = rocking_period(radii, tilt, depth) / theory - 1.0;
    // A floor that gives way changes inertia and lever by about depth / h, of either sign.
    EXPECT_LT(std::abs(soft - slower), 2.0 * soft_depth / h);
    EXPECT_LT(std::abs(stiff - slower), 2.0 * depth / h);
    // What is linear in depth leaves the rigid limit; the shear spring, which starts unstressed,
    // swings by depth / h of the tilt and moves a crossing by that over 2 pi of a period.
    EXPECT_LT(std::abs((4.0 * stiff - soft) / 3.0 - slower), soft_depth / (2.0 * pi * h) / 2.0);
  }
}

}  // namespace
