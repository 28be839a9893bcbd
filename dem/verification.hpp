// SPDX-License-Identifier: MIT
/// @file
/// A run that is checked while it goes on, `tangency-dem run --verify`: contacts against the exact
/// relation and neighbours against all pairs (contact_check.hpp), what is measured against a second
/// count (recount.hpp), and the account of energy against its bound.
///
/// (1) A check changes nothing: the states of a run are the same with and without it, to the bit.
/// (2) The answers of a check do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <tangency/dem/profile.hpp>
#include <tangency/dem/simulation.hpp>
#include <tangency/dem/verification/contact_check.hpp>
#include <tangency/dem/work_done.hpp>

namespace tangency::inline v0::dem {

/// A check and a state that disagree; what() is one line with the cycle, the pair (particles by
/// their ids) and both answers.
class VerificationFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What has been checked so far.
struct Verified {
  CheckCounts pairs;                  ///< summed over the states looked at
  std::int64_t states = 0;            ///< that were looked at
  std::int64_t recounts = 0;          ///< of what is measured
  double largest_energy_error = 0.0;  ///< of any state, over the work done until then
};

/// Names and values in the order in which they are reported.
std::vector<ProfileEntry> entries_of(const Verified& verified);

/// One line for people.
std::string text_of(const Verified& verified);

/// Checks the states of one run, one after the other.
class Verification {
 public:
  /// Of the error of the energy account over what went through it and moves. Chosen: a run warns
  /// from 0.02 on that its step is too long; ten times that is an account that is wrong. What moves
  /// counts with the strain of the cell: a contact begins within a step of length v dt, of which
  /// the work by mean forces is off by K (v dt)^2 / 8 at most, f^2 / 8 m v^2 with the
  /// time_step_factor f <= 0.3.
  static constexpr double kMostEnergyError = 0.2;

  /// Bodies a state whose neighbours are looked for among all. Chosen: with the rest of the checks
  /// a cycle takes less than three times as long (docs/runs.md).
  static constexpr std::size_t kSearchedBodies = 8;

  /// Looks at the contacts of the state, at the neighbours of kSearchedBodies bodies by turns, and
  /// at the energy.
  /// @throws VerificationFault  the first by the order of pairs; counts() has them all
  void check(const Simulation& simulation);

  /// Counts again what is measured.
  /// `with_laws` is as for difference_from_recount().
  /// @throws VerificationFault
  void recount(const Simulation& simulation, bool with_laws);

  /// So far, what was found included.
  const Verified& verified() const { return verified_; }

 private:
  void check_energy(const Simulation& simulation);

  ContactCheck contacts_;
  WorkDone work_;
  double most_motion_ = 0.0;  ///< of any state so far: energy, the strain's included
  Verified verified_;
};

}  // namespace tangency::inline v0::dem
