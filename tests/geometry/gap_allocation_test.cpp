// SPDX-License-Identifier: GPL-3.0-or-later
// A program of its own, because it replaces the global allocation functions.
#include <gmp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/gap_derivatives.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/pencil.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/trace_contact.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/families/extreme.hpp>

namespace {

thread_local long allocations = 0;
thread_local bool refusing = false;

void* counted(std::size_t size) {
  ++allocations;
  if (refusing) throw std::bad_alloc();
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
      all.push_back({verify::to_ellipsoid(pair.a), verify::to_ellipsoid(pair.b)});
    }
  };
  for (const auto& family : verify::extreme_families()) draw(verify::ExtremePairs(family, kSeed));
  for (const auto& family : verify::deep_families()) draw(verify::DeepPairs(family, kSeed));
  return all;
}

TEST(Allocation, IsSeenByTheCounter) {
  const long before = allocations;
  // A call of the function: what a new-expression allocates a compiler may leave out.
  ::operator delete(::operator new(sizeof(int)));
  EXPECT_EQ(allocations, before + 1);
}

TEST(Allocation, HappensInNoAnswerOfTheFilterAlone) {
  const std::vector<Bodies> pairs = all_pairs();
  std::vector<Ellipsoid> bodies;
  std::vector<IndexedPair> list;
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    bodies.push_back(pairs[i].a);
    bodies.push_back(pairs[i].b);
    list.push_back({2 * i, 2 * i + 1});
  }
  // A touch, which only the exact tier knows.
  bodies.push_back(Ellipsoid(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  bodies.push_back(Ellipsoid(Vec3(2, 0, 0), Vec3(1, 1, 1)));
  const auto last = static_cast<std::uint32_t>(bodies.size());
  list.push_back({last - 2, last - 1});
  const BodyArray array(bodies);
  std::vector<std::optional<bool>> batch(list.size()), single(list.size());
  const long before = allocations;
  overlaps_by_filter(array, {list, {}}, batch);
  for (std::size_t i = 0; i < list.size(); ++i) {
    single[i] = overlaps_by_filter(bodies[list[i].a], bodies[list[i].b]);
  }
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(single.back(), std::nullopt);
  for (std::size_t i = 0; i < list.size(); ++i) {
    ASSERT_EQ(batch[i].has_value(), single[i].has_value()) << i;
    const bool exact = overlaps(bodies[list[i].a], bodies[list[i].b]);
    if (!single[i]) continue;
    ASSERT_TRUE(*single[i] == exact && *batch[i] == exact) << i;
  }
}

TEST(Allocation, ThatFailsInTheExactTierEndsTheProcessAndNotTheFilter) {
  const Ellipsoid a(Vec3(0, 0, 0), Vec3(1, 1, 1)), b(Vec3(2, 0, 0), Vec3(1, 1, 1));
  ASSERT_FALSE(overlaps(a, b));
  EXPECT_DEATH(
      {
        refusing = true;
        if (overlaps_by_filter(a, b) == std::nullopt) std::fputs("unknown, ", stderr);
        overlaps(a, b);
      },
      "unknown, terminate called after throwing an instance of 'std::bad_alloc'");
}

long asked_of_gmp = 0;  // bytes

void* counted_allocate(std::size_t size) {
  asked_of_gmp += static_cast<long>(size);
  return std::malloc(size);
}
void* counted_reallocate(void* memory, std::size_t, std::size_t size) {
  asked_of_gmp += static_cast<long>(size);
  return std::realloc(memory, size);
}
void plain_free(void* memory, std::size_t) { std::free(memory); }

// How long the exact tier works, without a clock: by the bytes of all its numbers. Containment by
// linear bisection asked for 749 MB, and the members of the pencil for 1142.
TEST(ExactTier, WorksOnFewNumbersForTheSlowestKnownPair) {
  const Ellipsoid a({0x1.1719ca896a532p-2, 0x1.ee82af1968dbp+946, 0x1.ead646d985d92p+48},
                    {0x1.78b19aa964dfcp-999, 0x1.c493dfdc8efbp+1019, 0x1.20081796dc9aap+951},
                    {-0x1.2ecfc0948332cp+969, -0x1.abc8419cf8eacp+959, 0x0.000000000aep-1022,
                     0x1.ed5087c5db74ap-17});
  const Ellipsoid b({-0x1.2f36e085d089fp+0, -0x0.00000001efabcp-1022, 0x1.bb4ba10184ed2p+989},
                    {0x1.e084937f7793cp+485, 0x1.4c6b957dc0eap+1010, 0x1.1ecfd732c7c9bp-451},
                    {-0x1.872f20993c357p+0, 0x1.c07d2ae0af475p+1023, 0x0.0000000000057p-1022,
                     0x1.d3db708181438p+0});
  mp_set_memory_functions(counted_allocate, counted_reallocate, plain_free);
  const RelationAnswer answer = relation(a, b);
  const long of_relation = std::exchange(asked_of_gmp, 0);
  const std::size_t members = pencil_members(a, b).size();
  const long of_pencil = asked_of_gmp;
  mp_set_memory_functions(nullptr, nullptr, nullptr);
  std::printf("relation: %ld bytes, pencil_members: %ld\n", of_relation, of_pencil);
  EXPECT_EQ(answer.relation, Relation::overlap);
  EXPECT_EQ(members, 33u);
  EXPECT_LT(of_relation, 1'300'000);  // twice what it is
  EXPECT_LT(of_pencil, 97'000'000);
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

TEST(Allocation, HappensInNoGapAtABoundedCost) {
  const std::vector<Bodies> pairs = all_pairs();
  std::vector<Ellipsoid> bodies;
  std::vector<IndexedPair> list;
  for (std::uint32_t i = 0; i < pairs.size(); ++i) {
    bodies.push_back(pairs[i].a);
    bodies.push_back(pairs[i].b);
    list.push_back({2 * i, 2 * i + 1});
  }
  const BodyArray array(bodies);
  std::vector<double> gap(list.size()), above(list.size());
  const long before = allocations;
  bounded_gaps(array, {list, {}}, {{.gap = gap}, above});
  for (std::size_t i = 0; i < list.size(); ++i) {
    const BoundedGap one = bounded_gap(pairs[i].a, pairs[i].b);
    ASSERT_EQ(allocations, before) << i;
    ASSERT_GE(one.above, 0.0) << i;
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
