// SPDX-License-Identifier: MIT
/// @file
/// The laws of a scene's contacts, from its table [contact] or its tables [contact.NAME-NAME].
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <optional>
#include <string_view>

#include <tangency/dem/contact/contact_laws.hpp>
#include <tangency/dem/scene/scene_model.hpp>
#include <tangency/dem/scene/scene_section.hpp>

namespace tangency::inline v0::dem {

/// What walls are called in [contact.NAME-NAME].
inline constexpr std::string_view kWallName = "wall";

/// The index of a particle type, of "wall" in a walled cell the one after them.
std::optional<std::size_t> type_named(const Scene& scene, std::string_view name);

/// @param contact  the table [contact]
/// @param scene    as far as it is read: cell and particles
/// @return a law for every two types
/// @throws SceneError
ContactLaws read_contacts(const toml::table& contact, const Source& source, const Scene& scene);

}  // namespace tangency::inline v0::dem
