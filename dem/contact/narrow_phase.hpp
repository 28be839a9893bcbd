// SPDX-License-Identifier: MIT
/// @file
/// The narrow phase: whether and where listed pairs touch, the one place that asks geometry. Each
/// kind of body pays for itself alone: spheres for a square root, ellipses for the plane's solver,
/// ellipsoids for the batch.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tangency/dem/cell.hpp>
#include <tangency/dem/neighbours.hpp>
#include <tangency/dem/particles.hpp>
#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/ellipse.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/indexed_pair.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0::dem {

/// Which answer of a pair with several is meant.
enum class Branch {
  follow,  ///< that of the step before, while it lasts
  global,  ///< the shortest way out, at the cost of a search
  /// That of the published scheme of curves (geometry/trace_contact.hpp), an approximation, for the
  /// ellipsoids that it answers; else as follow. Slow: it is there to be compared with.
  trace,
};

/// Pairs of a block whose answer took another way than most, for a Profile.
struct MeasuredPairs {
  std::int64_t slow = 0;        ///< gaps of ellipsoids that took more than the fast tier
  std::int64_t unanswered = 0;  ///< of Branch::trace: that touch, and the scheme does not answer
};

/// Pairs that are looked at together. Measured on assembly-1000: from 32 to 256 the time differs by
/// less than a tenth.
inline constexpr std::size_t kPairBlock = 64;

/// How the bodies of a block of pairs lie at the current positions, in columns. Entries from the
/// number of pairs on are pairs of no extent that lie apart.
struct BlockGeometry {
  template <class T>
  /// A value a pair of a block.
  using Column = std::array<T, kPairBlock>;

  Column<IndexedPair> pairs;  ///< particles, and after them walls
  Column<Vec3> branch;        ///< c_b - c_a; to a wall: to where the wall is touched
  Column<double> gap;         ///< signed, length; of pairs known to be apart without it: infinite
  Column<Vec3> normal;        ///< unit, from a to b; 0: not known
  Column<Vec3> arm;           ///< contact point - c_a, midpoint of the witness points
};

/// The particles as bodies of geometry, and the questions that pairs of them ask.
class NarrowPhase {
 public:
  /// Looks at these particles from now on; before every refresh(), since they may have moved in
  /// memory or changed their kind.
  void aim(const Particles& particles);

  /// Takes over shapes and orientations of particles first to last - 1. Different ones may be
  /// refreshed by different threads.
  void refresh(const Particles& particles, std::size_t first, std::size_t last);

  /// How pairs lie, at most kPairBlock of them. By Branch::trace body A of the scheme, which
  /// answers otherwise for (B, A), is the one that comes first in the scene: the order in memory
  /// does not matter. Walls, and particles that are all spheres, are measured by their formulas;
  /// for spheres that is the scheme's answer.
  /// @param pairs  which bodies, and which image of the second
  /// @param particles  all of them
  /// @param cell  the cell they are in
  /// @param branch  which gap is a contact
  /// @param block  where the answers go
  /// @param normals  of a step before, 0 where not known: starts for Branch::follow
  MeasuredPairs measure(std::span<const Pair> pairs, const Particles& particles, const Cell& cell,
                        std::span<const Vec3> normals, Branch branch, BlockGeometry& block) const;
  /// The same of the first pairs of a block, whose bodies and separations stand there already: no
  /// walls, and of branches follow and global alone.
  ///
  /// There are `count` of them, at most kPairBlock, with as many normals as above. The accuracy is
  /// that of the gaps of ellipsoids.
  MeasuredPairs measure(std::size_t count, std::span<const Vec3> normals, Branch branch,
                        const Accuracy& accuracy, BlockGeometry& block) const;

  /// Principal curvatures of the distance between two touching bodies of a block.
  PrincipalCurvatures relative_curvature(const IndexedPair& pair, const Vec3& normal) const;

  /// The ellipsoids as the lanes read them; none where the particles are of another kind.
  std::span<const tangency::detail::LaneBody> rows() const;

 private:
  enum class Kind { spheres, ellipses, ellipsoids };
  void measure_spheres(std::size_t count, BlockGeometry& block) const;
  std::int64_t measure_ellipsoids(std::size_t count, std::span<const Vec3> normals, Branch branch,
                                  const Accuracy& accuracy, BlockGeometry& block) const;
  std::int64_t trace(std::size_t count, const Particles& particles, BlockGeometry& block) const;
  void measure_wall(std::size_t k, std::size_t wall, const Particles& particles, const Cell& cell,
                    BlockGeometry& block) const;

  Kind kind_ = Kind::spheres;
  std::vector<double> radii_;      ///< of spheres
  std::vector<Ellipse> ellipses_;  ///< centred at the origin, as ellipsoids are
  MovingBodies bodies_;            ///< the ellipsoids
};

}  // namespace tangency::inline v0::dem
