// SPDX-License-Identifier: MIT
/// @file
/// Reads a scene: scene_keys.hpp has the keys and what they may be.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tangency/dem/particles.hpp>
#include <tangency/dem/scene/scene_error.hpp>
#include <tangency/dem/scene/scene_model.hpp>

namespace tangency::inline v0::dem {

/// @throws SceneError  for a file that cannot be read, is no TOML or breaks the schema
Scene load_scene(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
Scene parse_scene(const std::string& text, const std::string& name);

}  // namespace tangency::inline v0::dem
