// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The instruction sets that the batch calls choose from.
#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <string_view>
#include <vector>

namespace tangency::bench {

/// Only this one from now on; 0: the best of the machine.
inline void force_level(std::int64_t level) {
  hwy::SetSupportedTargetsForTest(level);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

/// Of what this machine and this build have, the best of AVX-512, of AVX2 and of the rest. Code
/// without vector instructions only where there is nothing else.
inline std::vector<std::int64_t> best_levels() {
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

}  // namespace tangency::bench
