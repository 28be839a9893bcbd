// SPDX-License-Identifier: MIT
/// @file
/// How many cycles a stage needs at least: what can be known before it runs.
#pragma once

#include <cstdint>

#include <tangency/dem/particles.hpp>
#include <tangency/dem/scene/scene_model.hpp>

namespace tangency::inline v0::dem {

/// Cycles, and the key of the stage that needs so many.
struct CyclesNeeded {
  double cycles = 0.0;  ///< how many the stage needs
  /// of the scene
  const char* key = "";
};

/// What of a stage is done, and what lies before it.
struct StageProgress {
  std::int64_t cycles = 0;      ///< done
  std::int64_t increments = 0;  ///< of growth, done
  double axial_strain = 0.0;    ///< reached, logarithmic, compression positive
  /// Logarithmic volumetric compression to where the particles could bear stress; 0: they do.
  double to_packing = 0.0;
};

/// The logarithmic volumetric compression from a cell of this volume to where bounding spheres
/// (circles) of the particles could bear stress, at the loosest: 0 where they could now.
double compression_to_packing(const Particles& particles, double cell_volume);

/// The fewest cycles in which the rest of a stage can be done: what its rate of shear, its
/// duration, its increments, or the way to a packing that bears stress need. Of all else nothing is
/// known before: 0. Requires a stage that moves.
CyclesNeeded cycles_needed(const Stage& stage, double time_step, int dimensions,
                           const StageProgress& done);

}  // namespace tangency::inline v0::dem
