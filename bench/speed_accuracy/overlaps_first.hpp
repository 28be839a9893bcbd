// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Does it pay to ask overlaps() first, and for the contact only where the answer is yes? A
/// neighbour list holds pairs that touch and pairs that are near; the share of the former decides.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>

namespace tangency::speed_accuracy {

/// Listed pairs in random order: contacts of a class that overlap, and the same shapes at gaps of
/// up to 20 % of the mean radius of the two bodies (the geometric mean of semi-axes, averaged).
struct ListedPairs {
  std::string family;
  int touching;                   ///< percent
  std::vector<Ellipsoid> bodies;  ///< A and B of every pair in turn
  std::vector<IndexedPair> list;
  std::vector<double> gap;   ///< true
  std::vector<double> unit;  ///< smallest semi-axis
  std::vector<Vec3> previous_normal;
};

/// The shares of touching pairs that are tried, in percent.
std::span<const int> touching_shares();

/// @param family  a name of verify::contact_classes()
ListedPairs listed_pairs(const std::string& family, int touching, std::size_t count);

/// The contacts of all touching pairs, in two ways.
struct Ahead {
  std::string method;           ///< that gives the contact
  std::int64_t level = 0;       ///< 0: one pair at a time
  std::function<void()> all;    ///< of every pair
  std::function<void()> asked;  ///< of those that overlaps() says yes to
  /// After both: has each way found every touching pair's gap, and no other's below 0?
  std::function<bool()> right;
};

/// @param pairs, array  must outlive the result; `array` is of the pairs' bodies
std::vector<Ahead> ways_to_contacts(const ListedPairs& pairs, const BodyArray& array,
                                    std::span<const std::int64_t> levels);

}  // namespace tangency::speed_accuracy
