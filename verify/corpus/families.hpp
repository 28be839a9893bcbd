// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the corpora are made of: families of inputs, each an endless sequence that depends on
/// nothing but its seed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <tangency/verify/oracles/ellipse.hpp>
#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::verify {

struct EllipsoidPair {
  RawEllipsoid a, b;
};

struct EllipsePair {
  RawEllipse a, b;
};

template <class Input>
struct InputFamily {
  std::string name;   // of letters, digits, spaces and .+-
  std::size_t count;  // of rows in the corpus
  // A new sequence from its start.
  std::function<std::function<Input()>(std::uint64_t seed)> sequence;
};

using PairFamilies = std::vector<InputFamily<EllipsoidPair>>;

PairFamilies class_families();      // moderate to extreme shapes in shallow contact
PairFamilies near_families();       // gaps of 1e-3 to 1e-17 of the smallest semi-axis
PairFamilies touch_families();      // exact external touches and their neighbours
PairFamilies symmetric_families();  // equal and parallel axes, spheres, a common axis or plane
PairFamilies nested_families();     // one inside the other, inner touches, common centres
PairFamilies extreme_families();    // needles, discs, sizes, scales, far origins
PairFamilies deep_families();       // overlaps of any depth, where several normals compete
PairFamilies profile_families();    // displacement profiles of the published study

std::vector<InputFamily<EllipsePair>> ellipse_families();
std::vector<InputFamily<RawQuadric>> quadric_families();

}  // namespace tangency::verify
