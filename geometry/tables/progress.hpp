// SPDX-License-Identifier: MIT
/// @file
/// A line on the terminal that says how far a long run is.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace tangency::tool {

/// Shows "pairs.csv: 45 %, 12 s left" on standard error and takes it away at the end. Shows nothing
/// unless standard error is a terminal and the input is a file of more than 4 MB.
class Progress {
 public:
  /// @param total_bytes  of the input, if known
  /// @param welcome      false where the line would disturb other output
  Progress(std::string input, std::optional<std::uint64_t> total_bytes, bool welcome);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param bytes  of the input that are done with
  void update(std::uint64_t bytes);
  /// Takes the line away, until the next update, so that a message can be written.
  void clear() noexcept;

 private:
  using Clock = std::chrono::steady_clock;

  std::string input_;
  double total_bytes_;
  bool enabled_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now();
  std::optional<Clock::time_point> last_shown_;
};

}  // namespace tangency::tool
