// SPDX-License-Identifier: MIT
/// @file
/// What a person who waits for a long run sees, on standard error.
#pragma once

#include <chrono>
#include <limits>
#include <optional>
#include <string>

namespace tangency::inline v0::tables {

/// On a terminal a bar that is drawn over itself; elsewhere a plain line now and then; or nothing.
/// The time left is what the fraction done took so far, carried on, and at most what the run has:
/// a guess.
class Progress {
 public:
  enum class Shown { nothing, on_terminal, everywhere };

  /// @param start  the fraction that is done now; that of the first show() where it is not known
  explicit Progress(Shown shown, std::optional<double> start = std::nullopt);
  /// Takes the bar away.
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Is it time to show something: the first time at once? Cheap: asked every cycle.
  bool is_due() const;

  /// @param fraction   of the whole run, in [0, 1]
  /// @param note       one short line: what is done
  /// @param most_left  seconds after which the run ends in any case
  void show(double fraction, const std::string& note,
            double most_left = std::numeric_limits<double>::infinity());

  /// Takes the bar away until the next show(), so that a message can be written.
  void clear() noexcept;
  /// Ends the bar's line, which stays above a message.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  bool on_terminal_;
  bool enabled_;
  bool bar_is_open_ = false;
  std::optional<double> first_fraction_;
  Clock::time_point start_ = Clock::now();
  std::optional<Clock::time_point> last_;
};

}  // namespace tangency::inline v0::tables
