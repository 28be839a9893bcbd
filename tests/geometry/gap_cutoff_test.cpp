// SPDX-License-Identifier: GPL-3.0-or-later
// Accuracy::cutoff: what is said of pairs beyond it is true, and pairs within it do not notice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/moving_bodies.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>
#include <tangency/verify/families/extreme.hpp>

namespace tangency {
namespace {

using testing::at_every_level;
using testing::Columns;
using testing::Family;
using testing::Indexed;
using testing::kSeed;
using testing::same_bits;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Of the smaller of a pair's smallest semi-axes would do; the families are of about that size.
constexpr double kCutoff = 0.125;

const std::vector<std::pair<std::string, Accuracy>>& points() {
  static const std::vector<std::pair<std::string, Accuracy>> all = {
      {"fast", Accuracy::fast()},
      {"standard", Accuracy::standard()},
      {"certified", Accuracy::certified()},
      {"within 1e-3", Accuracy::within(1e-3)}};
  return all;
}

/// Pairs of a family, B moved along the normal until the gap is about the cutoff and what is drawn
/// by its logarithm, of either sign: from a rounding to ten times the bodies.
Family about_the_cutoff(const Family& from, std::size_t most) {
  Family to{from.name, {}, {}};
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> power(-17.0, 1.0);
  for (std::size_t i = 0; i < std::min(most, from.a.size()); ++i) {
    const Gap now = signed_gap(from.a[i], from.b[i]);
    const double off = std::pow(10.0, power(random)) * (i % 2 == 0 ? 1.0 : -1.0);
    to.a.push_back(from.a[i]);
    to.b.push_back(from.b[i].moved_to(from.b[i].centre() + (kCutoff + off - now.gap) * now.normal));
  }
  return to;
}

const std::vector<Family>& families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> some;
    for (const Family& f : testing::drawn_families()) {
      // Of lengths far from 1 one side of the cutoff is empty.
      const double size = f.a[0].largest_semi_axis();
      if (size > 0x1p-10 && size < 0x1p10) some.push_back(about_the_cutoff(f, 150));
    }
    return some;
  }();
  return all;
}

/// The same pairs in every form that the calls take, with normals of a moment ago; of every third
/// pair there is none.
struct Forms {
  explicit Forms(const Family& f) : family(f), in(f), array(in.bodies) {
    for (const Ellipsoid& body : in.bodies) {
      semi_axes.push_back(body.semi_axes());
      orientations.push_back(body.orientation());
    }
    moving = MovingBodies(semi_axes, orientations);
    for (std::size_t i = 0; i < f.a.size(); ++i) {
      const Vec3 n = signed_gap(f.a[i], f.b[i]).normal;
      const Vec3 turned = n + 1e-4 * Vec3(0.3, -0.5, 0.8).cross(n);
      previous.push_back(i % 3 == 0 ? Vec3(Vec3::Zero()) : turned);
    }
  }
  std::size_t size() const { return in.pairs.size(); }
  PairList apart() const { return {in.pairs, in.separations}; }

  Family family;
  Indexed in;
  BodyArray array;
  std::vector<Vec3> semi_axes, previous;
  std::vector<Quaternion> orientations;
  MovingBodies moving;
};

using Ask = std::function<std::vector<Gap>(const Forms&, Accuracy)>;

std::vector<Gap> by_columns(const Forms& forms, const std::function<void(const GapColumns&)>& ask) {
  Columns columns(forms.size());
  ask(columns.all());
  std::vector<Gap> gaps;
  for (std::size_t i = 0; i < forms.size(); ++i) gaps.push_back(columns[i]);
  return gaps;
}

const std::vector<std::pair<std::string, Ask>>& calls() {
  static const std::vector<std::pair<std::string, Ask>> all = {
      {"array",
       [](const Forms& f, Accuracy accuracy) {
         return by_columns(f, [&](const GapColumns& to) {
           signed_gaps(f.array, {f.in.pairs, {}}, to, accuracy);
         });
       }},
      {"plain",
       [](const Forms& f, Accuracy accuracy) {
         std::vector<Gap> gaps(f.size());
         signed_gaps(f.family.a, f.family.b, gaps, accuracy);
         return gaps;
       }},
      {"followed array",
       [](const Forms& f, Accuracy accuracy) {
         std::vector<Gap> gaps(f.size());
         follow_gaps(f.array, f.apart(), f.previous, gaps, accuracy, 2);
         return gaps;
       }},
      {"followed moving", [](const Forms& f, Accuracy accuracy) {
         return by_columns(f, [&](const GapColumns& to) {
           follow_gaps(f.moving, f.apart(), f.previous, to, accuracy);
         });
       }}};
  return all;
}

/// gap_batch.hpp (9)
/// @return  is it beyond?
bool expect_kept(const Gap& limited, const Gap& whole, double cutoff) {
  const double least = whole.gap - whole.gap_error;
  if (limited.status != GapStatus::beyond) {
    EXPECT_TRUE(same_bits(limited, whole));
    EXPECT_LE(least, cutoff * (1 + 0x1p-50));
    return false;
  }
  EXPECT_GT(limited.gap, cutoff);
  EXPECT_LE(limited.gap, whole.gap + whole.gap_error);
  EXPECT_EQ(limited.gap_error, kInfinity);
  EXPECT_EQ(limited.tier, GapTier::fast);
  EXPECT_TRUE(limited.normal.isZero(0) && limited.arm_a.isZero(0) && limited.arm_b.isZero(0));
  return true;
}

