// SPDX-License-Identifier: MIT
/// @file
/// The law of motion: leapfrog with mass-proportional damping [Ouadfel1998, eq. 3.15-3.34].
///
/// Damping acts on the fluctuation, not on the affine motion, so that a strained assembly is not
/// held back. Rotation follows the simplified Euler equations I w' = M, whose quadratic terms
/// are dropped: right for slow motion. Orientations turn by the exact rotation exp(w dt), where
/// the thesis adds a first-order increment that leaves the rotations.
///
/// (1) Without force and damping a particle moves and turns uniformly.
/// (2) Without damping the scheme is time-reversible and of second order.
/// (3) Orientations stay unit to rounding.
/// (4) In the plane a force along x and y and a moment about z leave every other component of
///     velocities, positions and orientations exactly 0: nothing has to be locked.
#pragma once

#include <stdexcept>
#include <tangency/dem/cell.hpp>
#include <tangency/dem/particles.hpp>

namespace tangency::dem {

/// The run blew up: a velocity is no longer finite.
class Diverged : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Takes velocities from half a step before to half a step after the resultants' time,
///     v <- ((1 - damping dt/2) v + F dt / m) / (1 + damping dt/2),
/// then positions and orientations a step on, with the affine motion of the cell, then the cell.
/// @param damping  rate at which a free particle's velocity decays, >= 0, 1/time
/// @throws Diverged
void move(Particles& particles, Cell& cell, const Resultants& resultants, double damping,
          double dt);

/// exp(v/2) q, normalised: q turned by the rotation vector v in space.
Eigen::Quaterniond turned_by(const Eigen::Quaterniond& q, const Vec3& rotation_vector);

/// sqrt(m_min / K_max): the time to which the step is compared. The critical step of one particle
/// on one spring is twice this [Ouadfel1998, eq. 3.24].
double characteristic_time(const Particles& particles, double largest_stiffness);

}  // namespace tangency::dem
