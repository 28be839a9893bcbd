// SPDX-License-Identifier: GPL-3.0-or-later
// A program of its own, because it replaces the global allocation functions.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <new>
#include <thread>
#include <vector>

#include <tangency/bench/families/extreme.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/gap_derivatives.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/trace_contact.hpp>
#include <tangency/tests/support/conversions.hpp>

namespace {

thread_local long allocations = 0;

void* counted(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace tangency {
namespace {

constexpr std::uint64_t kSeed = 20261122;
constexpr int kPairs = 100;  // of each family

struct Bodies {
  Ellipsoid a, b;
};

/// Every family at the extremes and deep.
std::vector<Bodies> all_pairs() {
  std::vector<Bodies> all;
  const auto draw = [&](auto pairs) {
    for (int i = 0; i < kPairs; ++i) {
      const auto pair = pairs.next();
      all.push_back({testing::to_ellipsoid(pair.a), testing::to_ellipsoid(pair.b)});
    }
  };
  for (const auto& family : families::extreme_families())
    draw(families::ExtremePairs(family, kSeed));
  for (const auto& family : families::deep_families()) draw(families::DeepPairs(family, kSeed));
  return all;
}

TEST(Allocation, IsSeenByTheCounter) {
  const long before = allocations;
  delete new int(1);
  EXPECT_EQ(allocations, before + 1);
}

TEST(Allocation, HappensInNoGapOfAnotherDefinition) {
  for (const auto& [a, b] : all_pairs()) {
    const long before = allocations;
    const OtherGap planes = perram_wertheim_gap(a, b), midpoint = midpoint_potential_gap(a, b);
    ASSERT_EQ(allocations, before);
    ASSERT_NE(planes.status, OtherGapStatus::not_converged);
    ASSERT_NE(midpoint.status, OtherGapStatus::not_converged);
  }
}

TEST(Allocation, HappensInTheSchemeOfCurvesOnlyWhereTheExactRelationDoes) {
  int answers = 0;
  for (const auto& [a, b] : all_pairs()) {
    if (relation(a, b).tier == Tier::exact) continue;
    const long before = allocations;
    const TraceContact trace = trace_contact(a, b);
    ASSERT_EQ(allocations, before);
    if (trace.status != TraceStatus::ok) continue;
    ++answers;
    ASSERT_TRUE(std::isfinite(trace.gap) && trace.normal.allFinite() && trace.arm_b.allFinite());
  }
  EXPECT_GT(answers, 100);
}

TEST(Allocation, HappensInNoTierOfTheGapButTheExactOne) {
  std::array<int, 5> pairs{}, allocating{};
  for (const auto& [a, b] : all_pairs()) {
    const long before = allocations;
    const Gap gap = signed_gap(a, b);
    const Vec3 d = b.centre() - a.centre();
    const Gap followed = follow_gap(a, b, d, gap.normal);
    const ContactBounds bounds = contact_bounds(a, b, gap);
    const auto derivatives = gap_derivatives(a, b, gap);
    const bool allocated = allocations != before;
    ASSERT_GE(bounds.normal, 0.0);
    ASSERT_TRUE(derivatives.gradient.allFinite());
    const auto tier = static_cast<std::size_t>(std::max(gap.tier, followed.tier));
    ++pairs[tier];
    // A `local` answer is held against the exact relation.
    if (gap.status == GapStatus::local || followed.status == GapStatus::local) continue;
    allocating[tier] += allocated;
  }
  for (std::size_t tier = 0; tier < 4; ++tier) {
    EXPECT_GT(pairs[tier], 0) << tier;
    EXPECT_EQ(allocating[tier], 0) << tier;
  }
}

TEST(Threads, GetTheSameBitsAsOne) {
  const std::vector<Bodies> pairs = all_pairs();
  const auto solve = [&](std::vector<Gap>& gaps) {
    for (const auto& [a, b] : pairs) gaps.push_back(signed_gap(a, b));
  };
  std::vector<Gap> alone, first, second;
  solve(alone);
  std::thread one([&] { solve(first); }), other([&] { solve(second); });
  one.join();
  other.join();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (const Gap& gap : {first[i], second[i]}) {
      ASSERT_EQ(gap.gap, alone[i].gap);
      ASSERT_EQ(gap.normal, alone[i].normal);
      ASSERT_EQ(gap.gap_error, alone[i].gap_error);
    }
  }
}

}  // namespace
}  // namespace tangency
