// SPDX-License-Identifier: MIT
/// @file
/// What a scene calls its units: names for pages and tables, of no effect on a run. A scene that
/// names none has none, and nothing is made up for it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tangency::inline v0::dem {

/// Of length, stress and time, which [units] has. Force is stress times length^2 and energy stress
/// times length^3, so that a set is always consistent.
struct Units {
  std::string length, stress, time, force, energy;

  /// Each by what it is of, in this order: "length", "stress", "time", "force", "energy".
  std::vector<std::pair<std::string_view, std::string_view>> entries() const;
};

/// "mm" and "kPa" make "mN" and "uJ".
/// @returns  nothing where a name is not one that [units] may have
std::optional<Units> units_of(std::string_view length, std::string_view stress,
                              std::string_view time);

}  // namespace tangency::inline v0::dem
