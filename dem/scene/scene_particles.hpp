// SPDX-License-Identifier: MIT
/// @file
/// Reading a [particles.NAME] table of a scene.
#pragma once

#include <tangency/dem/samples/batches.hpp>
#include <tangency/dem/scene/scene_section.hpp>

namespace tangency::inline v0::dem {

/// The particles of one type, all of them with their shapes where these differ.
/// @param dimensions  2 or 3, of the scene
/// @throws SceneError  naming the key whose value is refused
Batch read_batch(const Section& section, int dimensions);

}  // namespace tangency::inline v0::dem
