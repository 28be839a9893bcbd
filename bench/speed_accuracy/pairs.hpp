// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The pairs that speed is held against accuracy on, and what is true of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tangency/bench/speed_accuracy/score.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::speed_accuracy {

inline constexpr std::uint64_t kSeed = 20261122;

/// Pairs of one kind. A's centre is at the origin, so that the rounded separation that following
/// takes is the true one.
struct Pairs {
  std::string name;
  std::vector<verify::RawEllipsoid> raw;  ///< A and B of every pair in turn, as `bodies`
  std::vector<Ellipsoid> bodies;
  std::vector<IndexedPair> list;
  std::vector<double> smallest;       ///< semi-axis of each pair
  double least;                       ///< of those
  std::vector<Vec3> previous_normal;  ///< of a moment ago: bench/moved_back.hpp
  std::optional<BodyArray> array;     ///< of `bodies`, which therefore stay in place

  Pairs() = default;
  Pairs(const Pairs&) = delete;
  Pairs& operator=(const Pairs&) = delete;

  std::size_t size() const { return list.size(); }
  const Ellipsoid& a(std::size_t i) const { return bodies[2 * i]; }
  const Ellipsoid& b(std::size_t i) const { return bodies[2 * i + 1]; }
};

/// Names of all families: classes of contacts, extreme shapes, deep overlaps.
std::vector<std::string> family_names();

/// The first `count` pairs of a family; always the same.
std::unique_ptr<Pairs> draw_pairs(const std::string& family, std::size_t count);

/// From the 100-digit oracle. A normal is called unique where every other maximum is lower by more
/// than 1e-9 of the smallest semi-axis, so that no method's tolerance hides a tie.
Truth truth_of(const Pairs& pairs, std::size_t i);

}  // namespace tangency::speed_accuracy
