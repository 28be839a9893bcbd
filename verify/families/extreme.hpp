// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Pairs at the extremes of shape, size, place and gap, whose true gap only an oracle knows: they
/// are placed in long double and then rounded, so that a small gap becomes what the rounding of
/// B's centre makes of it.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string>

#include <tangency/verify/oracles/plain_bodies.hpp>

namespace tangency::families {

/// How the pairs of a family are drawn. Normals: a third uniform, a third along an axis of a body,
/// a third near one (1e-12 to 1 rad). Gaps: log-uniform from 1e-16 of the smallest semi-axis to
/// 1e6 times the largest; a quarter below 0, there to rho only.
struct ExtremeFamily {
  enum class Shape {
    needles,  ///< one long axis, the other two within a factor of 2
    discs,    ///< one short axis, the other two within a factor of 2
    mixed,    ///< a needle and a disc, or log-uniform axes
  };
  std::string name;
  Shape shape;
  double aspect;      ///< of every body
  double size_ratio;  ///< B's size over A's is log-uniform in [1/size_ratio, size_ratio]
  double scale;       ///< of all lengths
  double origin;      ///< distance of A's centre from the origin over `scale`
};

std::span<const ExtremeFamily> extreme_families();

/// Overlapping pairs: shapes log-uniform, size ratio to 3.
struct DeepFamily {
  std::string name;
  double aspect;         ///< of every body at most
  double least_depth;    ///< 0 to 1: the centres' distance over that where the pair touches at
  double largest_depth;  ///< a random normal; 0 is concentric
  double within;         ///< > 0: only pairs that a manufactured overlap of at most this share of
                         ///< the smallest semi-axis gives; else 0
};

std::span<const DeepFamily> deep_families();

struct RawPair {
  verify::RawEllipsoid a, b;
};

/// What exact arithmetic finds hardest: every number of a body drawn log-uniformly from 2^-range to
/// 2^range, and B one sixth of the time another such body, else A with a centre, a semi-axis or a
/// quaternion nudged by one unit in the last place, with semi-axes grown by powers of two, or
/// doubled and moved. Touching and nested pairs are frequent among them.
class HeaviestPairs {
 public:
  /// @param range  1 to 1074, of exponents
  HeaviestPairs(std::uint64_t seed, int range);
  RawPair next();

 private:
  double magnitude();
  double number();
  verify::RawEllipsoid body();

  std::mt19937_64 random_;
  int range_;
  int kind_ = 0;
};

/// Endless, reproducible sequences.
class ExtremePairs {
 public:
  ExtremePairs(const ExtremeFamily& family, std::uint64_t seed);
  RawPair next();

 private:
  ExtremeFamily family_;
  std::mt19937_64 random_;
};

class DeepPairs {
 public:
  DeepPairs(const DeepFamily& family, std::uint64_t seed);
  RawPair next();

 private:
  DeepFamily family_;
  std::mt19937_64 random_;
};

}  // namespace tangency::families
