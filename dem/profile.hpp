// SPDX-License-Identifier: MIT
/// @file
/// Where the time of a run's cycles goes.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tangency::inline v0::dem {

/// It never runs backwards.
using Clock = std::chrono::steady_clock;

/// Since a moment.
inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What a cycle is made of.
enum class Phase : std::size_t {
  motion,   ///< velocities, positions and orientations; with Fire
  bodies,   ///< the kernel's bodies at the new places
  list,     ///< is the neighbour list current, and where not, a new one
  gaps,     ///< signed gaps of the listed pairs
  law,      ///< forces and works of contacts
  sums,     ///< resultants of the particles, stress
  control,  ///< servos, thickness of the cell, the balance that growth waits for
};
inline constexpr std::size_t kPhases = 7;  ///< how many phases there are
/// "motion", as they are named above.
const char* name_of(Phase phase);

/// Of all cycles since it was made. Counts that nobody counts stay 0.
struct Profile {
  std::array<double, kPhases> seconds{};  ///< of the clock on the wall, by Phase
  std::int64_t cycles = 0;                ///< steps that were timed
  std::int64_t list_builds = 0;           ///< neighbour lists that were built
  std::int64_t listed_pairs = 0;          ///< summed over cycles, as all counts of pairs
  std::int64_t touching_pairs = 0;        ///< of the listed ones
  std::int64_t slow_pairs = 0;            ///< whose gap took more than the fast tier (GapTier)
  /// Of touching pairs by Branch::trace: those that the published scheme does not answer.
  std::int64_t unanswered_contacts = 0;

  /// Seconds of a phase.
  double& operator[](Phase phase) { return seconds[static_cast<std::size_t>(phase)]; }
  /// Seconds of a phase.
  double operator[](Phase phase) const { return seconds[static_cast<std::size_t>(phase)]; }
};

/// Adds the time of its scope to a phase. Without a profile it does not look at the clock.
class PhaseTimer {
 public:
  /// Counts until it is destroyed; of a null pointer, nothing.
  PhaseTimer(Profile* profile, Phase phase) : profile_(profile), phase_(phase) {
    if (profile_ != nullptr) start_ = Clock::now();
  }
  ~PhaseTimer() {
    if (profile_ != nullptr) (*profile_)[phase_] += seconds_since(start_);
  }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
  Profile* profile_;
  Phase phase_;
  Clock::time_point start_;
};

/// The most memory that this process has had so far, bytes.
std::int64_t peak_memory();

/// Names and values in the order in which they are reported, without phases and pairs of 0:
/// seconds of each phase as "motion_seconds", counts a cycle, and "peak_memory_bytes".
using ProfileEntry = std::pair<std::string, std::variant<std::int64_t, double>>;
/// As names, seconds and shares, the largest first.
std::vector<ProfileEntry> entries_of(const Profile& profile);

/// A table for people: a line a phase with its seconds, share and nanoseconds a listed pair and
/// cycle, then the counts. `cycle_seconds` is what all cycles took: what no phase has is a line of
/// its own.
std::string table_of(const Profile& profile, double cycle_seconds);

}  // namespace tangency::inline v0::dem
