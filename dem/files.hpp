// SPDX-License-Identifier: MIT
/// @file
/// Whole files: read at once, and written so that they appear whole or not at all.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

namespace tangency::dem {

/// A file's bytes; nothing for one that cannot be read.
std::optional<std::string> read_whole(const std::filesystem::path& file);

/// A file that cannot be written; what() is one line, "out/history.csv: cannot be written: No space
/// left on device".
class WriteError : public std::runtime_error {
 public:
  /// @param problem  the system's error number; 0: not known
  WriteError(const std::filesystem::path& file, int problem);
};

/// Writes FILE.part and renames it: a failure leaves an old file as it was.
/// @throws WriteError
void write_whole(const std::filesystem::path& file, const std::string& bytes);

}  // namespace tangency::dem
