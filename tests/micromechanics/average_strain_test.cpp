// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include <tangency/dem/micromechanics/average_strain.hpp>

#include "nets.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using tangency::Mat3;
using tangency::Vec3;

constexpr double kExact = 1e-12;

struct Net {
  Centres centres;
  Links contacts;  ///< some of the edges, or all
  StrainMesh mesh;
};

/// Triangles or tetrahedra, some of whose edges are contacts.
Net net_of_simplices(Random& random, int dimensions, std::size_t count) {
  Net net{random_centres(random, count, random_cell(random, dimensions), dimensions), {}, {}};
  net.mesh = simplex_mesh(net.centres.view(), delaunay_simplices(net.centres.view()));
  net.contacts = some_edges(random, net.mesh, 0.5);
  return net;
}

/// Polygons, all of whose edges are contacts, and contacts that are no edge.
Net net_of_polygons(Random& random, std::size_t count) {
  Net net = net_of_simplices(random, 2, count);
  net.contacts = some_edges(random, net.mesh, 0.7);
  net.mesh = polygon_mesh(net.centres.view(), net.contacts.view());
  return net;
}

std::vector<Net> nets(Random& random) {
  return {net_of_simplices(random, 2, 60), net_of_simplices(random, 3, 60),
          net_of_simplices(random, 3, 2), net_of_polygons(random, 200)};
}

/// Later centres of any displacements, in a cell strained by `gradient`.
Centres displaced(Random& random, const Centres& centres, const Mat3& gradient) {
  Centres later = centres;
  later.edges = (Mat3::Identity() + gradient) * centres.edges;
  for (Vec3& x : later.position) x += random_vector(random, centres.dimensions);
  return later;
}

// dem/micromechanics/average_strain.hpp (1)
TEST(AverageStrain, IsTheGradientOfTheCellWhateverTheCentresDo) {
  Random random(41);
  for (int repeat = 0; repeat < 3; ++repeat)
    for (const Net& net : nets(random)) {
      const int dimensions = net.centres.dimensions;
      const Mat3 gradient = random_matrix(random, dimensions);
      const Centres later = displaced(random, net.centres, gradient);
      EXPECT_LT((gradient_of(net.mesh, displacement_differences(net.mesh, later.view())) - gradient)
                    .norm(),
                kExact);
      std::vector<Vec3> velocity;
      for (std::size_t i = 0; i < net.centres.position.size(); ++i)
        velocity.push_back(random_vector(random, dimensions));
      EXPECT_LT(
          (gradient_of(net.mesh, velocity_differences(net.mesh, velocity, gradient)) - gradient)
              .norm(),
          kExact);
    }
}

TEST(AverageStrain, DoesNotHangOnTheImagesThatCentresAreGivenAs) {
  Random random(42);
  const Net net = net_of_simplices(random, 3, 30);
  const Mat3 gradient = random_matrix(random, 3);
  Centres later = displaced(random, net.centres, gradient), moved = net.centres;
  for (std::size_t i = 0; i < moved.position.size(); ++i) {
    const Vec3 by(static_cast<double>(i % 3), -static_cast<double>(i % 2), 1.0);
    moved.position[i] += moved.edges * by;
    later.position[i] += later.edges * by;
  }
  const StrainMesh mesh = simplex_mesh(moved.view(), delaunay_simplices(moved.view()));
  EXPECT_EQ(mesh.edges.size(), net.mesh.edges.size());
  EXPECT_LT((gradient_of(mesh, displacement_differences(mesh, later.view())) - gradient).norm(),
            1e-11);
}

// dem/micromechanics/average_strain.hpp (2)
TEST(AverageStrain, AMotionOfOneCentreAddsNothing) {
  Random random(43);
  for (const Net& net : nets(random)) {
    std::vector<Vec3> velocity(net.centres.position.size(), Vec3::Zero());
    velocity[1] = 1e3 * random_vector(random, net.centres.dimensions);
    EXPECT_LT(gradient_of(net.mesh, velocity_differences(net.mesh, velocity, Mat3::Zero())).norm(),
              1e3 * kExact);
  }
}

