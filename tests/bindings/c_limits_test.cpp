// SPDX-License-Identifier: GPL-3.0-or-later
// Where the questions of the interface in C end: extremes of numbers, counts and sizes of structs
// are answered or refused, and none ends the process.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include <tangency/geometry/bindings/c/tangency.h>

#include "rows.hpp"

namespace tangency::testing {
namespace {

constexpr std::size_t kHuge = std::size_t{1} << 63;  // pairs: twice that is 0

Row unit_ball(double x) { return {x, 0, 0, 1, 1, 1, 1, 0, 0, 0}; }

/// In a row along x, 3 from one to the next.
std::vector<Row> unit_balls(std::size_t count) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < count; ++i) rows.push_back(unit_ball(3.0 * static_cast<double>(i)));
  return rows;
}

void expect_refused(int code, int expected, const std::string& message) {
  EXPECT_EQ(code, expected);
  EXPECT_EQ(tangency_error_message(), message);
}

struct Curvatures {
  double relative[2] = {-1, -1};
  int code;

  Curvatures(const Row& a, const Row& b) {
    const CBodies bodies({a, b});
    const double normal[3] = {1, 0, 0};
    auto columns = empty_columns<tangency_curvature_columns>();
    columns.relative = relative;
    code = tangency_contact_curvatures(bodies, nullptr, 1, normal, &columns, 1);
  }
};

TEST(CCurvatures, OfAspectRatiosBeyondTheKernelsAreRefused) {
  const Row b{3e165, 0, 0, 1e165, 1, 1, 1, 0, 0, 0};
  expect_refused(Curvatures({0, 0, 0, 1e165, 1e-160, 1, 1, 0, 0, 0}, b).code, TANGENCY_BAD_ROW,
                 "pairs: row 0: longest semi-axis = 1e+165: must be at most 1e70 times the "
                 "shortest, 1e-160");
  // The longest of one body, the shortest of the other.
  expect_refused(Curvatures({0, 0, 0, 1e40, 1e40, 1e40, 1, 0, 0, 0},
                            {2e40, 0, 0, 1e-40, 1e-40, 1e-40, 1, 0, 0, 0})
                     .code,
                 TANGENCY_BAD_ROW,
                 "pairs: row 0: longest semi-axis = 1e+40: must be at most 1e70 times the "
                 "shortest, 1e-40");
  const Curvatures within({0, 0, 0, 0x1p116, 0x1p-116, 1, 1, 0, 0, 0}, unit_ball(0x1p117));
  ASSERT_EQ(within.code, TANGENCY_OK) << tangency_error_message();
  EXPECT_TRUE(std::isfinite(within.relative[0]) && std::isfinite(within.relative[1]));
}

TEST(CCurvatures, WithoutPairsAreOfBodiesKAndCountPlusK) {
  std::vector<Row> rows = unit_balls(4);
  rows[2][3] = rows[2][4] = rows[2][5] = 2;
  const CBodies bodies(rows);
  const double normals[12] = {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0};
  double b[4] = {};
  auto columns = empty_columns<tangency_curvature_columns>();
  columns.b = b;
  ASSERT_EQ(tangency_contact_curvatures(bodies, nullptr, 2, normals, &columns, 1), TANGENCY_OK);
  EXPECT_NEAR(b[0], 0.5, 1e-13);  // a sphere's, some 100 roundings
  EXPECT_NEAR(b[2], 1.0, 1e-13);
  expect_refused(tangency_contact_curvatures(bodies, nullptr, 4, normals, &columns, 1),
                 TANGENCY_BAD_ARGUMENT,
                 "count = 4: without pairs must be half of 4, the number of bodies");
}

