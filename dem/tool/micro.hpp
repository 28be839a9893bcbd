// SPDX-License-Identifier: MIT
/// @file
/// `tangency-dem micro STATE`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <tangency/dem/micromechanics/averages.hpp>
#include <tangency/dem/state.hpp>

namespace tangency::inline v0::dem {

/// Where the friction of a state's contacts stands, which a state itself does not know: as given,
/// or in the scene that the run was of. Neither: that of the scene's contacts, as of a stage
/// without a friction of its own.
struct StateFriction {
  std::optional<double> given;
  std::string scene;                  ///< a file; empty: none
  std::vector<std::string> settings;  ///< what --set changed of the scene in the run
};

/// The laws of a state's contacts with that friction.
/// @param file  the state's
/// @throws SceneError, StateError  where the scene is refused, or is not the state's
/// @throws tables::UsageError      settings without a scene
ContactLaws laws_of(const State& state, const std::string& file, const StateFriction& friction);

struct MicroOptions {
  std::string state;
  std::string since;  ///< an older state of the same run; empty: none
  micromechanics::Classes classes;
  StateFriction friction;
  std::string json, histogram;  ///< files; empty: none
};

/// "near-uniform" or "polar" as a kind; requires one of the two.
micromechanics::Classes::Kind partition_named(const std::string& name);

/// Prints the averages of a saved packing, and writes the files that are asked for: `-` prints one
/// instead of the averages.
/// @throws StateError, tables::Error  as every command, and then nothing is left of either file
int micro(const MicroOptions& options);

}  // namespace tangency::inline v0::dem
