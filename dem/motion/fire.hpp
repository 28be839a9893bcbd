// SPDX-License-Identifier: MIT
/// @file
/// Damping of a stage that awaits balance: the fast inertial relaxation engine [Bitzek2006], at the
/// stage's time step.
///
/// A damping that is one rate suits one frequency, and the slowest modes of a packing without
/// friction are a hundred and more times slower than those that bound the time step: a rate that
/// stops the fast ones lets the slow ones creep. Here velocities are turned towards the forces
/// while they run downhill, and taken away as soon as they run uphill, so that each stretch lasts
/// as long as its own modes let it. What is compared and measured: docs/simulator.md. Contacts lose
/// nothing to their approach meanwhile.
///
/// (1) Velocities without force and forces without velocity change nothing but that what does not
///     run downhill stops.
/// (2) What it takes is the change of kinetic_energy_at(): the energy account adds up with it.
/// (3) It does not depend on the number of threads.
#pragma once

#include <cstdint>

#include <tangency/dem/motion/motion.hpp>
#include <tangency/dem/particles.hpp>

namespace tangency::inline v0::detail {
struct InertiaProducts;
}

namespace tangency::inline v0::dem {

/// How far the velocities are turned, and for how long they have run downhill.
struct Fire {
  double mixing = 0.1;        ///< share of the new direction, in (0, 1]
  std::int64_t downhill = 0;  ///< cycles

  /// Steers velocities half a step before the resultants' time; with v and the accelerations
  /// a = F / m, turns by their inertia alike:
  ///     v <- (1 - mixing) v + mixing |v| a / |a|  where F . v > 0,  else v <- 0,
  /// lengths of all bodies together, weighted by mass. Before move() without damping.
  /// @return  the energy taken; below 0 by up to half a step's work of the forces on what was
  /// turned
  double steer(Particles& particles, const Resultants& resultants, const Motion& motion, double dt);

  /// What a cycle does to velocities: v <- keep v + push a.
  struct Turn {
    double keep = 1.0, push = 0.0;  ///< factors of velocity and of acceleration
    /// The energy that it takes, by the products of all particles before it.
    double taken(const detail::InertiaProducts& before, double dt) const;
  };
  /// The next cycle's, by the products of all particles: what steer() does, for who keeps the
  /// particles elsewhere.
  Turn turn_by(const detail::InertiaProducts& all);
};

}  // namespace tangency::inline v0::dem
