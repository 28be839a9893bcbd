// SPDX-License-Identifier: MIT
#include <tangency/dem/lanes/instruction_set.hpp>

#include <atomic>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/dem/lanes/instruction_set.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::dem::HWY_NAMESPACE {
namespace {

HWY_ATTR const char* own_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace
}  // namespace tangency::inline v0::dem::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::dem {
namespace {

constexpr std::int64_t kWithoutFusedMultiplyAdds = HWY_SSSE3 | HWY_SSE4 | HWY_EMU128 | HWY_SCALAR;

std::atomic<bool> reproducible = false;

HWY_EXPORT(own_name);

}  // namespace

std::string instruction_set() { return HWY_DYNAMIC_DISPATCH(own_name)(); }

void use_reproducible_arithmetic() {
  hwy::DisableTargets(~kWithoutFusedMultiplyAdds);
  // Chosen here, by one thread: SupportedTargets() of Highway 1.0 itself chooses, and among all the
  // processor has, so that nothing may ask it between a choice and what is computed.
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  reproducible = true;
}

bool uses_reproducible_arithmetic() { return reproducible; }

}  // namespace tangency::inline v0::dem

namespace tangency::inline v0::detail {

void use_every_instruction_set() {
  hwy::DisableTargets(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  dem::reproducible = false;
}

}  // namespace tangency::inline v0::detail
#endif
