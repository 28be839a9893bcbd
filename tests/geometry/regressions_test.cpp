// SPDX-License-Identifier: GPL-3.0-or-later
// Every pair that was once answered wrongly, tests/data/regressions, is held against all that is
// promised of a pair, not only what it broke.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <tangency/geometry/ellipse_crossings.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/gap.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/relation.hpp>
#include <tangency/geometry/tables/csv.hpp>
#include <tangency/verify/families/conversions.hpp>
#include <tangency/verify/oracles/ellipse.hpp>
#include <tangency/verify/oracles/relation.hpp>

namespace tangency {
namespace {

constexpr double kU = kUnitRoundoff;

/// The numbers of one row by name, and its words: what it broke and the relation that is true.
struct Row {
  std::function<double(const std::string&)> number;
  std::string broke, expected;
};

template <class Check>
void for_each_regression(const std::string& table, const Check& check) {
  tables::Reader reader(TANGENCY_TEST_DATA "/regressions/" + table);
  const tables::Column broke = reader.header().require("broke");
  const tables::Column expected = reader.header().require("expected");
  int rows = 0;
  tables::for_each_row(reader, [&](const tables::RowCursor& row) {
    const Row read{
        [&](const std::string& name) { return row.number(reader.header().require(name)); },
        std::string(row.text(broke)), std::string(row.text(expected))};
    SCOPED_TRACE(table + " row " + std::to_string(rows++) + ", which broke " + read.broke);
    EXPECT_FALSE(read.broke.empty());
    check(read);
  });
  EXPECT_GT(rows, 0);
}

Ellipsoid body(const Row& row, const std::string& name) {
  const auto at = [&](const char* field) { return row.number(name + field); };
  return {{at("x"), at("y"), at("z")},
          {at("r1"), at("r2"), at("r3")},
          Eigen::Quaterniond(at("qw"), at("qx"), at("qy"), at("qz"))};
}

Ellipse ellipse(const Row& row, const std::string& name) {
  const auto at = [&](const char* field) { return row.number(name + field); };
  return {{at("x"), at("y")}, {at("r1"), at("r2")}, {at("ux"), at("uy")}};
}

/// The sign that the gap of a pair of this relation has.
int sign_of(Relation r) {
  return r == Relation::separate ? 1 : r == Relation::external_touch ? 0 : -1;
}
int sign(double x) { return (x > 0) - (x < 0); }

Relation exchanged(Relation r) {
  return r == Relation::a_in_b ? Relation::b_in_a : r == Relation::b_in_a ? Relation::a_in_b : r;
}

/// Two answers of one pair.
template <class Answer>
void expect_same_gap(const Answer& x, const Answer& y, Relation truth) {
  EXPECT_EQ(sign(x.gap), sign_of(truth));
  EXPECT_EQ(sign(y.gap), sign_of(truth));
  EXPECT_GE(x.gap_error, 0) << "NaN, or negative";
  // The true gap is at least gap - gap_error, and at most gap + gap_error where ok.
  if (!std::isfinite(x.gap)) return;
  if (y.status == GapStatus::ok) {
    EXPECT_LE(x.gap - x.gap_error, y.gap + y.gap_error);
  }
  if (x.status == GapStatus::ok) {
    EXPECT_LE(y.gap - y.gap_error, x.gap + x.gap_error);
  }
}

TEST(Regressions, PairsKeepEveryPromise) {
  for_each_regression("pairs.csv", [](const Row& row) {
    const Ellipsoid a = body(row, "a."), b = body(row, "b.");
    EXPECT_EQ(verify::name(verify::exact_relation(verify::to_raw(a), verify::to_raw(b)).relation),
              row.expected);
    const Relation truth = relation(a, b).relation;
    EXPECT_EQ(to_string(truth), row.expected);
    EXPECT_EQ(relation(b, a).relation, exchanged(truth));
    EXPECT_EQ(overlaps(a, b), sign_of(truth) < 0);
    const Gap gap = signed_gap(a, b);
    expect_same_gap(gap, signed_gap(b, a), truth);
    Gap batch;
    signed_gaps({&a, 1}, {&b, 1}, {&batch, 1});
    expect_same_gap(gap, batch, truth);
  });
}

TEST(Regressions, EllipsesKeepEveryPromise) {
  int searched = 0;
  for_each_regression("ellipses.csv", [&](const Row& row) {
    const Ellipse a = ellipse(row, "a."), b = ellipse(row, "b.");
    const auto raw = [](const Ellipse& e) -> verify::RawEllipse {
      const Vec2 &c = e.centre(), &r = e.semi_axes(), &u = e.direction();
      return {{c[0], c[1]}, {r[0], r[1]}, {u[0], u[1]}};
    };
    EXPECT_EQ(verify::name(verify::exact_ellipse_relation(raw(a), raw(b)).relation.relation),
              row.expected);
    const Relation truth = relation(a, b).relation;
    EXPECT_EQ(to_string(truth), row.expected);
    EXPECT_EQ(relation(b, a).relation, exchanged(truth));
    const double area = common_area(a, b);
    EXPECT_GE(area, 0);
    EXPECT_LE(area, std::min(a.area(), b.area()));
    EXPECT_EQ(area, common_area(b, a));
    const PlaneGap gap = signed_gap(a, b);
    expect_same_gap(gap, signed_gap(b, a), truth);
    searched += gap.tier == GapTier::search;
    const Vec2 d = b.centre() - a.centre();
    const double rounding = 16 * kU * (d.norm() + a.largest_semi_axis() + b.largest_semi_axis());
    for (int i = 0; i < 256; ++i) {
      const Vec2 n(std::cos(i * M_PI / 128), std::sin(i * M_PI / 128));
      EXPECT_LE(n.dot(d) - a.support(n) - b.support(n), gap.gap + gap.gap_error + rounding) << i;
    }
  });
  EXPECT_GE(searched, 5) << "rows whose best normal only the search finds";
}

}  // namespace
}  // namespace tangency
