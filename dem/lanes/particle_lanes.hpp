// SPDX-License-Identifier: MIT
/// @file
/// Particles in the lanes of vector registers: what motion.cpp, fire.cpp and kinetic_energy() are
/// made of. The instruction set is chosen when the program runs.
///
/// (1) Every operation is rounded once and none is fused, no function of the C library is called,
///     and sums run in the order of the particles: the bits of all that is computed here depend
///     neither on the instruction set nor on the machine.
/// (2) What happens to a particle does not depend on those beside it.
///
/// Assumes rounding to nearest. Thread-safe for ranges that do not overlap.
#pragma once

#include <cstddef>

namespace tangency::inline v0::dem {

/// Particles of one chunk. Chosen: a multiple of the lanes of every instruction set, and work
/// enough (1 to 4 us) that calls and sums of chunks are no part of it.
inline constexpr std::size_t kChunk = 64;

}  // namespace tangency::inline v0::dem

namespace tangency::inline v0::detail {

/// Columns of particles and resultants as dem::Particles and dem::Resultants have them: three
/// numbers a vector, four (x, y, z, w) an orientation, one a mass.
struct ParticleColumns {
  const double *velocity, *angular_velocity, *orientation, *semi_axes, *mass;
  const double *force, *moment;  ///< null: none acts
  bool is_plane;                 ///< moments of inertia are those of disks
};

/// Columns that are changed in place; those of one kind are the same memory as above.
struct MovedColumns {
  double *position, *velocity, *angular_velocity, *orientation;
};

/// How a step changes velocities: v <- keep v + push (force / mass + gravity), turns alike.
struct DampedKick {
  double keep, push;
  double share;  ///< of its damping in MotionStep::damping, in [0, 1]
};

/// The coefficients of a step, of dem::move().
struct MotionStep {
  DampedKick of_shift, of_turn;
  double dt;
  double damping;  ///< the larger of the two
  double gravity[3];
  double rate[9];  ///< of the cell, row by row
  bool turns;      ///< else orientations and angular velocities stay
  bool is_full;    ///< Euler's equations; else, and for spheres and in the plane, without what is
                   ///< quadratic in them
};

/// Of some particles.
struct MovedSum {
  double damping = 0.0, gravity = 0.0;  ///< energies, of dem::MotionWork
  bool blown_up = false;                ///< a position or an orientation is not finite

  MovedSum& operator+=(const MovedSum& other) {
    damping += other.damping;
    gravity += other.gravity;
    blown_up = blown_up || other.blown_up;
    return *this;
  }
};

/// dem::move() of the particles [first, last), at most dem::kChunk. A turn by more than 2^21 rad,
/// half of which is more than the largest angle of cosine_sine_lanes(), counts as blown up.
MovedSum move_lanes(const ParticleColumns& columns, const MovedColumns& moved,
                    const MotionStep& step, std::size_t first, std::size_t last) noexcept;

/// Scalar products of velocities v and accelerations a, weighted by inertia, shifts and turns
/// together: twice the kinetic energy, the power of the forces, and what Fire needs.
struct InertiaProducts {
  double vv = 0.0, va = 0.0, aa = 0.0;

  InertiaProducts& operator+=(const InertiaProducts& other) {
    vv += other.vv;
    va += other.va;
    aa += other.aa;
    return *this;
  }
};

/// Of the particles [first, last), at most dem::kChunk; a = force / mass + gravity.
InertiaProducts inertia_products_lanes(const ParticleColumns& columns, const double* gravity,
                                       bool turns, std::size_t first, std::size_t last) noexcept;

/// v <- keep v + push a of the particles [first, last), at most dem::kChunk.
void steer_lanes(const ParticleColumns& columns, const MovedColumns& moved, double keep,
                 double push, const double* gravity, bool turns, std::size_t first,
                 std::size_t last) noexcept;

/// Cosine and sine of angles, count at most dem::kChunk, within kSineError; NaN of angles beyond
/// 2^20 rad: for tests.
void cosine_sine_lanes(const double* angle, double* cosine, double* sine,
                       std::size_t count) noexcept;

/// Of cosine and sine in move_lanes(), in ulps of the true value. Measured: 1.94 and, of angles up
/// to 0.1, where the half angles of a sound run's steps are, 0.51.
inline constexpr double kSineError = 2.0;

}  // namespace tangency::inline v0::detail
