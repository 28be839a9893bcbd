// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Pairs for tests of the batch calls, and every instruction set they can run with.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/tests/support/instruction_sets.hpp>
#include <tangency/tests/support/same_bits.hpp>
#include <tangency/verify/families/adversarial.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/extreme.hpp>
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

/// Contacts of every class, adversarial pairs, extreme shapes and deep overlaps.
inline std::vector<Family> drawn_families() {
  std::vector<Family> all;
  for (const auto& shape : verify::contact_classes()) all.push_back(contacts(shape, 1000));
  Family hostile{"adversarial", {}, {}};
  verify::for_each_adversarial_pair(kSeed, 1000, [&](const verify::AdversarialPair& p) {
    hostile.a.push_back(verify::to_ellipsoid(p.a));
    hostile.b.push_back(verify::to_ellipsoid(p.b));
  });
  all.push_back(std::move(hostile));
  const auto add = [&](const auto& shape, auto source) {
    Family f{shape.name, {}, {}};
    for (int i = 0; i < 60; ++i) {
      const verify::EllipsoidPair p = source.next();
      f.a.push_back(verify::to_ellipsoid(p.a));
      f.b.push_back(verify::to_ellipsoid(p.b));
    }
    all.push_back(std::move(f));
  };
  for (const auto& shape : verify::extreme_families())
    add(shape, verify::ExtremePairs(shape, kSeed));
  for (const auto& shape : verify::deep_families()) add(shape, verify::DeepPairs(shape, kSeed));
  return all;
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

/// Answers by columns, each also as a whole.
struct Columns {
  explicit Columns(std::size_t pairs)
      : gap(pairs),
        gap_error(pairs),
        normal(pairs),
        arm_a(pairs),
        arm_b(pairs),
        status(pairs),
        tier(pairs) {}
  GapColumns all() { return {gap, gap_error, normal, arm_a, arm_b, status, tier}; }
  Gap operator[](std::size_t i) const {
    return {gap[i], normal[i], arm_a[i], arm_b[i], gap_error[i], status[i], tier[i]};
  }
  std::vector<double> gap, gap_error;
  std::vector<Vec3> normal, arm_a, arm_b;
  std::vector<GapStatus> status;
  std::vector<GapTier> tier;
};

/// Runs with each instruction set that this machine and this build have, one after the other.
inline void at_every_level(const std::function<void()>& run) {
  const int levels = for_each_instruction_set([&](const char* name) {
    SCOPED_TRACE(name);
    run();
  });
  ASSERT_GT(levels, 0);
}

}  // namespace tangency::testing
