// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/bench/speed_accuracy/timing.hpp>

#include <Eigen/Dense>
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <vector>

#include <tangency/bench/instruction_set.hpp>

namespace tangency::speed_accuracy {
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
  bench::force_level(job.level);
  const double first = time_of(job, 1);  // brings the pairs into the cache
  int times = 1;
  if (first < shortest) times = static_cast<int>(std::min(1e6, shortest / std::max(first, 1e-7)));
  times = std::max(times, 1);
  const double taken = time_of(job, times);
  bench::force_level(0);
  const auto answered = static_cast<double>(times) * static_cast<double>(job.pairs);
  job.least = std::min(job.least, 1e9 * taken / answered);
  return first + taken;
}

}  // namespace

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
  constexpr std::size_t kInCache = 1024;
  std::srand(1);  // Eigen's Random draws from it
  std::vector<Eigen::Matrix3d> matrices(kInCache);
  for (auto& m : matrices) m = Eigen::Matrix3d::Random();
  const auto run = [matrices] {
    for (const Eigen::Matrix3d& m : matrices) {
      const Eigen::Matrix3d inverse = m.inverse();
      benchmark::DoNotOptimize(inverse.data());
      benchmark::ClobberMemory();
    }
  };
  return {run, kInCache};
}

}  // namespace tangency::speed_accuracy
