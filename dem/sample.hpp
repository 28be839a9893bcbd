// SPDX-License-Identifier: MIT
/// @file
/// Where particles start from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/dem/start_axes.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// So many particles of one kind.
struct Batch {
  Shape shape;            ///< semi-axes by ratios
  double density;         ///< mass per volume
  std::size_t count;      ///< particles of this kind
  int directed_axis = 0;  ///< the body axis that StartAxes turn
};

/// One particle of an explicit arrangement.
struct Body {
  std::size_t type;                                 ///< index of its batch
  Vec3 position;                                    ///< of the centre
  Quaternion orientation = Quaternion::Identity();  ///< not 0, of any length
  Vec3 velocity = Vec3::Zero();                     ///< relative to the strain
  Vec3 angular_velocity = Vec3::Zero();             ///< in space axes
};

/// Most edges of the cell that a body may be away from its corner, along each axis. Chosen: half of
/// what geometry/near_pairs.hpp serves.
inline constexpr double kMostEdgesAway = 0x1p28;
/// What a message says of a coordinate beyond it.
inline constexpr const char* kNearTheCell = "at most 2^28 edges of the cell away from its corner";
/// Is a coordinate within it?
inline bool is_near_cell(double coordinate, double edge) {
  return coordinate >= -kMostEdgesAway * edge && coordinate <= kMostEdgesAway * edge;
}

/// How particles are placed at the start.
enum class Arrangement { lattice, random, explicit_bodies };

/// How they are put into the cell.
struct Placement {
  std::optional<Vec3> cell_size;  ///< edges; without: the smallest cube that holds all
  double jitter;                  ///< lattice: each coordinate moves by up to this, length
  std::uint64_t seed;             ///< of the random numbers
  Arrangement arrangement = Arrangement::lattice;  ///< how they are placed
  /// random, without a cell_size: the share of the cell that the bounding spheres fill.
  double bounding_fraction = 0.25;
  int dimensions = 3;              ///< 2: in the plane, on a square lattice, by bounding circles
  std::array<bool, 3> walled{};    ///< as in Cell
  std::span<const Body> bodies{};  ///< of an explicit arrangement, which needs a cell_size
  StartAxes axes{};                ///< not of an explicit arrangement
};

/// A cell without room, too thin for its particles (thin_cell.hpp), or with too many sites: what()
/// says how much room there is.
class DoesNotFit : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The largest share of a cell that bounding spheres may fill where they are placed at random.
/// Chosen: some way below 0.38 and 0.547, where random sequential placement of equal ones finds no
/// more room [Widom1966, Feder1980].
constexpr double largest_bounding_fraction(int dimensions) { return dimensions == 2 ? 0.45 : 0.3; }

/// Is there room for them? @throws DoesNotFit, as place() would but for bad luck in random()
void check_room(const std::vector<Batch>& batches, const Placement& how);

/// Is the cell thick enough for a run (thin_cell.hpp)? place() serves thinner ones.
/// @throws DoesNotFit
void check_thickness(const std::vector<Batch>& batches, const Placement& how);

/// place_on_lattice(), place_at_random() or the bodies as they are.
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
