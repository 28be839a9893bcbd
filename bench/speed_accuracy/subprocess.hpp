// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Other programs, and a place for their files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

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

 private:
  std::filesystem::path path_;
};

/// Runs a program of the PATH to its end, its outputs being ours.
/// @param words  its name and its arguments
/// @throws std::runtime_error  it cannot be started, or its status is not 0
void run_program(std::vector<std::string> words);

}  // namespace tangency::speed_accuracy
