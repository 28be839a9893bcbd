// SPDX-License-Identifier: MIT
/// @file
/// tangency-dem run.
#pragma once

#include <tangency/dem/scene/scene_file.hpp>
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

/// Before anything of a run is read: HUP, INT and TERM end it after its cycle from now on. A signal
/// that the parent had ignored, as nohup does, stays so. A reader of the progress that has gone
/// ends no run, and a file that may not grow is a failed write.
void catch_interrupts();

/// The scene's file with what --set changes.
/// @throws SceneError
SceneFile scene_file_of(const RunOptions& options);

/// The start of a run, or where it goes on.
/// @param file  scene_file_of(options)
/// @throws SceneError, StateError
Simulation simulation_of(const RunOptions& options, const SceneFile& file);

/// Where a run goes on from a state, which options.resume names.
/// @throws SceneError, StateError
Simulation simulation_of(const RunOptions& options, const SceneFile& file, State state);

/// Runs a scene, without its [sweep]; messages go to standard error.
/// @throws SceneError, StateError, OutputError  where the input is refused
/// @throws WriteError, std::filesystem::filesystem_error  where a result cannot be written
int run(const RunOptions& options, const SceneFile& file);

}  // namespace tangency::inline v0::dem
