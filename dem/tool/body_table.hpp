// SPDX-License-Identifier: MIT
/// @file
/// The table of bodies that an explicit arrangement may name.
#pragma once

#include <filesystem>

#include <tangency/dem/scene.hpp>
#include <tangency/dem/scene/scene_file.hpp>

namespace tangency::inline v0::dem {

/// Reads the table that the scene's place names, if it names one, from beside the scene: CSV with
/// the columns type, x, y, z and, each group all or none, qw, qx, qy, qz; vx, vy, vz; wx, wy, wz.
///
/// A table may have the semi-axes of its bodies: in space in one of the forms of
/// geometry/tool/body_columns.hpp but a quadric, in the plane as r1, r2. Types whose bodies are
/// then not all as the scene says have these shapes, to rounding, and the scene is read again with
/// them.
/// @param scene  of that source
/// @throws SceneError  "bodies.csv:3: type = p: ..."
void read_bodies(Scene& scene, const SceneFile& source, const std::filesystem::path& scene_file);

}  // namespace tangency::inline v0::dem
