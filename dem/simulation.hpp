// SPDX-License-Identifier: MIT
/// @file
/// A run: the state of an assembly and the cycle that moves it on.
///
/// (1) The state after a cycle depends on the state before it and the scene alone: not on the
///     number of threads, and not on whether the run was saved and resumed in between.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <tangency/dem/contact/contact_law.hpp>
#include <tangency/dem/contact/contacts.hpp>
#include <tangency/dem/contact/thin_cell.hpp>
#include <tangency/dem/loading.hpp>
#include <tangency/dem/motion/motion.hpp>
#include <tangency/dem/neighbours.hpp>
#include <tangency/dem/observe.hpp>
#include <tangency/dem/profile.hpp>
#include <tangency/dem/scene.hpp>
#include <tangency/dem/scene/cycles_needed.hpp>
#include <tangency/dem/scene/scene_model.hpp>
#include <tangency/dem/state.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// How a stage goes on.
enum class StageStatus {
  running,
  done,
  out_of_cycles,  ///< the stage's max_cycles are spent and its criterion is not met
};

/// A run of a scene, step by step.
class Simulation {
 public:
  /// Places the particles: the scene's first stage.
  /// @throws DoesNotFit   where random placement has bad luck
  /// @throws CellTooThin  where a particle touches two images of another, or one of its own
  explicit Simulation(const Scene& scene);
  /// @overload
  /// `placed` is called now and then with the share of the particles that have their place.
  Simulation(const Scene& scene, std::function<void(double)> placed);

  /// Continues from a saved state.
  /// @throws std::invalid_argument  where the state is not one of such a scene: what() says why
  Simulation(const Scene& scene, State state);

  /// All that changes.
  const State& state() const { return state_; }
  /// As given.
  const Scene& scene() const { return scene_; }
  /// The scene's, with the current stage's friction as far as its ramp has come, and without
  /// restitution where the stage has no rate of damping (fire.hpp).
  const ContactLaws& laws() const { return laws_; }
  /// Have all stages ended?
  bool finished() const { return state_.stage == scene_.stages.size(); }
  /// The current stage, or the last one when finished.
  const Stage& stage() const;
  /// Of the current stage, with the stresses to which a ramp has come. Requires !finished().
  const Loading& loading() const { return loading_; }

  /// One cycle of the current stage. Requires !finished().
  /// @throws Diverged
  /// @throws CellTooThin  where the cell is, or would be after this cycle: nothing has moved then,
  ///                      and the state can be saved
  void step();

  /// Where the current stage is. Requires !finished().
  StageStatus status() const;

  /// Goes on to the next stage, whose first cycle starts the strains anew. Requires !finished().
  void next_stage();

  /// Strain of the current stage since it began: of a shear its axial strain, of another the time
  /// in it times its largest given rate, 0 without one. Requires !finished().
  double strain() const;
  /// Has the last cycle passed a multiple of this strain? Never in a stage without a given rate.
  bool has_passed(double strain) const;

  /// Time step of the current stage.
  double time_step() const;

  /// The time step over critical_time_step(): above 1 the motion is no longer that of the model,
  /// even where nothing blows up.
  double time_step_ratio() const;

  /// The fewest cycles in which the rest of the current stage can be done: what its rate of shear,
  /// its duration, its increments, or the way to a packing that bears stress need. Of all else
  /// nothing is known before: 0. Requires !finished().
  CyclesNeeded cycles_needed() const;

  /// A guess at how much of the current stage is done, in [0, 1]: for progress bars only.
  double stage_fraction() const;

  /// What the state is like now.
  Observation observe() const;

  /// Kinetic and elastic energy now less what the account says: Observation::energy_error.
  double energy_error() const;

  /// From now on cycles are added to a profile, which has to live as long; null: to none, which
  /// costs nothing.
  void record(Profile* profile) { profile_ = profile; }

  /// What differs between the contact laws that a resumed state was made with and the scene's, one
  /// line; empty where nothing does.
  const std::string& changed_laws() const { return changed_laws_; }
  /// Alike of the velocities of walls and of the stresses that they hold, which become the scene's,
  /// and of the places of walls that stand still, which stay the state's.
  const std::string& changed_walls() const { return changed_walls_; }

 private:
  void prepare_stage();
  void renew_loading();
  void renew_friction();
  double ramp_share() const;
  void begin_servos();
  void sort_in_space();
  void describe_cell_anew();
  bool anything_turns() const;
  bool grows_now() const;
  bool is_relaxed() const;
  bool is_grown() const;
  bool walls_bear_their_stress(double tolerance) const;
  bool is_at_its_end() const;
  void grow();
  void require_single_contacts() const;
  Mat3 next_rate(double dt);
  void move_particles(double dt);
  Contacts::Borne force_on_plane(std::size_t plane) const;
  void set_planes_going(double dt);
  void require_in_front() const;
  void keep_list_current(double dt);
  void renew_list(std::vector<Pair> before, double dt);
  void update_contacts(double dt);
  Motion motion() const;
  double kinetic_energy_now() const;
  void watch(const Stress& stress);

  Scene scene_;
  State state_;
  ContactLaws laws_;  ///< laws()
  Loading loading_;   ///< the current stage's, with the stresses of its ramp
  std::string changed_laws_;
  std::string changed_walls_;
  bool turns_ = true;                 ///< is there anything that could turn, or seem to?
  LeastCell least_;                   ///< of the particles as they are
  double characteristic_time_ = 0.0;  ///< of the masses and the stage's laws
  Profile* profile_ = nullptr;
};

}  // namespace tangency::inline v0::dem
