// SPDX-License-Identifier: MIT
/// @file
/// From the tree of a scene's file to the scene.
#pragma once

#include <toml++/toml.h>

#include <tangency/dem/scene/scene_model.hpp>
#include <tangency/dem/scene/scene_section.hpp>

namespace tangency::inline v0::dem {

/// @param shapes  of a table of bodies that has their semi-axes
/// @throws SceneError  where the tree breaks the schema
Scene read_scene(const toml::table& root, const Source& source, const BodyShapes& shapes);

}  // namespace tangency::inline v0::dem
