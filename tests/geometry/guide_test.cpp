// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include <tangency/geometry/common_volume.hpp>
#include <tangency/geometry/containment.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/neighbours.hpp>
#include <tangency/geometry/question_batch.hpp>
#include <tangency/geometry/time_batch.hpp>

namespace tangency {
namespace {

// What the examples of docs/guide.md take for granted.
#define GUIDE_EXAMPLE(number)                                                     \
  void guide_example_##number(                                                    \
      const Ellipsoid& a, const Ellipsoid& b, std::vector<Ellipsoid>& ellipsoids, \
      const std::vector<IndexedPair>& pairs, const std::vector<Vec3>& separations)

// Each as a function, and kGuideExamples, which has all of them: CMakeLists.txt writes it.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#include "guide_examples.inc"
#pragma GCC diagnostic pop

TEST(Guide, EveryExampleInCppCompilesAndRuns) {
  std::vector<Ellipsoid> two{Ellipsoid(Vec3(0, 0, 0), Vec3(1, 2, 3)),
                             Ellipsoid(Vec3(3, 0, 0), Vec3(1, 2, 1))};
  const std::vector<IndexedPair> pairs(65, IndexedPair{0, 1});
  const std::vector<Vec3> separations(pairs.size(), Vec3(3, 0, 0));
  for (const auto example : kGuideExamples) example(two[0], two[1], two, pairs, separations);
}

}  // namespace
}  // namespace tangency
