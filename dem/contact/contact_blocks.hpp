// SPDX-License-Identifier: MIT
/// @file
/// One step of a block's contacts: what both engines, the simulator and LAMMPS (dem/lammps), have
/// in common once they know how the bodies of each pair lie. contact_lanes.hpp computes it.
#pragma once

#include <span>

#include <tangency/dem/contact/contact_laws.hpp>
#include <tangency/dem/contact/narrow_phase.hpp>
#include <tangency/dem/lanes/contact_lanes.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// What is the same for all blocks of a step.
struct BlockStep {
  const Particles& particles;         ///< types, masses, shapes and orientations are read
  const NarrowPhase& narrow_phase;    ///< of these particles, refreshed
  const ContactLaws& laws;            ///< between all types
  std::span<const MotionRow> motion;  ///< of the particles and, after them, of the walls
  double dt;                          ///< time since the last update
  Mat3 rate;                          ///< velocity gradient that velocities leave out, 1/time
  bool bears_shear;                   ///< may any pair have a shear force, before or after?
  bool damped;                        ///< does the approach of any lose energy?
};

/// From the contacts as they were, in block.state, to those at the current positions:
/// contact_lanes() by the law of each pair. Of the block it reads count, state and where results
/// go; the rest it sets. May be called by several threads for blocks that share no state.
/// @param step  of all blocks
/// @param geometry  how the bodies lie, as NarrowPhase::measure() has it
/// @param block  its contacts
void step_block(const BlockStep& step, const BlockGeometry& geometry, ContactBlock& block);

}  // namespace tangency::inline v0::dem
