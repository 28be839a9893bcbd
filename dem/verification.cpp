// SPDX-License-Identifier: MIT
#include <tangency/dem/verification.hpp>

#include <algorithm>
#include <cmath>

#include <tangency/dem/chunks.hpp>
#include <tangency/dem/motion/motion.hpp>
#include <tangency/dem/verification/recount.hpp>
#include <tangency/geometry/tables/number_text.hpp>

namespace tangency::inline v0::dem {
namespace {

std::string cycle_of(const Simulation& simulation) {
  return "cycle " + std::to_string(simulation.state().cycle) + ": ";
}

/// "particles 3 and 8, image (0, 0, 1)" or "particle 3 and wall 2".
std::string name_of(const Pair& pair, const Particles& particles) {
  const auto id = [&](std::int32_t i) {
    return std::to_string(particles.id[static_cast<std::size_t>(i)]);
  };
  const auto count = static_cast<std::int32_t>(particles.size());
  if (pair.b >= count)
    return "particle " + id(pair.a) + " and wall " + std::to_string(pair.b - count);
  const auto& [x, y, z] = pair.image;
  return "particles " + id(pair.a) + " and " + id(pair.b) + ", image (" + std::to_string(x) + ", " +
         std::to_string(y) + ", " + std::to_string(z) + ")";
}

/// Of the fluctuating velocities, and of each contact's bodies in the strain of the cell.
double energy_of_motion(const State& state) {
  const Particles& particles = state.particles;
  const std::vector<Pair>& pairs = state.list.pairs();
  const auto straining = [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    for (std::size_t k = first; k < last; ++k) {
      if (!state.contacts.touches(k)) continue;
      const auto a = static_cast<std::size_t>(pairs[k].a), b = static_cast<std::size_t>(pairs[k].b);
      const double mass =
          std::max(particles.mass[a], b < particles.size() ? particles.mass[b] : 0.0);
      sum += 0.5 * mass * (state.cell.rate * state.contacts.columns().branch[k]).squaredNorm();
    }
    return sum;
  };
  return kinetic_energy(particles) + sum_by_chunks<double>(pairs.size(), straining);
}

}  // namespace

std::vector<ProfileEntry> entries_of(const Verified& verified) {
  const CheckCounts& pairs = verified.pairs;
  return {{"states", verified.states},
          {"contacts", pairs.contacts},
          {"wrong", pairs.wrong},
          {"missed", pairs.missed},
          {"apart", pairs.apart},
          {"at_a_touch", pairs.rounded},
          {"depths", pairs.depths},
          {"on_a_followed_branch", pairs.followed},
          {"bodies_searched", pairs.searched},
          {"recounts", verified.recounts},
          {"largest_energy_error", verified.largest_energy_error}};
}

std::string text_of(const Verified& verified) {
  const CheckCounts& pairs = verified.pairs;
  const auto number = [](std::int64_t count) { return std::to_string(count); };
  return "verified " + number(verified.states) + " states: " + number(pairs.contacts) +
         " contacts certified, " + number(pairs.wrong) + " wrong, " + number(pairs.missed) +
         " missed; " + number(pairs.apart) + " pairs apart, " + number(pairs.rounded) +
         " at a touch to rounding; " + number(pairs.depths) + " depths, " + number(pairs.followed) +
         " of them on a followed branch; neighbours of " + number(pairs.searched) + " bodies; " +
         number(verified.recounts) + " recounts; energy error at most " +
         tables::rounded_text(verified.largest_energy_error, 3) + " of the work done";
}

void Verification::check(const Simulation& simulation) {
  const State& state = simulation.state();
  contacts_.aim(state.particles);
  CheckCounts counts = contacts_.check_listed(simulation);
  const auto turn = static_cast<std::size_t>(state.cycle);
  counts += contacts_.check_unlisted(simulation, turn * kSearchedBodies % state.particles.size(),
                                     kSearchedBodies);
  verified_.pairs += counts;
  ++verified_.states;
  if (counts.first)
    throw VerificationFault(cycle_of(simulation) + name_of(counts.first->pair, state.particles) +
                            ": " + counts.first->what);
  check_energy(simulation);
}

void Verification::check_energy(const Simulation& simulation) {
  work_.note(simulation.state().energy);
  most_motion_ = std::max(most_motion_, energy_of_motion(simulation.state()));
  const double error = std::abs(simulation.energy_error()), through = work_.sum() + most_motion_;
  if (error > 0.0)
    verified_.largest_energy_error = std::max(verified_.largest_energy_error, error / through);
  if (error > kMostEnergyError * through)
    throw VerificationFault(cycle_of(simulation) + "the run has an energy error of " +
                            tables::to_text(error) + "; allowed are " +
                            tables::rounded_text(kMostEnergyError, 3) + " of the work done, " +
                            tables::to_text(through));
}

void Verification::recount(const Simulation& simulation, bool with_laws) {
  ++verified_.recounts;
  if (const auto difference = difference_from_recount(simulation, with_laws))
    throw VerificationFault(cycle_of(simulation) + *difference);
}

}  // namespace tangency::inline v0::dem
