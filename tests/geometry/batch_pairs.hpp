// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Pairs for tests of the batch calls, and every instruction set they can run with.
#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/manufactured.hpp>

namespace tangency::testing {

inline constexpr std::uint64_t kSeed = 20261122;

struct Family {
  std::string name;
  std::vector<Ellipsoid> a, b;
};

inline Family contacts(const verify::ContactFamily& shape, std::size_t count) {
  Family f{shape.name, {}, {}};
  verify::ManufacturedContacts source(shape, kSeed);
  for (std::size_t i = 0; i < count; ++i) {
    const auto c = source.next();
    f.a.push_back(verify::to_ellipsoid(c.a));
    f.b.push_back(verify::to_ellipsoid(c.b));
  }
  return f;
}

/// The bodies of a family in one array, A and B of each pair in turn.
struct Indexed {
  explicit Indexed(const Family& f) {
    for (std::uint32_t i = 0; i < f.a.size(); ++i) {
      bodies.push_back(f.a[i]);
      bodies.push_back(f.b[i]);
      pairs.push_back({2 * i, 2 * i + 1});
      separations.push_back(f.b[i].centre() - f.a[i].centre());
    }
  }
  std::vector<Ellipsoid> bodies;
  std::vector<IndexedPair> pairs;
  std::vector<Vec3> separations;
};

/// Runs with each instruction set that this machine and this build have, one after the other.
inline void at_every_level(const std::function<void()>& run) {
  const std::vector<std::int64_t> levels = hwy::SupportedAndGeneratedTargets();
  ASSERT_FALSE(levels.empty());
  for (const std::int64_t level : levels) {
    hwy::SetSupportedTargetsForTest(level);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    SCOPED_TRACE(hwy::TargetName(level));
    run();
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
}

}  // namespace tangency::testing
