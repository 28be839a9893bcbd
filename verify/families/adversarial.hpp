// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Hostile pairs for the yes/no and the relation question: exact touches, their neighbours in the
/// grid of doubles, zero discriminants, nests, equal sets and extremes. Wherever the construction
/// settles the exact relation of the stored doubles, the pair carries it; no solver is asked.
///
/// The stream depends on the seed and the index alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include <tangency/verify/families/pair.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency::inline v0::verify {

struct AdversarialPair : EllipsoidPair {
  std::string_view family;
  std::optional<ExactRelation> relation;  ///< where known by construction
};

/// The families, in the order in which they take turns.
std::span<const std::string_view> adversarial_family_names();

/// Calls `use` with `count` pairs, the families taking turns and either body coming first. The
/// first pairs of a longer stream are those of a shorter one.
void for_each_adversarial_pair(std::uint64_t seed, std::size_t count,
                               const std::function<void(const AdversarialPair&)>& use);

}  // namespace tangency::inline v0::verify
