// SPDX-License-Identifier: MIT
#include <tangency/dem/scene/scene_contacts.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace tangency::inline v0::dem {
namespace {

bool is_contact_key(std::string_view name) {
  const auto keys = scene_keys();
  return std::any_of(keys.begin(), keys.end(),
                     [&](const Key& key) { return key.section == "contact" && key.name == name; });
}

/// The largest stiffness of a Hertz contact of two bodies with these curvatures at their flattest.
HertzContact stiffest(const Vec2& a, const Vec2& b, double overlap, const Material& material) {
  const double curvature[2] = {a[0] + b[0], a[1] + b[1]};
  return hertz_contact(curvature, overlap, material);
}

/// The least curvatures of a type's bodies at their flattest place, the end of the shortest axis,
/// where an ellipsoid has radii b^2/c and a^2/c; of a wall those of a sphere so large that it is
/// flat.
Vec2 flattest_of(const Scene& scene, std::size_t type) {
  const auto& types = scene.particle_types;
  if (type >= types.size()) return Vec2::Constant(1e-150);
  const Batch& batch = types[type].batch;
  Vec2 least = Vec2::Constant(std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < (batch.shapes.empty() ? 1 : batch.count); ++i) {
    const Vec3 axes = batch.shape_of(i).semi_axes(scene.dimensions);
    least = least.cwiseMin(Vec2(axes[2] / (axes[1] * axes[1]), axes[2] / (axes[0] * axes[0])));
  }
  return least;
}

/// The largest of its mean radii, of a wall infinite.
double radius_of(const Scene& scene, std::size_t type) {
  const auto& types = scene.particle_types;
  return type < types.size() ? types[type].batch.radius_range()[1]
                             : std::numeric_limits<double>::infinity();
}

ContactLaw law_of(const Scene& scene, const Section& section, std::size_t a, std::size_t b) {
  const double friction = section.real("friction_coefficient");
  const double cohesion = section.real("cohesion");
  const double damping = damping_ratio_of(section.real("restitution"));
  if (section.text("law") == "linear") {
    for (const char* key : {"young_modulus", "poisson_ratio", "largest_overlap"})
      section.forbid(key, "with law = \"hertz\" alone");
    if (!section.has("normal_stiffness")) section.fail_missing("normal_stiffness");
    const double normal = section.real("normal_stiffness");
    return {normal,   section.optional_real("shear_stiffness").value_or(normal),
            friction, cohesion,
            {},       damping};
  }
  if (scene.dimensions == 2)
    section.fail("law", "with dimensions = 2 linear: Hertz has no overlap of disks");
  for (const char* key : {"normal_stiffness", "shear_stiffness"})
    section.forbid(key, "with law = \"linear\" alone");
  if (!section.has("young_modulus")) section.fail_missing("young_modulus");
  const Material material{section.real("young_modulus"), section.real("poisson_ratio")};
  const double smaller = std::min(radius_of(scene, a), radius_of(scene, b));
  const HertzContact most = stiffest(flattest_of(scene, a), flattest_of(scene, b),
                                     section.real("largest_overlap") * smaller, material);
  return {most.stiffness, std::max(most.shear_stiffness[0], most.shear_stiffness[1]),
          friction,       cohesion,
          material,       damping};
}

bool are_walls(const Scene& scene, std::size_t a, std::size_t b) {
  return std::min(a, b) == scene.particle_types.size();
}

std::string type_name(const Scene& scene, std::size_t type) {
  const auto& types = scene.particle_types;
  return type < types.size() ? types[type].name : std::string(kWallName);
}

/// [contact.a-b] and [contact.b-a] are one law: of the two, refuses that of the later line.
void refuse_second_law(const Source& source, const toml::table& contact, const toml::key& name,
                       std::string_view b, std::string_view a) {
  const std::string reversed = std::string(b) + "-" + std::string(a);
  const auto other = contact.find(reversed);
  if (a == b || other == contact.end()) return;
  const auto line = [](const toml::key& key) { return key.source().begin.line; };
  const bool first = line(name) < line(other->first);
  const toml::key& second = first ? other->first : name;
  source.fail(second.source(), "contact." + std::string(second.str()) + ": a second law for " +
                                   "the two types of contact." +
                                   std::string((first ? name : other->first).str()) +
                                   "; one is allowed");
}

}  // namespace

std::optional<std::size_t> type_named(const Scene& scene, std::string_view name) {
  const auto& types = scene.particle_types;
  for (std::size_t k = 0; k < types.size(); ++k)
    if (types[k].name == name) return k;
  if (scene.has_walls() && name == kWallName) return types.size();
  return std::nullopt;
}

ContactLaws read_contacts(const toml::table& contact, const Source& source, const Scene& scene) {
  const std::size_t types = scene.particle_types.size() + (scene.has_walls() ? 1 : 0);
  std::vector<std::optional<ContactLaw>> laws(types * types);
  const bool common = std::any_of(contact.begin(), contact.end(), [](const auto& entry) {
    return !entry.second.is_table() || is_contact_key(entry.first.str());
  });
  if (common || contact.empty()) {
    const Section section(source, contact, "contact", "contact");
    for (std::size_t k = 0; k < laws.size(); ++k)
      if (!are_walls(scene, k / types, k % types))
        laws[k] = law_of(scene, section, k / types, k % types);
  }
  for (const auto& [name, node] : contact) {
    if (!node.is_table()) continue;
    const std::string_view pair = name.str();
    const std::size_t dash = std::min(pair.find('-'), pair.size());
    const auto a = type_named(scene, pair.substr(0, dash));
    const auto b = type_named(scene, pair.substr(std::min(dash + 1, pair.size())));
    const std::string path = "contact." + std::string(pair);
    if (!a || !b || are_walls(scene, *a, *b))
      source.fail(name.source(), path + ": NAME-NAME of two of the scene's particle types" +
                                     (scene.has_walls() ? ", or of one and wall" : ""));
    refuse_second_law(source, contact, name, pair.substr(dash + 1), pair.substr(0, dash));
    const Section section(source, *node.as_table(), path, "contact", {}, &contact);
    laws[*a * types + *b] = laws[*b * types + *a] = law_of(scene, section, *a, *b);
  }
  ContactLaws all;
  all.types = types;
  for (std::size_t k = 0; k < laws.size(); ++k) {
    if (are_walls(scene, k / types, k % types)) laws[k] = laws.front();  // no two walls meet
    if (!laws[k])
      source.fail(contact.source(),
                  "contact." + type_name(scene, k / types) + "-" + type_name(scene, k % types) +
                      " is missing: a law for every two types, or one in [contact] for all");
    all.law.push_back(*laws[k]);
  }
  return all;
}

}  // namespace tangency::inline v0::dem
