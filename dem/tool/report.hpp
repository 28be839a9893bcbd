// SPDX-License-Identifier: MIT
/// @file
/// tangency-dem report.
#pragma once

#include <filesystem>

namespace tangency::inline v0::dem {

/// Prints a table of the stages that a run's directory has rows of, and writes report.html there.
/// The run need not be complete.
/// @return what the program returns
/// @throws tables::Error, OutputError  where the directory is not one of a run
/// @throws WriteError
int report(const std::filesystem::path& directory);

}  // namespace tangency::inline v0::dem
