// SPDX-License-Identifier: MIT
/// @file
/// tangency-dem run.
#pragma once

#include <filesystem>
#include <optional>

#include <tangency/dem/simulation.hpp>
#include <tangency/dem/tool/run_options.hpp>

namespace tangency::inline v0::dem {

/// What the program returns beside tables::kRefused, which is that of a bad scene, state or command
/// line, where nothing was written, and of a failed write. A run that a signal ended returns 128 +
/// the signal, as shells do.
enum ExitStatus : int {
  success = 0,
  not_reached = 1,  ///< a stage did not end, the cell became too thin, or the run blew up
  fault_found = 3,  ///< a check of --verify and the run disagree
};

/// Runs a scene; messages go to standard error.
/// @throws SceneError, StateError, OutputError  where the input is refused
/// @throws WriteError, std::filesystem::filesystem_error  where a result cannot be written
int run(const RunOptions& options);

/// The run of a scene, from a state on, or from where the scene places its bodies.
/// @param quiet  no progress to standard error
/// @throws SceneError, StateError  where they are refused, or do not belong together
Simulation simulation_of(const std::filesystem::path& scene,
                         const std::optional<std::filesystem::path>& state, bool quiet);

}  // namespace tangency::inline v0::dem
