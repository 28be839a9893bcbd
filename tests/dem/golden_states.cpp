// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Writes the rows of tests/data/golden_states/states.csv that this machine can: with every kind of
/// arithmetic that it has.
#include "golden_states.hpp"

#include <cstdint>
#include <cstdio>
#include <set>
#include <string>

int main() {
  using namespace tangency::testing;
  std::set<std::string> seen;
  at_every_level([&](std::int64_t) {
    const std::string arithmetic = arithmetic_now();
    if (!seen.insert(arithmetic).second) return;
    for (const GoldenRun& run : kGoldenRuns) {
      tangency::dem::Simulation simulation = start(run);
      run_cycles(simulation, run.cycles);
      std::printf("%s,%s\n", arithmetic.c_str(), row_of(run, simulation).c_str());
    }
  });
}
