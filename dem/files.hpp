// SPDX-License-Identifier: MIT
/// @file
/// Whole files: read at once, and written so that they appear whole or not at all.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace tangency::dem {

/// A file's bytes; nothing for one that cannot be read.
std::optional<std::string> read_whole(const std::filesystem::path& file);

/// Writes FILE.part and renames it: a failure leaves an old file as it was.
/// @throws std::runtime_error  naming the file that cannot be written
void write_whole(const std::filesystem::path& file, const std::string& bytes);

}  // namespace tangency::dem
