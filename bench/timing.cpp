// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/timing.hpp>

#include <Eigen/Dense>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string_view>

namespace tangency::bench {
namespace {

/// Of this thread, in s.
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double time_of(const Job& job, int times) {
  const double start = processor_time();
  for (int i = 0; i < times; ++i) {
    job.run();
    benchmark::ClobberMemory();
  }
  return processor_time() - start;
}

/// One turn of a job. @return s that it took
double take_turn(Job& job, double shortest) {
  force_level(job.level);
  const double first = time_of(job, 1);  // brings the pairs into the cache
  int times = 1;
  if (first < shortest) times = static_cast<int>(std::min(1e6, shortest / std::max(first, 1e-7)));
  times = std::max(times, 1);
  const double taken = time_of(job, times);
  force_level(0);
  const auto answered = static_cast<double>(times) * static_cast<double>(job.pairs);
  job.least = std::min(job.least, 1e9 * taken / answered);
  return first + taken;
}

std::vector<Eigen::Matrix3d> matrices_in_cache() {
  std::srand(1);  // Eigen's Random draws from it
  std::vector<Eigen::Matrix3d> matrices(kInCache);
  for (auto& m : matrices) m = Eigen::Matrix3d::Random();
  return matrices;
}

void invert(const Eigen::Matrix3d& matrix) {
  const Eigen::Matrix3d inverse = matrix.inverse();
  benchmark::DoNotOptimize(inverse.data());
  benchmark::ClobberMemory();
}

}  // namespace

void force_level(std::int64_t level) {
  hwy::SetSupportedTargetsForTest(level);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

std::vector<std::int64_t> best_levels() {
  std::vector<std::int64_t> best;
  const auto kind_of = [](std::int64_t level) {
    const std::string_view name = hwy::TargetName(level);
    return name.starts_with("AVX3") ? 3 : name == "AVX2" ? 2 : 1;
  };
  for (const std::int64_t level : hwy::SupportedAndGeneratedTargets()) {
    if (best.empty() || kind_of(level) != kind_of(best.back())) best.push_back(level);
  }
  return best;
}

void time_by_turns(std::span<Job> jobs, const Effort& effort) {
  std::vector<double> spent(jobs.size());
  for (int round = 0; round < effort.rounds; ++round) {
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      if (round < kAtLeast || spent[i] < effort.enough)
        spent[i] += take_turn(jobs[i], effort.shortest);
    }
  }
}

Job inverse_job() {
  return {[matrices = matrices_in_cache()] {
            for (const Eigen::Matrix3d& m : matrices) invert(m);
          },
          kInCache};
}

void least_of_repetitions(benchmark::internal::Benchmark* benchmark) {
  benchmark->MinTime(0.05)->Repetitions(15)->ReportAggregatesOnly(true)->ComputeStatistics(
      "min", [](const std::vector<double>& times) {
        return *std::min_element(times.begin(), times.end());
      });
}

void add_inverse() {
  benchmark::RegisterBenchmark("inverse", [matrices =
                                               matrices_in_cache()](benchmark::State& state) {
    std::size_t i = 0;
    for (auto _ : state) {
      invert(matrices[i]);
      if (++i == kInCache) i = 0;
    }
  })->Apply(least_of_repetitions);
}

void RatioReporter::ReportRuns(const std::vector<Run>& runs) {
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Aggregate || run.aggregate_name != "min") continue;
    const bool real = !run.run_name.time_type.empty();  // several threads
    times_.emplace_back(run.run_name.function_name,
                        real ? run.GetAdjustedRealTime() : run.GetAdjustedCPUTime());
  }
}

void RatioReporter::Finalize() {
  double inverse = 0;
  for (const auto& [name, time] : times_) {
    if (name == "inverse") inverse = time;
  }
  if (inverse == 0) return;
  std::printf("\nratio to Eigen's 3x3 inverse (%.2f ns)\n", inverse);
  for (const auto& [name, time] : times_)
    std::printf("%-44s %8.1f x\n", name.c_str(), time / inverse);
}

}  // namespace tangency::bench
