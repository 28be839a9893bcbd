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

#include <tangency/bench/pairs.hpp>

namespace tangency::speed_accuracy {

/// The shares of touching pairs that are tried, in percent.
inline constexpr int kTouchingShares[] = {0, 10, 25, 50, 75, 90, 100};

/// Listed pairs in random order: contacts of a class that overlap, and the same shapes at gaps of
/// up to 20 % of the mean radius of the two bodies (the geometric mean of semi-axes, averaged).
/// @param family  a name of verify::contact_classes()
/// @param touching  percent
std::unique_ptr<bench::Pairs> listed_pairs(const std::string& family, int touching,
                                           std::size_t count);

/// The contacts of all touching pairs, in two ways.
struct Ahead {
  std::string method;           ///< that gives the contact
  std::int64_t level = 0;       ///< 0: one pair at a time
  std::function<void()> all;    ///< of every pair
  std::function<void()> asked;  ///< of those that overlaps() says yes to
  /// After both: has each way found every touching pair's gap, and no other's below 0?
  std::function<bool()> right;
};

/// @param pairs  must outlive the result
std::vector<Ahead> ways_to_contacts(const bench::Pairs& pairs,
                                    std::span<const std::int64_t> levels);

}  // namespace tangency::speed_accuracy
