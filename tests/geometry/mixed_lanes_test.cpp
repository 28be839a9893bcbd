// SPDX-License-Identifier: GPL-3.0-or-later
// The first tier of the batch, in mixed precision: which pairs it settles, that what it proves is
// true however badly it starts, and that a pair's answer is its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <tangency/geometry/batch/gap_lanes.hpp>
#include <tangency/geometry/batch/pair_task.hpp>
#include <tangency/geometry/batch/shape_rows.hpp>
#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>

namespace tangency {
namespace {

using detail::kBlock;
using testing::at_every_level;
using testing::contacts;
using testing::Family;
using testing::Indexed;
using testing::kSeed;
using testing::same_bits;
using Shape = verify::ContactFamily::Shape;
using GapUnit = verify::ContactFamily::GapUnit;

/// Contacts of one aspect ratio.
Family contacts_of_aspect(double aspect, double largest_gap, std::size_t count) {
  const auto name = "aspect " + std::to_string(aspect) + " gap " + std::to_string(largest_gap);
  return contacts({name, Shape::triaxial, aspect, 3.0, GapUnit::smallest_semi_axis, largest_gap},
                  count);
}

/// The same pairs in another unit of length.
Family scaled(const Family& f, double unit) {
  Family to{f.name + " in another unit", {}, {}};
  const auto other = [unit](const Ellipsoid& e) {
    return Ellipsoid(unit * e.centre(), unit * e.semi_axes(), e.orientation());
  };
  for (std::size_t i = 0; i < f.a.size(); ++i) {
    to.a.push_back(other(f.a[i]));
    to.b.push_back(other(f.b[i]));
  }
  return to;
}

/// What the first tier says of all pairs, asked once.
struct FirstTier {
  std::vector<Gap> gaps;
  std::vector<bool> settled, promising;
  std::vector<Vec3> nearer;
  bool within_float = false;

