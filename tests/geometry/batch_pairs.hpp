// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Pairs for tests of the batch calls, and every instruction set they can run with.
#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <bit>
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

/// Answers by columns, each also as a whole of tier fast, which columns do not tell.
struct Columns {
  explicit Columns(std::size_t pairs)
      : gap(pairs), gap_error(pairs), normal(pairs), arm_a(pairs), arm_b(pairs), status(pairs) {}
  GapColumns all() { return {gap, gap_error, normal, arm_a, arm_b, status}; }
  Gap operator[](std::size_t i) const {
    return {gap[i], normal[i], arm_a[i], arm_b[i], gap_error[i], status[i], GapTier::fast};
  }
  std::vector<double> gap, gap_error;
  std::vector<Vec3> normal, arm_a, arm_b;
  std::vector<GapStatus> status;
};

inline bool same_bits(double x, double y) {
  return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
}
inline bool same_bits(const Vec3& v, const Vec3& w) {
  return same_bits(v[0], w[0]) && same_bits(v[1], w[1]) && same_bits(v[2], w[2]);
}
inline bool same_bits(const Gap& g, const Gap& h) {
  return same_bits(g.gap, h.gap) && same_bits(g.gap_error, h.gap_error) &&
         same_bits(g.normal, h.normal) && same_bits(g.arm_a, h.arm_a) &&
         same_bits(g.arm_b, h.arm_b) && g.status == h.status && g.tier == h.tier;
}

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
