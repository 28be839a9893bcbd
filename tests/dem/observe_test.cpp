// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include <tangency/dem/observe.hpp>

#include "assembly.hpp"
#include "assembly_state.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using tangency::testing::crowd;
using tangency::testing::laws_in;

constexpr ContactLaw kFrictionless{100.0, 0.0, 0.0, 0.0};

struct Seen {
  NeighbourList list;
  Contacts contacts;

  Seen(const Particles& particles, const Cell& cell, const ContactLaw& law = kFrictionless,
       double dt = 0.0) {
    list.build(particles, cell, 0.3);
    contacts.carry_over({}, list.pairs());
    contacts.update(particles, cell, list, laws_in(cell, law), dt);
  }
};

Cell cube(double edge) { return Cell::box(Vec3::Constant(edge)); }

/// Three spheres in a row along x, touching 0-1 (overlap 0.5) and 1-2 (overlap 0.25), and one
/// apart.
Particles row_of_spheres() {
  Particles particles;
  for (const double x : {1.0, 2.5, 4.25})
    particles.add({x, 5.0, 5.0}, Eigen::Quaterniond::Identity(), Vec3::Ones(), 1.0, 0);
  particles.add({7.5, 1.0, 1.0}, Eigen::Quaterniond::Identity(), Vec3::Ones(), 1.0, 0);
  return particles;
}

TEST(Observe, StressOfARowOfSpheresIsForceTimesBranchOverVolume) {
  const Stress stress = stress_of(Seen(row_of_spheres(), cube(10.0)).contacts, cube(10.0));
  Mat3 expected = Mat3::Zero();
  expected(0, 0) = (50.0 * 1.5 + 25.0 * 1.75) / 1000.0;
  EXPECT_LT((stress.tensor - expected).norm(), 1e-13);
  EXPECT_NEAR(stress.affine_stiffness, 100.0 * (1.5 * 1.5 + 1.75 * 1.75) / 3000.0, 1e-13);
}

double elastic_energy(const Particles& particles, const Cell& cell) {
  double energy = 0.0;
  const Seen seen(particles, cell);
  for (const Contact& contact : seen.contacts.records())
    energy += 0.5 * kFrictionless.normal_stiffness * contact.overlap * contact.overlap;
  return energy;
}

// Without friction forces derive from an energy, so that stress is minus its derivative by strain.
TEST(Observe, StressIsTheDerivativeOfTheElasticEnergyByStrain) {
  const Cell cell = cube(6.0);
  // Shallow contacts, so that each has one normal: crowds of deep ones jump between local answers.
  Particles particles = crowd(40, cell, 21);
  for (Vec3& axes : particles.semi_axes) axes = 0.8 * axes + Vec3::Constant(0.2);
  const Stress stress = stress_of(Seen(particles, cell).contacts, cell);
  ASSERT_GT(stress.mean(), 0.1);
  for (int axis = 0; axis < 3; ++axis) {
    const double strain = 1e-6;
    const auto energy_at = [&](double e) {
      Cell strained = cell;
      Particles moved = particles;
      strained.edges(axis, axis) *= 1.0 + e;
      for (Vec3& x : moved.position) x[axis] *= 1.0 + e;
      return elastic_energy(moved, strained);
    };
    const double derivative = (energy_at(strain) - energy_at(-strain)) / (2.0 * strain);
    EXPECT_NEAR(stress.tensor(axis, axis), -derivative / cell.volume(), 1e-6 * stress.mean());
  }
}

