// SPDX-License-Identifier: GPL-3.0-or-later
/// What cannot matter to an assembly does not: where the origin lies, which image stands for a
/// particle, in which order they are counted, how the axes are turned.
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <tangency/dem/observe.hpp>

#include "assembly.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using namespace tangency::testing;

const ContactLaw kLinear{100.0, 80.0, 0.3, 0.0};
const ContactLaw kHertz{600.0, 500.0, 0.3, 0.0, Material{1000.0, 0.25}};

/// Sites of a simple cubic lattice of spacing 2 in a cube of 3 of them, or a body-centred one.
Moving lattice(const Vec3& semi_axes, bool body_centred) {
  Moving made{Cell::box(Vec3::Constant(6.0)), {}};
  for (int k = 0; k < 27; ++k) {
    const Vec3 site(2.0 * (k % 3), 2.0 * (k / 3 % 3), 2.0 * (k / 9));
    made.particles.add(site, Eigen::Quaterniond::Identity(), semi_axes, 1.0, 0);
    if (body_centred)
      made.particles.add(site + Vec3::Ones(), Eigen::Quaterniond::Identity(), semi_axes, 1.0, 0);
  }
  return made;
}

// Neighbours 2 apart along the axes, in the body-centred one also sqrt(3) along the diagonals.
TEST(SymmetricLattice, HasNoNetForceOrTorque) {
  for (const ContactLaw& law : {kLinear, kHertz})
    for (const bool body_centred : {false, true})
      for (const Vec3& axes : {Vec3(1.05, 1.05, 1.05), Vec3(1.1, 1.05, 1.02)}) {
        Moving made = lattice(axes, body_centred);
        made.update(law, 0.0);
        EXPECT_EQ(made.touching(), body_centred ? 54u * 14u / 2u : 27u * 6u / 2u);
        const double largest = made.largest_contact_force();
        ASSERT_GT(largest, 1.0);
        for (std::size_t i = 0; i < made.particles.size(); ++i) {
          EXPECT_LT(made.contacts.resultants().force[i].norm(), 1e-13 * largest);
          EXPECT_LT(made.contacts.resultants().moment[i].norm(), 1e-13 * largest);
        }
      }
}

class Seen : public testing::TestWithParam<ContactLaw> {
 protected:
  static constexpr int kSteps = 30;
  static constexpr double kTimeStep = 0.002;
  /// Normals' errors of up to 1e-8, which gaps feel in second order alone, and rounding, grown by
  /// 30 steps of a crowd that flies apart: seen up to 5e-9.
  static constexpr double kTolerance = 2e-8;

  Moving crowd_in_a_cell() const {
    const Cell cell = Cell::box({4.5, 5.0, 5.5});
    Moving made{cell, crowd(50, cell, 31)};
    for (Vec3& axes : made.particles.semi_axes) axes = 0.85 * axes;
    made.cell.rate << -0.2, 0.1, 0.05, 0.1, 0.15, -0.1, 0.05, -0.1, -0.3;
    return made;
  }
  Moving after(Moving from) const {
    from.run(GetParam(), kSteps, kTimeStep);
    return from;
  }
  /// Compares forces, moments and velocities, those of `here` turned.
  static void expect_same(const Moving& here, const Moving& there, const Mat3& turn,
                          const std::vector<std::size_t>& where) {
    ASSERT_EQ(here.touching(), there.touching());
    ASSERT_GT(here.touching(), 30u);
    double shear = 0.0;
    for (const Contact& contact : here.contacts.records())
      shear = std::max(shear, contact.shear.force.norm());
    const double largest = here.largest_force();
    ASSERT_GT(shear, 0.003 * largest) << "friction is part of what is compared";
    const double allowed = kTolerance * largest;
    for (std::size_t i = 0; i < where.size(); ++i) {
      const std::size_t k = where[i];
      const Resultants &a = here.contacts.resultants(), &b = there.contacts.resultants();
      ASSERT_LT((turn * a.force[i] - b.force[k]).norm(), allowed);
      ASSERT_LT((turn * a.moment[i] - b.moment[k]).norm(), allowed);
      ASSERT_LT((turn * here.particles.velocity[i] - there.particles.velocity[k]).norm(), allowed);
    }
  }
  static std::vector<std::size_t> in_order(std::size_t count) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    return order;
  }
};

