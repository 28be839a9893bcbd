// SPDX-License-Identifier: MIT
#include <tangency/geometry/bindings/c/tangency.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tangency/geometry/bindings/c/instruction_set.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tangency::inline v0::c::HWY_NAMESPACE {
namespace {

HWY_ATTR const char* own_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace
}  // namespace tangency::inline v0::c::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tangency::inline v0::c {
namespace {

HWY_EXPORT(own_name);

}  // namespace
}  // namespace tangency::inline v0::c

extern "C" const char* tangency_instruction_set(void) {
  using namespace tangency::c;  // NOLINT(google-build-using-namespace)
  return HWY_DYNAMIC_DISPATCH(own_name)();
}
#endif
