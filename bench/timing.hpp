// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How every benchmark here takes times: in ns of processor time, the least of several runs, which
/// is what repeats on a machine that others use too; as ratios to the throughput of Eigen's 3x3
/// inverse over 1024 distinct matrices in cache, timed in the same run; and at one instruction set
/// after the other. Either by Google Benchmark, with --benchmark_enable_random_interleaving=true,
/// or by turns: so that a busy moment meets all alike.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tangency::bench {

inline constexpr std::size_t kInCache = 1024;

/// The batch calls use this instruction set of Highway alone from now on; 0: the best of the
/// machine.
void force_level(std::int64_t level);

/// Of what this machine and this build have, the best of AVX-512, of AVX2 and of the rest. Code
/// without vector instructions only where there is nothing else.
std::vector<std::int64_t> best_levels();

/// All pairs of something, to be timed by turns.
struct Job {
  std::function<void()> run;  ///< all pairs once
  std::size_t pairs;
  std::int64_t level = 0;                                  ///< in force while it runs
  double least = std::numeric_limits<double>::infinity();  ///< ns per pair
};

struct Effort {
  int rounds;       ///< in each of which every job has its turn
  double shortest;  ///< s of processor time in one turn: quick jobs run several times in it
  double enough;    ///< s of processor time after which a job takes part in no more than kAtLeast
};
inline constexpr int kAtLeast = 3;

/// Improves `least` of every job.
void time_by_turns(std::span<Job> jobs, const Effort& effort);

/// Eigen's inverse of the matrices in cache.
Job inverse_job();

/// For Benchmark::Apply.
void least_of_repetitions(benchmark::internal::Benchmark* benchmark);

/// Registers a benchmark of call(i) for i in 0 .. count - 1, over and over.
template <class Call>
benchmark::internal::Benchmark* add_calls(const std::string& name, std::size_t count,
                                          const Call& call) {
  return benchmark::RegisterBenchmark(name.c_str(),
                                      [count, call](benchmark::State& state) {
                                        std::size_t i = 0;
                                        for (auto _ : state) {
                                          benchmark::DoNotOptimize(call(i));
                                          if (++i == count) i = 0;
                                        }
                                      })
      ->Apply(least_of_repetitions);
}

/// Registers the inverse under the name "inverse".
void add_inverse();

/// Prints each time as a ratio to that of "inverse" when all is done.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  std::vector<std::pair<std::string, double>> times_;
};

}  // namespace tangency::bench
