// SPDX-License-Identifier: MIT
/// @file
/// How a stage of a scene grows its particles, from its table.
#pragma once

#include <tangency/dem/growth.hpp>
#include <tangency/dem/scene/scene_model.hpp>
#include <tangency/dem/scene/scene_section.hpp>

namespace tangency::inline v0::dem {

/// @param scene  as far as it is read: particles, and stages up to this one, which is the last and
///               has no growth yet
/// @throws SceneError
Growth read_growth(const Section& section, const Scene& scene);

}  // namespace tangency::inline v0::dem
