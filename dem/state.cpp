// SPDX-License-Identifier: MIT
#include <tangency/dem/state.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Relative difference of two descriptions of one particle: the semi-axes of another machine's
/// libm are a few roundings off. Chosen: far below any change that someone makes.
constexpr double kSameRelatively = 1e-9;

void require_equal(const std::string& key, double in_state, double in_scene) {
  if (std::abs(in_state - in_scene) <= kSameRelatively * in_scene) return;
  throw std::invalid_argument("a state with " + key + " = " + tables::rounded_text(in_state, 10) +
                              "; the scene has " + tables::rounded_text(in_scene, 10));
}

/// Of a type whose bodies are not alike.
/// @throws std::invalid_argument  where those of the state are others
void require_same_shapes(const Particles& particles, std::size_t type, const ParticleType& wanted) {
  std::vector<std::array<double, 3>> is, was;
  const auto add = [](auto& all, const Vec3& axes) { all.push_back({axes[0], axes[1], axes[2]}); };
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (static_cast<std::size_t>(particles.type[i]) == type) add(was, particles.semi_axes[i]);
  for (const Shape& shape : wanted.batch.shapes) add(is, shape.semi_axes(particles.dimensions));
  std::sort(is.begin(), is.end());
  std::sort(was.begin(), was.end());
  for (std::size_t i = 0; i < is.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      require_equal("a semi-axis of particles." + wanted.name, was[i][k], is[i][k]);
}

/// @throws std::invalid_argument  naming the first key of the scene that the particles are not of
void require_same_particles(const State& state, const Scene& scene) {
  const Particles& particles = state.particles;
  const std::vector<ParticleType>& types = scene.particle_types;
  require_equal("cell.dimensions", state.cell.dimensions, scene.dimensions);
  if (state.cell.walled != scene.walled)
    throw std::invalid_argument("a state with other cell.walls than the scene");
  require_equal("wall tables", static_cast<double>(state.cell.planes.size()),
                static_cast<double>(scene.planes.size()));
  const auto count = static_cast<std::int32_t>(types.size());
  std::vector<std::size_t> counts(types.size(), 0);
  for (const std::int32_t type : particles.type) {
    if (type < 0 || type >= count)
      throw std::invalid_argument("a state with more particle types than the scene's " +
                                  std::to_string(count));
    ++counts[static_cast<std::size_t>(type)];
  }
  for (std::size_t k = 0; k < types.size(); ++k)
    require_equal("particles." + types[k].name + ".count", static_cast<double>(counts[k]),
                  static_cast<double>(types[k].batch.count));
  for (const std::uint32_t i : particles.index_of_id()) {
    const auto type = static_cast<std::size_t>(particles.type[i]);
    const auto& [name, batch] = types[type];
    const Shape shape = scene.shape_in(type, state.stage, state.increments);
    const Vec3& axes = particles.semi_axes[i];
    const std::string path = "particles." + name;
    const int dimensions = scene.dimensions;
    require_equal(path + ".density", particles.mass[i] / volume_of(axes, dimensions),
                  batch.density);
    if (!batch.shapes.empty()) continue;
    require_equal(path + ".mean_radius", mean_radius_of(axes, dimensions), shape.mean_radius);
    require_equal(path + ".elongation", axes[0] / axes[1], shape.elongation);
    require_equal(path + ".flatness", axes[1] / axes[2], shape.flatness);
  }
  for (std::size_t k = 0; k < types.size(); ++k)
    if (!types[k].batch.shapes.empty()) require_same_shapes(particles, k, types[k]);
}

std::string short_text(double x) { return tables::rounded_text(x, 6); }

std::string short_text(const Vec3& v) {
  return "[ " + short_text(v[0]) + ", " + short_text(v[1]) + ", " + short_text(v[2]) + " ]";
}

std::string wall_key(std::size_t k, const std::string& key) {
  return "wall[" + std::to_string(k) + "]." + key;
}

/// @throws std::invalid_argument  naming the first wall that has another normal
void require_same_normals(const std::vector<PlaneWall>& made, const Scene& scene) {
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const Vec3 &was = made[k].normal, &is = scene.planes[k].normal;
    if ((was - is).norm() > kSameRelatively)
      throw std::invalid_argument("a state with " + wall_key(k, "normal") + " = " +
                                  short_text(was) + "; the scene has " + short_text(is));
  }
}

}  // namespace

