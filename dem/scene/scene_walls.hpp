// SPDX-License-Identifier: MIT
/// @file
/// The walls of a scene that stand at any angle, from its [[wall]] tables.
#pragma once

#include <toml++/toml.h>

#include <vector>

#include <tangency/dem/plane_wall.hpp>
#include <tangency/dem/scene/scene_model.hpp>
#include <tangency/dem/scene/scene_section.hpp>

namespace tangency::inline v0::dem {

/// @param root   the tree of the scene's file
/// @param scene  as far as it is read: the cell
/// @return none where the scene has no such table
/// @throws SceneError
std::vector<PlaneWall> read_walls(const toml::table& root, const Source& source,
                                  const Scene& scene);

/// A wall that goes further in a step passes a body, or throws it, before the two have met.
/// @param root   that of which the walls were read
/// @param scene  with its particles, contacts and stages
/// @throws SceneError  of a wall that may go so far
void check_walls(const toml::table& root, const Source& source, const Scene& scene);

}  // namespace tangency::inline v0::dem
