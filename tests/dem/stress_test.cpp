// SPDX-License-Identifier: GPL-3.0-or-later
/// The stress that contacts say against the work that the cell's boundary does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <tangency/dem/observe.hpp>

#include "assembly.hpp"

namespace {

using namespace tangency::dem;
using tangency::Mat3;
using tangency::Vec3;
using namespace tangency::testing;

/// Ellipsoids at rest under stress: without friction, so that what they store is all there is.
Moving relaxed_sample(const ContactLaw& law) {
  const Cell cell = Cell::box({2.8, 2.9, 2.7});
  Moving made{cell, crowd(20, cell, 41)};
  made.branch = Branch::follow;
  for (std::size_t i = 0; i < made.particles.size(); ++i) {
    made.particles.semi_axes[i] *= 0.8;
    made.particles.velocity[i].setZero();
    made.particles.angular_velocity[i].setZero();
  }
  made.update(law, 0.0);
  return made;
}

double energy_of(const Moving& sample) { return sample.contacts.totals().energy; }

/// Brings the sample to rest in its cell, far enough that what is left does not show in its energy.
void rest(Moving& sample, const ContactLaw& law) {
  const double dt = 0.2 * characteristic_time(sample.particles, law.normal_stiffness);
  const auto unbalanced = [&] {
    double worst = 0.0;
    const Resultants& on = sample.contacts.resultants();
    for (std::size_t i = 0; i < sample.particles.size(); ++i)
      worst = std::max({worst, on.force[i].norm(), on.moment[i].norm()});
    return worst / sample.largest_contact_force();
  };
  for (int step = 0; step < 60000 && unbalanced() > 1e-7; ++step)
    sample.step(law, {Rotation::full, Vec3::Zero(), 0.005 / dt}, dt);
  ASSERT_LE(unbalanced(), 1e-7);
}

// In a static state the assembly gives way where it can, and still the work is that of the stress:
// by virtual work, to first order in the strain.
TEST(StaticStress, FromContactsIsTheWorkOfTheBoundaryPerStrainAndVolume) {
  const ContactLaw law{100.0, 0.0, 0.0, 0.0};
  Moving sample = relaxed_sample(law);
  rest(sample, law);
  const Stress stress = stress_of(sample.contacts, sample.cell);
  ASSERT_GT(stress.mean(), 1.0);
  const double strain = 1e-5;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      Mat3 direction = Mat3::Zero();
      direction(i, j) += 0.5;
      direction(j, i) += 0.5;
      double energy[2];
      for (const int sign : {0, 1}) {
        Moving strained = sample;
        const Mat3 gradient = Mat3::Identity() + (sign == 0 ? -strain : strain) * direction;
        strained.cell.edges = gradient * strained.cell.edges;
        for (Vec3& x : strained.particles.position) x = gradient * x;
        strained.update(law, 0.0);
        rest(strained, law);
        energy[sign] = energy_of(strained);
      }
      const double work = (energy[1] - energy[0]) / (2.0 * strain * sample.cell.volume());
      EXPECT_NEAR(stress.tensor.cwiseProduct(direction).sum(), -work, 1e-3 * stress.mean())
          << i << j;
    }
}

// The account's boundary work is taken force by force as the cell strains; a quasi-static path's
// is also the stress times the strain.
TEST(StaticStress, TimesTheStrainIsTheBoundaryWorkOfTheAccount) {
  const ContactLaw law{100.0, 80.0, 0.5, 0.0};
  Moving sample = relaxed_sample({100.0, 0.0, 0.0, 0.0});
  rest(sample, {100.0, 0.0, 0.0, 0.0});
  const double dt = 0.1 * characteristic_time(sample.particles, law.normal_stiffness);
  Mat3 rate;
  rate << -0.4, 0.2, 0.1, 0.2, 0.3, -0.1, 0.1, -0.1, -0.2;
  sample.cell.rate = 0.01 * rate;
  double account = 0.0, by_stress = 0.0;
  for (int step = 0; step < 2000; ++step) {
    const auto power = [&] {
      const Mat3 s = stress_of(sample.contacts, sample.cell).tensor;
      return -s.cwiseProduct(sample.cell.rate).sum() * sample.cell.volume();
    };
    const double before = power();
    move(sample.particles, sample.cell, sample.contacts.resultants(),
         {Rotation::full, Vec3::Zero(), 0.5 / dt}, dt);
    if (!sample.list.is_current(sample.particles, sample.cell)) {
      const std::vector<Pair> pairs = sample.list.pairs();
      sample.list.build(sample.particles, sample.cell, 0.3);
      sample.contacts.carry_over(pairs, sample.list.pairs());
    }
    account +=
        sample.contacts.update(sample.particles, sample.cell, sample.list, laws(law), dt).boundary;
    by_stress += 0.5 * dt * (before + power());
  }
  ASSERT_GT(std::abs(by_stress), 1e-3);
  EXPECT_NEAR(account, by_stress, 1e-3 * std::abs(by_stress));
}

}  // namespace
