// SPDX-License-Identifier: GPL-3.0-or-later
/// Assemblies of ellipses in the plane.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <tangency/dem/parallel.hpp>
#include <tangency/dem/saved/state_file.hpp>

#include "assembly.hpp"
#include "scenes.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using namespace tangency::testing;

constexpr ContactLaw kFrictionless{100.0, 0.0, 0.0, 0.0};
constexpr ContactLaw kFrictional{100.0, 80.0, 0.3, 0.0};

Cell plane_cell(double x, double y) { return Cell::box({x, y, 1.0}, 2); }

/// `count` ellipses of axes drawn from [0.5, 1] at random places, moving and turning.
Particles plane_crowd(std::size_t count, const Cell& cell, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  Particles particles;
  particles.dimensions = 2;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 centre(cell.edges(0, 0) * uniform(random), cell.edges(1, 1) * uniform(random), 0.0);
    const double a = 0.5 * (1.0 + uniform(random)), b = a * (0.6 + 0.4 * uniform(random));
    particles.add(centre, uniform_rotation(random, 2), {a, b, b}, 1.0, 0);
    particles.velocity.back() = Vec3(uniform(random) - 0.5, uniform(random) - 0.5, 0.0);
    particles.angular_velocity.back() = Vec3(0.0, 0.0, uniform(random) - 0.5);
  }
  return particles;
}

struct Plane {
  Cell cell;
  Particles particles;
  NeighbourList list;
  Contacts contacts;

  Plane(std::size_t count, const Cell& in, std::uint64_t seed)
      : cell(in), particles(plane_crowd(count, in, seed)) {}

  void update(const ContactLaw& law, double dt) {
    if (!list.is_current(particles, cell)) {
      const std::vector<Pair> before = list.pairs();
      list.build(particles, cell, 0.3);
      contacts.carry_over(before, list.pairs());
    }
    contacts.update(particles, cell, list, laws(law), dt);
  }
  void step(const ContactLaw& law, double dt, double damping = 0.0) {
    move(particles, cell, contacts.resultants(), {Rotation::full, Vec3::Zero(), damping}, dt);
    update(law, dt);
  }
};

Vec3 momentum(const Particles& p) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * p.velocity[i];
  return sum;
}

/// About the origin, along z; only of bodies that no image of another touches does it stay.
double angular_momentum(const Particles& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double inertia = 0.25 * p.mass[i] * p.semi_axes[i].head<2>().squaredNorm();
    sum += p.mass[i] * p.position[i].cross(p.velocity[i])[2] + inertia * p.angular_velocity[i][2];
  }
  return sum;
}

TEST(PlaneShape, HasTheWantedAreaAndRatio) {
  const Vec3 axes = Shape{10.0, 1.0 / 0.7, 1.0}.semi_axes(2);
  EXPECT_NEAR(axes[0] * axes[1], 100.0, 1e-13);
  EXPECT_NEAR(axes[1] / axes[0], 0.7, 1e-15);
}

TEST(PlaneParticles, AreDisksOfUnitThickness) {
  const Vec3 axes(2.0, 1.5, 1.5);
  EXPECT_NEAR(volume_of(axes, 2), 3.0 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(principal_inertia(8.0, axes, 2)[2], 8.0 / 4.0 * (4.0 + 2.25), 1e-15);
}

// A cluster that flies apart in a cell so wide that no image is met: its contacts are frictional,
// off-centre and many.
TEST(Plane, ConservesMomentumAndAngularMomentum) {
  Plane plane(60, plane_cell(7.0, 8.0), 3);
  plane.cell = plane_cell(60.0, 60.0);
  plane.update(kFrictional, 0.0);
  const Vec3 linear = momentum(plane.particles);
  const double angular = angular_momentum(plane.particles);
  const double energy = kinetic_energy(plane.particles);
  for (int k = 0; k < 500; ++k) plane.step(kFrictional, 0.005);
  EXPECT_GT(kinetic_energy(plane.particles), 10.0 * energy) << "the contacts did something";
  EXPECT_LT((momentum(plane.particles) - linear).norm(), 1e-12 * 60.0);
  EXPECT_NEAR(angular_momentum(plane.particles), angular, 1e-11 * 60.0);
}

// dem/motion/motion.hpp (5)
TEST(Plane, LeavesNothingOutOfIt) {
  Plane plane(80, plane_cell(9.0, 8.0), 4);
  plane.update(kFrictional, 0.0);
  plane.cell.rate = plane.cell.isotropic(-0.02);
  for (int k = 0; k < 300; ++k) plane.step(kFrictional, 0.01, 1.0);
  const Particles& p = plane.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    ASSERT_EQ(p.position[i][2], 0.0);
    ASSERT_EQ(p.velocity[i][2], 0.0);
    ASSERT_EQ(p.angular_velocity[i].head<2>(), Eigen::Vector2d::Zero());
    ASSERT_EQ(p.orientation[i].x(), 0.0);
    ASSERT_EQ(p.orientation[i].y(), 0.0);
  }
  EXPECT_EQ(plane.cell.edges(2, 2), 1.0);
  EXPECT_LT(plane.cell.edges(0, 0), 9.0);
  const Stress stress = stress_of(plane.contacts, plane.cell);
  EXPECT_EQ(stress.tensor.col(2), Vec3::Zero());
  EXPECT_EQ(stress.mean(), 0.5 * (stress.tensor(0, 0) + stress.tensor(1, 1)));
}

