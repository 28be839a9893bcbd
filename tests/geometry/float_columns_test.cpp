// SPDX-License-Identifier: GPL-3.0-or-later
// Answers of batches by columns of floats: rounded, what is proven of them stays proven of the
// floats, at the ends of float's range too.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <tangency/geometry/batch/float_answers.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/tests/geometry/batch_pairs.hpp>
#include <tangency/tests/geometry/floating_point_guard.hpp>

namespace tangency {
namespace {

using testing::at_every_level;
using testing::Columns;
using testing::Family;
using testing::Indexed;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

bool same(float x, float y) {
  return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
}
bool same(const Vec3f& x, const Vec3& y) {
  return same(x[0], static_cast<float>(y[0])) && same(x[1], static_cast<float>(y[1])) &&
         same(x[2], static_cast<float>(y[2]));
}

int sign(double x) { return (x > 0) - (x < 0); }

struct FloatColumns {
  explicit FloatColumns(std::size_t pairs)
      : gap(pairs),
        gap_error(pairs),
        normal(pairs),
        arm_a(pairs),
        arm_b(pairs),
        point(pairs),
        status(pairs),
        tier(pairs) {}
  FloatGapColumns all() { return {gap, gap_error, normal, arm_a, arm_b, status, tier, point}; }

  std::vector<float> gap, gap_error;
  std::vector<Vec3f> normal, arm_a, arm_b, point;
  std::vector<GapStatus> status;
  std::vector<GapTier> tier;
};

/// Does [gap - gap_error, gap + gap_error] of the floats hold that of the doubles, without being
/// wider than the header says? In exact numbers.
::testing::AssertionResult encloses(float f, float f_error, double gap, double error) {
  if (sign(f) != sign(gap)) return ::testing::AssertionFailure() << "sign of " << f << ", " << gap;
  if (std::isinf(f) && f_error == kInfinity) return ::testing::AssertionSuccess();
  if (std::isinf(f)) return ::testing::AssertionFailure() << "infinite gap, error " << f_error;
  const mpq_class lost = abs(mpq_class(f) - mpq_class(gap)), least = lost + mpq_class(error);
  const mpq_class at_most =
      (mpq_class(error) + mpq_class(0x1p-24) * abs(mpq_class(gap)) + mpq_class(0x1p-148)) *
      (1 + mpq_class(0x1p-22));
  if (f_error == kInfinity) {
    if (at_most > mpq_class(std::numeric_limits<float>::max()))
      return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "infinite error, " << gap << " +- " << error;
  }
  if (mpq_class(f_error) >= least && mpq_class(f_error) <= at_most)
    return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << f << " +- " << f_error << " of " << gap << " +- " << error;
}

TEST(FloatAnswers, KeepSignAndBoundAtTheEndsOfTheRange) {
  using detail::to_float_error;
  using detail::to_float_gap;
  constexpr float smallest = 0x1p-149f, largest = std::numeric_limits<float>::max();
  EXPECT_TRUE(same(to_float_gap(0.0), 0.0f));
  EXPECT_TRUE(same(to_float_gap(5e-324), smallest));
  EXPECT_TRUE(same(to_float_gap(-5e-324), -smallest));
  EXPECT_TRUE(same(to_float_gap(0x1p-150), smallest));  // a tie, which goes to 0
  EXPECT_TRUE(same(to_float_gap(-0x1.8p-149), -2 * smallest));
  EXPECT_TRUE(same(to_float_gap(0x1.fffffefp127), largest));
  EXPECT_TRUE(same(to_float_gap(0x1.ffffffp127), kInfinity));
  EXPECT_TRUE(same(to_float_gap(-1e300), -kInfinity));
  EXPECT_EQ(to_float_error(0.0, 0.0), 0.0f);
  EXPECT_EQ(to_float_error(1.0, 0.0), 0.0f);  // a float: nothing is lost
  EXPECT_EQ(to_float_error(1.0, 0x1p-60), std::nextafter(0x1p-60f, 1.0f));
  EXPECT_EQ(to_float_error(0.0, 5e-324), smallest);
  EXPECT_EQ(to_float_error(1e300, 1.0), kInfinity);
  EXPECT_EQ(to_float_error(std::numeric_limits<double>::infinity(), 1.0), kInfinity);
  EXPECT_EQ(to_float_error(0x1.fffffefp127, 0.0), 0x1.e00002p102f);
  EXPECT_EQ(to_float_error(1.0, 0x1.ffffff8p127), kInfinity);
}

TEST(FloatAnswers, EncloseWhatTheDoublesDoAtEveryMagnitude) {
  std::mt19937_64 random(testing::kSeed);
  std::uniform_real_distribution<double> mantissa(1.0, 2.0), power(-1070.0, 1020.0),
      near(-155.0, 130.0), part(-60.0, 2.0);
  for (int i = 0; i < 40000; ++i) {
    const double size = std::exp2(i % 4 == 0 ? power(random) : near(random));
    const double gap = (i % 2 == 0 ? 1 : -1) * mantissa(random) * size;
    const double error = i % 7 == 0 ? 0.0 : std::abs(gap) * std::exp2(part(random));
    ASSERT_TRUE(encloses(detail::to_float_gap(gap), detail::to_float_error(gap, error), gap, error))
        << i;
    const float up = detail::to_float_upwards(std::abs(gap));
    ASSERT_GE(static_cast<double>(up), std::abs(gap)) << i;
    ASSERT_LT(static_cast<double>(std::nextafter(up, 0.0f)), std::abs(gap)) << i;
  }
}

/// Float columns are the double ones of the same call, rounded, and enclose what those enclose.
void expect_rounded(const FloatColumns& floats, const Columns& doubles,
                    const std::vector<Vec3>& points) {
  for (std::size_t i = 0; i < doubles.gap.size(); ++i) {
    const double gap = doubles.gap[i], error = doubles.gap_error[i];
    ASSERT_TRUE(encloses(floats.gap[i], floats.gap_error[i], gap, error)) << i;
    ASSERT_TRUE(same(floats.gap[i], detail::to_float_gap(gap))) << i;
    ASSERT_TRUE(same(floats.gap_error[i], detail::to_float_error(gap, error))) << i;
    ASSERT_TRUE(same(floats.normal[i], doubles.normal[i])) << i;
    ASSERT_LE((floats.normal[i].cast<double>() - doubles.normal[i]).norm(), 0x1p-24) << i;
    ASSERT_TRUE(same(floats.arm_a[i], doubles.arm_a[i])) << i;
    ASSERT_TRUE(same(floats.arm_b[i], doubles.arm_b[i])) << i;
    ASSERT_TRUE(same(floats.point[i], points[i])) << i;
    ASSERT_EQ(floats.status[i], doubles.status[i]) << i;
    ASSERT_EQ(floats.tier[i], doubles.tier[i]) << i;
  }
}

/// Cold and followed from the cold normals as floats, in place.
template <class Bodies>
void expect_rounded(const Bodies& bodies, const PairList& list, Accuracy accuracy) {
  const std::size_t n = list.pairs.size();
  Columns doubles(n);
  FloatColumns floats(n);
  std::vector<Vec3> points(n), previous;
  GapColumns columns = doubles.all();
  columns.point = points;
  signed_gaps(bodies, list, columns, accuracy);
  signed_gaps(bodies, list, floats.all(), accuracy);
  expect_rounded(floats, doubles, points);

  floats.normal[n / 2].setZero();  // asked afresh
  for (const Vec3f& normal : floats.normal) previous.push_back(normal.cast<double>());
  follow_gaps(bodies, list, previous, columns, accuracy);
  follow_gaps(bodies, list, floats.normal, floats.all(), accuracy, 2);
  expect_rounded(floats, doubles, points);
}

// geometry/gap_batch.hpp (8)
TEST(FloatGapColumns, AreTheDoubleColumnsRounded) {
  for (const Family& family : testing::drawn_families()) {
    SCOPED_TRACE(family.name);
    const Indexed in(family);
    const BodyArray bodies(in.bodies);
    expect_rounded(bodies, {in.pairs, {}}, Accuracy::standard());
    if (family.a.size() < 1000) continue;
    expect_rounded(bodies, {in.pairs, in.separations}, Accuracy::certified());
    at_every_level([&] { expect_rounded(bodies, {in.pairs, {}}, Accuracy::fast()); });
  }
}

/// Bodies whose numbers are floats, in rows with something else between them.
struct FloatPoses {
  struct Row {
    float axes[3];
    std::uint32_t tag;
    float turn[4];  ///< w x y z
    float centre[3];
  };

