// SPDX-License-Identifier: MIT
/// @file
/// Bodies that move at every step of a simulator, for the batch calls of gap_batch.hpp and for
/// neighbours.hpp: made from columns of semi-axes, orientations and centres, and no Ellipsoid is
/// made unless a single call needs one. A refresh costs a tenth of what the constructor of
/// Ellipsoid and BodyArray::refresh() do.
///
/// Lengths in any one unit; an orientation turns body coordinates into space coordinates, and means
/// R(q/|q|) exactly whatever its length is. Numbers in float are meant as the values they have.
///
/// (1) What is asked of a body depends on its numbers alone, to the bit: not on how they came here,
///     in double or float of the same value, in which range, or what the body was before.
/// (2) Bodies with centres have the gaps of the same bodies without at the separations c_B - c_A:
///     signed_gaps() within the errors of both, whose own counts what the difference is rounded by;
///     follow_gaps(), which asks of the rounded one, to the bit.
/// (3) remove() leaves every body as it is but the last, which takes the free place.
///
/// The bodies are in one of two states:
///  - they *look at* columns of the caller's, who keeps them in place and calls refresh(): all are
///    centred at the origin then, so that a question about a pair gives its separation;
///  - they *own* their numbers: what is handed over is copied, and no column has to outlive a call.
/// The first call of the second kind copies columns that were looked at.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <tangency/geometry/ellipsoid.hpp>
#include <tangency/geometry/large_pages.hpp>
#include <tangency/geometry/lattice.hpp>
#include <tangency/geometry/strided.hpp>
#include <tangency/geometry/vectors.hpp>

namespace tangency::inline v0 {

namespace detail {
struct FloatRow;
struct LaneBody;
struct ShapeRow;
}  // namespace detail

/// Where bodies are and how they are turned, of a range of them.
struct PoseColumns {
  QuaternionColumn orientations;  ///< of each body, of any length but 0
  VectorColumn centres = {};      ///< as many; or none: all at the origin
};

/// What is asked of bodies that are looked at.
enum class Questions {
  any,
  /// None in single precision: no Accuracy::fast(), or any other `of_size` that is not below its,
  /// and no cutoff; a call that asks for one ends the process. A refresh takes a sixth less.
  in_double,
};

/// The bodies Ellipsoid(centre, semi_axes[i], orientations[i]).
///
/// What the batch reads of them is what they were at the last refresh(), or when they were last
/// set: 288 bytes a body, 224 where questions are in double alone. Bodies that do not overlap as
/// ranges may be refreshed and set by different threads, but for the calls that change their
/// number, the first call that owns numbers and the first that gives bodies centres. One that was
/// moved from is empty; so is the copy of one that looks at columns, whose owner has columns of his
/// own to look_at().
///
/// Here and below a column of another length, and an index that is none, end the process with one
/// line on standard error. Numbers that make no ellipsoid do so where a pair names them.
class MovingBodies {
 public:
  MovingBodies() noexcept;
  /// Looks at the columns, and refreshes all of them.
  /// @param semi_axes  of each body, finite and > 0
  /// @param orientations  as many as semi_axes
  MovingBodies(std::span<const Vec3> semi_axes, std::span<const Quaternion> orientations);
  /// Owns copies.
  MovingBodies(const VectorColumn& semi_axes, const PoseColumns& poses);
  ~MovingBodies();
  /// The copy of bodies that look at columns is empty, that of bodies that own their numbers owns
  /// its own.
  MovingBodies(const MovingBodies&);
  /// As the constructor does.
  MovingBodies& operator=(const MovingBodies&);
  /// Its source is empty afterwards.
  MovingBodies(MovingBodies&&) noexcept;
  /// Its source is empty afterwards.
  MovingBodies& operator=(MovingBodies&&) noexcept;

  /// Other columns from now on, to be refreshed before anything is asked. Allocates only where
  /// there are more bodies than there ever were.
  void look_at(std::span<const Vec3> semi_axes, std::span<const Quaternion> orientations);
  /// The same for some questions alone. Of bodies that own their numbers anything may be asked,
  /// whatever was said here before.
  void look_at(std::span<const Vec3> semi_axes, std::span<const Quaternion> orientations,
               Questions questions);

  /// To be called after columns that are looked at were changed, from body `first` to before
  /// `last`; of bodies that are owned it changes nothing. What is written does not depend on the
  /// ranges.
  /// @param first  the first body of the range
  /// @param last  not before first, and at most size()
  void refresh(std::size_t first, std::size_t last) noexcept;

  // What follows owns its numbers, and needs no refresh().

  /// All bodies anew; whether they have centres is as the poses say. Allocates only where there are
  /// more bodies than there ever were.
  void assign(const VectorColumn& semi_axes, const PoseColumns& poses);
  /// The bodies from `first` on, as many as there are orientations; their semi-axes stay. Centres
  /// stay too where the poses have none.
  void set_poses(std::size_t first, const PoseColumns& poses);
  /// @overload
  void set_pose(std::size_t i, const Quaternion& orientation, const Vec3& centre);
  /// The bodies from `first` on, as many as there are rows; their poses stay.
  void set_semi_axes(std::size_t first, const VectorColumn& semi_axes);
  /// At the end. Bodies without centres have some from now on, those before at the origin. The
  /// arguments may be numbers of these bodies.
  /// @return  its index
  std::size_t add(const Vec3& semi_axes, const Quaternion& orientation, const Vec3& centre);
  /// The last body becomes body i.
  void remove(std::size_t i);
  /// Drops bodies at the end, or adds balls of radius 1 at the origin, to be set. Where no body is
  /// left there are no centres either, until some are set.
  void resize(std::size_t count);

  /// The number of bodies.
  std::size_t size() const noexcept { return semi_axes_.size(); }
  /// Are centres owned, so that separations need not be given?
  bool has_centres() const noexcept { return !centres_.empty(); }
  /// As many as bodies, or none. Valid until their number changes.
  std::span<const Vec3> centres() const noexcept { return centres_; }
  /// The body as its columns have it now. i < size(), not checked.
  /// @throws InvalidEllipsoid
  Ellipsoid operator[](std::size_t i) const;

  /// c_B + edges * image - c_A of each pair, rounded, for PairList::separations. Bodies need
  /// centres.
  /// @param pairs  which bodies, and which image of the second
  /// @param edges  columns: the edge vectors of the cell
  /// @param answers  as many as pairs
  void separations(std::span<const NearPair> pairs, const Mat3& edges,
                   std::span<Vec3> answers) const noexcept;

  /// For the library's own use.
  const detail::LaneBody* lanes() const noexcept { return lanes_.data(); }
  /// For the library's own use.
  const detail::ShapeRow* rows() const noexcept { return rows_.data(); }
  /// For the library's own use: null where questions are in double alone.
  const detail::FloatRow* floats() const noexcept {
    return floats_.empty() ? nullptr : floats_.data();
  }

 private:
  void own();
  void look_at_own() noexcept;
  void give_centres();
  void fill(std::size_t first, std::size_t count) noexcept;

  std::span<const Vec3> semi_axes_;
  std::span<const Quaternion> orientations_;
  bool owns_ = false;
  std::vector<Vec3> own_axes_, centres_;  ///< centres: none, or as many as bodies
  std::vector<Quaternion> own_turns_;
  std::vector<detail::LaneBody, LargePages<detail::LaneBody>> lanes_;
  std::vector<detail::ShapeRow, LargePages<detail::ShapeRow>> rows_;
  std::vector<detail::FloatRow, LargePages<detail::FloatRow>> floats_;  ///< as rows_, or none
};

}  // namespace tangency::inline v0
