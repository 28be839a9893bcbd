// SPDX-License-Identifier: MIT
/// @file
/// What to change where a stage went wrong or cannot go on: keys that its kind of stage has, or
/// that the scene has, and the values to give them. Values are estimates from what was seen,
/// rounded to two digits to the safe side.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tangency/dem/simulation.hpp>

namespace tangency::inline v0::dem {

/// The largest mean overlap that is sound, in mean radii. Particles stand for rigid ones. Chosen;
/// the published parameters are softer: at 100e6 the dense sample has 0.107 and the end of its
/// shear 0.155, which scenes with them call intended (docs/simulator.md).
inline constexpr double kSoundOverlap = 0.1;

/// A key of a scene, and its value, as TOML writes it, now and as advised.
struct Change {
  std::string key, from, to;
};

/// Keys of a stage that strain it at a given rate, each with `share` of what it is.
/// @param dimensions  of the scene
std::vector<Change> slower_strains(const Drive& stage, double share, int dimensions);

/// For an inertial fraction above `sound`: "the motion is too fast ...; lower max_strain_rate to
/// 0.012". Strain rates in proportion; where nothing strains, the time that damping needs; where a
/// stage ends in balance, how much of it to ask for. "" where nothing strains and damping = 0: the
/// scene asks for motion.
std::string advice_on_motion(const Simulation& simulation, const Observation& seen, double sound);

/// For a stress that was not held: "raise servo_gain from 0.005 to 0.5", of the servo's keys the
/// first that is too small for its stress; where none is, half of the rates that strain the stage,
/// or twice its duration.
std::string advice_on_servo(const Simulation& simulation);

/// The servo_gain of a simple shear that is so fast that it is a flow; none where it is slower, or
/// holds no stress.
std::optional<double> gain_of_flow(const Scene& scene, const Drive& stage);

/// The servo_gain with which dampers at contacts (restitution) do not make the servo ring, where
/// the stage's gain is so large that they do; else none. In a step a damper answers a strain by 2
/// zeta sqrt(m_max / m_min) / time_step_factor times what the spring does, and the servo knows of
/// the spring alone.
std::optional<double> gain_of_dampers(const Simulation& simulation, const Drive& stage);

/// "lower time_step_factor to 0.2", a share of what it is.
std::string advice_on_step(const Simulation& simulation, double share);

/// For overlaps `times` as large as sound ones: "raise contact.normal_stiffness to 2e9".
std::string advice_on_stiffness(const Simulation& simulation, double times);

/// For a cell that is too thin: where the stage should end, or how many particles it takes.
std::string advice_on_thickness(const Simulation& simulation, const ThinPlace& place);

/// For a stage that is to have so many more cycles than have been: "raise max_cycles to 12000".
std::string advice_on_cycles(const Simulation& simulation, double more);

/// "gravity along z acts where no wall bears it: ...", or "" where walls bear it or a particle's
/// mean weight along such axes is below that share of the mean contact force.
std::string advice_on_gravity(const Simulation& simulation, const Observation& seen, double share);

}  // namespace tangency::inline v0::dem