  explicit FloatPoses(const Indexed& in) {
    for (const Ellipsoid& body : in.bodies) {
      Row row{};
      row.tag = 0xffffffff;  // a NaN to who reads it as a float
      for (int k = 0; k < 3; ++k) {
        row.axes[k] = static_cast<float>(body.semi_axes()[k]);
        row.centre[k] = static_cast<float>(body.centre()[k]);
      }
      const Quaternion& turn = body.orientation();
      row.turn[0] = static_cast<float>(turn.w());
      for (int k = 0; k < 3; ++k) row.turn[k + 1] = static_cast<float>(turn.vec()[k]);
      rows.push_back(row);
    }
    bodies.assign(column(rows[0].axes),
                  {{column(rows[0].turn), QuaternionOrder::wxyz}, column(rows[0].centre)});
  }
  Strided<float> column(const float* first) const { return {first, rows.size(), sizeof(Row)}; }

  std::vector<Row> rows;
  MovingBodies bodies;
};

TEST(FloatGapColumns, GoWithPosesInFloat) {
  for (const auto& shape : verify::contact_classes()) {
    const Indexed in(testing::contacts(shape, 500));
    const FloatPoses poses(in);
    const std::size_t n = in.pairs.size();
    at_every_level([&] { expect_rounded(poses.bodies, {in.pairs, {}}, Accuracy::standard()); });
    FloatColumns floats(n);
    signed_gaps(poses.bodies, {in.pairs, {}}, floats.all());
    for (std::size_t i = 0; i < n; ++i) {
      // The single call on the bodies that the floats mean, and the exact relation.
      const Ellipsoid a = poses.bodies[in.pairs[i].a], b = poses.bodies[in.pairs[i].b];
      const Gap gap = signed_gap(a, b);
      const double gap_there = floats.gap[i], error_there = floats.gap_error[i];
      ASSERT_LE(std::abs(gap_there - gap.gap), error_there + gap.gap_error) << i;
      ASSERT_EQ(gap_there < 0, overlaps(a, b)) << i;
      ASSERT_EQ(floats.status[i], gap.status) << i;
    }
  }
}

// Lengths beyond either end of float's range: no sign is lost, and no bound.
TEST(FloatGapColumns, KeepSignsBeyondTheRangeOfFloat) {
  const Family contacts = testing::contacts(verify::contact_classes()[1], 200);
  for (const double unit : {1e-60, 1e-44, 1e-41, 1e-36, 1e36, 1e38, 1e41, 1e60}) {
    SCOPED_TRACE(unit);
    Family scaled{"scaled", {}, {}};
    for (std::size_t i = 0; i < contacts.a.size(); ++i) {
      const auto there = [&](const Ellipsoid& e) {
        return Ellipsoid(unit * e.centre(), unit * e.semi_axes(), e.orientation());
      };
      scaled.a.push_back(there(contacts.a[i]));
      scaled.b.push_back(there(contacts.b[i]));
    }
    const Indexed in(scaled);
    const std::size_t n = in.pairs.size();
    const BodyArray bodies(in.bodies);
    expect_rounded(bodies, {in.pairs, {}}, Accuracy::standard());
    FloatColumns floats(n);
    for (const auto& environment : testing::all_environments()) {
      FloatColumns there(n);
      {
        const testing::EnvironmentGuard guard(environment);
        signed_gaps(bodies, {in.pairs, {}}, there.all());
      }
      signed_gaps(bodies, {in.pairs, {}}, floats.all());
      int smallest = 0, infinite = 0;
      for (std::size_t i = 0; i < n; ++i) {
        ASSERT_TRUE(same(there.gap[i], floats.gap[i])) << environment.name;
        ASSERT_TRUE(same(there.gap_error[i], floats.gap_error[i])) << environment.name;
        ASSERT_EQ(floats.gap[i] < 0, overlaps(scaled.a[i], scaled.b[i])) << i;
        smallest += std::abs(floats.gap[i]) == 0x1p-149f;
        infinite += std::isinf(floats.gap[i]);
      }
      if (unit == 1e-60) {
        EXPECT_EQ(smallest, static_cast<int>(n));
      }
      if (unit == 1e60) {
        EXPECT_EQ(infinite, static_cast<int>(n));
      }
    }
  }
}

TEST(FloatGapColumns, NeedNotAllBeAskedFor) {
  const Indexed in(testing::contacts(verify::contact_classes()[0], 150));
  const std::size_t n = in.pairs.size();
  const BodyArray bodies(in.bodies);
  FloatColumns all(n), alone(n);
  const PairList list{in.pairs, {}};
  signed_gaps(bodies, list, all.all());
  signed_gaps(bodies, list, {.gap = alone.gap});
  signed_gaps(bodies, list, {.gap_error = alone.gap_error});
  signed_gaps(bodies, list, {.arm_b = alone.arm_b});
  signed_gaps(bodies, list, {.point = alone.point});
  for (std::size_t i = 0; i < n; ++i) {
    ASSERT_TRUE(same(alone.gap[i], all.gap[i])) << i;
    ASSERT_TRUE(same(alone.gap_error[i], all.gap_error[i])) << i;
    ASSERT_EQ(alone.arm_b[i], all.arm_b[i]) << i;
    ASSERT_EQ(alone.point[i], all.point[i]) << i;
  }
  std::vector<float> short_column(n - 1);
  EXPECT_DEATH(signed_gaps(bodies, list, {.gap_error = short_column}), "gap_error");
  const std::vector<Vec3f> few(3, Vec3f::UnitX());
  EXPECT_DEATH(follow_gaps(bodies, list, few, {.gap = alone.gap}), "previous_normals");
}

}  // namespace
}  // namespace tangency
