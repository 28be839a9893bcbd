// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A state of particles whose contacts all have one law, made without a scene.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <tangency/dem/simulation.hpp>

namespace tangency::testing {

/// One law for all, walls included.
inline dem::ContactLaws laws_in(const dem::Cell& cell, const dem::ContactLaw& law) {
  const std::size_t types = cell.has_walls() ? 2 : 1;
  return {types, std::vector(types * types, law)};
}

/// Of particles that have moved for a time `dt`.
inline dem::State state_of(dem::Particles particles, const dem::Cell& cell,
                           const dem::ContactLaw& law, double dt) {
  dem::State state;
  state.cell = cell;
  state.particles = std::move(particles);
  state.laws = laws_in(cell, law);
  state.list.build(state.particles, cell, 0.3);
  state.contacts.carry_over({}, state.list.pairs());
  state.contacts.update(state.particles, cell, state.list, state.laws, dt);
  return state;
}

}  // namespace tangency::testing
