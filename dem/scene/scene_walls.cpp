// SPDX-License-Identifier: MIT
#include <tangency/dem/scene/scene_walls.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace tangency::inline v0::dem {
namespace {

/// Share of the smallest semi-axis that a wall may go in a time step. Chosen: the largest overlap
/// that is sound.
constexpr double kMostOfAStep = 0.1;

PlaneWall read_plane(const Section& section, const Scene& scene) {
  const Vec3 normal = *section.optional_real3("normal");
  if (normal.isZero(0.0)) section.fail("normal", "3 finite numbers, not all 0");
  for (int k = 0; k < 3; ++k)
    if (!scene.walled[static_cast<std::size_t>(k)] && normal[k] != 0.0)
      section.fail("normal", "0 along axes without walls in cell.walls");
  PlaneWall plane{normal.normalized(), 0.0,
                  section.optional_real3("velocity").value_or(Vec3::Zero())};
  plane.offset = plane.normal.dot(*section.optional_real3("point"));
  if (scene.dimensions == 2 && plane.velocity[2] != 0.0)
    section.fail("velocity", "with dimensions = 2 none along z");
  if (!section.has("stress")) {
    section.forbid("max_speed", "with stress alone");
    return plane;
  }
  if (!section.has("max_speed")) section.fail_missing("max_speed");
  plane.held = {section.real("stress"), section.real("max_speed")};
  return plane;
}

/// Of all shapes that the types have at the end of a stage.
double smallest_semi_axis(const Scene& scene) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t type = 0; type < scene.particle_types.size(); ++type)
    for (std::size_t k = 0; k <= scene.stages.size(); ++k)
      smallest =
          std::min(smallest, scene.shape_in(type, k, 0).semi_axes(scene.dimensions).minCoeff());
  for (const ParticleType& type : scene.particle_types)
    for (const Shape& shape : type.batch.shapes)
      smallest = std::min(smallest, shape.semi_axes(scene.dimensions).minCoeff());
  return smallest;
}

double longest_step(const Scene& scene) {
  double factor = 0.0;
  for (const Stage& stage : scene.stages)
    if (stage.drive) factor = std::max(factor, stage.drive->time_step_factor);
  return factor * scene.characteristic_time();
}

}  // namespace

std::vector<PlaneWall> read_walls(const toml::table& root, const Source& source,
                                  const Scene& scene) {
  const toml::node* node = root.get("wall");
  if (!node) return {};
  const toml::array& list = tables_of(source, *node, "wall");
  if (!scene.has_walls() || !scene.cell_size)
    source.fail(node->source(), "wall: in a cell with a size and walls of its own, cell.walls");
  std::vector<PlaneWall> walls;
  for (std::size_t k = 0; k < list.size(); ++k)
    walls.push_back(read_plane(section_of(source, list, "wall", k), scene));
  return walls;
}

void check_walls(const toml::table& root, const Source& source, const Scene& scene) {
  const double most = kMostOfAStep * smallest_semi_axis(scene) / longest_step(scene);
  const auto allowed = [&](const char* what) {
    return std::string(what) + " < " + short_text(most) + " (m/s), " + short_text(kMostOfAStep) +
           " of the smallest semi-axis in the longest time step";
  };
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const PlaneWall& plane = scene.planes[k];
    const Section section = section_of(source, *root.get("wall")->as_array(), "wall", k);
    if (plane.held && !(plane.held->max_speed < most))
      section.fail("max_speed", allowed("a finite number"));
    if (!plane.held && !(std::abs(plane.normal.dot(plane.velocity)) < most))
      section.fail("velocity", allowed("3 finite numbers, their part along the normal"));
  }
}

}  // namespace tangency::inline v0::dem
