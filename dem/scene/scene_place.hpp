// SPDX-License-Identifier: MIT
/// @file
/// How the bodies of a scene are placed: its stage of kind place, and its [[body]] tables.
#pragma once

#include <toml++/toml.h>

#include <string>

#include <tangency/dem/scene/scene_model.hpp>
#include <tangency/dem/scene/scene_section.hpp>

namespace tangency::inline v0::dem {

/// @param section     of a stage of kind place
/// @param scene       as far as it is read: cell and particles
/// @param has_shapes  does the table of bodies have their semi-axes?
/// @throws SceneError
Place read_place(const Section& section, const Scene& scene, bool has_shapes);

/// The scene's [[body]] tables, which an explicit arrangement without a file must have.
/// @param root   the tree of the scene's file
/// @param place  of the first stage, which the scene has
/// @throws SceneError
void read_bodies(const toml::table& root, const Source& source, const Section& place, Scene& scene);

/// Refuses a cell that has no room for the particles, or is too thin for them.
/// @param path   what messages call the stage
/// @param scene  with its first stage
/// @throws SceneError
void check_placement(const toml::table& root, const Source& source, const std::string& path,
                     const toml::table& stage, const Scene& scene);

}  // namespace tangency::inline v0::dem
