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

/// A file that cannot be written, on a full disk for one; what() is one line that starts with its
/// name.
class WriteError : public std::runtime_error {
 public:
  explicit WriteError(const std::filesystem::path& file)
      : std::runtime_error(file.string() + ": cannot be written") {}
};

/// Writes FILE.part and renames it: a failure leaves an old file as it was.
/// @throws WriteError
void write_whole(const std::filesystem::path& file, const std::string& bytes);

}  // namespace tangency::dem
