// SPDX-License-Identifier: MIT
/// @file
/// The law of motion: leapfrog with mass-proportional damping [Ouadfel1998, eq. 3.15-3.34].
///
/// Damping acts on the fluctuation, not on the affine motion, so that a strained assembly is not
/// held back. Orientations turn by exact rotations, where the thesis adds a first-order increment
/// that leaves the rotations.
///
/// (1) Without force and damping a particle moves uniformly; a free body keeps its angular
///     momentum (full) or its angular velocity (simplified) to rounding.
/// (2) Without damping the scheme is time-reversible and of second order.
/// (3) Orientations stay unit to rounding.
/// (4) The bits of all that is computed here depend on nothing but the input: not on the number of
///     threads, the instruction set, the C library or the particles beside a particle.
/// (5) In the plane a force along x and y and a moment about z leave every other component of
///     velocities, positions and orientations exactly 0: nothing has to be locked.
#pragma once

#include <optional>
#include <stdexcept>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::detail {
struct MotionStep;
}

namespace tangency::inline v0::dem {

/// The run blew up: a velocity is no longer finite, or as good as that.
class Diverged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Which turns are followed.
enum class Rotation {
  none,        ///< orientations and angular velocities stay as they are
  simplified,  ///< I w' = M, the quadratic terms of Euler's equations dropped: for slow motion
  full,        ///< Euler's equations, turns about the body axes in turn [Dullweber1997]
};

/// How particles are moved.
struct Motion {
  Rotation rotation = Rotation::full;  ///< which turns
  Vec3 gravity = Vec3::Zero();         ///< acceleration, length/time^2
  double damping = 0.0;  ///< rate at which a free particle's velocity decays, >= 0, 1/time
  /// The same of its angular velocity; without: damping.
  std::optional<double> rotational_damping = {};
};

/// What acted on the fluctuating velocities besides contacts, energy.
struct MotionWork {
  double damping = 0.0;  ///< taken away, up to the half step of the new velocities
  double gravity = 0.0;  ///< given, on the way to the new positions
};

/// Takes velocities from half a step before to half a step after the resultants' time,
///     v <- ((1 - damping dt/2) v + F dt / m) / (1 + damping dt/2),
/// and angular velocities alike with their damping [Ouadfel1998, eq. 3.15, 3.21],
/// then positions and orientations a step on, with the affine motion of the cell, then the cell.
/// Spheres and plane bodies, whose quadratic terms are 0, take the simplified equations.
/// @throws Diverged  also where a body turns by more than 2^21 rad about one axis at once: in the
///     step, or by Euler's equations in one of the five turns that its step is made of
MotionWork move(Particles& particles, Cell& cell, const Resultants& resultants,
                const Motion& motion, double dt);

/// The coefficients of a step of move(), for who keeps the particles elsewhere.
/// The rate is that of the cell.
detail::MotionStep step_of(const Motion& motion, const Mat3& rate, double dt);

/// Translational and rotational energy of the fluctuating velocities.
double kinetic_energy(const Particles& particles);

/// Kinetic energy of the velocities, half a step before the resultants' time, and half a step's
/// work of contacts and gravity: with it, and damping as MotionWork has it, an account of
/// leapfrog's energies adds up but for how far works by mean forces are from stored energies, of
/// second order.
double kinetic_energy_at(const Particles& particles, const Resultants& resultants,
                         const Motion& motion, double dt);

/// sqrt(m_min / K_max): the time to which the step is compared. The critical step of one particle
/// on one spring is twice this [Ouadfel1998, eq. 3.24].
double characteristic_time(const Particles& particles, double largest_stiffness);

}  // namespace tangency::inline v0::dem
