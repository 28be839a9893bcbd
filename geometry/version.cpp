// SPDX-License-Identifier: MIT
#include <tangency/version.hpp>

namespace tangency {

const char* version() noexcept { return TANGENCY_VERSION_STRING; }

}  // namespace tangency
