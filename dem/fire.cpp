// SPDX-License-Identifier: MIT
#include <tangency/dem/fire.hpp>

#include <cmath>
#include <cstddef>

#include <tangency/dem/chunks.hpp>
#include <tangency/dem/particle_columns.hpp>
#include <tangency/dem/particle_lanes.hpp>

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
  const bool runs_downhill = sum.va > 0.0;
  if (!runs_downhill) *this = {kStartMixing, 0};
  const double keep = runs_downhill ? 1.0 - mixing : 0.0;
  const double push = runs_downhill ? mixing * std::sqrt(sum.vv / sum.aa) : 0.0;
  for_each_chunk(count, [&](std::size_t first, std::size_t last) {
    detail::steer_lanes(columns, moved, keep, push, gravity, turns, first, last);
  });
  if (runs_downhill && ++downhill > kLeastDownhill) mixing *= kMixingDecay;
  const detail::InertiaProducts after{
      keep * keep * sum.vv + 2.0 * keep * push * sum.va + push * push * sum.aa,
      keep * sum.va + push * sum.aa, sum.aa};
  return energy_at(sum, dt) - energy_at(after, dt);
}

}  // namespace tangency::inline v0::dem
