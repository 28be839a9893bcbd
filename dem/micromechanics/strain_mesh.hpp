// SPDX-License-Identifier: MIT
/// @file
/// Nets that join the centres of a periodic packing and cover its cell: what average strain is
/// summed over [Ouadfel1998, section 8.8]: polygons between contacts in the plane
/// [KruytRothenburg1996], tetrahedra between centres in space [Bagi1996].
///
/// A net's cells are the polygons between contacts in the plane, the triangles between centres, or
/// their tetrahedra in space. Each edge goes from the centre of particle k to that of an image of
/// particle l, and has a vector, its area, with which the velocity gradient of the cell is exactly
/// (1/V) times the sum of difference (x) area (average_strain.hpp).
///
/// Centres need not lie inside the cell, but at most kMostCells cells from the origin: an image is
/// the number of edges of the cell, along each axis, by which a centre is moved from where it is
/// given, at most kMostImages. Units are any consistent set. In the plane all centres have z = 0,
/// images do not move along z, the third edge of the cell is not read, areas of edges are lengths,
/// and `volume` is an area. Cells are periodic along every axis of their dimensions: walls have no
/// net.
///
/// Errors: input that is not what is said here is std::invalid_argument, which names the array and
/// the place; centres or contacts that have no net are NoMesh. Functions keep nothing: any number
/// of threads may call them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// By how many edges a centre is moved, along each axis.
using PeriodicImage = std::array<std::int32_t, 3>;

/// Chosen: images of pairs can be added and turned round without overflow; and centres are so near
/// the origin that the image of any neighbours is one of these.
inline constexpr std::int32_t kMostImages = 1 << 28, kMostCells = 1 << 26;

/// There is no net of these centres or contacts; what() is one line that says why.
class NoMesh : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Centres in a periodic cell.
struct PeriodicCentres {
  std::span<const Vec3> position;  ///< one a body, length
  Mat3 edges = Mat3::Identity();   ///< columns: the edge vectors of the cell, as dem::Cell has them
  int dimensions = 3;              ///< 2 or 3

  double volume() const;  ///< of the cell; an area in the plane
  /// Of an image, length.
  Vec3 translation(const PeriodicImage& image) const;
  /// From the centre of k to that of the image of l.
  Vec3 branch(const std::array<std::int64_t, 2>& bodies, const PeriodicImage& image) const;
};
/// @throws std::invalid_argument where centres are not what PeriodicCentres says
void require_sound(const PeriodicCentres& centres);

/// Pairs of a particle and the image of a particle, views of arrays that the caller keeps. (a, b,
/// image) and (b, a, -image) are one pair. No pair stands twice, and none is a particle with
/// itself.
struct PeriodicPairs {
  std::span<const std::array<std::int64_t, 2>> bodies;  ///< indices into the positions
  std::span<const PeriodicImage> image;                 ///< of the second

  /// The number of pairs.
  std::size_t size() const { return bodies.size(); }
};
/// @throws std::invalid_argument where pairs are not what PeriodicPairs says
void require_sound(const PeriodicPairs& pairs, const PeriodicCentres& centres);

/// An edge of a net, from a body to an image of a body.
struct MeshEdge {
  std::array<std::int64_t, 2> bodies{};  ///< k, l
  PeriodicImage image{};                 ///< of l
  Vec3 branch = Vec3::Zero();            ///< from k to the image of l
  /// h of a net of polygons: the centre of the polygon on the left less that on the right, turned
  /// by -90 degrees (eq. 8.11). d of triangles and tetrahedra: 1/(n (n + 1)), n the dimensions,
  /// times the sum over those at the edge of the outward area of the face opposite k less that of
  /// the face opposite l.
  Vec3 area = Vec3::Zero();
};

/// (1) (1/V) sum branch (x) area is the unit tensor, of the plane in the plane
struct StrainMesh {
  int dimensions = 3;           ///< 2 or 3
  double volume = 0.0;          ///< of the cell, length^dimensions
  std::vector<MeshEdge> edges;  ///< each once
  std::size_t cells = 0;        ///< polygons, triangles or tetrahedra
  std::size_t centres = 0;      ///< particles that are corners of one
};

/// A triangle or tetrahedron of a periodic net: particles, and the images of them that are its
/// corners. The fourth of a triangle is not used.
struct PeriodicSimplex {
  std::array<std::int64_t, 4> bodies{};  ///< at the corners; as many as dimensions + 1
  std::array<PeriodicImage, 4> image{};  ///< of each corner
};

/// The Delaunay triangles or tetrahedra of the centres, each once, by Qhull [Barber1996]. Where
/// more than n + 1 centres lie on a sphere, as in lattices, these are those of centres and a cell
/// that are moved by at most a thousandth of the mean distance, all images of a centre alike: some
/// then have no volume. Centres may be few, and the cell thin or sheared. Centres in one place are
/// moved apart like those on a sphere: simplices between them have next to no volume.
/// @throws NoMesh without a centre, where the cell is so thin that more images than kMostCells are
///                around it, and where no such move gives simplices that fill the cell
///
/// (2) together they fill the cell once, and each face is that of two of them
/// (3) no centre lies inside the sphere of another's corners, where no more than n + 1 lie on one
std::vector<PeriodicSimplex> delaunay_simplices(const PeriodicCentres& centres);

/// The net of these triangles or tetrahedra, or of any that have property (2).
/// @throws std::invalid_argument for particles that are none, and images beyond kMostImages
StrainMesh simplex_mesh(const PeriodicCentres& centres, std::span<const PeriodicSimplex> simplices);

/// The net of the polygons between contacts in the plane, none of which a contact divides. What
/// does not span the cell, and what hangs on it by one contact, is left out, particles without
/// contacts with it. Its edges have the order of `contacts`, those left out skipped.
///
/// Edges leave a centre in the order of their contact points, not of their branches: with convex
/// bodies no two edges cross then that are drawn by way of the contact points, even where straight
/// ones would.
/// @param centres  where the particles are
/// @param contacts  the contacts
/// @param arm  contact point less centre of the first body, one a pair; empty: that the edges are
///             straight
/// @throws NoMesh where contacts do not span the cell along both axes, or edges cross
///
/// (4) polygons less contacts plus particles are 0, and signed areas add up to that of the cell
StrainMesh polygon_mesh(const PeriodicCentres& centres, const PeriodicPairs& contacts,
                        std::span<const Vec3> arm = {});

/// Which pair each edge of a net is; empty of those that are none.
std::vector<std::optional<std::size_t>> pairs_of_edges(const StrainMesh& mesh,
                                                       const PeriodicPairs& pairs);

}  // namespace tangency::inline v0::micromechanics