// dem/micromechanics/average_strain.hpp (3)
TEST(StrainParts, AddUpToTheGradientOfTheCell) {
  Random random(44);
  for (const Net& net : nets(random)) {
    const Motions motions = random_motions(random, net.centres, net.contacts);
    const StrainParts parts = strain_parts(net.mesh, net.centres.view(), motions.of(net.contacts));
    EXPECT_LT((parts.sum() - motions.rate).norm(), 10 * kExact);
    for (const Mat3& part : {parts.normal, parts.elastic, parts.sliding, parts.rotation})
      EXPECT_GT(part.norm(), 1e-3);
    EXPECT_EQ(parts.edges_in_contact + parts.contacts_left_out, net.contacts.bodies.size());
    if (net.mesh.edges.size() == parts.edges_in_contact) {
      EXPECT_EQ(parts.apart.norm(), 0.0);
    } else {
      EXPECT_GT(parts.apart.norm(), 1e-3);
    }
  }
}

/// The one part that is not 0 and what it is, of a square lattice whose contacts move in one way.
struct OnePart {
  const char* of;
  Mat3 rate = Mat3::Zero();
  double spin = 0.0;
  bool slides = false;
  Mat3 StrainParts::*part = nullptr;
  Mat3 value = Mat3::Zero();
};

TEST(StrainParts, OfASquareLatticeAreKnown) {
  const Centres centres = lattice(3, 2);
  const Links links = pairs_at(centres, 1.0);
  const StrainMesh mesh = polygon_mesh(centres.view(), links.view());
  Mat3 opening = Mat3::Zero(), shear = Mat3::Zero(), turn = Mat3::Zero();
  opening(0, 0) = 0.3;
  opening(1, 1) = -0.2;
  shear(0, 1) = 0.4;
  turn(0, 1) = -0.5;
  turn(1, 0) = 0.5;
  const std::vector<OnePart> cases{{"opening", opening, 0.0, false, &StrainParts::normal, opening},
                                   {"shear", shear, 0.0, false, &StrainParts::elastic, shear},
                                   {"sliding", shear, 0.0, true, &StrainParts::sliding, shear},
                                   {"turning", turn, 0.5, false, &StrainParts::rotation, turn}};
  for (const OnePart& each : cases) {
    Motions motions;
    motions.rate = each.rate;
    motions.velocity.assign(centres.position.size(), Vec3::Zero());
    motions.spin.assign(centres.position.size(), Vec3(0.0, 0.0, each.spin));
    for (std::size_t c = 0; c < links.bodies.size(); ++c) {
      const Vec3 branch = centres.view().branch(links.bodies[c], links.image[c]);
      motions.normal.push_back(branch);  // of length 1
      motions.arm.push_back(0.5 * branch);
      // All that moves slides: across the contact alone.
      motions.sliding.push_back(each.slides ? Vec3(each.rate * branch) : Vec3(Vec3::Zero()));
    }
    const StrainParts parts = strain_parts(mesh, centres.view(), motions.of(links));
    for (Mat3 StrainParts::*part :
         {&StrainParts::normal, &StrainParts::elastic, &StrainParts::sliding,
          &StrainParts::rotation, &StrainParts::apart}) {
      const Mat3 wanted = part == each.part ? each.value : Mat3(Mat3::Zero());
      EXPECT_LT((parts.*part - wanted).norm(), kExact) << each.of;
    }
    EXPECT_EQ(parts.edges_in_contact, links.bodies.size());
  }
}

TEST(StrainParts, AreTheSameWithBodiesExchanged) {
  Random random(45);
  const Net net = net_of_simplices(random, 3, 40);
  const Motions motions = random_motions(random, net.centres, net.contacts);
  Links links = net.contacts;
  Motions other = motions;
  for (std::size_t c = 0; c < links.bodies.size(); c += 2) {
    other.arm[c] -= net.centres.view().branch(links.bodies[c], links.image[c]);
    std::swap(links.bodies[c][0], links.bodies[c][1]);
    for (std::int32_t& k : links.image[c]) k = -k;
    other.normal[c] *= -1.0;
    other.sliding[c] *= -1.0;
  }
  const StrainParts a = strain_parts(net.mesh, net.centres.view(), motions.of(net.contacts));
  const StrainParts b = strain_parts(net.mesh, net.centres.view(), other.of(links));
  EXPECT_LT((a.normal - b.normal).norm(), kExact);
  EXPECT_LT((a.elastic - b.elastic).norm(), kExact);
  EXPECT_LT((a.sliding - b.sliding).norm(), kExact);
  EXPECT_LT((a.rotation - b.rotation).norm(), kExact);
  EXPECT_LT((a.apart - b.apart).norm(), kExact);
}

