// SPDX-License-Identifier: MIT
/// @file
/// What a run measures, counted again by other code: one loop over the contacts, in their order,
/// without lanes, blocks or threads.
#pragma once

#include <optional>
#include <string>

#include <tangency/dem/simulation.hpp>

namespace tangency::inline v0::dem {

/// Of two counts of one thing: how far they may be from each other, in parts of the sum of the
/// sizes of what is added. Chosen: 10^6 terms, each rounded some ten times, are within 1e-9 at
/// worst.
inline constexpr double kRecountError = 1e-9;

/// Holds what Simulation::observe() says against the contacts and particles of the state, and these
/// against each other: numbers and spread of contacts, stress, mean force and overlap, stored and
/// kinetic energy, porosity, and force, moment and number of contacts of each particle. A pair
/// apart bears nothing.
/// `with_laws`: the contacts were made by Simulation::laws(), as after a step. Then it asks too
/// whether the push of linear undamped contacts is their stiffness times the overlap, and no shear
///                   above what friction bears?
/// @return the first difference, one line: the run's number and the other; nothing where there is
///         none
std::optional<std::string> difference_from_recount(const Simulation& simulation, bool with_laws);

}  // namespace tangency::inline v0::dem
