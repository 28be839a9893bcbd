// SPDX-License-Identifier: MIT
#include <tangency/version.hpp>

namespace tangency::inline v0 {

const char* version() noexcept { return TANGENCY_VERSION_STRING; }

}  // namespace tangency::inline v0
