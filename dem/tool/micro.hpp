// SPDX-License-Identifier: MIT
/// @file
/// `tangency-dem micro STATE`.
#pragma once

#include <optional>
#include <string>

#include <tangency/dem/micromechanics/averages.hpp>

namespace tangency::inline v0::dem {

struct MicroOptions {
  std::string state;
  std::string since;  ///< an older state of the same run; empty: none
  micromechanics::Classes classes;
  /// That of the stage which the state is of; nothing: those of the scene's contacts.
  std::optional<double> friction;
  std::string json, histogram;  ///< files; empty: none
};

/// "near-uniform" or "polar" as a kind; requires one of the two.
micromechanics::Classes::Kind partition_named(const std::string& name);

/// Prints the averages of a saved packing, and writes the files that are asked for: `-` prints one
/// instead of the averages.
/// @throws StateError, tables::Error  as every command, and then nothing is left of either file
int micro(const MicroOptions& options);

}  // namespace tangency::inline v0::dem