void require_state_of(const Scene& scene, const State& state) {
  if (state.stage > scene.stages.size())
    throw std::invalid_argument("a state after " + std::to_string(state.stage) +
                                " stages; the scene has " + std::to_string(scene.stages.size()));
  const bool is_over = state.stage == scene.stages.size();
  const auto& growth = scene.stages[is_over ? state.stage - 1 : state.stage].growth;
  const std::int64_t most = growth && !is_over ? growth->increments : 0;
  if (state.increments < 0 || state.increments > most)
    throw std::invalid_argument("a state after " + std::to_string(state.increments) +
                                " increments of growth; the scene's stage has " +
                                std::to_string(most));
  require_same_particles(state, scene);
  require_same_normals(state.cell.planes, scene);
}

std::string difference_of_laws(const ContactLaws& made, const Scene& scene) {
  std::vector<std::string> keys;
  std::string text;
  const auto compare = [&](std::size_t pair, const std::string& key, double was, double is) {
    if (std::abs(was - is) <= kSameRelatively * std::abs(is)) return;
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) return;
    keys.push_back(key);
    const auto name = [&](std::size_t type) {
      return type < scene.particle_types.size() ? scene.particle_types[type].name : "wall";
    };
    const std::size_t types = made.types;
    text += (text.empty() ? "" : "; ") + std::string("contact.") + name(pair / types) + "-" +
            name(pair % types) + "." + key + " = " + short_text(was) + ", and here " +
            short_text(is);
  };
  if (made.law.size() != scene.laws.law.size()) return "other particle types";
  for (std::size_t pair = 0; pair < made.law.size(); ++pair) {
    const ContactLaw &was = made.law[pair], &is = scene.laws.law[pair];
    if (was.hertz.has_value() != is.hertz.has_value()) return "another contact.law";
    if (was.hertz) {
      compare(pair, "young_modulus", was.hertz->young_modulus, is.hertz->young_modulus);
      compare(pair, "poisson_ratio", was.hertz->poisson_ratio, is.hertz->poisson_ratio);
    } else {
      compare(pair, "normal_stiffness", was.normal_stiffness, is.normal_stiffness);
      compare(pair, "shear_stiffness", was.shear_stiffness, is.shear_stiffness);
    }
    compare(pair, "friction_coefficient", was.friction_coefficient, is.friction_coefficient);
    compare(pair, "cohesion", was.cohesion, is.cohesion);
    compare(pair, "restitution", was.restitution(), is.restitution());
  }
  return text;
}

std::string difference_of_walls(const Cell& made, const Scene& scene) {
  std::string text;
  const auto add = [&](const std::string& difference) {
    text += (text.empty() ? "" : "; ") + difference;
  };
  const double same = kSameRelatively * made.edges.diagonal().norm();
  for (std::size_t k = 0; k < scene.planes.size(); ++k) {
    const PlaneWall &was = made.planes[k], &is = scene.planes[k];
    const auto held = [](const PlaneWall& plane, double PlaneWall::Held::*number) {
      return plane.held ? short_text(*plane.held.*number) : std::string("not held");
    };
    if (was.held || is.held) {
      for (const auto& [key, number] : {std::pair("stress", &PlaneWall::Held::stress),
                                        std::pair("max_speed", &PlaneWall::Held::max_speed)})
        if (held(was, number) != held(is, number))
          add(wall_key(k, key) + " = " + held(was, number) + ", and here " + held(is, number));
      continue;
    }
    if ((was.velocity - is.velocity).norm() > kSameRelatively * is.velocity.norm())
      add(wall_key(k, "velocity") + " = " + short_text(was.velocity) + ", and here " +
          short_text(is.velocity));
    const bool moves = was.normal.dot(was.velocity) != 0.0 || is.normal.dot(is.velocity) != 0.0;
    if (!moves && std::abs(was.offset - is.offset) > same)
      add(wall_key(k, "point") + " at " + short_text(was.offset) + " along its normal, and here " +
          short_text(is.offset) + ": it stays where it is");
  }
  return text;
}

}  // namespace tangency::inline v0::dem
