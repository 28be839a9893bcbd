// SPDX-License-Identifier: MIT
#include <tangency/dem/scene/units.hpp>

#include <array>
#include <cstddef>

namespace tangency::inline v0::dem {
namespace {

/// Prefixes of SI, each a thousand times the one before.
constexpr std::array<std::string_view, 10> kPrefixes{"a", "f", "p", "n", "u",
                                                     "m", "",  "k", "M", "G"};
constexpr int kNoPrefix = 6;

/// The power of a thousand of a unit with a prefix.
std::optional<int> thousands(std::string_view name, std::string_view unit) {
  if (!name.ends_with(unit)) return std::nullopt;
  name.remove_suffix(unit.size());
  for (std::size_t k = 0; k < kPrefixes.size(); ++k)
    if (kPrefixes[k] == name) return static_cast<int>(k) - kNoPrefix;
  return std::nullopt;
}

/// @returns  nothing where no prefix is for it
std::optional<std::string> named(int power, const char* unit) {
  const int place = power + kNoPrefix;
  if (place < 0 || place >= static_cast<int>(kPrefixes.size())) return std::nullopt;
  return std::string(kPrefixes[static_cast<std::size_t>(place)]) + unit;
}

}  // namespace

std::vector<std::pair<std::string_view, std::string_view>> Units::entries() const {
  return {
      {"length", length}, {"stress", stress}, {"time", time}, {"force", force}, {"energy", energy}};
}

std::optional<Units> units_of(std::string_view length, std::string_view stress,
                              std::string_view time) {
  const auto of_length = thousands(length, "m"), of_stress = thousands(stress, "Pa");
  if (!of_length || !of_stress || !thousands(time, "s")) return std::nullopt;
  const auto force = named(*of_stress + 2 * *of_length, "N");
  const auto energy = named(*of_stress + 3 * *of_length, "J");
  if (!force || !energy) return std::nullopt;
  return Units{std::string(length), std::string(stress), std::string(time), *force, *energy};
}

}  // namespace tangency::inline v0::dem