TEST(Observe, FrictionAngleComesFromThePrincipalStresses) {
  const Eigen::Quaterniond turn(0.3, 0.5, -0.1, 0.8);
  const Mat3 rotation = turn.normalized().toRotationMatrix();
  const Mat3 stress = rotation * Vec3(3.0, 1.0, 2.0).asDiagonal() * rotation.transpose();
  EXPECT_NEAR(friction_angle_deg(stress), 30.0, 1e-12);
  EXPECT_NEAR(friction_angle_deg(Mat3::Identity()), 0.0, 1e-6);
  EXPECT_EQ(deviator_of(Mat3::Identity()), 0.0);
  EXPECT_NEAR(deviator_of(Vec3(2.0, 2.0, 7.0).asDiagonal()), 5.0, 1e-14) << "triaxial: s1 - s3";
  EXPECT_NEAR(deviator_of(Vec3(2.0, 7.0, 0.0).asDiagonal(), 2), 2.5, 1e-14);
  EXPECT_EQ(friction_angle_deg(Mat3::Zero()), 0.0);
}

TEST(Observe, BalanceCountsRattlersApartAndTakesTheWorstOfAllWithContacts) {
  const Particles particles = row_of_spheres();
  const Seen seen(particles, cube(10.0));
  const Balance balance = balance_of(particles, seen.contacts);
  EXPECT_EQ(balance.rattlers, 3);  // the ends of the row, and the sphere apart
  EXPECT_NEAR(balance.mean_contact_force, 37.5, 1e-12);
  EXPECT_NEAR(balance.largest_unbalanced_ratio, 50.0 / 37.5, 1e-13);
  EXPECT_NEAR(balance.inertial_fraction, (50.0 + 25.0 + 25.0) / 3.0 / 37.5, 1e-13);
  EXPECT_NEAR(balance.largest_unbalanced_moment_ratio, 0.0, 1e-13);
}

TEST(Observe, RatiosAreZeroWhereNoContactBearsAForce) {
  const Particles particles = row_of_spheres();
  const Seen seen(particles, cube(10.0), {0.0, 0.0, 0.0, 0.0});
  ASSERT_GT(seen.contacts.totals().contacts, 0);
  for (const bool pulled : {false, true}) {
    const Balance balance =
        balance_of(particles, seen.contacts, pulled ? Vec3(1.0, 0.0, 0.0) : Vec3::Zero());
    EXPECT_EQ(balance.mean_contact_force, 0.0);
    EXPECT_EQ(balance.inertial_fraction, 0.0);
    EXPECT_EQ(balance.largest_unbalanced_ratio, 0.0);
    EXPECT_EQ(balance.largest_unbalanced_moment_ratio, 0.0);
  }
}

// Along x the contacts push the first sphere by -50, the second by 25 and the third by 25.
TEST(Observe, BalanceCountsTheWeightOfEachParticle) {
  Particles particles = row_of_spheres();
  particles.mass = {2.0, 1.0, 0.5, 9.0};
  const Seen seen(particles, cube(10.0));
  const Vec3 gravity(25.0, 0.0, 0.0);
  const Balance balance = balance_of(particles, seen.contacts, gravity);
  EXPECT_NEAR(balance.largest_unbalanced_ratio, 50.0 / 37.5, 1e-13);
  EXPECT_NEAR(balance.inertial_fraction, (0.0 + 50.0 + 37.5) / 3.0 / 37.5, 1e-13);
  EXPECT_EQ(balance.rattlers, 1) << "one contact can bear a weight";
  EXPECT_EQ(observe(particles, cube(10.0), seen.contacts, gravity).balance.inertial_fraction,
            balance.inertial_fraction);
}

TEST(Observe, RowHasTheAssemblysNumbers) {
  Particles particles = row_of_spheres();
  particles.velocity[0] = {3.0, 0.0, 4.0};
  Cell cell = cube(10.0);
  cell.reference_edges = Vec3(10.0, 12.0, 20.0).asDiagonal();
  const Seen seen(particles, cell);
  const Observation row = observe(particles, cell, seen.contacts);
  EXPECT_NEAR(row.axial_strain, std::log(2.0), 1e-15);
  EXPECT_NEAR(row.volumetric_strain, -std::log(2.4), 1e-15);
  EXPECT_EQ(row.contacts, 2);
  EXPECT_EQ(row.coordination_number, 1.0);
  EXPECT_EQ(row.balance.mechanical_coordination, 2.0) << "of the sphere between two";
  EXPECT_NEAR(row.coordination_std, std::sqrt(0.5), 1e-15);
  const double sphere = 4.0 / 3.0 * std::numbers::pi;
  EXPECT_NEAR(row.porosity, 1.0 - 4.0 * sphere / 1000.0, 1e-15);
  EXPECT_NEAR(row.mean_normal_force, 37.5, 1e-12);
  EXPECT_NEAR(row.mean_overlap, 0.375, 1e-14);
  EXPECT_NEAR(row.kinetic_energy, 0.5 * sphere * 25.0, 1e-12);
}

