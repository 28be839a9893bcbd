// SPDX-License-Identifier: MIT
/// @file
/// What the stages of a scene will be like, estimated from the scene and its first state before
/// anything moves. Estimates are those of equal spheres that are packed at random: they tell powers
/// of ten and mostly the first digit (docs/choosing.md compares them with runs).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <tangency/dem/scene/cycles_needed.hpp>
#include <tangency/dem/simulation.hpp>

namespace tangency::inline v0::dem {

/// What a packing bears, force/area, and whether friction holds it.
struct Pressed {
  double stress;
  bool has_friction;
};

/// Of one stage that moves.
struct StageForecast {
  std::size_t stage;  ///< its index in the scene
  double time_step;   ///< time
  double
      steps_a_contact;  ///< time steps of the shortest impact: pi sqrt(m_min / (2 K_max)) of them
  CyclesNeeded least;   ///< cycles that it needs at least
  /// Held in this stage or, where it holds none, before it; at least what weight makes at the
  /// bottom; force/area. Without any: none.
  std::optional<Pressed> pressed;
  /// rate d sqrt(density / stress) of the given strain rates, and of the bound of the servo.
  std::optional<double> inertial_number, servo_inertial_number;
  /// Mean overlap over mean radius under that stress, and of the type and law where it is largest.
  std::optional<double> overlap;
  std::size_t softest = 0;  ///< that type
  /// Least period of the cell at the stage's end over the least that its particles allow
  /// (thin_cell.hpp); none where all axes have walls.
  std::optional<double> cell_over_least;
};

/// Of the current stage and those after it.
std::vector<StageForecast> forecast(const Simulation& simulation);

/// The factor by which the stiffness, or Young's modulus, of a type's contacts with its like has to
/// grow, so that their mean overlap is `overlap` times the mean radius.
double stiffer_by(const Scene& scene, std::size_t type, const Pressed& pressed, double overlap);

/// The largest overlap over mean radius of a head-on impact of two bodies of a type.
/// @param speed  of approach
double overlap_of_impact(const Scene& scene, std::size_t type, double speed);

/// Bytes that a run of so many particles needs, once they are packed.
double memory_of(std::size_t particles);

}  // namespace tangency::inline v0::dem
