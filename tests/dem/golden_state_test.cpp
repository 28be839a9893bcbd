// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdint>
#include <fstream>
#include <iostream>
#include <ostream>
#include <string>

#include <tangency/dem/parallel.hpp>

#include "../tool/process.hpp"
#include "golden_states.hpp"

namespace tangency::testing {
namespace {

/// The committed row of a run of this machine's arithmetic, without the kind; "" where there is
/// none.
std::string committed(const GoldenRun& run) {
  std::ifstream file(TANGENCY_TEST_DATA "/golden_states/states.csv");
  const std::string arithmetic = arithmetic_now().append(",");
  const std::string start = std::string(run.name).append(",");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(arithmetic) && line.compare(arithmetic.size(), start.size(), start) == 0)
      return line.substr(arithmetic.size());
  return "";
}

class GoldenState : public ::testing::TestWithParam<GoldenRun> {
 protected:
  void SetUp() override {
    // Where no row is of this processor's best arithmetic: the rows of every x86-64 processor.
    if (committed(run_).empty()) use_level(HWY_SSE4);
    if (committed(run_).empty()) use_level(HWY_SSSE3);
    if (committed(run_).empty())
      GTEST_SKIP()
          << "no row of tests/data/golden_states/states.csv is of this machine's arithmetic, "
          << arithmetic_now() << "; golden_states writes one";
  }
  void TearDown() override {
    use_level(0);
    dem::set_threads(0);
  }

  const GoldenRun& run_ = GetParam();
};

// dem/simulation.hpp (1)
TEST_P(GoldenState, IsTheCommittedOneAtEveryThreadCount) {
  for (const int threads : {1, 2, 4}) {
    dem::set_threads(threads);
    dem::Simulation simulation = start(run_);
    run_cycles(simulation, run_.cycles);
    EXPECT_EQ(row_of(run_, simulation), committed(run_)) << threads << " threads";
  }
}

TEST_P(GoldenState, IsTheCommittedOneOfEveryInstructionSet) {
  at_every_level([&](std::int64_t level) {
    if (committed(run_).empty()) {
      std::cout << "no row of " << arithmetic_now() << std::endl;
      return;
    }
    dem::Simulation simulation = start(run_);
    run_cycles(simulation, run_.cycles);
    EXPECT_EQ(row_of(run_, simulation), committed(run_)) << hwy::TargetName(level);
  });
}

// dem/simulation.hpp (1)
TEST_P(GoldenState, IsTheCommittedOneOfARunThatWasSavedAndResumed) {
  const TemporaryFolder folder;
  dem::Simulation first = start(run_);
  run_cycles(first, 3 * run_.cycles / 4);
  save_state(first.state(), folder.path("a.state"));
  dem::Simulation resumed(first.scene(), dem::load_state(folder.path("a.state")));
  run_cycles(resumed, run_.cycles - 3 * run_.cycles / 4);
  EXPECT_EQ(row_of(run_, resumed), committed(run_));
}

INSTANTIATE_TEST_SUITE_P(Runs, GoldenState, ::testing::ValuesIn(kGoldenRuns),
                         [](const auto& made) { return std::string(made.param.name); });

}  // namespace
}  // namespace tangency::testing
