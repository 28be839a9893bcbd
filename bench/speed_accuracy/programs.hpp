// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Other programs, and a place for their files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tangency::speed_accuracy {

/// Empty at first; removed with everything in it.
class TemporaryFolder {
 public:
  /// @throws std::runtime_error
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// The path of a new file with this text.
  std::string add(const std::string& name, std::string_view text) const;

 private:
  std::filesystem::path path_;
};

/// As one word of the shell.
std::string shell_word(std::string_view word);

/// What a command of the shell wrote to its standard output.
/// @throws std::runtime_error  it cannot be started, or its status is not 0
std::string output_of(const std::string& command);

}  // namespace tangency::speed_accuracy
