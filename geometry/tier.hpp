// SPDX-License-Identifier: MIT
/// @file
/// Which tier of a predicate gave an answer. Both give the same one: the filter answers only where
/// a proven error bound leaves no doubt, everything else goes to exact arithmetic.
#pragma once

#include <string_view>

namespace tangency {

enum class Tier { filter, exact };

/// "filter" or "exact", as the file formats write it.
constexpr std::string_view to_string(Tier tier) noexcept {
  return tier == Tier::filter ? "filter" : "exact";
}

}  // namespace tangency
