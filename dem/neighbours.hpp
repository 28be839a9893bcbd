// SPDX-License-Identifier: MIT
/// @file
/// Which pairs of particles may touch before the list is next renewed.
///
/// Each particle has a skin, a length in proportion to its own size; thicker where it moves fast.
/// The list holds the pairs of images whose gap is at most the sum of both skins, each pair once,
/// in an order that depends on nothing but the positions. docs/derivations/neighbour-list.md
/// derives how long it lasts.
///
/// (1) Every pair that touches is listed as long as is_current() is true.
/// (2) No pair is listed twice; a particle may meet itself through the periodic boundary.
/// (3) A cell of any size is served, one smaller than a particle included.
/// (4) In a plane cell no image moves along z, in a walled one none along a walled axis.
/// (5) Every particle that touches a wall is listed with it, like (1).
/// (6) A listed pair was within its skins and the error of its gap when the list was built.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// Particle `a` and the image of particle `b`; a <= b, and for a == b the image is positive in
/// lexicographic order. Or, with b = number of particles + k, particle `a` and wall k (WallFace).
struct Pair {
  std::int32_t a, b;  ///< indices of particles; of a wall and a particle, b is the particle
  Image image;        ///< the image of b

  /// By a, then b, then image.
  auto operator<=>(const Pair&) const = default;
};

/// Faces of a cell that may be walls; after them its planes are counted.
inline constexpr std::size_t kCellFaces = 6;

/// Wall k as a body at x sees it: the face at the origin's end (even k) or at the far end (odd k)
/// of axis k / 2, from kCellFaces on a plane of the cell.
struct WallFace {
  Vec3 normal;    ///< unit, out of the wall
  double height;  ///< how far x is in front of it; < 0 behind

  /// Of wall k, which the cell has to have.
  WallFace(std::size_t k, const Vec3& x, const Cell& cell);
};

/// From a's centre to the centre of b's image. Not for walls.
inline Vec3 branch_vector(const Pair& pair, const Particles& particles, const Cell& cell) {
  const Vec3& a = particles.position[static_cast<std::size_t>(pair.a)];
  const Vec3& b = particles.position[static_cast<std::size_t>(pair.b)];
  // Of most pairs neither is an image.
  const auto& [x, y, z] = pair.image;
  return (x | y | z) == 0 ? Vec3(b - a) : Vec3(b + cell.translation(pair.image) - a);
}

/// Pairs that may touch until the particles have moved by the skin.
class NeighbourList {
 public:
  /// Lists the pairs whose gap is at most the sum of their skins. Where it throws it is as it was.
  /// @param particles  all of them
  /// @param cell  the cell they are in
  /// @param skin_ratio  > 0: a particle's least skin in its mean radii (mean_radius_of())
  /// @param dt  time step: skins last at least some steps of the motion that particles have now, up
  ///            to half of a mean radius; 0: the same ratio for all
  /// @throws std::invalid_argument  where particles are too far away for geometry/near_pairs.hpp
  void build(const Particles& particles, const Cell& cell, double skin_ratio, double dt = 0.0);

  /// Does (1) still hold?
  bool is_current(const Particles& particles, const Cell& cell) const;

  /// The least that is left of a skin among particles [first, last), length; the list is current
  /// where it is > 0 for all. A skin is used up by how far the particle moved relative to the cell,
  /// how it turned and grew, and how the cell strained since build(). Infinite for no particles, -
  /// infinite where the list is not of these particles. Several threads may ask at a time.
  double least_slack(const Particles& particles, const Cell& cell, std::size_t first,
                     std::size_t last) const;

  /// In ascending order.
  const std::vector<Pair>& pairs() const { return pairs_; }

  /// Indices [first, last) into pairs().
  struct Range {
    std::size_t first, last;  ///< pairs [first, last)
  };
  /// The pairs in which particle i is a, walls included: they follow each other.
  Range pairs_as_a(std::size_t i) const { return {first_as_a_[i], first_as_a_[i + 1]}; }
  /// The pairs in which it is b, in ascending order. A pair with its own image is in both.
  std::span<const std::uint32_t> pairs_as_b(std::size_t i) const {
    return std::span(as_b_).subspan(first_as_b_[i], first_as_b_[i + 1] - first_as_b_[i]);
  }
  /// Calls f(index, as_b) for each pair of particle i: first those in which it is b, then those in
  /// which it is a, each in ascending order.
  template <class F>
  void for_each_pair_of(std::size_t i, F&& f) const {
    for (const std::uint32_t index : pairs_as_b(i)) f(std::size_t{index}, true);
    const Range range = pairs_as_a(i);
    for (std::size_t index = range.first; index < range.last; ++index) f(index, false);
  }

  /// What build() saw; with pairs() all there is to save.
  struct Reference {
    Mat3 edges = Mat3::Zero();            ///< of the cell
    std::vector<double> skin;             ///< of each particle, length
    std::vector<Vec3> reduced_position;   ///< in parts of the cell's edges
    std::vector<Quaternion> orientation;  ///< one a particle
    std::vector<Vec3> semi_axes;          ///< one a particle, length
    std::vector<double> planes = {};      ///< offsets of the cell's planes
  };
  /// What the list was built from.
  const Reference& reference() const { return reference_; }
  /// Puts back a saved list.
  void restore(Reference reference, std::vector<Pair> pairs);

 private:
  /// What least_slack() needs of a particle's shape at the build.
  struct Skin {
    double thickness;
    double ball;    ///< radius of the bounding sphere with the skin
    double spread;  ///< largest less smallest semi-axis: what a turn can bring nearer
  };
  void list_walls(const Particles& particles, const Cell& cell, std::size_t i);
  void measure_skins();
  void index_pairs();

  Reference reference_;
  Mat3 inverse_edges_ = Mat3::Zero();  ///< of the reference
  std::vector<Skin> skins_;
  std::vector<Pair> pairs_;
  std::vector<std::uint32_t> first_as_a_, first_as_b_, as_b_;
};

}  // namespace tangency::inline v0::dem
