// SPDX-License-Identifier: MIT
/// @file
/// The particles that are to be placed, and how.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include <tangency/dem/particles.hpp>
#include <tangency/dem/samples/start_axes.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// So many particles of one kind.
struct Batch {
  Shape shape;            ///< semi-axes by ratios; where they differ, with the mean of mean_radius
  double density;         ///< mass per volume
  std::size_t count;      ///< particles of this kind
  int directed_axis = 0;  ///< the body axis that StartAxes turn
  /// Of each particle; none where all have `shape`.
  std::vector<Shape> shapes{};
  /// insertion: where centres lie along the last axis, in shares of the cell.
  std::array<double, 2> layer{0.0, 1.0};

  /// Of particle number i of the kind.
  const Shape& shape_of(std::size_t i) const { return shapes.empty() ? shape : shapes[i]; }
  /// The least and the largest of the mean radii.
  std::array<double, 2> radius_range() const;
  /// Of the least particle; length^3, in the plane length^2.
  double least_volume(int dimensions) const;
};

/// One particle of an explicit arrangement.
struct Body {
  std::size_t type;                                 ///< index of its batch
  Vec3 position;                                    ///< of the centre
  Quaternion orientation = Quaternion::Identity();  ///< not 0, of any length
  Vec3 velocity = Vec3::Zero();                     ///< relative to the strain
  Vec3 angular_velocity = Vec3::Zero();             ///< in space axes
  Vec3 semi_axes = Vec3::Zero();                    ///< a >= b >= c; 0: those of its batch
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
enum class Arrangement { lattice, random, explicit_bodies, insertion };

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
  /// insertion, without a cell_size: the share of the cell that the particles fill.
  double volume_fraction = 0.3;
  /// Called now and then with the share of the particles that are placed, where it is given.
  std::function<void(double)> progress{};
};

/// A cell without room, too thin for its particles (thin_cell.hpp), or with too many sites: what()
/// says how much room there is.
class DoesNotFit : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One of the particles that are to be placed.
struct Coming {
  std::size_t batch, number;  ///< which of which kind
  Vec3 axes;                  ///< semi-axes, length
  /// Of its bounding sphere, length.
  double radius() const { return axes.maxCoeff(); }
};

/// All of them, kind by kind.
std::vector<Coming> coming_particles(const std::vector<Batch>& batches, int dimensions);

/// The one with the largest bounding sphere first; equal ones stay as they are.
void sort_largest_first(std::vector<Coming>& all);

/// What is counted as filled in a cell, and how far it may be.
struct Filling {
  const char* what;  ///< in messages: "the particles"
  /// Of one of them; length^3, in the plane length^2.
  double (*volume)(const Coming&, int dimensions);
  double fraction;   ///< of the cell that is filled where `how` has no edges
  double most;       ///< of a cell with edges
  double clearance;  ///< share of their axes by which particles are made larger
};

/// The edges of a cell for all particles: those that `how` says, or of a cube (square).
/// @throws DoesNotFit  where it would be filled beyond `most`, or an edge is no longer than a
/// particle
Vec3 edges_with_room(const std::vector<Batch>& batches, const Placement& how,
                     const Filling& filling);

/// Radii of their bounding spheres, made larger by a share of each.
std::vector<double> bounding_radii(const std::vector<Coming>& all, double clearance);

}  // namespace tangency::inline v0::dem
