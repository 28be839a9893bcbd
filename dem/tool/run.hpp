// SPDX-License-Identifier: MIT
/// @file
/// tangency-dem run.
#pragma once

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

}  // namespace tangency::inline v0::dem
