// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Writes the rows of tests/data/golden_states/states.csv that this machine can: for its libm, with
/// every kind of arithmetic of the batch.
#include "golden_states.hpp"

#include <cstdint>
#include <cstdio>
#include <set>
#include <string>

int main() {
  using namespace tangency::testing;
  std::set<std::string> kinds;
  at_every_level([&](std::int64_t) {
    const std::string kind = kind_of_this_machine();
    if (!kinds.insert(kind).second) return;
    for (const GoldenRun& run : kGoldenRuns) {
      tangency::dem::Simulation simulation = start(run);
      run_cycles(simulation, run.cycles);
      std::printf("%s,%s\n", kind.c_str(), row_of(run, simulation).c_str());
    }
  });
}
