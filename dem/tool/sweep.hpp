// SPDX-License-Identifier: MIT
/// @file
/// Runs each combination of a scene's [sweep] in a folder of its own.
///
/// A folder is called by what its combination sets, and has `scene.toml`, the whole scene of the
/// combination. What is complete there is not run again, what was stopped goes on from its last
/// checkpoint, or anew without one; a folder whose scene is another one, or that has results
/// without a scene, is refused. With `after` the stages up to that one run once, in a folder of the
/// stage's name, and each combination goes on from their end.
#pragma once

#include <tangency/dem/scene/scene_file.hpp>
#include <tangency/dem/tool/run_options.hpp>

namespace tangency::inline v0::dem {

/// Writes DIR/sweep.csv, a row a combination that has run: its folder, its status as of a run, its
/// values and the numbers of its summary.json.
/// @param file  with a sweep, and with what --set changes
/// @return 0 where all are complete; 2 where the scene of one was refused; else 1 where one did not
///         reach its end; 128 + the signal that ended one, and so all
/// @throws as run(), and OutputError for folders of another scene
int sweep(const RunOptions& options, const SceneFile& file);

}  // namespace tangency::inline v0::dem
