// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Every instruction set that this machine and this build have.
#pragma once

#include <hwy/targets.h>

#include <cstdint>

namespace tangency::testing {

/// Calls run(name) with each of them chosen, the widest first, and chooses as usual after it. The
/// choice is the whole process's: nothing else may run.
/// @return  how many there are
template <class Run>
int for_each_instruction_set(const Run& run) {
  int count = 0;
  const auto choose = [](std::int64_t level) {
    hwy::SetSupportedTargetsForTest(level);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  };
  for (const std::int64_t level : hwy::SupportedAndGeneratedTargets()) {
    choose(level);
    run(hwy::TargetName(level));
    choose(0);
    ++count;
  }
  return count;
}

}  // namespace tangency::testing