TEST(CMotions, OfAnyFiniteNumbersAreAnswered) {
  const double least = 0x1p-1000, most = 1.7e308;
  const CBodies balls(unit_balls(2));
  const CBodies thin({{0, 0, 0, 1, 1, least, 1, 0, 0, 0}, {3, 0, 0, 1, 1, 1, 1, 0, 0, 0}});
  auto columns = empty_columns<tangency_time_columns>();
  int status = -1;
  double time = -1, resolution = -1;
  columns.status = &status, columns.time = &time, columns.resolution = &resolution;
  const auto expect_answered = [&](tangency_bodies* bodies, const double* motions, double horizon) {
    ASSERT_EQ(
        tangency_times_of_contact(bodies, nullptr, 1, nullptr, motions, horizon, 1e-6, &columns, 1),
        TANGENCY_OK)
        << tangency_error_message();
    EXPECT_TRUE(status >= TANGENCY_TIME_STATUS_NONE &&
                status <= TANGENCY_TIME_STATUS_NOT_CONVERGED);
    EXPECT_TRUE(time >= 0 && time <= horizon && resolution >= 0) << time << ' ' << resolution;
  };
  for (tangency_bodies* bodies :
       {static_cast<tangency_bodies*>(balls), static_cast<tangency_bodies*>(thin)}) {
    for (const double horizon : {most, 1.0, 0x1p-1000, 0.0}) {
      for (std::size_t first = 0; first < 9; first += 3) {
        double motions[18] = {};
        for (std::size_t k = 0; k < 3; ++k)
          motions[first + k] = most, motions[first + 9 + k] = -most;
        expect_answered(bodies, motions, horizon);
      }
      double motions[18] = {};
      for (std::size_t k = 0; k < 18; ++k) motions[k] = (k % 2 == 0 ? 0x1p499 : -0x1p498);
      expect_answered(bodies, motions, horizon);
    }
  }
}

TEST(CStructs, OfSizesThatEndWithinAFieldAreRefused) {
  const CBodies bodies(unit_balls(2));
  double gap = -1;
  auto columns = empty_columns<tangency_contact_columns>();
  columns.gap = columns.gap_error = &gap;
  const std::size_t whole = sizeof columns;
  for (const std::size_t size :
       {std::size_t{8}, std::size_t{20}, whole - 1, std::size_t{0x5555555555555550}}) {
    columns.size = size;
    EXPECT_EQ(tangency_contacts(bodies, nullptr, 1, nullptr, nullptr, nullptr, &columns, 1),
              TANGENCY_BAD_ARGUMENT)
        << size;
    EXPECT_EQ(std::string(tangency_error_message()).find("answers.size = "), 0U);
  }
  columns.size = 20;
  expect_refused(tangency_contacts(bodies, nullptr, 1, nullptr, nullptr, nullptr, &columns, 1),
                 TANGENCY_BAD_ARGUMENT, "answers.size = 20: must be sizeof of the struct");
}

TEST(CStructs, HaveNoPaddingBehindTheirLastField) {
  static_assert(sizeof(tangency_accuracy) ==
                offsetof(tangency_accuracy, cutoff) + sizeof(tangency_accuracy::cutoff));
  static_assert(sizeof(tangency_neighbour_question) ==
                offsetof(tangency_neighbour_question, reserved) +
                    sizeof(tangency_neighbour_question::reserved));
  const CBodies bodies(unit_balls(2));
  auto question = empty_columns<tangency_neighbour_question>();
  question.reserved = 7;
  tangency_neighbours* list = nullptr;
  expect_refused(tangency_neighbours_create(&list, bodies, &question, nullptr, 1),
                 TANGENCY_BAD_ARGUMENT, "question.reserved = 7: must be 0");
}

TEST(CCounts, WithoutPairsAreComparedBeforeAnythingIsListed) {
  const CBodies bodies(unit_balls(4));
  const double points[9] = {};
  auto columns = empty_columns<tangency_point_columns>();
  expect_refused(tangency_points(bodies, points, 3, nullptr, kHuge, &columns, 1),
                 TANGENCY_BAD_ARGUMENT,
                 "count = 9223372036854775808: without pairs must be at most 3, the number of "
                 "points");
  expect_refused(tangency_points(bodies, points, 9, nullptr, 5, &columns, 1), TANGENCY_BAD_ARGUMENT,
                 "count = 5: without pairs must be at most 4, the number of bodies");
  // Twice this is 4, but for what overflows.
  const std::size_t overflowing = kHuge + 2;
  auto contacts = empty_columns<tangency_contact_columns>();
  EXPECT_EQ(
      tangency_contacts(bodies, nullptr, overflowing, nullptr, nullptr, nullptr, &contacts, 1),
      TANGENCY_BAD_ARGUMENT)
      << tangency_error_message();
  const double circles[10] = {0, 0, 1, 1, 0, 3, 0, 1, 1, 0};
  tangency_ellipses* ellipses = nullptr;
  ASSERT_EQ(tangency_ellipses_create(&ellipses, TANGENCY_PLANE_FORM_ANGLE, circles,
                                     TANGENCY_NUMBER_DOUBLE, 2, 5 * sizeof(double), 1.0),
            TANGENCY_OK);
  auto plane = empty_columns<tangency_plane_contact_columns>();
  EXPECT_EQ(tangency_plane_contacts(ellipses, nullptr, kHuge + 1, &plane, 1), TANGENCY_BAD_ARGUMENT)
      << tangency_error_message();
  expect_refused(tangency_plane_contacts(ellipses, nullptr, 2, &plane, 1), TANGENCY_BAD_ARGUMENT,
                 "count = 2: without pairs must be half of 2, the number of ellipses");
  tangency_ellipses_destroy(ellipses);
}