TEST(Observe, GrowthIsSeenByTheFirstTypeAndByWhatFillsTheCell) {
  Particles particles = row_of_spheres();
  // The first type need not stand first.
  particles.add({1.0, 8.0, 8.0}, Eigen::Quaterniond::Identity(), {1.5, 1.0, 1.0}, 1.0, 0);
  for (std::size_t i = 0; i < 4; ++i) particles.type[i] = 1;
  const Seen seen(particles, cube(10.0));
  const Observation row = observe(particles, cube(10.0), seen.contacts);
  EXPECT_EQ(row.elongation, 1.5);
  EXPECT_EQ(row.eccentricity, 0.2);
  const double solid = 4.0 / 3.0 * std::numbers::pi * 5.5;
  EXPECT_NEAR(row.packing_density, solid / 1000.0, 1e-15);
  EXPECT_NEAR(row.packing_density, 1.0 - row.porosity, 1e-15);
  EXPECT_NEAR(row.void_ratio, (1000.0 - solid) / solid, 1e-12);
  EXPECT_EQ(row.contact_density, 2.0 * 2.0 / 1000.0);
  const double mean_radius = (4.0 + std::cbrt(1.5)) / 5.0;
  EXPECT_NEAR(row.overlap_fraction, 0.375 / (2.0 * mean_radius), 1e-15);
}

/// The stress before it is made symmetric, and (1/V) sum of resultant (x) place in the cell: by the
/// contacts' records alone.
struct BySums {
  Mat3 stress = Mat3::Zero(), unbalanced = Mat3::Zero();

  BySums(const Particles& particles, const Cell& cell, const Seen& seen) {
    std::vector<Vec3> resultant(particles.size(), Vec3::Zero());
    for (std::size_t k = 0; k < seen.list.pairs().size(); ++k) {
      const Contact contact = seen.contacts.records()[k];
      if (!contact.touches()) continue;
      stress += contact.force * contact.branch.transpose() / cell.volume();
      const auto a = static_cast<std::size_t>(seen.list.pairs()[k].a);
      const auto b = static_cast<std::size_t>(seen.list.pairs()[k].b);
      resultant[a] -= contact.force;
      if (b < particles.size()) resultant[b] += contact.force;
    }
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Image image = cell.image_of(particles.position[i]);
      const Vec3 there = particles.position[i] - cell.translation(image);
      unbalanced += resultant[i] * there.transpose() / cell.volume();
    }
  }
};

/// A crowd far from balance, in a skewed cell or between walls.
struct Unbalanced {
  Cell cell;
  Particles particles;
  Seen seen;

  Unbalanced(const Cell& in, std::uint64_t seed)
      : cell(in), particles(crowd_in(in, seed)), seen(particles, cell, {100.0, 80.0, 0.5, 0.0}) {
    // A second step, so that contacts have shear forces.
    seen.contacts.update(particles, cell, seen.list, laws_in(cell, {100.0, 80.0, 0.5, 0.0}), 0.01);
  }
  static Particles crowd_in(const Cell& cell, std::uint64_t seed) {
    Particles particles = crowd(60, cell, seed);
    for (Vec3& x : particles.position)  // inside along walled axes, with some behind the walls
      for (int k = 0; k < 3; ++k)
        if (cell.walled[static_cast<std::size_t>(k)]) x[k] = (x[k] + cell.edges(k, k)) / 3.0;
    return particles;
  }
};