/// Half the width of an ellipse along the direction at `angle`.
double half_width(const Particles& p, std::size_t i, double angle) {
  const double own = 2.0 * std::atan2(p.orientation[i].z(), p.orientation[i].w());
  return std::hypot(p.semi_axes[i][0] * std::cos(angle - own),
                    p.semi_axes[i][1] * std::sin(angle - own));
}

/// The plane gap by looking at 20000 directions: short by less than 1e-6, the distance of the
/// centres over two times the square of half the spacing.
double gap_by_scan(const Particles& p, const Pair& pair, const Vec3& d) {
  double best = -1e300;
  for (int k = 0; k < 20000; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / 20000.0;
    const double value = std::cos(angle) * d[0] + std::sin(angle) * d[1] -
                         half_width(p, static_cast<std::size_t>(pair.a), angle) -
                         half_width(p, static_cast<std::size_t>(pair.b), angle);
    best = std::max(best, value);
  }
  return best;
}

TEST(Plane, ContactsAreThePairsOfImagesWithANegativePlaneGap) {
  Plane plane(40, plane_cell(7.0, 8.0), 5);
  for (Vec3& axes : plane.particles.semi_axes) axes *= 0.8;  // shallow: each has one normal
  plane.update(kFrictionless, 0.0);
  std::size_t seen = 0;
  for (const Pair& pair : meeting_pairs(plane.particles, plane.cell, 1)) {
    if (pair.image[2] != 0) continue;
    const auto& pairs = plane.list.pairs();
    const auto at = std::lower_bound(pairs.begin(), pairs.end(), pair) - pairs.begin();
    ASSERT_EQ(pairs[static_cast<std::size_t>(at)], pair);
    const Contact& contact = plane.contacts.records()[static_cast<std::size_t>(at)];
    const double gap =
        gap_by_scan(plane.particles, pair, branch_vector(pair, plane.particles, plane.cell));
    ASSERT_NEAR(contact.overlap, std::max(0.0, -gap), 1e-6);
    seen += gap < 0.0 ? 1 : 0;
  }
  EXPECT_GT(seen, 25u);
}

// dem/neighbours.hpp (1) (4)
TEST(PlaneNeighbourList, HoldsEveryTouchingPairAndNoImageAlongTheThickness) {
  const Cell cell = plane_cell(5.0, 12.0);
  const Particles particles = plane_crowd(80, cell, 6);
  NeighbourList list;
  list.build(particles, cell, 0.2);
  std::vector<Pair> meeting = meeting_pairs(particles, cell, 2);
  std::erase_if(meeting, [&](const Pair& pair) {
    return pair.image[2] != 0 ||
           gap_by_scan(particles, pair, branch_vector(pair, particles, cell)) > 0.0;
  });
  ASSERT_GT(meeting.size(), 100u);
  EXPECT_TRUE(
      std::includes(list.pairs().begin(), list.pairs().end(), meeting.begin(), meeting.end()));
  for (const Pair& pair : list.pairs()) EXPECT_EQ(pair.image[2], 0);
}

double elastic_energy(const Plane& plane) {
  Plane again = plane;
  again.contacts = Contacts();
  again.list = NeighbourList();
  again.update(kFrictionless, 0.0);
  double energy = 0.0;
  for (const Contact& contact : again.contacts.records())
    energy += 0.5 * kFrictionless.normal_stiffness * contact.overlap * contact.overlap;
  return energy;
}

TEST(PlaneStress, IsTheDerivativeOfTheElasticEnergyByStrain) {
  Plane plane(40, plane_cell(7.0, 8.0), 7);
  for (Vec3& axes : plane.particles.semi_axes) axes *= 0.8;
  plane.update(kFrictionless, 0.0);
  const Stress stress = stress_of(plane.contacts, plane.cell);
  ASSERT_GT(stress.mean(), 0.1);
  for (int axis = 0; axis < 2; ++axis) {
    const double strain = 1e-6;
    const auto energy_at = [&](double e) {
      Plane strained = plane;
      strained.cell.edges(axis, axis) *= 1.0 + e;
      for (Vec3& x : strained.particles.position) x[axis] *= 1.0 + e;
      return elastic_energy(strained);
    };
    const double derivative = (energy_at(strain) - energy_at(-strain)) / (2.0 * strain);
    EXPECT_NEAR(stress.tensor(axis, axis), -derivative / 56.0, 1e-6 * stress.mean());
  }
}

