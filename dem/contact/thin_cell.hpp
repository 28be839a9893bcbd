// SPDX-License-Identifier: MIT
/// @file
/// When a cell is too thin for its particles: where one of them could touch an image of its own, or
/// two images of another. It then bears the cell's load on itself, and stresses are no longer those
/// of an assembly. docs/derivations/thin-cells.md derives the lengths.
///
/// (1) While the shortest period is at least LeastCell::free_period no contact is doubled, wherever
///     the particles are and however they are turned.
/// (2) Below LeastCell::period one can be: between two particles at some places, however they are
///     turned, or of the longest particle with its own image, where it is turned along the period.
/// (3) Walls have no images. Nearer to each other than LeastCell::wall_distance they leave no place
///     for the thickest particle, however it is turned.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/contact/contacts.hpp>
#include <tangency/dem/neighbours.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// The least lengths of a cell by the particles in it; a_1 >= a_2 the largest of their largest
/// semi-axes, c_1 >= c_2 of their smallest.
class LeastCell {
 public:
  /// Counts particles of these semi-axes.
  void add(const Vec3& semi_axes, std::size_t count = 1);

  double period() const;       ///< the larger of 2 a_1 and 2 (c_1 + c_2); of one particle 2 a_1
  double free_period() const;  ///< 2 (a_1 + a_2); of one particle 2 a_1
  double wall_distance() const { return 2.0 * smallest_[0]; }  ///< 2 c_1
  /// Is period() the length of the longest particle, and not that of two that are thick?
  bool is_of_one() const { return period() == 2.0 * largest_[0]; }

 private:
  /// Of all particles the two largest of their largest and of their smallest semi-axes.
  std::array<double, 2> largest_{}, smallest_{};
};

/// Of all particles.
LeastCell least_cell_of(const Particles& particles);

/// A length of a cell, and the least that is allowed.
struct ThinPlace {
  std::string what;      ///< "the cell's period along z, 3.99 m, is below 4 m, where ..."
  double length, least;  ///< length of the cell there, and the least that is allowed
};

/// Share of LeastCell::wall_distance() to which walls may squeeze particles in a run. Chosen: the
/// overlap that a sound run has at most, a tenth of the radius, at each of the two walls.
inline constexpr double kMostSqueeze = 0.9;

/// Where the cell is thinner than its particles allow, if anywhere.
/// @param cell  the cell they are in
/// @param least  fewest elements a range
/// @param squeezed  share of LeastCell::wall_distance() that is left to walls
std::optional<ThinPlace> thin_place(const Cell& cell, const LeastCell& least,
                                    double squeezed = 1.0);

/// A particle that touches an image of its own, or two images of another, if there is one; named by
/// their ids.
std::optional<ThinPlace> doubled_contact(const Particles& particles, const Contacts& contacts,
                                         const NeighbourList& list, const Cell& cell,
                                         const LeastCell& least);

/// The cell has become too thin, or the next step would make it so.
class CellTooThin : public std::runtime_error {
 public:
  /// Its text names the place.
  explicit CellTooThin(ThinPlace at) : std::runtime_error(at.what), place(std::move(at)) {}
  ThinPlace place;  ///< where the cell is too thin
};

}  // namespace tangency::inline v0::dem
