// SPDX-License-Identifier: MIT
/// @file
/// Which pairs of particles may touch before the list is next renewed.
///
/// The list holds every pair of images whose bounding spheres come within `skin` of each other,
/// each pair once, in an order that depends on nothing but the positions:
///
/// (1) Every pair whose bounding spheres meet is listed as long as is_current() is true.
/// (2) No pair is listed twice; a particle may meet itself through the periodic boundary.
/// (3) A cell of any size is served, one smaller than a particle included.
/// (4) In a plane cell no image moves along z, in a walled one none along a walled axis.
/// (5) Every particle whose bounding sphere meets a wall is listed with it, like (1).
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::dem {

/// Particle `a` and the image of particle `b`; a <= b, and for a == b the image is positive in
/// lexicographic order. Or, with b = number of particles + k, particle `a` and wall k (Wall).
struct Pair {
  std::int32_t a, b;
  Image image;

  auto operator<=>(const Pair&) const = default;
};

/// Wall k of a cell: the face at the origin's end (even k) or at the far end (odd k) of axis k / 2.
struct Wall {
  int axis;
  bool far;

  explicit Wall(std::size_t k) : axis(static_cast<int>(k / 2)), far(k % 2 == 1) {}
  /// Unit, out of the wall and into the cell.
  Vec3 normal() const { return (far ? -1.0 : 1.0) * Vec3::Unit(axis); }
  /// How far x is in front of it; < 0 behind.
  double height_of(const Vec3& x, const Cell& cell) const {
    return far ? cell.edges(axis, axis) - x[axis] : x[axis];
  }
};

/// From a's centre to the centre of b's image. Not for walls.
inline Vec3 branch_vector(const Pair& pair, const Particles& particles, const Cell& cell) {
  const Vec3& a = particles.position[static_cast<std::size_t>(pair.a)];
  const Vec3& b = particles.position[static_cast<std::size_t>(pair.b)];
  // Of most pairs neither is an image.
  return pair.image == Image{} ? Vec3(b - a) : Vec3(b + cell.translation(pair.image) - a);
}

class NeighbourList {
 public:
  /// Lists the pairs whose bounding spheres come within `skin` (> 0, length).
  void build(const Particles& particles, const Cell& cell, double skin);

  /// Does (1) still hold? Looks at how far particles moved relative to the cell, how much the
  /// cell shrank and how much particles grew since build().
  bool is_current(const Particles& particles, const Cell& cell) const;

  /// In ascending order.
  const std::vector<Pair>& pairs() const { return pairs_; }

  /// A particle's part in pair `index`: as its a or as its b.
  struct Incidence {
    std::uint32_t index;
    bool as_b;
  };
  /// The pairs of particle i, in ascending order.
  const Incidence* begin_of(std::size_t i) const { return incidences_.data() + first_[i]; }
  const Incidence* end_of(std::size_t i) const { return incidences_.data() + first_[i + 1]; }

  /// What build() saw; with pairs() all there is to save. Reduced positions are in parts of the
  /// cell's edges.
  struct Reference {
    Mat3 edges = Mat3::Zero();  ///< of the cell
    double skin = 0.0;
    double largest_radius = 0.0;
    std::vector<Vec3> reduced_position;
  };
  const Reference& reference() const { return reference_; }
  /// Puts back a saved list.
  void restore(Reference reference, std::vector<Pair> pairs);

 private:
  void index_incidences(std::size_t particles);

  Reference reference_;
  std::vector<Pair> pairs_;
  std::vector<Incidence> incidences_;
  std::vector<std::size_t> first_;
};

}  // namespace tangency::dem
