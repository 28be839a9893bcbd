// SPDX-License-Identifier: GPL-3.0-or-later
// Linked with the objects of `tangency`: the same program at the one instruction set that every
// x86-64 of the last twenty years has, so that its answers are the same on all of them.
#include <hwy/targets.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

const bool kForced = [] {
  for (const std::int64_t level : hwy::SupportedAndGeneratedTargets()) {
    if (level != HWY_SSSE3) continue;
    hwy::SetSupportedTargetsForTest(level);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return true;
  }
  std::fputs("this build or this machine has no SSSE3\n", stderr);
  std::exit(2);
}();

}  // namespace
