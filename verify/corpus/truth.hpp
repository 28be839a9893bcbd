// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What is true of an input, by the oracles alone.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <tangency/verify/families/families.hpp>
#include <tangency/verify/oracles/classification.hpp>
#include <tangency/verify/oracles/gap.hpp>
#include <tangency/verify/oracles/perram_wertheim.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::inline v0::verify {

/// Normals that reach the gap.
struct TrueNormals {
  enum class Set {
    point,   ///< this one
    circle,  ///< all that a turn about `axis` makes of it
    all,     ///< every normal
  };
  Set set;
  Real3 normal;
  Real3 axis;  ///< unit; of a circle only
};

struct PairTruth {
  ExactRelation relation;
  Real size;                         ///< L = |d| + largest semi-axis of A + that of B
  Real gap;                          ///< 0 on an external touch
  std::vector<TrueNormals> normals;  ///< every maximiser, in descending order
  std::optional<PerramWertheimTruth> perram_wertheim;  ///< nothing for coinciding centres
};

/// Nothing where the oracle does not prove the gap to be the global one. Throws std::logic_error
/// where exact relation and gap do not fit each other.
std::optional<PairTruth> pair_truth(const EllipsoidPair& pair);
std::optional<PairTruth> pair_truth(const MatrixPair& pair);

/// The same without the gaps by other definitions: `perram_wertheim` is left empty.
/// @param most_boxes  what may be spent on deep pairs: gap.hpp
std::optional<PairTruth> common_normal_truth(const EllipsoidPair& pair,
                                             std::size_t most_boxes = kMostGapBoxes);

struct EllipsePairTruth {
  ExactRelation relation;
  int crossings;  ///< -1 for equal ellipses
  Real size;      ///< L
  Real area, smaller_area;
  PlaneGapTruth gap;
};

/// Throws std::logic_error as above.
EllipsePairTruth ellipse_truth(const EllipsePair& pair);

}  // namespace tangency::inline v0::verify