// dem/micromechanics/average_strain.hpp (4)
TEST(StrainParts, OfAPackingThatTurnsAsOneBodyAreRotationAlone) {
  Random random(46);
  for (const Net& net : {net_of_simplices(random, 3, 40), net_of_polygons(random, 100)}) {
    Motions motions = random_motions(random, net.centres, net.contacts);
    const Vec3 spin = net.centres.dimensions == 3 ? Vec3(0.3, -0.5, 0.7) : Vec3(0.0, 0.0, 0.7);
    motions.sliding.clear();
    motions.rate << 0.0, -spin[2], spin[1], spin[2], 0.0, -spin[0], -spin[1], spin[0], 0.0;
    for (Vec3& v : motions.velocity) v.setZero();
    for (Vec3& w : motions.spin) w = spin;
    const StrainParts parts = strain_parts(net.mesh, net.centres.view(), motions.of(net.contacts));
    EXPECT_LT(parts.published().norm(), kExact);
    EXPECT_LT((parts.rotation + parts.apart - motions.rate).norm(), kExact);
    if (net.centres.dimensions == 2) {
      EXPECT_EQ(parts.apart.norm(), 0.0);
    }
  }
}

// dem/micromechanics/average_strain.hpp (5)
TEST(StrainOfEdges, AddUpToTheGradientOfTheCell) {
  Random random(47);
  for (const Net& net : nets(random)) {
    const Links later_contacts = some_edges(random, net.mesh, 0.6);
    const Mat3 gradient = random_matrix(random, net.centres.dimensions);
    const Centres later = displaced(random, net.centres, gradient);
    const StrainOfEdges parts =
        strain_of_edges(net.mesh, displacement_differences(net.mesh, later.view()),
                        net.contacts.view(), later_contacts.view());
    EXPECT_LT((parts.sum() - gradient).norm(), kExact);
    EXPECT_EQ(parts.kept.edges + parts.gained.edges, later_contacts.bodies.size());
    // Each edge is looked for among the contacts, which were taken from edges as they are.
    const auto is_in = [](const Links& links, const MeshEdge& edge) {
      for (std::size_t c = 0; c < links.bodies.size(); ++c)
        if (links.bodies[c] == edge.bodies && links.image[c] == edge.image) return true;
      return false;
    };
    const auto difference = displacement_differences(net.mesh, later.view());
    const auto expect_part = [&](const StrainOfEdges::Part& part, bool before, bool after) {
      Mat3 sum = Mat3::Zero();
      std::size_t edges = 0;
      for (std::size_t i = 0; i < net.mesh.edges.size(); ++i) {
        const MeshEdge& edge = net.mesh.edges[i];
        if (is_in(net.contacts, edge) != before || is_in(later_contacts, edge) != after) continue;
        sum += difference[i] * edge.area.transpose() / net.mesh.volume;
        ++edges;
      }
      EXPECT_EQ(part.edges, edges);
      EXPECT_LT((part.gradient - sum).norm(), kExact);
    };
    expect_part(parts.kept, true, true);
    expect_part(parts.lost, true, false);
    expect_part(parts.gained, false, true);
    expect_part(parts.apart, false, false);
    EXPECT_EQ(parts.kept.edges + parts.gained.edges + parts.lost.edges + parts.apart.edges,
              net.mesh.edges.size());
    EXPECT_GT(parts.kept.edges, 0u);
    EXPECT_GT(parts.lost.edges, 0u);
    EXPECT_GT(parts.lost.gradient.norm(), 0.0);
  }
}