// dem/observe.hpp (1)
TEST(Observe, BoundaryStressIsThatOfTheContactsLessTheMomentsOfTheResultants) {
  Cell skewed = cube(5.0);
  skewed.edges.col(1) += Vec3(1.0, 0.0, 0.0);
  skewed.edges.col(2) += Vec3(-0.5, 1.5, 0.0);
  for (const Cell& cell : {cube(5.0), skewed, Cell::box({5.0, 4.5, 6.0}, 3, {false, false, true}),
                           Cell::box({5.0, 5.5, 5.0}, 3, {true, true, true})})
    for (const std::uint64_t seed : {71u, 72u, 73u}) {
      const Unbalanced one(cell, seed);
      const BySums sums(one.particles, cell, one.seen);
      const Mat3 boundary =
          boundary_stress_of(one.particles, cell, one.seen.contacts, one.seen.list);
      const double scale = sums.stress.norm();
      ASSERT_GT(sums.unbalanced.norm(), 0.01 * scale);
      ASSERT_GT((sums.stress - sums.stress.transpose()).norm(), 1e-3 * scale);
      EXPECT_LT((boundary - sums.stress + sums.unbalanced).norm(), 1e-12 * scale) << seed;
      EXPECT_NEAR(asymmetry_of(one.seen.contacts, cell),
                  (sums.stress - sums.stress.transpose()).norm() / (sums.stress.trace() / 3.0),
                  1e-12);
    }
}

// A particle that went round through the periodic faces is where it was.
TEST(Observe, BoundaryStressDoesNotDependOnWhichImageAParticleIsKeptAs) {
  const Cell cell = cube(5.0);
  const Unbalanced one(cell, 74);
  Particles moved = one.particles;
  for (std::size_t i = 0; i < moved.size(); i += 3)
    moved.position[i] += cell.translation({1, -2, static_cast<std::int32_t>(i % 2)});
  const Seen here(one.particles, cell), there(moved, cell);
  const Mat3 expected = boundary_stress_of(one.particles, cell, here.contacts, here.list);
  EXPECT_LT((boundary_stress_of(moved, cell, there.contacts, there.list) - expected).norm(),
            1e-11 * expected.norm());
}

TEST(Observe, AnEmptyAssemblyHasNoNanInItsRow) {
  Particles particles;
  particles.add(Vec3::Ones(), Eigen::Quaterniond::Identity(), Vec3::Ones(), 1.0, 0);
  const Seen seen(particles, cube(10.0));
  const Observation row = observe(particles, cube(10.0), seen.contacts);
  for (const Field& field : history_fields(0, 0.0, "place", 0, row))
    if (const double* value = std::get_if<double>(&field.value)) {
      EXPECT_TRUE(std::isfinite(*value)) << field.name;
    }
}

TEST(Observe, HistoryHasItsColumnsInOrder) {
  std::string names;
  for (const Field& field : history_fields(0, 0.0, "place", 0, Observation{}))
    names += field.name + ",";
  EXPECT_EQ(
      names,
      "cycle,time,stage,axial_strain,volumetric_strain,mean_stress,s_xx,s_yy,s_zz,s_xy,s_yz,"
      "s_zx,friction_angle_deg,coordination_number,coordination_std,porosity,contacts,"
      "mean_normal_force,mean_overlap,inertial_fraction,kinetic_energy,elastic_energy,"
      "boundary_work,gravity_work,growth_work,branch_work,sliding_loss,damping_loss,energy_error,"
      "stage_cycle,elongation,eccentricity,packing_density,void_ratio,contact_density,"
      "overlap_fraction,asymmetry,boundary_s_xx,boundary_s_yy,boundary_s_zz,boundary_s_xy,"
      "boundary_s_yz,boundary_s_zx,viscous_loss,p,q,mechanical_coordination,"
      "shear_strain_xy,shear_strain_yz,shear_strain_zx,");
}

}  // namespace
