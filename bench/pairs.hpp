// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What is timed: pairs of ellipsoids whose truth is known, and the check of all answers before a
/// time is taken. Always the same pairs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/verify/families/manufactured.hpp>
#include <tangency/verify/grade/calls.hpp>
#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::bench {

inline constexpr std::uint64_t kSeed = 20261122;

/// Pairs of one kind.
struct Pairs {
  std::string name;
  std::vector<Ellipsoid> bodies;          ///< A and B of every pair in turn
  std::vector<verify::RawEllipsoid> raw;  ///< as `bodies`; empty where they are not drawn as such
  std::vector<IndexedPair> list;
  std::vector<double> smallest;          ///< semi-axis of each pair
  std::vector<Vec3> previous_normal;     ///< that the pair had when B was as in moment_ago()
  std::vector<verify::CallTruth> truth;  ///< in the smallest semi-axis
  std::optional<BodyArray> array;        ///< of `bodies`, which therefore stay in place

  Pairs() = default;
  Pairs(const Pairs&) = delete;
  Pairs& operator=(const Pairs&) = delete;

  /// A pair with its previous normal; `raw`, `truth` and `array` are the caller's.
  void add(const Ellipsoid& a, const Ellipsoid& b);
  std::size_t size() const { return list.size(); }
  const Ellipsoid& a(std::size_t i) const { return bodies[2 * i]; }
  const Ellipsoid& b(std::size_t i) const { return bodies[2 * i + 1]; }
};

/// B a moment ago: moved and turned by 1e-4, of the smallest semi-axis and in rad, which is more
/// than a simulator's step; in a direction of its own for each i.
Ellipsoid moment_ago(const Ellipsoid& b, double smallest_semi_axis, std::size_t i);

/// The first `count` contacts of a class, whose gaps are known without a solver.
std::unique_ptr<Pairs> contacts_of(const verify::ContactFamily& kind, std::size_t count);

/// Names of the families of drawn_pairs(): classes of contacts, extreme shapes, deep overlaps.
std::vector<std::string> family_names();

/// The first `count` pairs of a family. A's centre is at the origin, so that the rounded separation
/// that following takes is the true one. Truth is that of truth_of(), and not there yet.
std::unique_ptr<Pairs> drawn_pairs(const std::string& family, std::size_t count);

/// From the 100-digit oracle. A normal is called unique where every other maximum is lower by more
/// than 1e-9 of the smallest semi-axis, so that no method's tolerance hides a tie.
verify::CallTruth truth_of(const Pairs& pairs, std::size_t i);

verify::CallAnswer to_answer(const Gap& gap);

/// Answers of a batch by columns, with room for whole blocks of lanes.
struct Columns {
  std::vector<double> gap, gap_error;
  std::vector<Vec3> normal, arm_a, arm_b;
  std::vector<GapStatus> status;

  explicit Columns(std::size_t pairs);
  /// Of the first pairs: gap, gap_error, normal and status, which is what is timed.
  GapColumns usual(std::size_t count);
  GapColumns arms(std::size_t count);
  verify::CallAnswer answer(std::size_t i) const;
};

/// Of answers to contacts_of(): claimed bounds are not judged, since that truth is rounded itself.
verify::CallGrade grade_without_bounds(const Pairs& contacts,
                                       std::vector<std::optional<verify::CallAnswer>> answers);

/// Their largest error and their largest gap_error, in one line. Ends the program where an answer
/// is missing, or its sign is wrong, or its gap, local or not, is further from the truth than
/// rounding.
std::string require_right(const std::string& name, const Pairs& contacts,
                          const std::vector<std::optional<verify::CallAnswer>>& answers);

}  // namespace tangency::bench
