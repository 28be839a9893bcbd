// SPDX-License-Identifier: MIT
#include <tangency/dem/motion/motion.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <tangency/dem/chunks.hpp>
#include <tangency/dem/lanes/particle_lanes.hpp>
#include <tangency/dem/motion/particle_columns.hpp>

namespace tangency::inline v0::dem {
namespace {

detail::DampedKick kick_of(double damping, double largest, double dt) {
  const double half = 0.5 * damping * dt;
  return {(1.0 - half) / (1.0 + half), dt / (1.0 + half), largest > 0.0 ? damping / largest : 0.0};
}

}  // namespace

detail::MotionStep step_of(const Motion& motion, const Mat3& rate, double dt) {
  const double of_turns = motion.rotational_damping.value_or(motion.damping);
  detail::MotionStep step{};
  step.damping = std::max(motion.damping, of_turns);
  step.of_shift = kick_of(motion.damping, step.damping, dt);
  step.of_turn = kick_of(of_turns, step.damping, dt);
  step.dt = dt;
  for (int k = 0; k < 3; ++k) {
    step.gravity[k] = motion.gravity[k];
    for (int j = 0; j < 3; ++j) step.rate[3 * k + j] = rate(k, j);
  }
  step.turns = motion.rotation != Rotation::none;
  step.is_full = motion.rotation == Rotation::full;
  return step;
}

double characteristic_time(const Particles& particles, double largest_stiffness) {
  const double lightest = *std::min_element(particles.mass.begin(), particles.mass.end());
  return std::sqrt(lightest / largest_stiffness);
}

MotionWork move(Particles& particles, Cell& cell, const Resultants& resultants,
                const Motion& motion, double dt) {
  const detail::ParticleColumns columns = detail::columns_of(particles, resultants);
  const detail::MovedColumns moved = detail::moved_columns_of(particles);
  const detail::MotionStep step = step_of(motion, cell.rate, dt);
  const auto sum =
      sum_by_chunks<detail::MovedSum>(particles.size(), [&](std::size_t first, std::size_t last) {
        return detail::move_lanes(columns, moved, step, first, last);
      });
  cell.strain(dt);
  if (sum.blown_up || !(cell.volume() > 0.0))
    throw Diverged("the run blew up: a particle's velocity is no longer finite");
  return {sum.damping, sum.gravity};
}

double kinetic_energy(const Particles& particles) {
  const detail::ParticleColumns columns = detail::columns_of(particles);
  const Vec3 weightless = Vec3::Zero();
  const auto sum = sum_by_chunks<detail::InertiaProducts>(
      particles.size(), [&](std::size_t first, std::size_t last) {
        return detail::inertia_products_lanes(columns, weightless.data(), true, first, last);
      });
  return 0.5 * sum.vv;
}

double kinetic_energy_at(const Particles& particles, const Resultants& resultants,
                         const Motion& motion, double dt) {
  const detail::ParticleColumns columns = detail::columns_of(particles, resultants);
  const bool turns = motion.rotation != Rotation::none;
  const auto sum = sum_by_chunks<detail::InertiaProducts>(
      particles.size(), [&](std::size_t first, std::size_t last) {
        return detail::inertia_products_lanes(columns, motion.gravity.data(), turns, first, last);
      });
  const double energy = turns ? 0.5 * sum.vv : kinetic_energy(particles);
  return energy + 0.5 * dt * sum.va;
}

}  // namespace tangency::inline v0::dem