TEST_P(Seen, FromAMovedOriginIsTheSame) {
  const Moving here = crowd_in_a_cell();
  for (const Vec3& shift : {Vec3(0.1, -3.7, 11.3), Vec3(100.0, 200.0, -50.0)}) {
    Moving there = here;
    for (Vec3& x : there.particles.position) x += shift;
    const Moving end = after(here), end_there = after(there);
    expect_same(end, end_there, Mat3::Identity(), in_order(here.particles.size()));
    // The origin's shift strains with the cell.
    const Vec3 strained = end.cell.edges * here.cell.edges.inverse() * shift;
    for (std::size_t i = 0; i < here.particles.size(); ++i)
      ASSERT_LT((end.particles.position[i] + strained - end_there.particles.position[i]).norm(),
                1e-12 * strained.norm());
  }
}

TEST_P(Seen, ByOtherPeriodicImagesIsTheSame) {
  const Moving here = crowd_in_a_cell();
  Moving there = here;
  std::mt19937_64 random(32);
  const auto pick = [&] { return static_cast<std::int32_t>(random() % 5) - 2; };
  for (Vec3& x : there.particles.position) x += there.cell.translation({pick(), pick(), pick()});
  expect_same(after(here), after(there), Mat3::Identity(), in_order(here.particles.size()));
}

TEST_P(Seen, InAnotherOrderIsTheSame) {
  const Moving here = crowd_in_a_cell();
  const std::size_t count = here.particles.size();
  std::vector<std::size_t> where = in_order(count);
  std::mt19937_64 random(33);
  for (std::size_t left = count; left > 1; --left)
    std::swap(where[left - 1], where[random() % left]);
  Moving there = here;
  const Particles& p = here.particles;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t k = where[i];
    there.particles.position[k] = p.position[i];
    there.particles.velocity[k] = p.velocity[i];
    there.particles.angular_velocity[k] = p.angular_velocity[i];
    there.particles.orientation[k] = p.orientation[i];
    there.particles.semi_axes[k] = p.semi_axes[i];
    there.particles.mass[k] = p.mass[i];
  }
  expect_same(after(here), after(there), Mat3::Identity(), where);
}

TEST_P(Seen, FromAxesPutForOneAnotherIsTheSame) {
  const Moving here = crowd_in_a_cell();
  const Moving end = after(here);
  for (const Mat3& turn : axis_rotations()) {
    Moving there{Cell::box((turn * here.cell.edges.diagonal()).cwiseAbs()),
                 turned(here.particles, turn)};
    there.cell.rate = turn * here.cell.rate * turn.transpose();
    const Moving end_there = after(there);
    expect_same(end, end_there, turn, in_order(here.particles.size()));
    const Mat3 stress = turn * stress_of(end.contacts, end.cell).tensor * turn.transpose();
    ASSERT_LT((stress_of(end_there.contacts, end_there.cell).tensor - stress).norm(),
              kTolerance * stress.norm());
  }
}

TEST_P(Seen, FromAnyTurnedAxesIsTheSameForAClusterByItself) {
  const Cell near = Cell::box(Vec3::Constant(5.0));
  Moving here{Cell::box(Vec3::Constant(200.0)), crowd(50, near, 34)};
  for (std::size_t i = 0; i < here.particles.size(); ++i) {
    Vec3& x = here.particles.position[i];
    x = x - near.translation(near.image_of(x)) + Vec3::Constant(20.0);
    here.particles.semi_axes[i] *= 0.85;
  }
  here.cell.rate << -0.2, 0.1, 0.05, 0.1, 0.15, -0.1, 0.05, -0.1, -0.3;
  std::mt19937_64 random(35);
  const Moving end = after(here);
  for (int k = 0; k < 5; ++k) {
    const Mat3 turn = uniform_rotation(random).toRotationMatrix();
    Moving there{here.cell, turned(here.particles, turn)};
    there.cell.rate = turn * here.cell.rate * turn.transpose();
    expect_same(end, after(there), turn, in_order(here.particles.size()));
  }
}

INSTANTIATE_TEST_SUITE_P(With, Seen, testing::Values(kLinear, kHertz), [](const auto& one) {
  return std::string(one.param.hertz ? "Hertz" : "Linear");
});

}  // namespace
