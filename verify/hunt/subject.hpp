// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a hunt is after: somebody who answers pairs of ellipsoids, be it a program that reads
/// tables or a library that is called.
///
/// A hunt asks for the worst pair of a subject. It starts from the families of the corpora, moves
/// pairs towards what contact codes fear (moves.hpp), keeps the truth by the oracles (verdict.hpp),
/// prefers what was worst so far (search.hpp), and makes what it finds simple (shrink.hpp).
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <tangency/verify/families/pair.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::inline v0::verify {

/// What is said of one pair, by the conventions of `tangency contact`. What is not said is absent.
struct Answer {
  std::optional<Relation> relation{};
  std::optional<bool> overlaps{};                 ///< do the interiors meet
  std::optional<double> gap{};                    ///< signed, of the common normal
  std::optional<double> gap_error{};              ///< a claimed bound
  bool is_local = false;                          ///< the bound is for a local gap
  std::optional<std::array<double, 3>> normal{};  ///< from A to B
  bool unreadable = false;  ///< a cell is neither empty nor what its column is to hold
};

using Answers = std::vector<std::optional<Answer>>;

class Subject {
 public:
  virtual ~Subject() = default;
  /// An answer a pair, in order, and nothing for a pair that has none. Fewer than there are pairs
  /// only where the hunt has to end.
  virtual Answers answers(std::span<const EllipsoidPair> pairs) = 0;

 protected:
  Subject() = default;
  Subject(const Subject&) = default;
  Subject& operator=(const Subject&) = default;
};

}  // namespace tangency::inline v0::verify
