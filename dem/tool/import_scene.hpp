// SPDX-License-Identifier: MIT
/// @file
/// A sample of another program as a table of bodies, and as the beginning of a scene that places
/// them. A scene knows a shape and a density a particle type: each kind of body, of equal type,
/// semi-axes and density, becomes a type of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <tangency/dem/tool/exchange_sample.hpp>

namespace tangency::inline v0::dem {

/// Kinds of bodies.
struct BodyKinds {
  struct Kind {
    std::string name;  ///< of letters, digits and _: that of the sample's type, numbered where the
                       ///< type has several kinds
    Vec3 semi_axes;    ///< in descending order
    double density;
    std::size_t count;
  };
  std::vector<Kind> kinds;
  std::vector<std::int32_t> of_body;
};

/// Turns body axes so that semi-axes descend; bodies whose do so already stay, to the bit.
Sample with_descending_axes(Sample sample);

/// @param sample  of descending semi-axes
BodyKinds kinds_of(const Sample& sample);

/// CSV with type (the kind), x, y, z, qw, qx, qy, qz, vx, vy, vz, wx, wy, wz, r1, r2, r3, density.
std::string body_table(const Sample& sample, const BodyKinds& kinds);

/// [cell], [particles.NAME] and the stage that places the table's bodies; [contact] and further
/// stages are the user's.
/// @param table  the name of the table's file, seen from the scene
/// @throws SceneError  of a tilted cell, or of more kinds than a scene takes
std::string scene_of(const Sample& sample, const BodyKinds& kinds, const std::string& source,
                     const std::string& table);

}  // namespace tangency::inline v0::dem