// geometry/gap_batch.hpp (9)
TEST(GapCutoff, PairsBeyondAreAboveTheirBoundAndTheOthersAreToTheBitAsWithoutOne) {
  for (const Family& family : families()) {
    const Forms forms(family);
    std::ptrdiff_t beyond = 0, within = 0;
    at_every_level([&] {
      for (const auto& [point, accuracy] : points()) {
        for (const auto& [call, ask] : calls()) {
          SCOPED_TRACE(family.name + ", " + call + ", " + point);
          const std::vector<Gap> whole = ask(forms, accuracy);
          const std::vector<Gap> limited = ask(forms, accuracy.up_to(kCutoff));
          for (std::size_t i = 0; i < forms.size(); ++i) {
            SCOPED_TRACE(i);
            ++(expect_kept(limited[i], whole[i], kCutoff) ? beyond : within);
          }
        }
      }
    });
    EXPECT_GT(beyond, 0) << family.name;
    EXPECT_GT(within, 0) << family.name;
  }
}

// geometry/gap_batch.hpp (2): other pairs leave a block, other pairs fill it.
TEST(GapCutoff, AnAnswerDoesNotDependOnTheOrderNorOnTheNumberOfThePairs) {
  const Forms forms(about_the_cutoff(testing::contacts(verify::contact_classes()[1], 300), 300));
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < 211; ++k) order.push_back(k * 97 % forms.size());
  std::vector<IndexedPair> pairs;
  for (const std::size_t i : order) pairs.push_back(forms.in.pairs[i]);
  at_every_level([&] {
    for (const auto& [point, accuracy] : points()) {
      SCOPED_TRACE(point);
      std::vector<Gap> all(forms.size()), some(order.size());
      signed_gaps(forms.array, {forms.in.pairs, {}}, all, accuracy.up_to(kCutoff));
      signed_gaps(forms.array, {pairs, {}}, some, accuracy.up_to(kCutoff));
      for (std::size_t k = 0; k < order.size(); ++k)
        EXPECT_TRUE(same_bits(some[k], all[order[k]])) << order[k];
    }
  });
}

TEST(GapCutoff, FloatColumnsHaveALowerBoundThatIsNoHigherThanTheDoubleOne) {
  const Forms forms(about_the_cutoff(testing::contacts(verify::contact_classes()[0], 300), 300));
  at_every_level([&] {
    for (const auto& [point, accuracy] : points()) {
      SCOPED_TRACE(point);
      std::vector<Gap> doubles(forms.size());
      std::vector<float> gap(forms.size()), error(forms.size());
      std::vector<GapStatus> status(forms.size());
      const Accuracy limited = accuracy.up_to(kCutoff);
      signed_gaps(forms.array, {forms.in.pairs, {}}, doubles, limited);
      signed_gaps(forms.array, {forms.in.pairs, {}},
                  FloatGapColumns{.gap = gap, .gap_error = error, .status = status}, limited);
      for (std::size_t i = 0; i < forms.size(); ++i) {
        ASSERT_EQ(status[i], doubles[i].status) << i;
        if (status[i] != GapStatus::beyond) continue;
        EXPECT_LE(static_cast<double>(gap[i]), doubles[i].gap) << i;
        EXPECT_GE(static_cast<double>(gap[i]), doubles[i].gap * (1 - 0x1p-22)) << i;
        EXPECT_EQ(error[i], std::numeric_limits<float>::infinity()) << i;
      }
    }
  });
}

TEST(GapCutoff, BoundedGapsKnowNothingAboveOfAPairBeyond) {
  const Forms forms(about_the_cutoff(testing::contacts(verify::contact_classes()[2], 300), 300));
  at_every_level([&] {
    Columns columns(forms.size());
    std::vector<double> above(forms.size());
    std::vector<Vec3> point(forms.size(), Vec3::Ones());
    GapColumns to = columns.all();
    to.point = point;
    bounded_gaps(forms.array, {forms.in.pairs, {}}, {to, above},
                 Accuracy::standard().up_to(kCutoff));
    std::ptrdiff_t beyond = 0;
    for (std::size_t i = 0; i < forms.size(); ++i) {
      const Gap single = signed_gap(forms.family.a[i], forms.family.b[i]);
      if (columns.status[i] != GapStatus::beyond) {
        EXPECT_LE(columns.gap[i] - columns.gap_error[i], kCutoff * (1 + 0x1p-50)) << i;
        EXPECT_LT(above[i], kInfinity) << i;
        continue;
      }
      ++beyond;
      EXPECT_LE(columns.gap[i], single.gap + single.gap_error) << i;
      EXPECT_EQ(above[i], kInfinity) << i;
      EXPECT_TRUE(point[i].isZero(0)) << i;
    }
    EXPECT_GT(beyond, 0);
  });
}

// Normals may be written where they are read: a pair that comes back is asked afresh.
TEST(GapCutoff, APairThatComesBackFromBeyondIsAskedAfresh) {
  const Family far = about_the_cutoff(testing::contacts(verify::contact_classes()[0], 200), 200);
  const Forms forms(far);
  std::vector<Vec3> normals = forms.previous;
  at_every_level([&] {
    std::vector<Gap> fresh(forms.size()), followed(forms.size());
    std::vector<GapStatus> status(forms.size());
    follow_gaps(forms.array, forms.apart(), normals, {.normal = normals, .status = status},
                Accuracy::standard().up_to(kCutoff));
    signed_gaps(forms.array, forms.apart(), fresh);
    follow_gaps(forms.array, forms.apart(), normals, followed);
    for (std::size_t i = 0; i < forms.size(); ++i) {
      if (status[i] != GapStatus::beyond) continue;
      EXPECT_TRUE(normals[i].isZero(0)) << i;
      EXPECT_TRUE(same_bits(followed[i], fresh[i])) << i;
    }
  });
}

}  // namespace
}  // namespace tangency
