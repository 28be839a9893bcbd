// SPDX-License-Identifier: MIT
/// @file
/// Where particles start from.
#pragma once

#include <optional>
#include <random>
#include <stdexcept>
#include <tangency/dem/cell.hpp>
#include <tangency/dem/particles.hpp>
#include <vector>

namespace tangency::dem {

/// So many particles of one kind.
struct Batch {
  Shape shape;
  double density;
  std::size_t count;
};

/// How they are put on a simple cubic lattice.
struct LatticePlacement {
  std::optional<Vec3> cell_size;  ///< edges; without: the smallest cube that holds all
  double jitter;                  ///< each coordinate moves by up to this, length
  std::uint64_t seed;
};

/// A cell with too few sites, or too many: what() says how many.
class DoesNotFit : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Is there a lattice for them? @throws DoesNotFit, as place_on_lattice() would
void check_room(const std::vector<Batch>& batches, const LatticePlacement& how);

/// Puts the particles at rest on the sites of a simple cubic lattice, the kinds shuffled and
/// surplus sites left empty at random, positions jittered and axes turned by rotations drawn
/// uniformly: with aligned axes and exact sites a compressed assembly is a perfect crystal.
///
/// (1) No two particles overlap: sites are as far apart as the largest particle's diameter plus
///     twice the jitter.
/// (2) The same seed gives the same sample on every machine.
/// @throws DoesNotFit
Particles place_on_lattice(const std::vector<Batch>& batches, const LatticePlacement& how,
                           Cell& cell);

/// Uniform on [0, 1), from the 53 high bits: unlike std::uniform_real_distribution the same
/// everywhere.
double uniform(std::mt19937_64& random);

/// A rotation drawn uniformly [Shoemake1992].
Eigen::Quaterniond uniform_rotation(std::mt19937_64& random);

}  // namespace tangency::dem
