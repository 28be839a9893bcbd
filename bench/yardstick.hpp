// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What every benchmark here reports: times as ratios to the throughput of Eigen's 3x3 inverse over
/// 1024 distinct matrices in cache, timed in the same run, each the least of several repetitions.
/// Run with --benchmark_enable_random_interleaving=true, so that a busy moment meets all alike.
#pragma once

#include <Eigen/Dense>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

namespace tangency::bench {

inline constexpr std::size_t kInCache = 1024;

/// The least of several runs is what repeats on a machine that others use too.
inline void least_of_repetitions(benchmark::internal::Benchmark* b) {
  b->MinTime(0.05)->Repetitions(15)->ReportAggregatesOnly(true)->ComputeStatistics(
      "min", [](const std::vector<double>& times) {
        return *std::min_element(times.begin(), times.end());
      });
}

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

/// Registers the yardstick under the name "inverse".
inline void add_inverse() {
  std::srand(1);  // Eigen's Random draws from it
  std::vector<Eigen::Matrix3d> matrices(kInCache);
  for (auto& m : matrices) m = Eigen::Matrix3d::Random();
  benchmark::RegisterBenchmark("inverse", [matrices](benchmark::State& state) {
    std::size_t i = 0;
    for (auto _ : state) {
      const Eigen::Matrix3d inverse = matrices[i].inverse();
      benchmark::DoNotOptimize(inverse.data());
      benchmark::ClobberMemory();
      if (++i == kInCache) i = 0;
    }
  })->Apply(least_of_repetitions);
}

/// Prints each time as a ratio to that of "inverse" when all is done.
class RatioReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Aggregate || run.aggregate_name != "min") continue;
      const bool real = !run.run_name.time_type.empty();  // several threads
      times_.emplace_back(run.run_name.function_name,
                          real ? run.GetAdjustedRealTime() : run.GetAdjustedCPUTime());
    }
  }
  void Finalize() override {
    double inverse = 0;
    for (const auto& [name, time] : times_) {
      if (name == "inverse") inverse = time;
    }
    if (inverse == 0) return;
    std::printf("\nratio to Eigen's 3x3 inverse (%.2f ns)\n", inverse);
    for (const auto& [name, time] : times_)
      std::printf("%-44s %8.1f x\n", name.c_str(), time / inverse);
  }

 private:
  std::vector<std::pair<std::string, double>> times_;
};

}  // namespace tangency::bench