TEST(SlidingVelocity, IsThatOfASpringCutBackToItsLimit) {
  Random random(48);
  const double dt = 1e-7, stiffness = 3.0, limit = 0.8;
  int sliding = 0;
  for (int repeat = 0; repeat < 200; ++repeat) {
    Vec3 force = random_vector(random, 2), velocity = random_vector(random, 2);
    force *= limit / force.norm();
    const double rate = uniform(random, -2.0, 2.0);
    const Vec3 trial = force - stiffness * dt * velocity;
    const double now = limit + rate * dt;
    const Vec3 cut = trial.norm() > now ? Vec3(trial * (now / trial.norm())) : trial;
    const Vec3 slid = (cut - trial) / (stiffness * dt);
    EXPECT_LT((sliding_velocity(velocity, force, stiffness, rate) - slid).norm(), 1e-5);
    sliding += slid.norm() > 0.0 ? 1 : 0;
  }
  EXPECT_GT(sliding, 50);
  EXPECT_LT(sliding, 150);
  EXPECT_EQ(sliding_velocity({1, 2, 0}, Vec3::Zero(), 0.0, 0.0), Vec3(1, 2, 0));
  EXPECT_EQ(sliding_velocity({1, 2, 0}, Vec3::Zero(), 1.0, 0.0), Vec3(0, 0, 0));
}

/// Sum of relative velocities at the contacts around the square 0, 3, 4, 1 of a square lattice.
Vec3 around_a_square(const Centres& centres, const Links& links, const ContactMotion& motion) {
  const std::vector<Vec3> velocity = contact_velocities(motion, centres.view());
  Vec3 sum = Vec3::Zero();
  const std::int64_t walk[] = {0, 3, 4, 1, 0};
  for (int k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < links.bodies.size(); ++c) {
      if (links.image[c] != PeriodicImage{}) continue;
      if (links.bodies[c][0] == walk[k] && links.bodies[c][1] == walk[k + 1]) sum += velocity[c];
      if (links.bodies[c][1] == walk[k] && links.bodies[c][0] == walk[k + 1]) sum -= velocity[c];
    }
  return sum;
}

TEST(AverageStrainErrata, VelocitiesAtContactsAreTheStrainOnlyWhereNothingSpins) {
  Random random(49);
  const Centres centres = lattice(3, 2);
  const Links links = pairs_at(centres, 1.0);
  const StrainMesh mesh = polygon_mesh(centres.view(), links.view());
  Motions motions = random_motions(random, centres, links);
  for (std::size_t c = 0; c < links.bodies.size(); ++c) {
    motions.arm[c] = 0.5 * centres.view().branch(links.bodies[c], links.image[c]);
    motions.normal[c] = 2.0 * motions.arm[c];
  }
  for (Vec3& w : motions.spin) w.setZero();
  EXPECT_LT(around_a_square(centres, links, motions.of(links)).norm(), kExact);
  EXPECT_LT(
      (strain_parts(mesh, centres.view(), motions.of(links)).published() - motions.rate).norm(),
      kExact);

  // Spins alike, like those of gears that do not mesh: a rotation of -1 of a cell at rest.
  motions.rate.setZero();
  for (Vec3& w : motions.spin) w = Vec3::UnitZ();
  const StrainParts alike = strain_parts(mesh, centres.view(), motions.of(links));
  EXPECT_LT(alike.sum().norm(), kExact);
  EXPECT_NEAR(alike.published()(0, 1), 1.0, kExact);
  EXPECT_NEAR(alike.published()(1, 0), -1.0, kExact);

  // Of one particle alone: velocities do not add up to 0 around the square.
  for (Vec3& w : motions.spin) w.setZero();
  motions.spin[4] = Vec3::UnitZ();
  const Vec3 left = around_a_square(centres, links, motions.of(links));
  EXPECT_NEAR(left.norm(), std::sqrt(0.5), kExact);
}

TEST(AverageStrain, ArraysOfWrongLengthsAreRefused) {
  Random random(50);
  const Net net = net_of_simplices(random, 3, 10);
  Motions motions = random_motions(random, net.centres, net.contacts);
  EXPECT_THROW(gradient_of(net.mesh, {}), std::invalid_argument);
  EXPECT_THROW(velocity_differences(net.mesh, {}, Mat3::Zero()), std::invalid_argument);
  Centres fewer = net.centres;
  fewer.position.clear();
  EXPECT_THROW(displacement_differences(net.mesh, fewer.view()), std::invalid_argument);
  const auto refused = [&](const Motions& wrong) {
    try {
      strain_parts(net.mesh, net.centres.view(), wrong.of(net.contacts));
    } catch (const std::invalid_argument&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused(motions));
  for (auto list :
       {&Motions::normal, &Motions::arm, &Motions::sliding, &Motions::velocity, &Motions::spin}) {
    Motions wrong = motions;
    (wrong.*list).pop_back();
    EXPECT_TRUE(refused(wrong));
  }
}

}  // namespace
