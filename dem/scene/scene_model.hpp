// SPDX-License-Identifier: MIT
/// @file
/// A scene: everything that determines a run. scene.hpp reads it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tangency/dem/contact/contacts.hpp>
#include <tangency/dem/contact/narrow_phase.hpp>
#include <tangency/dem/growth.hpp>
#include <tangency/dem/loading.hpp>
#include <tangency/dem/motion/motion.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/dem/samples/sample.hpp>
#include <tangency/dem/samples/start_axes.hpp>
#include <tangency/dem/scene/units.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// A type of particles.
struct ParticleType {
  std::string name;  ///< as the scene calls it
  Batch batch;       ///< shape, density and count
};

/// Puts the particles into the cell.
struct Place {
  Arrangement arrangement;   ///< how the particles lie at the start
  std::uint64_t seed;        ///< of the random numbers
  double jitter;             ///< in mean radii of the smallest type
  double bounding_fraction;  ///< of a random arrangement without a cell size
  /// Of an explicit arrangement whose bodies do not stand in the scene: a table of them.
  std::string file;
  /// orientations at the start
  StartAxes axes{};
  double volume_fraction = 0.0;  ///< of an insertion without a cell size
};

/// The way on which held stresses, and a friction of the stage, go from what they are at its start
/// to what it says: linearly in what is named, and no more from there on.
struct Ramp {
  /// strain: that of Simulation::strain().
  enum class Over { cycles, time, strain } over;
  double length;  ///< > 0
};

/// How a stage moves, and when it ends: as soon as all that is set holds.
struct Drive {
  Loading loading;                ///< how the cell is strained
  std::optional<double> damping;  ///< in 1 / characteristic_time(); without: as in fire.hpp
  /// Alike of angular velocities; without: damping.
  std::optional<double> rotational_damping;
  double time_step_factor;  ///< in characteristic_time()
  /// of all contacts from this stage on; without: as before
  std::optional<double> friction_coefficient;
  /// Of the largest given rate, where the scene gives it so; the loading has the rate.
  std::optional<double> inertial_number;
  std::optional<Ramp> ramp;                    ///< a stage does not end on it; without: at once
  std::optional<double> stress_tolerance;      ///< of the loading's targets, relative
  std::optional<double> max_unbalanced_ratio;  ///< of every particle
  std::optional<double> axial_strain;          ///< compression reached, logarithmic
  std::optional<std::int64_t> duration;        ///< cycles
  std::int64_t max_cycles;                     ///< a stage that has not ended by then fails
};

/// States of a stage that a run keeps beside its last one.
struct KeptStates {
  bool end = false;             ///< of its end
  std::vector<double> strains;  ///< of a shear: where its axial strain is first so large; ascending
  bool points = false;          ///< of a shear: at the points of shear_points.hpp

  /// Is any state kept?
  bool any() const { return end || points || !strains.empty(); }
};

/// Either places or moves; one that moves may also grow the particles, and then ends when they are
/// grown, relaxed to its max_inertial_fraction and at the mean stress.
struct Stage {
  std::string name;              ///< as the scene calls it
  std::optional<Place> place;    ///< the stage places particles
  std::optional<Drive> drive;    ///< or it drives the cell
  std::optional<Growth> growth;  ///< set besides drive
  /// which states are written
  KeptStates kept{};
  /// what is advised against and meant here, by the names of `tangency-dem check`
  std::vector<std::string> intended{};
};

/// How often a run writes, in cycles.
struct OutputIntervals {
  std::int64_t history, frame, checkpoint;  ///< cycles; 0: only where a stage ends
  double checkpoint_seconds;                ///< of the clock on the wall; 0: not by time
  std::int64_t contacts = 0;                ///< cycles; 0: no tables of contacts
  std::int64_t micro = 0;                   ///< cycles; 0: no micro.csv
  bool polar = false;           ///< micro.csv's partition of directions; else near-uniform
  int classes = 0;              ///< its number N
  bool contact_frames = false;  ///< contacts in each frame too
  /// Strain between two rows, or frames, of a stage with a given rate; 0: by cycles there too.
  double history_strain = 0.0, frame_strain = 0.0;
};

/// Shapes of the bodies of each particle type, in the order of the scene; none of a type whose
/// bodies are as the scene says.
using BodyShapes = std::vector<std::vector<Shape>>;

/// A scene as it was read and checked.
struct Scene {
  int dimensions = 3;                        ///< 2 or 3
  std::array<bool, 3> walled{};              ///< along which edges the cell has walls
  std::optional<Vec3> cell_size;             ///< edges at the start, where the scene says so
  std::vector<PlaneWall> planes = {};        ///< walls besides the faces, as they start
  Vec3 gravity = Vec3::Zero();               ///< length per time^2
  Rotation rotation = Rotation::full;        ///< which turns are followed
  Branch branch = Branch::follow;            ///< which gap of two bodies is a contact
  std::vector<ParticleType> particle_types;  ///< in the order of the file
  std::vector<Body> bodies;                  ///< of an explicit arrangement
  ContactLaws laws;                          ///< between all types
  std::vector<Stage> stages;                 ///< the first, and no other, places
  OutputIntervals output;                    ///< how often results are written
  std::optional<Units> units = {};           ///< what numbers are called, where the scene says so
  std::vector<std::string> intended = {};    ///< in all stages, as Stage::intended

  /// Spheres have the directed axis of what they grow into.
  std::vector<Batch> batches() const;
  /// Of all types.
  std::size_t particle_count() const;
  /// Has any side walls?
  bool has_walls() const { return walled[0] || walled[1] || walled[2]; }
  /// Over all types, length.
  double smallest_mean_radius() const;
  /// sqrt(m_min / K_max), in which time steps are given.
  double characteristic_time() const;
  /// The strain rate that a servo may use by default to hold a stress, linear: that of an inertial
  /// number of 0.05 of the slowest type, fifty times what a quasi-static test has.
  double servo_strain_rate(double stress) const;
  /// Diameter times sqrt(density / stress), of the type where it is largest: a rate times it is
  /// the inertial number.
  double inertial_time(double stress) const;
  /// The largest stress that a stage holds, at its walls too; 0 where it holds none.
  double held_stress(const Stage& stage) const;
  /// Is what `check` calls so meant, in that stage or everywhere?
  bool intends(const Stage& stage, const std::string& about) const;
  /// What the first stage places.
  Placement placement() const;
  /// The shape of a type in stage number `stage` after so many increments of it; in a stage that
  /// does not grow these do not matter.
  Shape shape_in(std::size_t type, std::size_t stage, std::int64_t increments) const;
};

/// Gives a scene whose place names a file its bodies.
/// @throws SceneError  where they are not as many of each type as the scene says; starts with
/// `name`
void set_bodies(Scene& scene, std::vector<Body> bodies, const std::string& name);

}  // namespace tangency::inline v0::dem
