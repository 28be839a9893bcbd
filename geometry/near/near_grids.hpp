// SPDX-License-Identifier: MIT
/// @file
/// The grids in which near_pairs.hpp searches. Internal: what is promised stands there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tangency/geometry/lattice.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::detail {

/// Bodies sorted into boxes, a grid a level, level 0 that of the largest.
class NearGrids {
 public:
  NearGrids(std::span<const Vec3> centres, std::span<const double> reaches, const Lattice& lattice);

  std::size_t size() const { return bodies_.size(); }
  double margin() const;  ///< in the caller's unit of length
  void find(std::size_t first, std::size_t last, std::vector<NearPair>& found) const;

 private:
  using Place = std::array<std::int64_t, 3>;
  struct Level {
    double reach = 0.0;  ///< the largest
    std::size_t bodies = 0;
    Vec3 scale = Vec3::Zero();  ///< boxes per unit of the reduced coordinate
    Place count{1, 1, 1};
    bool hashed = false;
    std::size_t first_bucket = 0;
    std::uint64_t mask = 0;  ///< of a hash table
  };
  struct Body {
    Vec3 centre;  ///< moved into the cell along the periodic axes
    double reach;
  };
  /// What is read of the body that looks around itself.
  struct Seat {
    Vec3 reduced;  ///< centre in parts of the edges
    LatticeImage home;
    std::uint32_t id;
    std::uint64_t box;
  };
  /// Boxes of a level that a body looks into, in numbers that go on beyond the cell.
  struct Range {
    Place first, last;
    bool empty = false;
  };
  struct Look;

  void choose_unit(std::span<const Vec3> centres, std::span<const double> reaches);
  void scale_edges();
  void measure(std::span<const Vec3> centres, std::span<const double> reaches);
  void require_few_images() const;
  void shape_levels();
  void sort(std::span<const Vec3> centres, std::span<const double> reaches,
            const std::vector<std::uint8_t>& level_of);
  Seat seat_of(std::uint32_t id, const Vec3& centre) const;
  Place place_of(const Level& level, const Vec3& reduced) const;
  std::uint64_t box_of(const Level& level, const Place& place) const;
  std::size_t bucket_of(const Level& level, std::uint64_t box) const;
  Range range_around(const Level& level, const Seat& seat, double reach) const;
  void look_around(std::size_t at, const Level& level, bool own,
                   std::vector<NearPair>& found) const;
  void look_along_row(Look& look, Place place, std::int64_t last) const;

  double unit_ = 1.0;  ///< a power of two: lengths below are the caller's times this
  Lattice lattice_;
  Mat3 inverse_;
  Vec3 heights_;  ///< distances of opposite faces
  /// Of the reduced coordinates; along open axes as found.
  Vec3 low_ = Vec3::Zero(), extent_ = Vec3::Ones();
  double margin_ = 0.0;        ///< rounding of a distance
  Vec3 slack_ = Vec3::Zero();  ///< of reduced coordinates
  std::vector<Level> levels_;
  std::vector<std::uint32_t> starts_;  ///< of each bucket, in bodies_
  std::vector<Body> bodies_;
  std::vector<Seat> seats_;
  std::vector<std::uint8_t> level_at_;
};

}  // namespace tangency::inline v0::detail
