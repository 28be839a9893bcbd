// SPDX-License-Identifier: MIT
#include <tangency/dem/motion/fire.hpp>

#include <cmath>
#include <cstddef>

#include <tangency/dem/chunks.hpp>
#include <tangency/dem/lanes/particle_lanes.hpp>
#include <tangency/dem/motion/particle_columns.hpp>

namespace tangency::inline v0::dem {
namespace {

// The published values [Bitzek2006].
/// alpha_start: the mixing at the start of a stretch downhill.
constexpr double kStartMixing = 0.1;
/// f_alpha: the mixing's factor a cycle once the stretch has lasted.
constexpr double kMixingDecay = 0.99;
/// N_min: cycles after which it has.
constexpr std::int64_t kLeastDownhill = 5;

double energy_at(const detail::InertiaProducts& p, double dt) {
  return 0.5 * p.vv + 0.5 * dt * p.va;
}

}  // namespace

double Fire::steer(Particles& particles, const Resultants& resultants, const Motion& motion,
                   double dt) {
  const std::size_t count = particles.size();
  const bool turns = motion.rotation != Rotation::none;
  const double* gravity = motion.gravity.data();
  const detail::ParticleColumns columns = detail::columns_of(particles, resultants);
  const detail::MovedColumns moved = detail::moved_columns_of(particles);
  const auto sum =
      sum_by_chunks<detail::InertiaProducts>(count, [&](std::size_t first, std::size_t last) {
        return detail::inertia_products_lanes(columns, gravity, turns, first, last);
      });
  const Turn turn = turn_by(sum);
  for_each_chunk(count, [&](std::size_t first, std::size_t last) {
    detail::steer_lanes(columns, moved, turn.keep, turn.push, gravity, turns, first, last);
  });
  return turn.taken(sum, dt);
}

Fire::Turn Fire::turn_by(const detail::InertiaProducts& all) {
  const bool runs_downhill = all.va > 0.0;
  if (!runs_downhill) {
    *this = {kStartMixing, 0};
    return {0.0, 0.0};
  }
  const Turn turn{1.0 - mixing, mixing * std::sqrt(all.vv / all.aa)};
  if (++downhill > kLeastDownhill) mixing *= kMixingDecay;
  return turn;
}

double Fire::Turn::taken(const detail::InertiaProducts& before, double dt) const {
  const detail::InertiaProducts after{
      keep * keep * before.vv + 2.0 * keep * push * before.va + push * push * before.aa,
      keep * before.va + push * before.aa, before.aa};
  return energy_at(before, dt) - energy_at(after, dt);
}

}  // namespace tangency::inline v0::dem