TEST(CBodies, OfRowsThatAreSetNameBothNumbers) {
  const std::vector<Row> rows = unit_balls(5);
  const CBodies bodies(unit_balls(4));
  const auto set = [&](std::size_t first, std::size_t count) {
    return tangency_bodies_set(bodies, first, rows.data(), TANGENCY_NUMBER_DOUBLE, count,
                               sizeof(Row));
  };
  expect_refused(set(3, 2), TANGENCY_BAD_ARGUMENT,
                 "first = 3: must be at most 2, of 4 bodies for 2 rows");
  expect_refused(set(0, 5), TANGENCY_BAD_ARGUMENT,
                 "count = 5: must be at most 4, the number of bodies");
  EXPECT_EQ(set(2, 2), TANGENCY_OK);
  EXPECT_EQ(set(4, 0), TANGENCY_OK);
}

TEST(CBodies, StayByAxesWhereNoRowOfAnotherFormIsAppended) {
  const std::vector<Row> rows = unit_balls(2);
  const CBodies bodies(rows);
  const auto append_none = [&](int form) {
    return tangency_bodies_append(bodies, form, nullptr, TANGENCY_NUMBER_DOUBLE, 0, 72, 1.0);
  };
  ASSERT_EQ(append_none(TANGENCY_FORM_SHAPE), TANGENCY_OK);
  EXPECT_EQ(tangency_bodies_count(bodies), 2U);
  EXPECT_EQ(tangency_bodies_set(bodies, 0, rows.data(), TANGENCY_NUMBER_DOUBLE, 2, sizeof(Row)),
            TANGENCY_OK)
      << tangency_error_message();
  expect_refused(append_none(9), TANGENCY_BAD_ARGUMENT, "form = 9: must be a tangency_form");
}

TEST(CNeighbours, LeaveNothingInFieldsThatAreNotKnown) {
  struct Newer {
    tangency_neighbour_columns known;
    void* added;
  };
  const CBodies bodies(unit_balls(2));
  auto question = empty_columns<tangency_neighbour_question>();
  question.reach = 2;
  tangency_neighbours* list = nullptr;
  ASSERT_EQ(tangency_neighbours_create(&list, bodies, &question, nullptr, 1), TANGENCY_OK);
  Newer newer;
  std::memset(&newer, 0x55, sizeof newer);
  newer.known.size = sizeof newer;
  ASSERT_EQ(tangency_neighbours_columns(list, &newer.known), TANGENCY_OK);
  EXPECT_EQ(newer.added, nullptr);
  EXPECT_EQ(newer.known.size, sizeof newer);
  ASSERT_NE(newer.known.pairs, nullptr);
  EXPECT_EQ(newer.known.pairs[1], 1U);
  newer.known.size = 20;
  expect_refused(tangency_neighbours_columns(list, &newer.known), TANGENCY_BAD_ARGUMENT,
                 "columns.size = 20: must be sizeof of the struct");
  tangency_neighbours_destroy(list);
}

TEST(CNeighbours, NameTheNumbersOfEdgesThatDepend) {
  const CBodies bodies(unit_balls(2));
  const double edges[9] = {4, 0, 0, 0, 4, 0, 0, 8, 0};
  auto question = empty_columns<tangency_neighbour_question>();
  question.edges = edges;
  tangency_neighbours* list = nullptr;
  expect_refused(tangency_neighbours_create(&list, bodies, &question, nullptr, 1),
                 TANGENCY_BAD_ARGUMENT,
                 "question.edges = 4 0 0 0 4 0 0 8 0: must be finite and linearly independent");
  EXPECT_EQ(list, nullptr);
}

}  // namespace
}  // namespace tangency::testing
