// SPDX-License-Identifier: GPL-3.0-or-later
// Ellipses and quadrics of the interface in C, against the C++ calls.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <tangency/geometry/bindings/c/tangency.h>
#include <tangency/geometry/classify.hpp>
#include <tangency/geometry/ellipse_closest_point.hpp>
#include <tangency/geometry/ellipse_containment.hpp>
#include <tangency/geometry/ellipse_crossings.hpp>
#include <tangency/geometry/ellipse_gap.hpp>
#include <tangency/geometry/ellipse_relation.hpp>
#include <tangency/geometry/quadric.hpp>

#include "rows.hpp"

namespace tangency::testing {
namespace {

constexpr std::size_t kEllipses = 40;

struct Drawn {
  Drawn() {
    for (const Row& row : drawn_rows(kEllipses, 27, 1.5)) {
      rows.push_back({row[0], row[1], row[3], row[4], row[6], row[7]});
      all.emplace_back(Vec2(row[0], row[1]), Vec2(row[3], row[4]), Vec2(row[6], row[7]));
    }
    tangency_ellipses_create(&c, TANGENCY_PLANE_FORM_DIRECTION, rows.data(), TANGENCY_NUMBER_DOUBLE,
                             kEllipses, 48, 1.0);
  }
  ~Drawn() { tangency_ellipses_destroy(c); }
  Drawn(const Drawn&) = delete;
  Drawn& operator=(const Drawn&) = delete;

