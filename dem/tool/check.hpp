// SPDX-License-Identifier: MIT
/// @file
/// tangency-dem check: what to change in a scene before it runs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/advice.hpp>
#include <tangency/dem/tool/check_forecast.hpp>

namespace tangency::inline v0::dem {

/// Something that will go wrong, and the keys that put it right.
struct Advice {
  std::string stage;   ///< its name; "" where it is of the whole scene
  std::string about;   ///< "cycles", "inertial_number", "overlap", "cell", "memory" and so on
  std::string reason;  ///< what is, and what is sound
  /// Keys by their path, as --set takes them. With all of them this advice is gone.
  std::vector<Change> changes;

  /// One line: "stage shear: an inertial number of 0.01 ...; set ... from ... to ...".
  std::string text() const;
};

/// What was seen of a scene, from the current stage on.
struct SceneCheck {
  std::vector<StageForecast> stages;
  std::vector<Advice> advice;  ///< in the order of the stages, those of the scene first
  double memory = 0.0;         ///< bytes
};

/// Looks at each stage that is to come.
///
/// (1) Each advice names keys of the scene with values that are allowed.
/// (2) With the values of an advice the same check no longer gives it.
SceneCheck check_of(const Simulation& simulation);

/// The path of a stage's key: "stage.NAME.KEY", or "stage[K].KEY" where two stages have that name.
std::string path_of(const Scene& scene, std::size_t stage, const std::string& key);

/// As a table for people.
std::string text_of(const SceneCheck& check, const Simulation& simulation);

/// `scene, particles, memory_bytes, stages` (each with `stage, time_step, steps_a_contact,
/// cycles_at_least, cycles_key, max_cycles, stress, inertial_number, servo_inertial_number,
/// overlap, cell_over_least`, null where there is none) and `advice` (each with `stage, about,
/// reason, changes`, a list of `key, from, to`, values as TOML writes them).
std::string json_of(const SceneCheck& check, const Simulation& simulation,
                    const std::string& scene);

}  // namespace tangency::inline v0::dem
