// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cassert>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tangency/dem/simulation.hpp>
#include <utility>

namespace tangency::dem {
namespace {

/// Skin of the neighbour list, in largest semi-axes. Measured on assembly-1000: from 0.05 to 0.4
/// the time of a run changes by a tenth, so it is chosen with room for faster motion.
constexpr double skin_ratio = 0.2;

/// Porosity at which a random assembly begins to bear stress, roughly: that of spheres, and of
/// disks.
constexpr double jamming_porosity(int dimensions) { return dimensions == 2 ? 0.16 : 0.36; }

/// Relative difference of two descriptions of one particle: the semi-axes of another machine's
/// libm are a few roundings off. Chosen: far below any change that someone makes.
constexpr double same_particle = 1e-9;

void require_equal(const std::string& key, double in_state, double in_scene) {
  if (std::abs(in_state - in_scene) <= same_particle * in_scene) return;
  std::ostringstream text;
  text << std::setprecision(10) << "a state with " << key << " = " << in_state << "; the scene has "
       << in_scene;
  throw std::invalid_argument(text.str());
}

/// @throws std::invalid_argument  naming the first key of the scene that the particles are not of
void require_same_particles(const State& state, const Scene& scene) {
  const Particles& particles = state.particles;
  const std::vector<ParticleType>& types = scene.particle_types;
  require_equal("cell.dimensions", state.cell.dimensions, scene.dimensions);
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
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto type = static_cast<std::size_t>(particles.type[i]);
    const auto& [name, batch] = types[type];
    const Shape shape = scene.shape_in(type, state.stage, state.increments);
    const Vec3& axes = particles.semi_axes[i];
    const std::string path = "particles." + name;
    const int dimensions = scene.dimensions;
    require_equal(path + ".mean_radius",
                  dimensions == 2 ? std::sqrt(axes[0] * axes[1]) : std::cbrt(axes.prod()),
                  shape.mean_radius);
    require_equal(path + ".elongation", axes[0] / axes[1], shape.elongation);
    require_equal(path + ".flatness", axes[1] / axes[2], shape.flatness);
    require_equal(path + ".density", particles.mass[i] / volume_of(axes, dimensions),
                  batch.density);
  }
}

}  // namespace

Simulation::Simulation(const Scene& scene) : scene_(scene) {
  state_.particles = place(scene_.batches(), scene_.placement(), state_.cell);
  renew_list();
  state_.contacts.update(state_.particles, state_.cell, state_.list, scene_.laws, 0.0);
  next_stage();
}

Simulation::Simulation(const Scene& scene, State state) : scene_(scene), state_(std::move(state)) {
  if (state_.stage > scene_.stages.size())
    throw std::invalid_argument("a state after " + std::to_string(state_.stage) +
                                " stages; the scene has " + std::to_string(scene_.stages.size()));
  const auto& growth = stage().growth;
  const std::int64_t most = growth && !finished() ? growth->increments : 0;
  if (state_.increments < 0 || state_.increments > most)
    throw std::invalid_argument("a state after " + std::to_string(state_.increments) +
                                " increments of growth; the scene's stage has " +
                                std::to_string(most));
  require_same_particles(state_, scene_);
  prepare_stage();
}

const Stage& Simulation::stage() const {
  return scene_.stages[std::min(state_.stage, scene_.stages.size() - 1)];
}

void Simulation::prepare_stage() {
  laws_ = scene_.laws;
  if (!finished() && stage().compress->friction_coefficient)
    for (ContactLaw& law : laws_.law)
      law.friction_coefficient = *stage().compress->friction_coefficient;
}

void Simulation::next_stage() {
  assert(!finished());
  ++state_.stage;
  state_.stage_cycle = 0;
  state_.servo_integral = 0.0;
  state_.increments = 0;
  prepare_stage();
}

double Simulation::time_step() const {
  return stage().compress->time_step_factor *
         characteristic_time(state_.particles, laws_.largest_stiffness());
}

