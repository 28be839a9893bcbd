// SPDX-License-Identifier: MIT
#include <tangency/dem/scene/scene_growth.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Chosen: a larger change of shape throws neighbours about that no relaxation brings back.
constexpr double kMostGrowthOfAnIncrement = 0.01;

/// An end given as an elongation is an eccentricity but for rounding.
constexpr double kRounding = 1e-12;

/// Of a type, before the last stage so far.
Shape shape_before(const Scene& scene, std::size_t type) {
  return scene.shape_in(type, scene.stages.size() - 1, 0);
}

double eccentricity_before(const Scene& scene, std::size_t type) {
  return eccentricity_of(shape_before(scene, type).elongation);
}

/// Growth by so many cycles a per cent.
void read_rate(const Section& section, const Scene& scene, Growth& growth) {
  growth.cycles_per_percent = section.optional_integer("cycles_per_percent");
  if (!growth.cycles_per_percent) return;
  if (!growth.by_eccentricity) section.fail("cycles_per_percent", "with an eccentricity alone");
  section.forbid("increments", "not together with cycles_per_percent");
  const double last = section.real("eccentricity");
  double most = 0.0;
  for (std::size_t type = 0; type < scene.particle_types.size(); ++type)
    most = std::max(most, std::abs(last - eccentricity_before(scene, type)));
  if (most == 0.0)
    section.fail("cycles_per_percent", "with an eccentricity that the particles do not have yet");
  growth.increments = increments_at(*growth.cycles_per_percent, most);
}

/// @param last  the eccentricity at the end
std::optional<StressRamp> read_ramp(const Section& section, const Scene& scene, double last) {
  for (const auto& [one, other] : {std::pair("mean_stress_start", "ramp_eccentricity"),
                                   std::pair("ramp_eccentricity", "mean_stress_start")})
    if (section.has(one) && !section.has(other))
      section.fail(one, std::string("together with ") + other);
  if (!section.has("ramp_eccentricity")) return std::nullopt;
  const StressRamp ramp{section.real("mean_stress_start"), section.real("ramp_eccentricity")};
  const double first = eccentricity_before(scene, 0), way = last - first;
  if (way == 0.0) section.fail("ramp_eccentricity", "with an eccentricity that changes");
  const double share = (ramp.eccentricity - first) / way;
  const auto text = [](double x) { return tables::rounded_text(x, 6); };
  if (!(share > 0.0 && share <= 1.0 + kRounding))
    section.fail("ramp_eccentricity", std::string("a finite number ") + (way > 0.0 ? "> " : "< ") +
                                          text(first) + (way > 0.0 ? " and <= " : " and >= ") +
                                          text(last) + ", on the way of the first type's");
  return ramp;
}

/// Of any type's semi-axes in one increment.
double largest_change(const Scene& scene, const Growth& growth) {
  double largest = 0.0;
  for (std::size_t type = 0; type < scene.particle_types.size(); ++type)
    largest = std::max(largest, growth.largest_change(shape_before(scene, type), scene.dimensions));
  return largest;
}

/// Says how many would do.
[[noreturn]] void refuse_increments(const Section& section, const Scene& scene,
                                    const Growth& growth) {
  const std::int64_t given = growth.cycles_per_percent.value_or(growth.increments);
  Growth enough = growth;
  std::int64_t more = given;
  while (largest_change(scene, enough) > kMostGrowthOfAnIncrement) {
    more += (more + 99) / 100;
    enough.increments = growth.increments * more / given;
  }
  section.refuse(growth.cycles_per_percent ? "cycles_per_percent" : "increments", given,
                 std::to_string(more) + " or more: an increment would change a semi-axis by " +
                     short_text(largest_change(scene, growth)) + " of itself, and at most " +
                     short_text(kMostGrowthOfAnIncrement) + " is allowed");
}

}  // namespace

Growth read_growth(const Section& section, const Scene& scene) {
  for (const auto& [name, batch] : scene.particle_types)
    if (!batch.shapes.empty())
      section.fail("kind", "none that grows: the bodies of particles." + name + " are not alike");
  const auto e = section.optional_real("eccentricity");
  if (e)
    section.forbid("elongation", "not together with eccentricity");
  else if (!section.has("elongation"))
    section.fail_missing("elongation");
  Growth growth{e ? elongation_of(*e) : section.real("elongation"),
                section.optional_real("flatness"), section.integer("increments"),
                section.real("max_inertial_fraction"), e.has_value()};
  read_rate(section, scene, growth);
  growth.ramp = read_ramp(section, scene, eccentricity_of(growth.elongation));
  if (largest_change(scene, growth) > kMostGrowthOfAnIncrement)
    refuse_increments(section, scene, growth);
  return growth;
}

}  // namespace tangency::inline v0::dem
