// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Moves: what a hunt does to a pair, each towards something that contact codes fear. A move draws
/// from `Draw` alone, in doubles, so that a seed makes the same pairs everywhere.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/pair.hpp>

namespace tangency::inline v0::verify {

/// Where the bodies of a pair are nearest: a guess, which need not be good.
struct Nearness {
  std::array<double, 3> normal{1, 0, 0};  ///< unit, from A to B
  double gap = 0;
  double size = 1;  ///< L = |d| + both largest semi-axes
};

struct Move {
  std::string_view name;
  std::string_view fear;  ///< what it leads to
  void (*change)(Draw& draw, EllipsoidPair& pair, const Nearness& near);
};

/// All of them, in an order that does not change within a version; the first makes a near touch.
std::span<const Move> moves();

/// 10^from to 10^to, log-uniform, without a logarithm.
double drawn_magnitude(Draw& draw, int from, int to);

/// B moved along the normal, so that a gap there becomes `gap`.
void place_at_gap(EllipsoidPair& pair, const Nearness& near, double gap);

/// Of `digits` significant decimal digits.
double short_number(double value, int digits);

/// Both are ellipsoids (finite, semi-axes > 0, orientations other than 0) that a code may be asked
/// about: every number is 0 or of 1e-150 to 1e150, so that its square is a double; no semi-axis of
/// the two is 1e12 times another, and no centre 1e16 times the longest from the origin.
bool is_fair(const EllipsoidPair& pair);

/// Features of a pair that a fault may come from; a set of them is the sum.
enum Trait : std::uint16_t {
  kLong = 1,         ///< a semi-axis 1000 times another of its body
  kUnequal = 2,      ///< a body 1000 times the other
  kFar = 4,          ///< centres a million sizes from the origin
  kScaled = 8,       ///< a size beyond 1e-20 to 1e20
  kRound = 16,       ///< equal semi-axes in a body
  kAligned = 32,     ///< equal orientations
  kConcentric = 64,  ///< equal centres
  kNear = 128,       ///< gap within a millionth of the size
};

std::uint16_t traits(const EllipsoidPair& pair, const Nearness& near);

/// "long, far"; "plain" for none.
std::string_view trait_name(Trait trait);

}  // namespace tangency::inline v0::verify