  std::vector<std::array<double, 6>> rows;
  std::vector<Ellipse> all;
  tangency_ellipses* c = nullptr;
};

TEST(CPlaneContacts, AreThoseOfTheSingleCalls) {
  const Drawn drawn;
  ASSERT_NE(drawn.c, nullptr);
  constexpr std::size_t kPairs = kEllipses / 2;
  std::vector<int> relations(kPairs), crossing(kPairs), multiplicities(4 * kPairs), chord(kPairs);
  std::vector<double> gap(kPairs), normal(2 * kPairs), area(kPairs), arms(8 * kPairs),
      depth(kPairs), clear(kPairs), margin(kPairs);
  auto columns = empty_columns<tangency_plane_contact_columns>();
  columns.relation = relations.data();
  columns.crossings = crossing.data();
  columns.multiplicities = multiplicities.data();
  columns.gap = gap.data();
  columns.normal = normal.data();
  columns.area = area.data();
  columns.crossing_arms = arms.data();
  columns.chord_status = chord.data();
  columns.chord_depth = depth.data();
  columns.clearance = clear.data();
  columns.margin = margin.data();
  ASSERT_EQ(tangency_plane_contacts(drawn.c, nullptr, kPairs, &columns, 2), TANGENCY_OK)
      << tangency_error_message();
  for (std::size_t k = 0; k < kPairs; ++k) {
    const Ellipse &a = drawn.all[k], &b = drawn.all[kPairs + k];
    const EllipseRelation expected = relation(a, b);
    EXPECT_EQ(relations[k], static_cast<int>(expected.relation));
    EXPECT_EQ(crossing[k], expected.crossings.value_or(-1));
    EXPECT_EQ(gap[k], signed_gap(a, b).gap);
    EXPECT_EQ(Vec2(&normal[2 * k]), signed_gap(a, b).normal);
    EXPECT_EQ(area[k], common_area(a, b));
    EXPECT_EQ(clear[k], clearance(a, b).clearance);
    EXPECT_EQ(margin[k], containment_margin(a, b).margin);
    const Crossings points = crossings(a, b);
    for (std::size_t i = 0; i < 4; ++i) {
      const bool is_one = static_cast<int>(i) < points.count;
      EXPECT_EQ(multiplicities[4 * k + i], is_one ? points.at[i].multiplicity : 0);
      if (is_one) {
        EXPECT_EQ(Vec2(&arms[8 * k + 2 * i]), points.at[i].arm_a);
      }
    }
    const ChordContact by_chord = chord_contact(a, b);
    EXPECT_EQ(chord[k], static_cast<int>(by_chord.status));
    if (by_chord.status == ChordStatus::ok) {
      EXPECT_EQ(depth[k], by_chord.depth);
    }
  }
}

TEST(CPlaneContacts, OfEqualEllipsesHaveNoNumberOfCrossings) {
  // The circle of radius 2 by an angle and by a shape matrix at level 4, exactly the same.
  const double by_angle[5] = {1, 2, 2, 2, 0.5}, by_shape[5] = {1, 2, 1, 1, 0};
  tangency_ellipses* ellipses = nullptr;
  ASSERT_EQ(tangency_ellipses_create(&ellipses, TANGENCY_PLANE_FORM_ANGLE, by_angle,
                                     TANGENCY_NUMBER_DOUBLE, 1, 40, 1.0),
            TANGENCY_OK);
  ASSERT_EQ(tangency_ellipses_append(ellipses, TANGENCY_PLANE_FORM_SHAPE, by_shape,
                                     TANGENCY_NUMBER_DOUBLE, 1, 40, 4.0),
            TANGENCY_OK);
  int relation = -1, crossings = 0;
  auto columns = empty_columns<tangency_plane_contact_columns>();
  columns.relation = &relation;
  columns.crossings = &crossings;
  ASSERT_EQ(tangency_plane_contacts(ellipses, nullptr, 1, &columns, 1), TANGENCY_OK);
  EXPECT_EQ(relation, TANGENCY_RELATION_EQUAL);
  EXPECT_EQ(crossings, -1);
  EXPECT_EQ(tangency_plane_contacts(ellipses, nullptr, 2, &columns, 1), TANGENCY_BAD_ARGUMENT);
  tangency_ellipses_destroy(ellipses);
}

TEST(CPlanePoints, AreThoseOfTheSingleCall) {
  const Drawn drawn;
  std::vector<double> points, distance(kEllipses), normal(2 * kEllipses);
  for (const Row& row : drawn_rows(kEllipses, 28)) points.insert(points.end(), {row[0], row[1]});
  auto columns = empty_columns<tangency_plane_point_columns>();
  columns.distance = distance.data();
  columns.normal = normal.data();
  ASSERT_EQ(
      tangency_plane_points(drawn.c, points.data(), kEllipses, nullptr, kEllipses, &columns, 1),
      TANGENCY_OK);
  for (std::size_t i = 0; i < kEllipses; ++i) {
    const auto expected = closest_point(drawn.all[i], Vec2(&points[2 * i]));
    EXPECT_EQ(distance[i], expected.distance);
    EXPECT_EQ(Vec2(&normal[2 * i]), expected.normal);
  }
}

TEST(CEllipses, OfABadRowAreRefused) {
  const double row[6] = {0, 0, 1, 1, 0, 0};
  tangency_ellipses* ellipses = nullptr;
  EXPECT_EQ(tangency_ellipses_create(&ellipses, TANGENCY_PLANE_FORM_DIRECTION, row,
                                     TANGENCY_NUMBER_DOUBLE, 1, 48, 1.0),
            TANGENCY_BAD_ROW);
  EXPECT_EQ(std::string(tangency_error_message()).find("rows: row 0: ux = 0: "), 0U)
      << tangency_error_message();
  EXPECT_EQ(ellipses, nullptr);
}

TEST(CClassify, NamesTheTypesOfQuadrics) {
  const double quadrics[3][10] = {{1, 1, 1, 0, 0, 0, 0, 0, 0, -1},
                                  {1, 1, -1, 0, 0, 0, 0, 0, 0, 0},
                                  {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}};
  int type[3], rank4[3];
  auto columns = empty_columns<tangency_quadric_columns>();
  columns.type = type;
  columns.rank4 = rank4;
  ASSERT_EQ(tangency_classify(quadrics[0], 3, sizeof quadrics[0], &columns, 1), TANGENCY_OK);
  EXPECT_STREQ(tangency_name_of("quadric_type", type[0]), "real_ellipsoid");
  EXPECT_STREQ(tangency_name_of("quadric_type", type[1]), "real_elliptic_cone");
  EXPECT_STREQ(tangency_name_of("quadric_type", type[2]), "all_space");
  EXPECT_EQ(rank4[0], 4);
  EXPECT_EQ(rank4[1], 3);
  EXPECT_EQ(rank4[2], 0);
}

}  // namespace
}  // namespace tangency::testing
