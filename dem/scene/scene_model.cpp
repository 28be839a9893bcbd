// SPDX-License-Identifier: MIT
#include <tangency/dem/scene/scene_model.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <tangency/dem/scene/scene_error.hpp>

namespace tangency::inline v0::dem {

std::vector<Batch> Scene::batches() const {
  std::vector<Batch> all;
  for (std::size_t type = 0; type < particle_types.size(); ++type) {
    Batch& batch = all.emplace_back(particle_types[type].batch);
    const bool grows = batch.shape.elongation == 1.0 && batch.shape.flatness == 1.0;
    batch.directed_axis = directed_axis(grows ? shape_in(type, stages.size(), 0) : batch.shape);
  }
  return all;
}

std::size_t Scene::particle_count() const {
  std::size_t count = 0;
  for (const ParticleType& type : particle_types) count += type.batch.count;
  return count;
}

double Scene::smallest_mean_radius() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const ParticleType& type : particle_types)
    smallest = std::min(smallest, type.batch.radius_range()[0]);
  return smallest;
}

double Scene::characteristic_time() const {
  double lightest = std::numeric_limits<double>::infinity();
  for (const auto& [name, batch] : particle_types)
    lightest = std::min(lightest, batch.density * batch.least_volume(dimensions));
  return std::sqrt(lightest / laws.largest_stiffness());
}

double Scene::servo_strain_rate(double stress) const {
  constexpr double inertial_number = 0.05;  // Chosen: a collapse takes up to 20 times a test's rate
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [name, batch] : particle_types)
    least = std::min(least, std::sqrt(stress / batch.density) / (2.0 * batch.radius_range()[1]));
  return inertial_number * least;
}

double Scene::inertial_time(double stress) const {
  double most = 0.0;
  for (const auto& [name, batch] : particle_types)
    most = std::max(most, 2.0 * batch.shape.mean_radius * std::sqrt(batch.density));
  return most / std::sqrt(stress);
}

double Scene::held_stress(const Stage& stage) const {
  double most = stage.growth && stage.growth->ramp ? stage.growth->ramp->start : 0.0;
  for (const Target& target : stage.drive->loading.targets) most = std::max(most, target.wanted);
  for (const PlaneWall& plane : planes)
    if (plane.held) most = std::max(most, plane.held->stress);
  return most;
}

bool Scene::intends(const Stage& stage, const std::string& about) const {
  const auto has = [&](const std::vector<std::string>& list) {
    return std::find(list.begin(), list.end(), about) != list.end();
  };
  return has(intended) || has(stage.intended);
}

Placement Scene::placement() const {
  const Place& place = stages.front().place.value();
  return {cell_size,
          place.jitter * smallest_mean_radius(),
          place.seed,
          place.arrangement,
          place.bounding_fraction,
          dimensions,
          walled,
          bodies,
          place.axes,
          place.volume_fraction};
}

Shape Scene::shape_in(std::size_t type, std::size_t stage, std::int64_t increments) const {
  Shape shape = particle_types[type].batch.shape;
  for (std::size_t k = 0; k < stages.size() && k <= stage; ++k)
    if (const auto& growth = stages[k].growth)
      shape = growth->shape_after(shape, k < stage ? growth->increments : increments);
  return shape;
}

void set_bodies(Scene& scene, std::vector<Body> bodies, const std::string& name) {
  std::vector<std::size_t> counts(scene.particle_types.size(), 0);
  for (const Body& body : bodies) ++counts.at(body.type);
  for (std::size_t k = 0; k < counts.size(); ++k)
    if (const ParticleType& type = scene.particle_types[k]; counts[k] != type.batch.count)
      throw SceneError(name + ": " + std::to_string(counts[k]) + " bodies of type " + type.name +
                       ": as many as particles." + type.name + ".count, " +
                       std::to_string(type.batch.count));
  scene.bodies = std::move(bodies);
}

}  // namespace tangency::inline v0::dem
