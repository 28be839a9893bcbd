// SPDX-License-Identifier: MIT
#include <tangency/dem/scene/scene_place.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <utility>
#include <vector>

#include <tangency/dem/scene/scene_contacts.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Layers are for insertion, and bodies that stand in the scene or a file have their shapes
/// there.
void refuse_what_is_not_placed_so(const Section& section, const std::string& arrangement,
                                  const Scene& scene, bool has_shapes) {
  for (const auto& [name, batch] : scene.particle_types) {
    if (arrangement != "insertion" && batch.layer != std::array{0.0, 1.0})
      section.fail(section.has("arrangement") ? "arrangement" : "kind",
                   "arrangement = \"insertion\" with particles." + name + ".layer");
    if (arrangement == "explicit" && !batch.shapes.empty() && !has_shapes)
      section.fail("arrangement", "another: the bodies of particles." + name + " are not alike");
  }
}

StartAxes read_start_axes(const Section& section, int dimensions) {
  const std::string rule = section.text("axes");
  if (rule == "random") section.forbid("axes_direction", "not with axes = \"random\"");
  if (rule != "cone") section.forbid("axes_cone_deg", "with axes = \"cone\" alone");
  if (rule == "cone" && !section.has("axes_cone_deg")) section.fail_missing("axes_cone_deg");
  const Vec3 axial = Vec3::Unit(dimensions - 1);
  const Vec3 direction = section.optional_real3("axes_direction").value_or(axial);
  if (direction.isZero(0.0)) section.fail("axes_direction", "3 finite numbers, not all 0");
  if (dimensions == 2 && direction[2] != 0.0)
    section.fail("axes_direction", "with dimensions = 2 none along z");
  const double degrees = section.optional_real("axes_cone_deg").value_or(0.0);
  return {rule == "aligned" ? StartAxes::Rule::aligned
          : rule == "cone"  ? StartAxes::Rule::cone
          : rule == "plane" ? StartAxes::Rule::across
                            : StartAxes::Rule::random,
          direction, degrees * std::numbers::pi / 180.0};
}

Body read_body(const Section& section, const Scene& scene) {
  const auto type = type_named(scene, section.text("type"));
  if (!type || *type == scene.particle_types.size())
    section.fail("type", "a name of one of the scene's particle types");
  Body body{*type, *section.optional_real3("position")};
  for (int k = 0; k < 3 && scene.cell_size; ++k)
    if (!is_near_cell(body.position[k], (*scene.cell_size)[k]))
      section.fail("position", kNearTheCell);
  if (const auto q = section.optional_real4("orientation")) {
    if (q->isZero(0.0)) section.fail("orientation", "4 finite numbers, not all 0");
    if (scene.dimensions == 2 && ((*q)[1] != 0.0 || (*q)[2] != 0.0))
      section.fail("orientation", "with dimensions = 2 about z: x and y are 0");
    body.orientation = {(*q)[0], (*q)[1], (*q)[2], (*q)[3]};
  }
  body.velocity = section.optional_real3("velocity").value_or(Vec3::Zero());
  body.angular_velocity = section.optional_real3("angular_velocity").value_or(Vec3::Zero());
  if (scene.dimensions == 2) {
    if (body.position[2] != 0.0) section.fail("position", "with dimensions = 2 z is 0");
    if (body.velocity[2] != 0.0) section.fail("velocity", "with dimensions = 2 none along z");
    if (body.angular_velocity.head<2>() != Vec2::Zero())
      section.fail("angular_velocity", "with dimensions = 2 about z");
  }
  return body;
}

}  // namespace

Place read_place(const Section& section, const Scene& scene, bool has_shapes) {
  const std::string arrangement = section.text("arrangement");
  const auto only_of = [&](const char* one, std::initializer_list<const char*> keys) {
    for (const char* key : keys)
      if (arrangement != one)
        section.forbid(key, "with arrangement = \"" + std::string(one) + "\" alone");
  };
  only_of("lattice", {"jitter"});
  only_of("random", {"bounding_fraction"});
  only_of("insertion", {"volume_fraction"});
  if (scene.cell_size) section.forbid("volume_fraction", "without cell.size alone");
  only_of("explicit", {"file"});
  refuse_what_is_not_placed_so(section, arrangement, scene, has_shapes);
  if (arrangement == "explicit")
    for (const char* key : {"seed", "axes", "axes_direction", "axes_cone_deg"})
      section.forbid(key, "not with arrangement = \"explicit\"");
  const Place place{arrangement == "random"      ? Arrangement::random
                    : arrangement == "insertion" ? Arrangement::insertion
                    : arrangement == "explicit"  ? Arrangement::explicit_bodies
                                                 : Arrangement::lattice,
                    static_cast<std::uint64_t>(section.integer("seed")),
                    section.real("jitter"),
                    section.real("bounding_fraction"),
                    section.text("file", ""),
                    read_start_axes(section, scene.dimensions),
                    section.real("volume_fraction")};
  const double most = largest_bounding_fraction(scene.dimensions);
  if (place.bounding_fraction > most)
    section.fail("bounding_fraction", "a finite number > 0 and <= " + short_text(most) +
                                          " with dimensions = " + std::to_string(scene.dimensions));
  return place;
}

void read_bodies(const toml::table& root, const Source& source, const Section& place,
                 Scene& scene) {
  const bool wanted = scene.stages.front().place->arrangement == Arrangement::explicit_bodies &&
                      scene.stages.front().place->file.empty();
  const toml::node* node = root.get("body");
  if (!node && wanted) place.fail("arrangement", "with a file, or a list of [[body]] tables");
  if (!node) return;
  if (!wanted)
    source.fail(node->source(),
                "body: a place with arrangement = \"explicit\" and without a file has it");
  const toml::array& list = tables_of(source, *node, "body");
  std::vector<Body> bodies;
  for (std::size_t k = 0; k < list.size(); ++k)
    bodies.push_back(read_body(section_of(source, list, "body", k), scene));
  set_bodies(scene, std::move(bodies), source.at(node->source()));
}

void check_placement(const toml::table& root, const Source& source, const std::string& path,
                     const toml::table& stage, const Scene& scene) {
  try {
    check_room(scene.batches(), scene.placement());
    check_thickness(scene.batches(), scene.placement());
  } catch (const DoesNotFit& error) {
    const toml::node* size = root["cell"]["size"].node();
    if (size) source.fail(size->source(), "cell.size = " + text_of(*size) + ": " + error.what());
    source.fail(stage.source(), path + ": " + error.what());
  }
}

}  // namespace tangency::inline v0::dem
