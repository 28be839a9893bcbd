// SPDX-License-Identifier: GPL-3.0-or-later
/// A scene in other units of length, mass and time, powers of two of the first ones, runs to the
/// same bits, scaled: nowhere does a number stand for a length, a mass or a time by itself.
#include <gtest/gtest.h>

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

#include <tangency/dem/simulation.hpp>

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;

/// The old unit in the new one. Powers of two, so that products and quotients scale exactly; square
/// roots are only ever taken of even powers of a unit, cube roots of volumes and pure numbers.
struct Units {
  int length, mass, time;  ///< binary exponents

  double scaled(double x, int lengths, int masses, int times) const {
    return std::ldexp(x, lengths * length + masses * mass + times * time);
  }
  double of_length(double x) const { return scaled(x, 1, 0, 0); }
  double of_force(double x) const { return scaled(x, 1, 1, -2); }
  double of_stiffness(double x) const { return scaled(x, 0, 1, -2); }
  double of_stress(double x) const { return scaled(x, -1, 1, -2); }
  double of_energy(double x) const { return scaled(x, 2, 1, -2); }
  double of_rate(double x) const { return scaled(x, 0, 0, -1); }
  Vec3 of_length(const Vec3& v) const { return v * of_length(1.0); }
  Vec3 of_force(const Vec3& v) const { return v * of_force(1.0); }
};

std::string text(double x) {
  std::ostringstream out;
  out << std::setprecision(17) << x;
  const std::string digits = out.str();
  return digits.find_first_not_of("0123456789") == digits.npos ? digits + ".0" : digits;
}

/// Spheroids or spheres on a lattice or at random, pressed together and sheared, with friction.
std::string scene(const Units& u, bool hertz, bool round) {
  const std::string density = text(u.scaled(1000.0, -3, 1, 0));
  const std::string edge = text(u.of_length(90.0));
  const std::string contact =
      hertz ? "law = \"hertz\"\nyoung_modulus = " + text(u.of_stress(1e10)) + "\n"
            : "normal_stiffness = " + text(u.of_stiffness(1.5e10)) +
                  "\nshear_stiffness = " + text(u.of_stiffness(1e10)) + "\n";
  const std::string pressed = "mean_stress = " + text(u.of_stress(5e7)) +
                              "\nmax_strain_rate = " + text(u.of_rate(1.0)) + "\n";
  return "schema = 1\n[cell]\n" +
         (hertz ? "size = [" + edge + ", " + edge + ", " + edge + "]\n" : std::string()) +
         "[particles.a]\ncount = 20\nmean_radius = " + text(u.of_length(10.0)) +
         "\ndensity = " + density + (round ? "" : "\nelongation = 1.3\nflatness = 1.1") +
         "\n[particles.b]\ncount = 12\nmean_radius = " + text(u.of_length(7.3)) +
         "\ndensity = " + density +
         "\n[contact]\nfriction_coefficient = 0.5\ncohesion = " + text(u.of_force(1e5)) + "\n" +
         contact + "[[stage]]\nkind = \"place\"\n" +
         (hertz ? "arrangement = \"random\"\n" : "jitter = 0.1\n") +
         "[[stage]]\nkind = \"compress\"\n" + pressed +
         "[[stage]]\nkind = \"relax\"\nmax_unbalanced_ratio = 0.05\n" + pressed +
         "[[stage]]\nkind = \"shear\"\naxial_strain = 0.1\naxial_strain_rate = " +
         text(u.of_rate(0.3)) + "\nmean_stress = " + text(u.of_stress(5e7)) + "\n";
}

State end_of(const std::string& scene_text) {
  Simulation simulation(parse_scene(scene_text, "scene.toml"));
  while (!simulation.finished()) {
    const StageStatus status = simulation.status();
    if (status == StageStatus::out_of_cycles) {
      ADD_FAILURE() << "stage " << simulation.stage().name << " does not end";
      break;
    }
    if (status == StageStatus::done)
      simulation.next_stage();
    else
      simulation.step();
  }
  return simulation.state();
}

void expect_scaled(const Particles& here, const Particles& there, const Units& u) {
  for (std::size_t i = 0; i < here.size(); ++i) {
    ASSERT_EQ(u.of_length(here.position[i]), there.position[i]) << i;
    ASSERT_EQ(Vec3(here.velocity[i] * u.scaled(1.0, 1, 0, -1)), there.velocity[i]);
    ASSERT_EQ(Vec3(here.angular_velocity[i] * u.of_rate(1.0)), there.angular_velocity[i]);
    ASSERT_EQ(here.orientation[i].coeffs(), there.orientation[i].coeffs());
    ASSERT_EQ(u.of_length(here.semi_axes[i]), there.semi_axes[i]);
    ASSERT_EQ(u.scaled(here.mass[i], 0, 1, 0), there.mass[i]);
  }
}

void expect_scaled(const Contacts& here, const Contacts& there, const Units& u) {
  ASSERT_EQ(here.records().size(), there.records().size());
  for (std::size_t k = 0; k < here.records().size(); ++k) {
    const Contact &a = here.records()[k], &b = there.records()[k];
    ASSERT_EQ(a.normal, b.normal);
    ASSERT_EQ(u.of_length(a.arm), b.arm);
    ASSERT_EQ(u.of_length(a.overlap), b.overlap);
    ASSERT_EQ(u.of_force(a.force), b.force);
    ASSERT_EQ(u.of_force(a.shear.force), b.shear.force);
    ASSERT_EQ(u.of_stiffness(a.shear.stiffness), b.shear.stiffness);
    ASSERT_EQ(u.of_energy(a.shear.energy), b.shear.energy);
    ASSERT_EQ(u.of_energy(a.normal_energy), b.normal_energy);
  }
}

void expect_same_run(bool hertz, bool round) {
  const State here = end_of(scene({0, 0, 0}, hertz, round));
  std::size_t touching = 0, sheared = 0;
  for (const Contact& contact : here.contacts.records()) {
    touching += contact.touches() ? 1u : 0u;
    sheared += contact.shear.force.isZero(0.0) ? 0u : 1u;
  }
  ASSERT_GT(touching, 40u);
  ASSERT_GT(sheared, 40u);
  for (const Units& u : {Units{3, -7, 5}, Units{-17, -41, -9}, Units{1, 0, 0}}) {
    const State there = end_of(scene(u, hertz, round));
    ASSERT_EQ(here.cycle, there.cycle);
    EXPECT_EQ(Mat3(here.cell.edges * u.of_length(1.0)), there.cell.edges);
    EXPECT_EQ(u.scaled(here.time, 0, 0, 1), there.time);
    EXPECT_EQ(u.of_energy(here.energy.boundary), there.energy.boundary);
    EXPECT_EQ(u.of_energy(here.energy.sliding), there.energy.sliding);
    EXPECT_EQ(u.of_energy(here.energy.damping), there.energy.damping);
    expect_scaled(here.particles, there.particles, u);
    expect_scaled(here.contacts, there.contacts, u);
  }
}

TEST(OtherUnits, GiveTheSameBitsOfLinearEllipsoids) { expect_same_run(false, false); }
TEST(OtherUnits, GiveTheSameBitsOfHertzEllipsoids) { expect_same_run(true, false); }
TEST(OtherUnits, GiveTheSameBitsOfLinearSpheres) { expect_same_run(false, true); }
TEST(OtherUnits, GiveTheSameBitsOfHertzSpheres) { expect_same_run(true, true); }

}  // namespace
