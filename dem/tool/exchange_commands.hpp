// SPDX-License-Identifier: MIT
/// @file
/// tangency-dem export and tangency-dem import: samples to and from files of other programs.
#pragma once

#include <tangency/geometry/tables/command_line.hpp>

namespace tangency::inline v0::dem {

/// `export STATE --format F [--out FILE]`
void add_export(tables::Program& program);

/// `import FILE [--format F] [--frame N] [--out TABLE] [--scene SCENE]`
void add_import(tables::Program& program);

}  // namespace tangency::inline v0::dem
