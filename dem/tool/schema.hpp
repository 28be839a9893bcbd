// SPDX-License-Identifier: MIT
/// @file
/// The table of a scene's keys (scene_keys.hpp) in other forms than text.
#pragma once

#include <string>

namespace tangency::inline v0::dem {

/// An object with `schema` and `keys`, a list of `section, key, type, unit, required, default`
/// (null where there is none), `default_rule` (in words, or null), `minimum, maximum` (null where
/// there is none), `minimum_included, maximum_included, choices, stages` (kinds that have the key)
/// and `meaning`.
std::string schema_json();

/// A page: a table a section, and one a kind of stage. docs/scene-keys.md is it.
std::string schema_markdown();

}  // namespace tangency::inline v0::dem
