// SPDX-License-Identifier: MIT
/// @file
/// The sphere of directions cut into classes [Ouadfel1998, section 2.3.2 and appendix A].
///
/// Directions are unit vectors of any frame, areas are solid angles in steradian. Every partition
/// here is its own mirror image about the origin, so that a contact counted from either side gives
/// the same histogram. A partition never changes once made: any number of threads may read it.
#pragma once

#include <cstddef>
#include <vector>

#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::micromechanics {

/// (1) the areas add up to 4 pi
/// (2) class_of(-n) is opposite(class_of(n)), to the bit
/// (3) class_of(direction(g)) is g, and direction(opposite(g)) is -direction(g)
class SpherePartition {
 public:
  /// 24 n^2 classes of nearly equal area: the six faces of a cube by equal angles, each octant's
  /// third n by n. The largest area is to the smallest as 1.28 for n = 4, the published choice, and
  /// as less than sqrt(2) for any n. The 48 symmetries of the cube take classes to classes.
  /// @param n  1 to 1000, else std::invalid_argument
  static SpherePartition near_uniform(int n);

  /// Rings of equal angle about an axis, each cut into sectors of equal angle. Areas differ by as
  /// much as the sine of the angle to the axis does: 11.4 for 18 rings of 36 sectors, the published
  /// choice.
  /// @param rings    at least 1
  /// @param sectors  even, so that opposite directions are of opposite classes
  /// @param axis     of any length but 0; std::invalid_argument otherwise, as of the other two
  static SpherePartition polar(int rings, int sectors, const Vec3& axis = Vec3::UnitZ());

  /// The number of classes.
  std::size_t size() const { return area_.size(); }
  /// Solid angle of a class.
  double area(std::size_t g) const { return area_[g]; }
  /// Unit vector at the middle of a class by its angles, the published place.
  const Vec3& direction(std::size_t g) const { return direction_[g]; }
  /// The class opposite to class g.
  std::size_t opposite(std::size_t g) const;

  /// The class of a direction, in a time that does not grow with the number of classes. Of equally
  /// large components the first decides the face of the cube; an edge belongs to the class farther
  /// from the middle of the face or from the axis. That holds on one half of the sphere, and (2) on
  /// the other.
  /// @param n  of any length but 0
  std::size_t class_of(const Vec3& n) const;

  /// Of a polar partition: how many rings, the axis, and the sectors of each. Near-uniform ones
  /// have 0 rings.
  std::size_t rings() const { return rings_; }
  /// The number of sectors of each ring.
  std::size_t sectors() const { return sectors_; }
  /// Of the rings, unit.
  const Vec3& axis() const { return axis_; }

 private:
  std::size_t cube_class(const Vec3& n) const;
  std::size_t ring_class(const Vec3& n) const;

  std::size_t patches_ = 0;       ///< n of near_uniform, else 0
  std::vector<double> tangents_;  ///< of the edges of patches, the first 0
  std::size_t rings_ = 0, sectors_ = 0;
  Vec3 axis_ = Vec3::Zero(), first_ = Vec3::Zero(), second_ = Vec3::Zero();
  std::vector<double> area_;
  std::vector<Vec3> direction_;
};

}  // namespace tangency::inline v0::micromechanics
