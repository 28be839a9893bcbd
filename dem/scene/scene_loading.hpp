// SPDX-License-Identifier: MIT
/// @file
/// How a stage of a scene moves, from its table.
#pragma once

#include <string>

#include <tangency/dem/scene/scene_model.hpp>
#include <tangency/dem/scene/scene_section.hpp>

namespace tangency::inline v0::dem {

/// @param scene  as far as it is read: cell, particles and contacts
/// @throws SceneError
Drive read_drive(const Section& section, const std::string& kind, const Scene& scene);

}  // namespace tangency::inline v0::dem
