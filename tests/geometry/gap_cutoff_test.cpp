// SPDX-License-Identifier: GPL-3.0-or-later
// Accuracy::cutoff: what is said of pairs beyond it is true, and pairs within it do not notice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
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
// A length. The bodies that are asked about are of sizes about 1.
constexpr double kCutoff = 0.125;
// A touch, the smallest length, an ordinary one, one that no lane takes, and one that no gap is
// above.
constexpr double kCutoffs[] = {0.0, 5e-324, kCutoff, 1e30, std::numeric_limits<double>::max()};

const std::vector<std::pair<std::string, Accuracy>>& points() {
  static const std::vector<std::pair<std::string, Accuracy>> all = {
      {"fast", Accuracy::fast()},
      {"standard", Accuracy::standard()},
      {"certified", Accuracy::certified()},
      {"within 1e-3", Accuracy::within(1e-3)}};
  return all;
}

/// Pairs of a family, B moved along the normal until the gap is about the cutoff and what is drawn
/// by its logarithm, of either sign: from a rounding to ten times the bodies, or the cutoff where
/// that is more. About the largest double nothing can be placed: pairs are apart by 1 there.
Family about_the_cutoff(const Family& from, std::size_t most, double cutoff = kCutoff) {
  Family to{from.name, {}, {}};
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> power(-17.0, 1.0);
  const double about = cutoff < 1e300 ? cutoff : 1.0;
  for (std::size_t i = 0; i < std::min(most, from.a.size()); ++i) {
    const Gap now = signed_gap(from.a[i], from.b[i]);
    const double size = std::max(1.0, about);
    const double off = std::pow(10.0, power(random)) * (i % 2 == 0 ? size : -size);
    to.a.push_back(from.a[i]);
    to.b.push_back(from.b[i].moved_to(from.b[i].centre() + (about + off - now.gap) * now.normal));
  }
  return to;
}

/// Of lengths far from 1 one side of a cutoff is empty.
bool is_of_size_one(const Family& f) {
  const double size = f.a[0].largest_semi_axis();
  return size > 0x1p-10 && size < 0x1p10;
}

/// The same pairs in every form that the calls take, with previous normals in turn: none, one of a
/// moment ago, one that is far off.
struct Forms {
  explicit Forms(const Family& f) : family(f), in(f), array(in.bodies) {
    for (const Ellipsoid& body : in.bodies) {
      semi_axes.push_back(body.semi_axes());
      orientations.push_back(body.orientation());
    }
    moving = MovingBodies(semi_axes, orientations);
    for (std::size_t i = 0; i < f.a.size(); ++i) {
      const Vec3 n = signed_gap(f.a[i], f.b[i]).normal, off = Vec3(0.3, -0.5, 0.8).cross(n);
      const double by = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 1e-4 : 3.0;
      previous.push_back(i % 3 == 0 ? Vec3(Vec3::Zero()) : Vec3(0x1p40 * (n + by * off)));
      floats.push_back(previous.back().cast<float>());
    }
  }
  std::size_t size() const { return in.pairs.size(); }
  PairList apart() const { return {in.pairs, in.separations}; }

  Family family;
  Indexed in;
  BodyArray array;
  std::vector<Vec3> semi_axes, previous;
  std::vector<Vec3f> floats;  ///< previous, rounded
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
      {"moving",
       [](const Forms& f, Accuracy accuracy) {
         return by_columns(
             f, [&](const GapColumns& to) { signed_gaps(f.moving, f.apart(), to, accuracy); });
       }},
      {"normals written where they are read",
       [](const Forms& f, Accuracy accuracy) {
         return by_columns(f, [&](const GapColumns& to) {
           std::ranges::copy(f.previous, to.normal.begin());
           follow_gaps(f.array, f.apart(), to.normal, to, accuracy);
         });
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

/// At every level, point and call.
/// @return  how many answers are beyond, and how many are not
std::pair<std::ptrdiff_t, std::ptrdiff_t> expect_all_kept(const Forms& forms, double cutoff) {
  std::ptrdiff_t beyond = 0, within = 0;
  at_every_level([&] {
    for (const auto& [point, accuracy] : points()) {
      for (const auto& [call, ask] : calls()) {
        SCOPED_TRACE(call + ", " + point);
        const std::vector<Gap> whole = ask(forms, accuracy);
        const std::vector<Gap> limited = ask(forms, accuracy.up_to(cutoff));
        for (std::size_t i = 0; i < forms.size(); ++i) {
          SCOPED_TRACE(i);
          ++(expect_kept(limited[i], whole[i], cutoff) ? beyond : within);
        }
      }
    }
  });
  return {beyond, within};
}

// geometry/gap_batch.hpp (9)
TEST(GapCutoff, PairsBeyondAreAboveTheirBoundAndTheOthersAreToTheBitAsWithoutOne) {
  std::size_t turn = 0;
  for (const Family& family : testing::drawn_families()) {
    if (!is_of_size_one(family)) continue;
    for (const double cutoff : {kCutoff, kCutoffs[turn++ % std::size(kCutoffs)]}) {
      const Forms forms(about_the_cutoff(family, cutoff == kCutoff ? 40 : 10, cutoff));
      SCOPED_TRACE(family.name + ", " + std::to_string(cutoff));
      const auto [beyond, within] = expect_all_kept(forms, cutoff);
      EXPECT_EQ(beyond > 0, cutoff < 1e300);
      EXPECT_GT(within, 0);
    }
  }
  EXPECT_GE(turn, std::size(kCutoffs));
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
  const Family family = testing::contacts(verify::contact_classes()[0], 100);
  for (const double cutoff : kCutoffs) {
    const Forms forms(about_the_cutoff(family, 100, cutoff));
    std::vector<Vec3> normals;
    for (const Vec3f& n : forms.floats) normals.push_back(n.cast<double>());
    at_every_level([&] {
      for (const auto& [point, accuracy] : points()) {
        SCOPED_TRACE(point + ", " + std::to_string(cutoff));
        std::vector<Gap> doubles(forms.size());
        std::vector<float> gap(forms.size()), error(forms.size());
        std::vector<GapStatus> status(forms.size());
        const FloatGapColumns floats{.gap = gap, .gap_error = error, .status = status};
        const Accuracy limited = accuracy.up_to(cutoff);
        const auto check = [&] {
          for (std::size_t i = 0; i < forms.size(); ++i) {
            ASSERT_EQ(status[i], doubles[i].status) << i;
            if (status[i] != GapStatus::beyond) continue;
            EXPECT_LE(static_cast<double>(gap[i]), doubles[i].gap) << i;
            EXPECT_GE(static_cast<double>(gap[i]), doubles[i].gap * (1 - 0x1p-22)) << i;
            EXPECT_EQ(error[i], std::numeric_limits<float>::infinity()) << i;
          }
        };
        signed_gaps(forms.array, {forms.in.pairs, {}}, doubles, limited);
        signed_gaps(forms.array, {forms.in.pairs, {}}, floats, limited);
        check();
        follow_gaps(forms.array, forms.apart(), normals, doubles, limited);
        follow_gaps(forms.array, forms.apart(), forms.floats, floats, limited);
        check();
      }
    });
  }
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
