// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tangency/dem/simulation.hpp>
#include <utility>

namespace tangency::dem {
namespace {

/// Skin of the neighbour list, in largest semi-axes. Measured on assembly-1000: from 0.05 to 0.4
/// the time of a run changes by a tenth, so it is chosen with room for faster motion.
constexpr double skin_ratio = 0.2;

/// Porosity at which a random assembly begins to bear stress, roughly (spheres: 0.36).
constexpr double jamming_porosity = 0.36;

}  // namespace

Simulation::Simulation(const Scene& scene) : scene_(scene) {
  const Place& place = scene_.stages.front().place.value();
  state_.particles = place_on_lattice(
      scene_.batches(),
      {scene_.cell_size, place.jitter * scene_.smallest_mean_radius(), place.seed}, state_.cell);
  renew_list();
  state_.contacts.update(state_.particles, state_.cell, state_.list, scene_.laws, 0.0);
  next_stage();
}

Simulation::Simulation(const Scene& scene, State state) : scene_(scene), state_(std::move(state)) {
  const std::size_t particles = state_.particles.size();
  if (particles != scene_.particle_count())
    throw std::invalid_argument("a state of " + std::to_string(particles) +
                                " particles; the scene has " +
                                std::to_string(scene_.particle_count()));
  const auto types = static_cast<std::int32_t>(scene_.particle_types.size());
  if (std::any_of(state_.particles.type.begin(), state_.particles.type.end(),
                  [&](std::int32_t type) { return type < 0 || type >= types; }))
    throw std::invalid_argument("a state with more particle types than the scene's " +
                                std::to_string(types));
  if (state_.stage > scene_.stages.size())
    throw std::invalid_argument("a state after " + std::to_string(state_.stage) +
                                " stages; the scene has " + std::to_string(scene_.stages.size()));
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
  const double dt = time_step();
  const double damping =
      stage.damping / characteristic_time(state_.particles, laws_.largest_stiffness());
  const Stress stress = stress_of(state_.contacts, state_.cell);
  state_.cell.rate.setConstant(stage.servo.rate(stress, dt, state_.servo_integral));

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

StageStatus Simulation::status() const {
  const Compress& stage = *this->stage().compress;
  const double wanted = stage.servo.mean_stress;
  const double off = std::abs(stress_of(state_.contacts, state_.cell).mean() - wanted);
  if (off <= stage.stress_tolerance * wanted) {
    if (!stage.max_unbalanced_ratio) return StageStatus::done;
    const Balance balance = balance_of(state_.particles, state_.contacts, state_.list);
    if (std::max(balance.largest_unbalanced_ratio, balance.largest_unbalanced_moment_ratio) <=
        *stage.max_unbalanced_ratio)
      return StageStatus::done;
  }
  return state_.stage_cycle < stage.max_cycles ? StageStatus::running : StageStatus::out_of_cycles;
}

double Simulation::stage_fraction() const {
  if (finished()) return 1.0;
  const Compress& stage = *this->stage().compress;
  const Observation seen = observe();
  if (stage.max_unbalanced_ratio) {
    const double worst = std::max(seen.balance.largest_unbalanced_ratio,
                                  seen.balance.largest_unbalanced_moment_ratio);
    if (!(worst > 0.0)) return 0.0;
    return std::clamp(std::log(worst) / std::log(*stage.max_unbalanced_ratio), 0.0, 1.0);
  }
  const double to_jamming =
      std::log((1.0 - jamming_porosity) / (1.0 - seen.porosity)) - seen.volumetric_strain;
  const double volume_part =
      to_jamming > 0.0 ? std::clamp(-seen.volumetric_strain / to_jamming, 0.0, 1.0) : 1.0;
  const double stress_part = std::clamp(seen.stress.mean() / stage.servo.mean_stress, 0.0, 1.0);
  return 0.8 * volume_part + 0.2 * stress_part;
}

Observation Simulation::observe() const {
  return dem::observe(state_.particles, state_.cell, state_.contacts, state_.list);
}

}  // namespace tangency::dem
