// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the corpora are made of: families of inputs, each an endless sequence that depends on
/// nothing but its seed.
#pragma once

#include <array>
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
#include <tangency/verify/oracles/shape_matrix.hpp>
#include <tangency/verify/oracles/time_of_contact.hpp>

namespace tangency::inline v0::verify {

struct EllipsePair {
  RawEllipse a, b;
};

struct BodyAndPoint {
  RawEllipsoid body;
  std::array<double, 3> point;
};

/// The wall is the half-space normal . x <= offset.
struct BodyAndWall {
  RawEllipsoid body;
  std::array<double, 3> normal;
  double offset;
};

/// origin + t direction, t >= 0.
struct BodyAndRay {
  RawEllipsoid body;
  std::array<double, 3> origin, direction;
};

struct MovingPair {
  MovingBody a, b;
  double horizon, tolerance;
};

struct MatrixPair {
  RawShapeMatrix a, b;
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

std::vector<InputFamily<BodyAndPoint>> point_families();
std::vector<InputFamily<BodyAndWall>> wall_families();
std::vector<InputFamily<BodyAndRay>> ray_families();
std::vector<InputFamily<MovingPair>> time_families();
std::vector<InputFamily<MatrixPair>> matrix_families();
/// Every number is a float; squares of lengths are floats' too.
PairFamilies float_families();

/// Where body k of a family of neighbours has its place: one box after another along x.
inline constexpr double kNeighbourBox = 16;
/// Bodies with centres that are whole multiples of 2^-16, in [0, kNeighbourBox) in each direction,
/// or with `thin` to half of that in z: of a length that a needle meets itself around.
std::vector<InputFamily<RawEllipsoid>> neighbour_families(bool thin);

}  // namespace tangency::inline v0::verify
