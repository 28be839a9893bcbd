// SPDX-License-Identifier: MIT
/// @file
/// Where particles start from.
#pragma once

#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/dem/samples/batches.hpp>

namespace tangency::inline v0::dem {

/// The largest share of a cell that bounding spheres may fill where they are placed at random.
/// Chosen: some way below 0.38 and 0.547, where random sequential placement of equal ones finds no
/// more room [Widom1966, Feder1980].
constexpr double largest_bounding_fraction(int dimensions) { return dimensions == 2 ? 0.45 : 0.3; }

/// Is there room for them? @throws DoesNotFit, as place() would but for bad luck in random()
void check_room(const std::vector<Batch>& batches, const Placement& how);

/// Is the cell thick enough for a run (thin_cell.hpp)? place() serves thinner ones.
/// @throws DoesNotFit
void check_thickness(const std::vector<Batch>& batches, const Placement& how);

/// place_on_lattice(), place_at_random(), insert() of insertion.hpp, or the bodies as they are.
Particles place(const std::vector<Batch>& batches, const Placement& how, Cell& cell);

/// Puts the particles at rest on the sites of a simple cubic lattice, the kinds shuffled and
/// surplus sites left empty at random, positions jittered and axes drawn: with aligned axes and
/// exact sites a compressed assembly is a perfect crystal.
///
/// (1) No two particles overlap: sites are as far apart as the largest particle's diameter plus
///     twice the jitter.
/// (2) The same seed gives the same sample on every machine.
/// @throws DoesNotFit
Particles place_on_lattice(const std::vector<Batch>& batches, const Placement& how, Cell& cell);

/// Puts the particles at rest at random: the largest first, each at the first place drawn where its
/// bounding sphere meets none of those before it nor an image of its own, axes drawn. (1) and (2)
/// hold.
/// @throws DoesNotFit
Particles place_at_random(const std::vector<Batch>& batches, const Placement& how, Cell& cell);

}  // namespace tangency::inline v0::dem
