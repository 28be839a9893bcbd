// SPDX-License-Identifier: MIT
/// @file
/// The cell that an assembly lives in, straining homogeneously: periodic, or between plane walls.
///
/// A parallelepiped with a corner at the origin, so that the affine velocity at x is rate x. It
/// starts as a rectangular box and stays one while no shear rate is asked for. Inside the simulator
/// extension is positive; scenes and histories turn the sign (observe.hpp).
///
/// Along a walled axis the two faces are walls that move with the affine motion; the cell is then
/// rectangular. A plane cell has dimensions = 2: the bodies lie in the plane z = 0, the edge along
/// z is 1, the unit thickness, which does not strain, and there are no images along z.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <tangency/dem/plane_wall.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// Which periodic image of a particle: how many edges it is moved by along each axis.
using Image = std::array<std::int32_t, 3>;

/// Another description of a cell's lattice: the edge along y less xy of that along x, and the edge
/// along z less yz of the new one along y and xz of that along x.
struct Reset {
  std::int32_t xy = 0, yz = 0, xz = 0;  ///< in whole edges

  /// Is it the same description?
  bool is_none() const { return xy == 0 && yz == 0 && xz == 0; }
  /// Edges as they are described now.
  Mat3 edges(const Mat3& before) const;
  /// The same image, and the same place in parts of the edges.
  Image image(const Image& before) const;
  Vec3 reduced(const Vec3& before) const;  ///< alike
  /// The description of one after this one.
  Reset then(const Reset& next) const;
  /// The way back: image(inverse().image(i)) is i.
  Reset inverse() const;
};

/// A parallelepiped, periodic or walled along each of its edges.
struct Cell {
  Mat3 edges = Mat3::Identity();            ///< columns: the edge vectors; length
  Mat3 rate = Mat3::Zero();                 ///< velocity gradient, extension > 0, 1/time
  Mat3 reference_edges = Mat3::Identity();  ///< where strain is measured from
  int dimensions = 3;                       ///< 2 or 3: the axes that strain
  std::array<bool, 3> walled{};             ///< axes that end at walls instead of images
  std::vector<PlaneWall> planes = {};       ///< walls besides these faces, in front of which it is

  /// A box at rest.
  static Cell box(const Vec3& lengths, int dimensions = 3, std::array<bool, 3> walled = {});

  /// Are all edges along the axes, exactly?
  bool is_box() const { return edges.isDiagonal(0.0); }
  /// Has any side walls?
  bool has_walls() const { return walled[0] || walled[1] || walled[2]; }
  /// Of the parallelepiped, length^3.
  double volume() const;
  /// Distances between opposite faces.
  Vec3 heights() const;
  /// The image nearest to its particle, one of them where several are: the shortest period of the
  /// axes without walls, in whole edges. {} where all axes have walls.
  Image shortest_period() const;

  /// The translation that takes a particle to its image.
  Vec3 translation(const Image& image) const { return edges * Vec3(image[0], image[1], image[2]); }

  /// Coordinates in parts of the edges: [0, 1) inside.
  Vec3 reduced(const Vec3& x) const;

  /// The image number of the cell that holds x: floor(reduced(x)); 0 along walled axes.
  Image image_of(const Vec3& x) const;

  /// The isotropic strain rate r: r along every axis that strains.
  Mat3 isotropic(double r) const;

  /// One step of the homogeneous strain, as the particles take it: edges <- (1 + rate dt) edges
  /// [Ouadfel1998, eq. 3.33].
  void strain(double dt) { edges = (Mat3::Identity() + rate * dt) * edges; }

  /// Logarithmic (Hencky) strain from the reference, ln(F F') / 2, extension positive.
  Mat3 logarithmic_strain() const;

  /// How far right angles have closed since the reference: of xy, yz and zx each the sum of the two
  /// tangents by which lines that lay along the axes lean towards one another. In a simple shear it
  /// is how far layers have moved over how high they lie; 0 of what has stayed a box.
  Vec3 shear_strain() const;

  /// What makes the edges of a cell in simple shear the least skewed ones: where one is off its
  /// axis by more than half of another. The lattice stays. None of a cell whose edges along x and y
  /// are not along x and in the plane of x and y, as a shear_rate makes them.
  Reset reset() const;
};

}  // namespace tangency::inline v0::dem
