// SPDX-License-Identifier: MIT
/// @file
/// tangency-dem check, as a command.
#pragma once

#include <tangency/geometry/tables/command_line.hpp>

namespace tangency::inline v0::dem {

/// Of --set, which `run` has too.
inline constexpr const char* kSetHelp =
    "Set a key of the scene, as contact.friction_coefficient=0.3, stage.NAME.KEY=VALUE or "
    "stage[2].KEY=VALUE; several between commas; any number of times";

/// Adds `check` to the program.
void add_check(tables::Program& program);

}  // namespace tangency::inline v0::dem
