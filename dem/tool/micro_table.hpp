// SPDX-License-Identifier: MIT
/// @file
/// What `tangency-dem micro` prints: the averages of a packing for a reader.
#pragma once

#include <string>

#include <tangency/dem/tool/micro_summary.hpp>

namespace tangency::inline v0::dem {

/// Lines of at most 100 characters; what is not defined is `-`.
std::string micro_table(const MicroSummary& summary);

}  // namespace tangency::inline v0::dem
