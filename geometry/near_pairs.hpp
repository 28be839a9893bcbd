// SPDX-License-Identifier: MIT
/// @file
/// Which bodies come near each other: all pairs of bounding spheres that meet, among many bodies of
/// any sizes in open space or in a lattice of periodic images.
///
/// Body i is the ball of radius reach[i] about centre[i]: its bounding sphere and what is to be
/// listed around it. Lengths are in any one unit, and finite doubles of any size. A pair is (a, b,
/// image): the body a as stored and the body b moved by edges * image. Centres need not lie in the
/// cell.
///
/// (1) Every pair of images whose balls share a point is listed, for the doubles as stored and
///     exact arithmetic. Pairs that are apart by no more than margin() may be listed too, others
///     are not.
/// (2) Each pair is listed once: a <= b, and where a == b the image is lexicographically positive.
///     The list is in ascending order of a, b, image.
/// (3) Cells of any shape are served: skewed ones, and those smaller than a body, which meets its
///     own images then. Along an axis that is not periodic every image is 0.
/// (4) The list does not depend on how the search is divided among threads.
///
/// Bodies lie in grids, one for each power of two of the reach, and look for others in their own
/// and in the coarser ones: large and small bodies together cost what equal ones do. Time and
/// memory are linear in bodies and listed pairs where no more than some tens of balls share a
/// point.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <tangency/geometry/lattice.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

namespace detail {
class NearGrids;
}  // namespace detail

/// The search in parts, for callers with threads. Keeps copies of what it needs.
class NearPairSearch {
 public:
  /// @param lattice  which edges the bodies are repeated along
  /// @param centres  finite
  /// @param reaches  finite, >= 0; one a centre
  /// @throws std::invalid_argument  naming what is not so; where edges are linearly dependent, or a
  ///     periodic one is below 2^-1000 of the largest length; where a body is 2^29 edges away, or
  ///     so far that rounding moves it by a cell; where a ball holds more than 2^20 of its own
  ///     images along an axis
  NearPairSearch(std::span<const Vec3> centres, std::span<const double> reaches,
                 const Lattice& lattice);
  ~NearPairSearch();
  /// Its source is empty afterwards.
  NearPairSearch(NearPairSearch&&) noexcept;
  /// Its source is empty afterwards.
  NearPairSearch& operator=(NearPairSearch&&) noexcept;

  /// Bodies: parts of the search are ranges of [0, size()). Neighbours in that order are near each
  /// other in space.
  std::size_t size() const noexcept;

  /// Appends the pairs that part [first, last) finds, in no order. Parts that cover [0, size())
  /// once find each pair once. Several threads may search at a time.
  void find(std::size_t first, std::size_t last, std::vector<NearPair>& found) const;

  /// How far two balls may be apart and be listed, length: some 2^-46 of the largest coordinate,
  /// and 2^-1022 or more.
  double margin() const noexcept;

 private:
  std::unique_ptr<const detail::NearGrids> grids_;
};

/// What the parts of a search found, as one list in ascending order.
/// @param parts  what each part of the search found
/// @param bodies  every a is below
std::vector<NearPair> sorted_pairs(std::span<const std::vector<NearPair>> parts,
                                   std::size_t bodies);

/// The whole search on the calling thread. @throws  as NearPairSearch
std::vector<NearPair> near_pairs(std::span<const Vec3> centres, std::span<const double> reaches,
                                 const Lattice& lattice = Lattice::open());

}  // namespace tangency::inline v0