TEST(PlaneStress, HasTheFrictionAngleOfItsTwoPrincipalStresses) {
  Mat3 stress = Mat3::Zero();
  stress.topLeftCorner<2, 2>() << 2.0, 1.0, 1.0, 2.0;
  EXPECT_NEAR(friction_angle_deg(stress, 2), 30.0, 1e-12);
}

const std::vector<Batch> kMixed = {{{1.0, 1.0, 1.0}, 1.0, 150}, {{2.0, 1.5, 1.0}, 3.0, 40}};

void expect_no_overlap(const Particles& particles, const Cell& cell) {
  std::vector<Pair> meeting = meeting_pairs(particles, cell, 1);
  if (cell.dimensions == 2)
    std::erase_if(meeting, [](const Pair& pair) { return pair.image[2] != 0; });
  EXPECT_TRUE(meeting.empty());
}

// dem/samples/sample.hpp (1)
TEST(PlaceAtRandom, LeavesNoTwoBoundingSpheresMeeting) {
  for (const int dimensions : {2, 3}) {
    const double fraction = largest_bounding_fraction(dimensions);
    Cell cell;
    const Particles particles =
        place(kMixed, {{}, 0.0, 8, Arrangement::random, fraction, dimensions}, cell);
    ASSERT_EQ(particles.size(), 190u);
    EXPECT_EQ(std::count(particles.type.begin(), particles.type.end(), 1), 40);
    EXPECT_EQ(particles.dimensions, dimensions);
    expect_no_overlap(particles, cell);
    double filled = 0.0;
    for (const Vec3& axes : particles.semi_axes)
      filled += volume_of(Vec3::Constant(axes.maxCoeff()), dimensions);
    EXPECT_NEAR(filled / cell.volume(), fraction, 1e-12);
  }
}

TEST(PlaceAtRandom, ServesACellHardlyWiderThanAParticle) {
  Cell cell;
  const Vec3 edges(40.0, 2.5, 1.0);
  const Particles particles =
      place({{{1.0, 1.0, 1.0}, 1.0, 10}}, {edges, 0.0, 1, Arrangement::random, 0.1, 2}, cell);
  EXPECT_EQ(Vec3(cell.edges.diagonal()), edges);
  expect_no_overlap(particles, cell);
  EXPECT_THROW(place({{{1.0, 1.0, 1.0}, 1.0, 10}},
                     {Vec3(40.0, 1.9, 1.0), 0.0, 1, Arrangement::random, 0.1, 2}, cell),
               DoesNotFit);
}

// dem/samples/sample.hpp (2)
TEST(PlaceAtRandom, OfOneSeedIsOneSample) {
  Cell cell;
  const auto positions = [&](std::uint64_t seed) {
    return place(kMixed, {{}, 0.0, seed, Arrangement::random, 0.3, 2}, cell).position;
  };
  EXPECT_EQ(positions(3), positions(3));
  EXPECT_NE(positions(3), positions(4));
}

TEST(PlaceOnLattice, OfThePlaneIsSquareAndOverlapsNowhere) {
  Cell cell;
  const Particles particles =
      place_on_lattice(kMixed, {{}, 0.1, 3, Arrangement::lattice, 0.1, 2}, cell);
  EXPECT_EQ(cell.edges(2, 2), 1.0);
  EXPECT_EQ(cell.edges(0, 0), cell.edges(1, 1));
  EXPECT_NEAR(cell.edges(0, 0), 14 * 2.0 * (2.0 * std::sqrt(1.5) + 0.1), 1e-3);
  for (const Vec3& x : particles.position) EXPECT_EQ(x[2], 0.0);
  expect_no_overlap(particles, cell);
}

TEST(PlaneSimulation, HasTheSameStateAtEveryThreadCount) {
  std::string hash[3];
  const std::string text =
      with(with(with(growing_scene(2), "count = 25", "count = 500"),
                "arrangement = \"random\"\nbounding_fraction = 0.450000\n", ""),
           "max_strain_rate = 0.1", "max_strain_rate = 2.0");
  for (const int threads : {1, 2, 3}) {
    set_threads(threads);
    Simulation simulation(parse_scene(text, "scene.toml"));
    while (simulation.observe().contacts < 600) simulation.step();
    simulation.next_stage();
    for (int k = 0; k < 50; ++k) simulation.step();
    hash[threads - 1] = state_hash(simulation.state());
  }
  set_threads(0);
  EXPECT_EQ(hash[0], hash[1]);
  EXPECT_EQ(hash[0], hash[2]);
}

}  // namespace
