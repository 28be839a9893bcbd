// SPDX-License-Identifier: MIT
/// @file
/// What a person who waits for a run sees, on standard error.
#pragma once

#include <chrono>
#include <limits>
#include <string>

namespace tangency::dem {

/// On a terminal a bar that is drawn over itself; elsewhere a plain line now and then; or nothing.
/// The time left is what the fraction done took so far, carried on, and at most what the run has:
/// a guess.
class Progress {
 public:
  explicit Progress(bool quiet);

  /// Is it time to show something: the first time at once? Cheap: asked every cycle.
  bool is_due() const;

  /// @param fraction  of the whole run, in [0, 1]
  /// @param note      one short line: stage, cycle, stress
  /// @param most_left  seconds after which the run ends in any case
  void show(double fraction, const std::string& note,
            double most_left = std::numeric_limits<double>::infinity());

  /// Ends the bar's line. Call before other messages.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  bool quiet_;
  bool on_terminal_;
  bool bar_is_open_ = false;
  double first_fraction_ = -1.0;  ///< as first shown; below 0: nothing shown yet
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace tangency::dem