  /// @param starts  none: all are asked afresh
  FirstTier(const BodyArray& bodies, const Indexed& in, const std::vector<Vec3>& starts) {
    detail::PairTask task("mixed_lanes_test", bodies, {in.pairs, {}});
    if (!starts.empty()) task.previous_normals = starts.data();
    const auto work = std::make_unique<detail::Workspace>();
    for (std::size_t first = 0; first < task.count; first += kBlock) {
      const std::size_t count = std::min(kBlock, task.count - first);
      detail::gather(task, first, count, *work, nullptr);
      work->take_answers();
      const std::uint64_t bits = detail::mixed_gap_lanes(work->block);
      within_float |= work->block.within_float;
      for (std::size_t i = 0; i < count; ++i) {
        gaps.push_back({work->gap[i], work->normal[i], work->arm_a[i], work->arm_b[i],
                        work->gap_error[i], GapStatus::ok, GapTier::fast});
        settled.push_back((bits >> i & 1) != 0);
        promising.push_back((work->block.promising >> i & 1) != 0);
        nearer.push_back(work->nearer_normals[i]);
      }
    }
  }
  std::ptrdiff_t settled_count() const { return std::ranges::count(settled, true); }
};

std::vector<Gap> single_answers(const Family& f) {
  std::vector<Gap> gaps;
  for (std::size_t i = 0; i < f.a.size(); ++i) gaps.push_back(signed_gap(f.a[i], f.b[i]));
  return gaps;
}

/// Normals that are off by an angle, each in a direction of its own.
std::vector<Vec3> turned_normals(const std::vector<Gap>& gaps, double angle) {
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  std::vector<Vec3> turned;
  for (const Gap& gap : gaps) {
    const Vec3 across = gap.normal.cross(Vec3(normal(random), normal(random), normal(random)));
    turned.push_back(std::cos(angle) * gap.normal + std::sin(angle) * across.normalized());
  }
  return turned;
}

double size(const Family& f, std::size_t i) {
  return (f.b[i].centre() - f.a[i].centre()).norm() + f.a[i].largest_semi_axis() +
         f.b[i].largest_semi_axis();
}

/// What the first tier settles is true, and as good as promised.
void expect_true(const FirstTier& tier, const Family& f, const std::vector<Gap>& single) {
  for (std::size_t i = 0; i < single.size(); ++i) {
    if (!tier.settled[i]) continue;
    const Gap& gap = tier.gaps[i];
    ASSERT_EQ(single[i].status, GapStatus::ok) << i;
    ASSERT_EQ(std::signbit(gap.gap), std::signbit(single[i].gap)) << i;
    ASSERT_LE(std::abs(gap.gap - single[i].gap), gap.gap_error + single[i].gap_error) << i;
    ASSERT_LE(gap.gap_error, kOrdinaryGapErrorBound * kUnitRoundoff * size(f, i)) << i;
    ASSERT_LE(std::abs(gap.normal.norm() - 1), 8 * kUnitRoundoff) << i;
  }
}

TEST(MixedLanes, SettleOrdinaryContactsAndLeaveThinBodiesToTheDoubles) {
  for (int which = 0; which < 2; ++which) {
    const Family f = contacts(verify::contact_classes()[static_cast<std::size_t>(which)], 1024);
    const Indexed in(f);
    const BodyArray bodies(in.bodies);
    const std::vector<Vec3> starts = turned_normals(single_answers(f), 1e-4);
    at_every_level([&] {
      EXPECT_GE(FirstTier(bodies, in, {}).settled_count(), which == 0 ? 1024 : 980);
      EXPECT_GE(FirstTier(bodies, in, starts).settled_count(), which == 0 ? 1024 : 1010);
    });
  }
  const Family thin = contacts_of_aspect(100, 0.1, 256);
  const Indexed in(thin);
  const BodyArray bodies(in.bodies);
  at_every_level([&] {
    const FirstTier tier(bodies, in, {});
    EXPECT_FALSE(tier.within_float);
    EXPECT_EQ(tier.settled_count(), 0);
  });
}

// docs/derivations/gap-batch.md (T) (L): the step is as long as the start is bad.
TEST(MixedLanes, ProveWhatIsTrueHoweverFarTheStartIsOff) {
  for (const double aspect : {1.2, 5.0, 20.0, 40.0}) {
    const Family f = contacts_of_aspect(aspect, 0.1, 512);
    SCOPED_TRACE(f.name);
    const Indexed in(f);
    const BodyArray bodies(in.bodies);
    const std::vector<Gap> single = single_answers(f);
    for (double angle = 0.5; angle > 1e-9; angle *= 0.4) {
      SCOPED_TRACE(angle);
      const std::vector<Vec3> starts = turned_normals(single, angle);
      at_every_level([&] { expect_true(FirstTier(bodies, in, starts), f, single); });
    }
  }
}

// Gaps down to where the sign is lost in rounding, flat faces, and both ends of the range.
TEST(MixedLanes, ProveWhatIsTrueOfSmallGapsInEveryUnit) {
  for (const double gap : {1e-3, 1e-7, 1e-10, 1e-13, 1e-15, 1e-17}) {
    for (const double aspect : {1.0, 1.0 + 1e-9, 4.0, 30.0}) {
      const Family f = contacts_of_aspect(aspect, gap, 128);
      SCOPED_TRACE(f.name);
      const std::vector<Gap> single = single_answers(f);
      const Indexed in(f);
      const BodyArray bodies(in.bodies);
      at_every_level([&] { expect_true(FirstTier(bodies, in, {}), f, single); });
      for (const double unit : {0x1p-52, 0x1p-17, 0x1p17, 0x1p52}) {
        const Family other = scaled(f, unit);
        const Indexed there(other);
        const BodyArray others(there.bodies);
        at_every_level([&] {
          const FirstTier here(bodies, in, {}), tier(others, there, {});
          // All float numbers are in the pair's own unit.
          for (std::size_t i = 0; i < tier.gaps.size(); ++i) {
            ASSERT_EQ(tier.settled[i], here.settled[i]);
            ASSERT_EQ(tier.gaps[i].gap, unit * here.gaps[i].gap);
            ASSERT_EQ(tier.gaps[i].gap_error, unit * here.gaps[i].gap_error);
          }
        });
      }
    }
  }
}

// geometry/gap_batch.hpp (2)
TEST(MixedLanes, APairThatIsAskedAgainHasItsOwnAnswerBesideAnyOthers) {
  Family f = contacts_of_aspect(12, 0.1, 200);
  for (const Family& more : {contacts_of_aspect(2, 0.1, 200), contacts_of_aspect(2, 1e-15, 50),
                             contacts_of_aspect(100, 0.1, 50)}) {
    f.a.insert(f.a.end(), more.a.begin(), more.a.end());
    f.b.insert(f.b.end(), more.b.begin(), more.b.end());
  }
  const Indexed in(f);
  const BodyArray bodies(in.bodies);
  const std::vector<Gap> single = single_answers(f);
  const std::vector<Vec3> starts = turned_normals(single, 0.02);
  at_every_level([&] {
    const FirstTier once(bodies, in, starts);
    std::vector<Vec3> again = starts;
    std::size_t settled_then = 0;
    for (std::size_t i = 0; i < again.size(); ++i)
      if (!once.settled[i] && once.promising[i]) again[i] = once.nearer[i];
    const FirstTier twice(bodies, in, again);
    for (std::size_t i = 0; i < again.size(); ++i)
      if (!once.settled[i] && twice.settled[i]) ++settled_then;
    EXPECT_GE(settled_then, 20U);  // else nothing here is asked again

    std::vector<Gap> whole(in.pairs.size());
    follow_gaps(bodies, {in.pairs, {}}, starts, whole);
    std::vector<std::size_t> order(in.pairs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::shuffle(order.begin(), order.end(), std::mt19937_64(kSeed));
    std::vector<IndexedPair> pairs;
    std::vector<Vec3> normals;
    for (const std::size_t i : order) {
      pairs.push_back(in.pairs[i]);
      normals.push_back(starts[i]);
    }
    std::vector<Gap> shuffled(pairs.size());
    follow_gaps(bodies, {pairs, {}}, normals, shuffled);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const std::size_t i = order[k];
      ASSERT_TRUE(same_bits(shuffled[k], whole[i])) << i;
      Gap alone{};
      follow_gaps(bodies, {{&in.pairs[i], 1}, {}}, {&starts[i], 1}, std::span(&alone, 1));
      ASSERT_TRUE(same_bits(alone, whole[i])) << i;
    }
  });
}

// docs/derivations/gap-batch.md (N)
TEST(ShapeRows, AreProductsOfTheFactorsRoundedOnceButForWhatCancels) {
  const Family f = contacts_of_aspect(40, 0.1, 200);
  const BodyArray bodies(f.a);
  const detail::LaneBody* const lanes = bodies.lanes();
  at_every_level([&] {
    std::vector<detail::ShapeRow> rows(bodies.size());
    detail::fill_shape_rows(lanes, bodies.size(), rows.data());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      constexpr std::size_t kRow[] = {0, 1, 2, 1, 2, 0}, kColumn[] = {0, 1, 2, 2, 0, 1};
      double sums[3] = {};
      for (std::size_t e = 0; e < 6; ++e) {
        detail::DoubleDouble exact;
        for (std::size_t k = 0; k < 3; ++k) {
          const double* const column = lanes[i].factor + 3 * k;
          exact = exact + detail::two_product(column[kRow[e]], column[kColumn[e]]);
        }
        const double entry = rows[i].shape[e];
        ASSERT_LE(std::abs(((exact - detail::DoubleDouble(entry)).high)),
                  kUnitRoundoff * std::abs(entry) + 0x1p-73 * rows[i].reach)
            << i << " " << e;
        sums[kRow[e]] += std::abs(entry);
        if (kRow[e] != kColumn[e]) sums[kColumn[e]] += std::abs(entry);
      }
      const double most = std::max({sums[0], sums[1], sums[2]});
      ASSERT_GE(rows[i].reach, most);
      ASSERT_LE(rows[i].reach, most * (1 + 0x1p-45));
    }
  });
}

}  // namespace
}  // namespace tangency