void Simulation::step() {
  assert(!finished());
  const Compress& stage = *this->stage().compress;
  if (state_.stage_cycle == 0) state_.cell.reference_length = state_.cell.length;
  if (!is_grown() && is_relaxed()) grow();
  const double dt = time_step();
  const double damping =
      stage.damping / characteristic_time(state_.particles, laws_.largest_stiffness());
  const Stress stress = stress_of(state_.contacts, state_.cell);
  state_.cell.rate = state_.cell.isotropic(stage.servo.rate(stress, dt, state_.servo_integral));

  move(state_.particles, state_.cell, state_.contacts.resultants(), damping, dt);
  if (!state_.list.is_current(state_.particles, state_.cell)) renew_list();
  state_.contacts.update(state_.particles, state_.cell, state_.list, laws_, dt);

  ++state_.cycle;
  ++state_.stage_cycle;
  state_.time += dt;
}

void Simulation::renew_list() {
  double largest = 0.0;
  for (const Vec3& axes : state_.particles.semi_axes) largest = std::max(largest, axes.maxCoeff());
  const std::vector<Pair> before = state_.list.pairs();
  state_.list.build(state_.particles, state_.cell, skin_ratio * largest);
  state_.contacts.carry_over(before, state_.list.pairs());
}

/// Is the stress the wanted one and, where the stage asks for it, the assembly in balance?
bool Simulation::is_relaxed() const {
  const Compress& stage = *this->stage().compress;
  const double wanted = stage.servo.mean_stress;
  const double off = std::abs(stress_of(state_.contacts, state_.cell).mean() - wanted);
  if (!(off <= stage.stress_tolerance * wanted)) return false;
  const auto& growth = this->stage().growth;
  if (!stage.max_unbalanced_ratio && !growth) return true;
  const Balance balance = balance_of(state_.particles, state_.contacts, state_.list);
  if (growth) return balance.inertial_fraction <= growth->max_inertial_fraction;
  return std::max(balance.largest_unbalanced_ratio, balance.largest_unbalanced_moment_ratio) <=
         *stage.max_unbalanced_ratio;
}

bool Simulation::is_grown() const {
  const auto& growth = stage().growth;
  return !growth || state_.increments == growth->increments;
}

void Simulation::grow() {
  ++state_.increments;
  std::vector<Vec3> axes;
  for (std::size_t type = 0; type < scene_.particle_types.size(); ++type)
    axes.push_back(
        scene_.shape_in(type, state_.stage, state_.increments).semi_axes(state_.cell.dimensions));
  Particles& particles = state_.particles;
  for (std::size_t i = 0; i < particles.size(); ++i)
    particles.semi_axes[i] = axes[static_cast<std::size_t>(particles.type[i])];
}

StageStatus Simulation::status() const {
  if (is_grown() && is_relaxed()) return StageStatus::done;
  return state_.stage_cycle < stage().compress->max_cycles ? StageStatus::running
                                                           : StageStatus::out_of_cycles;
}

double Simulation::stage_fraction() const {
  if (finished()) return 1.0;
  const Compress& stage = *this->stage().compress;
  if (const auto& growth = this->stage().growth)
    return static_cast<double>(state_.increments) / static_cast<double>(growth->increments);
  const Observation seen = observe();
  if (stage.max_unbalanced_ratio) {
    const double worst = std::max(seen.balance.largest_unbalanced_ratio,
                                  seen.balance.largest_unbalanced_moment_ratio);
    if (!(worst > 0.0)) return 0.0;
    return std::clamp(std::log(worst) / std::log(*stage.max_unbalanced_ratio), 0.0, 1.0);
  }
  const double to_jamming =
      std::log((1.0 - jamming_porosity(scene_.dimensions)) / (1.0 - seen.porosity)) -
      seen.volumetric_strain;
  const double volume_part =
      to_jamming > 0.0 ? std::clamp(-seen.volumetric_strain / to_jamming, 0.0, 1.0) : 1.0;
  const double stress_part = std::clamp(seen.stress.mean() / stage.servo.mean_stress, 0.0, 1.0);
  return 0.8 * volume_part + 0.2 * stress_part;
}

Observation Simulation::observe() const {
  return dem::observe(state_.particles, state_.cell, state_.contacts, state_.list);
}

}  // namespace tangency::dem
