// SPDX-License-Identifier: MIT
/// @file
/// The state of a run, and which states a scene can go on from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/contact/contacts.hpp>
#include <tangency/dem/loading.hpp>
#include <tangency/dem/motion/fire.hpp>
#include <tangency/dem/neighbours.hpp>
#include <tangency/dem/observe.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/dem/scene/scene_model.hpp>

namespace tangency::inline v0::dem {

/// Everything that a run carries from one cycle to the next.
struct State {
  Particles particles;              ///< all of them
  Cell cell;                        ///< now
  NeighbourList list;               ///< pairs that may touch
  Contacts contacts;                ///< of those pairs
  std::int64_t cycle = 0;           ///< steps since the run began
  double time = 0.0;                ///< since the run began
  std::size_t stage = 0;            ///< the current one; the number of stages when all are done
  std::int64_t stage_cycle = 0;     ///< steps since the stage began
  std::vector<ServoMemory> servos;  ///< of the current stage's targets
  std::vector<double> ramp_start;   ///< stresses of these as the stage began; none without a ramp
  Fire fire;                        ///< of the current stage, where no damping is given
  ContactLaws laws;                 ///< the scene's, with which the contacts were made
  std::int64_t increments = 0;      ///< of growth, made in the current stage
  EnergyAccount energy;             ///< where energy went
  Reset description;                ///< of the cell since the run began, all resets one by one
};

/// @throws std::invalid_argument  naming the first key of the scene whose particles, growth, cell
/// or walls the state's are not
void require_state_of(const Scene& scene, const State& state);

/// What differs between the contact laws that a state was made with and the scene's:
/// "contact.a-b.normal_stiffness = 2, and here 3" of each key that differs, of the first pair that
/// it does for; "" where nothing does.
std::string difference_of_laws(const ContactLaws& made, const Scene& scene);

/// Alike of walls: "wall[0].velocity = [ 0, 0, 1 ], and here [ 0, 0, 2 ]". A wall that moves is
/// elsewhere by right.
std::string difference_of_walls(const Cell& made, const Scene& scene);

}  // namespace tangency::inline v0::dem
