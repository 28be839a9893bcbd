// SPDX-License-Identifier: MIT
/// @file
/// The pairs of a batch call, wherever their bodies are: in blocks for the lanes, and one by one
/// for the single calls, which answer what no lane proves. Internal.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include <tangency/geometry/batch/lane_block.hpp>
#include <tangency/geometry/body_array.hpp>
#include <tangency/geometry/bounded_gap.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/geometry/pair_list.hpp>

namespace tangency::inline v0::detail {

inline constexpr std::size_t kBlock = LaneBlock::kPairs;

/// A body of a call, which ends the process where its numbers make none.
Ellipsoid made_body(const char* call, const MovingBodies& bodies, std::size_t body) noexcept;

/// Ends the process where separations are given and are not as many as pairs, or where none are and
/// the bodies have no centres.
void require_separations(const char* call, const PairList& list, bool bodies_have_centres) noexcept;

/// The pairs of one call.
struct PairTask {
  const char* call = nullptr;
  const BodyArray* bodies = nullptr;     ///< null: moving bodies or plain pairs
  const MovingBodies* moving = nullptr;  ///< null: the bodies above or plain pairs
  const LaneBody* lanes = nullptr;       ///< of the bodies
  const ShapeRow* rows = nullptr;        ///< of the bodies
  const FloatRow* floats = nullptr;      ///< of the bodies
  std::size_t body_count = 0;
  const IndexedPair* pairs = nullptr;
  const Ellipsoid *plain_a = nullptr, *plain_b = nullptr;
  const Vec3* separations = nullptr;
  const Vec3* previous_normals = nullptr;
  const Eigen::Vector3f* previous_floats = nullptr;  ///< in place of those
  bool answers_over_normals = false;  ///< else what a lane leaves open is still there
  std::size_t count = 0;
  // As in LaneBlock.
  double tolerance_of_size = 0.0, tolerance = 0.0;
  bool polish = false;
  double cutoff = std::numeric_limits<double>::infinity();  ///< Accuracy's

  bool has_cutoff() const noexcept { return cutoff < std::numeric_limits<double>::infinity(); }
  /// The answer itself, or what is said of a pair beyond the cutoff.
  Gap wanted(const Gap& gap) const noexcept;

  /// Is the tolerance what float proves?
  bool in_floats() const noexcept { return !polish && tolerance_of_size >= kFloatTolerance; }

  /// Ends the process where separations are not as many as pairs; of moving bodies without centres
  /// they have to be given.
  PairTask(const char* of_call, const BodyArray& of_bodies, const PairList& list) noexcept;
  PairTask(const char* of_call, const MovingBodies& of_bodies, const PairList& list) noexcept;
  /// a[i] and b[i].
  PairTask(const char* of_call, std::span<const Ellipsoid> a, std::span<const Ellipsoid> b,
           std::span<const Vec3> given_separations) noexcept;

  /// Are previous normals given?
  bool follows() const noexcept {
    return previous_normals != nullptr || previous_floats != nullptr;
  }
  bool indexed() const noexcept { return bodies != nullptr || moving != nullptr; }
  const Ellipsoid& a(std::size_t i) const noexcept {
    return bodies != nullptr ? (*bodies)[pairs[i].a] : plain_a[i];
  }
  const Ellipsoid& b(std::size_t i) const noexcept {
    return bodies != nullptr ? (*bodies)[pairs[i].b] : plain_b[i];
  }
  /// c_B - c_A, rounded.
  Vec3 separation(std::size_t i) const noexcept;

  // The single calls. A separation that is not finite ends the process: no lane proves anything of
  // it, and so it comes here.

  /// @param previous_normal  null, or 0: the pair is asked afresh
  Gap single(std::size_t i, const Vec3* previous_normal) const noexcept;
  BoundedGap bounded(std::size_t i) const noexcept;
  bool overlaps(std::size_t i) const noexcept;
  std::optional<bool> overlaps_by_filter(std::size_t i) const noexcept;

  /// Do the bodies have what the accuracy asks for? Else the process ends.
  void require_floats() const noexcept;
  /// Are the bodies of pairs first to first + n in the array? Else the process ends.
  void require_indices(std::size_t first, std::size_t n) const noexcept;

 private:
  void require_finite_separation(std::size_t i) const noexcept;
  Gap single(std::size_t i, const Ellipsoid& a, const Ellipsoid& b,
             const Vec3* previous_normal) const noexcept;
  [[noreturn]] void name_outside(std::size_t first, std::size_t n) const noexcept;
};

/// What is said of a pair beyond the cutoff.
/// @param least  its gap is not below that
inline Gap beyond(double least) noexcept {
  return {least,
          Vec3::Zero(),
          Vec3::Zero(),
          Vec3::Zero(),
          std::numeric_limits<double>::infinity(),
          GapStatus::beyond,
          GapTier::fast};
}

/// The bodies of a block of plain pairs, as the lanes read them.
struct PlainRows {
  LaneBody bodies_a[kBlock], bodies_b[kBlock];
  ShapeRow rows_a[kBlock], rows_b[kBlock];
  FloatRow floats_a[kBlock], floats_b[kBlock];
};

/// A block of pairs and copies of what belongs to them, so that the answers may be written where
/// the questions were.
struct Workspace {
  LaneBlock block;
  IndexedPair pairs[kBlock];
  Vec3 separations[kBlock], normals[kBlock];
  Vec3 nearer_normals[kBlock];
  double gap[kBlock], gap_error[kBlock];
  Vec3 normal[kBlock], arm_a[kBlock], arm_b[kBlock];

  /// Where the search of a pair starts; 0 is anywhere.
  Vec3 start(std::size_t i) const noexcept {
    return block.normals != nullptr ? Vec3(Vec3::Map(block.normals + 3 * i)) : Vec3(Vec3::Zero());
  }
  /// The answers are to stand here.
  void take_answers() noexcept;
};

/// Pairs that lanes left open, wherever they stand in the list, until there are a block of them.
struct OpenPairs {
  Workspace work;
  std::size_t place[kBlock];  ///< of each in the list
  Vec3 previous[kBlock];      ///< normals that the caller gave
  std::size_t count = 0;

  bool full() const noexcept { return count == kBlock; }
  /// Pair i of a block. The search starts at `start`.
  /// @param at  its place in the list
  void add(const Workspace& from, std::size_t i, std::size_t at, const Vec3& given,
           const Vec3& start) noexcept;
  /// Ready for the lanes, which are to answer here. count is at least 1.
  /// @param plain  as of gather()
  void complete(const PairTask& task, PlainRows* plain) noexcept;
};

/// Pairs first to first + count as the lanes read them, count at most kBlock and at least 1.
/// @param plain  where the bodies of plain pairs go, until those of another block do; null where
///               the pairs are indexed
void gather(const PairTask& task, std::size_t first, std::size_t count, Workspace& work,
            PlainRows* plain) noexcept;

}  // namespace tangency::inline v0::detail
