// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the corpora are made of: families of inputs, each an endless sequence that depends on
/// nothing but its seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <tangency/verify/families/draw.hpp>
#include <tangency/verify/families/pair.hpp>
#include <tangency/verify/oracles/ellipse.hpp>
#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::inline v0::verify {

struct EllipsePair {
  RawEllipse a, b;
};

template <class Input>
struct InputFamily {
  std::string name;   ///< of letters, digits, spaces and .+-
  std::size_t count;  ///< of rows in the corpus
  /// A new sequence from its start.
  std::function<std::function<Input()>(std::uint64_t seed)> sequence;
};

/// What next(draw) makes, again and again; each sequence has a copy of `next` of its own.
template <class Next>
auto drawn_family(std::string name, std::size_t count, Next next) {
  using Input = std::invoke_result_t<Next&, Draw&>;
  return InputFamily<Input>{std::move(name), count,
                            [next](std::uint64_t seed) -> std::function<Input()> {
                              return [draw = Draw(seed), next]() mutable { return next(draw); };
                            }};
}

/// The pair, or with its bodies exchanged.
template <class Pair>
Pair exchanged_by_chance(Draw& draw, const Pair& pair) {
  return draw.coin() ? Pair{pair.b, pair.a} : pair;
}

using PairFamilies = std::vector<InputFamily<EllipsoidPair>>;

/// Of the corpus of pairs of this name. The seed is for profile_families().
PairFamilies pair_families(std::string_view corpus, std::uint64_t seed = 0);
/// Displacement profiles of the published study: the corpus `profiles`. Nothing in them is drawn;
/// with another seed than 0 their overlap and their steps are others.
PairFamilies profile_families(std::uint64_t seed = 0);

/// @param extreme_aspect  the largest aspect ratio of the family `extreme`
std::vector<InputFamily<EllipsePair>> ellipse_families(double extreme_aspect = 1e6);
std::vector<InputFamily<RawQuadric>> quadric_families();

}  // namespace tangency::inline v0::verify
