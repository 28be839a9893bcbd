// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Times by turns: every job is timed in every round, so that a busy moment meets all alike, and
/// the least time of a job is what repeats on a machine that others use too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>

namespace tangency::speed_accuracy {

struct Job {
  std::function<void()> run;  ///< all pairs once
  std::size_t pairs;
  std::int64_t level = 0;  ///< in force while it runs: bench/instruction_set.hpp
  double least = std::numeric_limits<double>::infinity();  ///< ns per pair
};

struct Effort {
  int rounds;
  double shortest;  ///< s of processor time in one round: quick jobs run several times in it
  double enough;    ///< s of processor time after which a job takes part in no more than kAtLeast
};
inline constexpr int kAtLeast = 3;

/// Improves `least` of every job.
void time_by_turns(std::span<Job> jobs, const Effort& effort);

/// The yardstick of all benchmarks here: Eigen's inverse of 1024 distinct 3x3 matrices in cache.
Job inverse_job();

}  // namespace tangency::speed_accuracy
