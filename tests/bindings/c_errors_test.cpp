// SPDX-License-Identifier: GPL-3.0-or-later
// What the interface in C refuses, and how it says so: no bad number ends the process.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <tangency/geometry/bindings/c/tangency.h>

#include "rows.hpp"

namespace tangency::testing {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr auto kNoRow = static_cast<std::size_t>(-1);

/// Two unit balls, and what a call about them needs.
struct Two {
  std::vector<Row> rows{{0, 0, 0, 1, 1, 1, 1, 0, 0, 0}, {3, 0, 0, 1, 1, 1, 1, 0, 0, 0}};
  CBodies bodies{rows};
  unsigned pairs[2] = {0, 1};
  double numbers[324] = {}, normal[3] = {1, 0, 0};
  int codes[8] = {};
  tangency_contact_columns contacts = empty_columns<tangency_contact_columns>();
  tangency_time_columns times = empty_columns<tangency_time_columns>();
  tangency_wall_columns walls = empty_columns<tangency_wall_columns>();
  tangency_ray_columns rays = empty_columns<tangency_ray_columns>();
  tangency_volume_columns volumes = empty_columns<tangency_volume_columns>();
  tangency_derivative_columns derivatives = empty_columns<tangency_derivative_columns>();
  tangency_other_gap_columns others = empty_columns<tangency_other_gap_columns>();
  tangency_quadric_columns quadrics = empty_columns<tangency_quadric_columns>();

  int contact(const double* separations = nullptr, const double* previous = nullptr,
              const tangency_accuracy* accuracy = nullptr) const {
    return tangency_contacts(bodies, pairs, 1, separations, previous, accuracy, &contacts, 1);
  }
};

void expect_refused(int code, int expected, std::size_t row, const std::string& message) {
  EXPECT_EQ(code, expected);
  EXPECT_EQ(tangency_error_message(), message);
  EXPECT_EQ(tangency_error_row(), row);
}

int create(const void* rows, std::size_t count, int form = TANGENCY_FORM_AXES, double level = 1.0,
           int number = TANGENCY_NUMBER_DOUBLE, std::ptrdiff_t stride = sizeof(Row)) {
  tangency_bodies* bodies = nullptr;
  const int code = tangency_bodies_create(&bodies, form, rows, number, count, stride, level);
  EXPECT_EQ(bodies == nullptr, code != TANGENCY_OK);
  tangency_bodies_destroy(bodies);
  return code;
}

TEST(CErrors, OfRowsNameRowFieldValueAndRule) {
  Two two;
  two.rows[1][4] = -1;
  expect_refused(create(two.rows.data(), 2), TANGENCY_BAD_ROW, 1,
                 "rows: row 1: r2 = -1: a semi-axis must be finite and > 0");
  two.rows[1][4] = 1;
  two.rows[0][2] = kNan;
  expect_refused(
      tangency_bodies_set(two.bodies, 0, two.rows.data(), TANGENCY_NUMBER_DOUBLE, 2, sizeof(Row)),
      TANGENCY_BAD_ROW, 0, "rows: row 0: z = nan: a centre must be finite");
  const double shape[9] = {0, 0, 0, 1, 1, -2, 0, 0, 0};
  EXPECT_EQ(create(shape, 1, TANGENCY_FORM_SHAPE), TANGENCY_BAD_ROW);
  EXPECT_EQ(std::string(tangency_error_message()).find("rows: row 0: m = "), 0U)
      << tangency_error_message();
  const double quadric[10] = {1, 1, -1, 0, 0, 0, 0, 0, 0, -1};
  EXPECT_EQ(create(quadric, 1, TANGENCY_FORM_QUADRIC), TANGENCY_BAD_ROW);
  EXPECT_EQ(tangency_error_row(), 0U);
}

TEST(CErrors, OfManyRowsNameTheFirstWhateverTheNumberOfThreads) {
  std::vector<Row> a = drawn_rows(20000, 25), b = drawn_rows(20000, 26);
  a[17000][3] = 0;
  b[4321][6] = b[4321][7] = b[4321][8] = b[4321][9] = 0;
  b[19000][3] = kNan;
  std::vector<double> gap(a.size());
  auto columns = empty_columns<tangency_contact_columns>();
  columns.gap = gap.data();
  for (const int threads : {1, 4}) {
    EXPECT_EQ(tangency_contacts_of_rows(a[0].data(), sizeof(Row), b[0].data(), sizeof(Row),
                                        a.size(), nullptr, &columns, threads),
              TANGENCY_BAD_ROW);
    EXPECT_EQ(tangency_error_row(), 4321U);
    EXPECT_EQ(std::string(tangency_error_message()).find("b: row 4321: qw = 0: "), 0U)
        << tangency_error_message();
  }
}

TEST(CErrors, OfPairsSeparationsAndNormals) {
  Two two;
  two.pairs[1] = 2;
  expect_refused(two.contact(), TANGENCY_BAD_ROW, 0,
                 "pairs: row 0: b = 2: must be below 2, the number of bodies");
  two.pairs[1] = 1;
  const double separation[3] = {1, kNan, 0};
  expect_refused(two.contact(separation), TANGENCY_BAD_ROW, 0,
                 "separations: row 0: y = nan: must be finite");
  const double huge[3] = {1e200, 0, 0};
  expect_refused(two.contact(nullptr, huge), TANGENCY_BAD_ROW, 0,
                 "previous_normals: row 0: largest component = 1e+200: must be 0, or within "
                 "[2^-100, 2^100]");
  expect_refused(
      tangency_contacts(two.bodies, nullptr, 2, nullptr, nullptr, nullptr, &two.contacts, 1),
      TANGENCY_BAD_ARGUMENT, kNoRow,
      "count = 2: without pairs must be half of 2, the number of bodies");
  const double half[3] = {0.5, 0, 0};
  expect_refused(tangency_gap_derivatives(two.bodies, two.pairs, 1, nullptr, half, two.codes,
                                          &two.derivatives, 1),
                 TANGENCY_BAD_ROW, 0, "normals: row 0: length = 0.5: must be 1");
  two.codes[0] = 7;
  expect_refused(tangency_gap_derivatives(two.bodies, two.pairs, 1, nullptr, two.normal, two.codes,
                                          &two.derivatives, 1),
                 TANGENCY_BAD_ROW, 0,
                 "statuses: row 0: status = 7: must be "
                 "TANGENCY_STATUS_OK, TANGENCY_STATUS_LOCAL or TANGENCY_STATUS_BEYOND");
}

TEST(CErrors, OfOtherThings) {
  Two two;
  const double wall[4] = {0, 0, 0, 1}, ray[8] = {0, 0, 0, 1, 0, 0, 2, 1};
  expect_refused(tangency_walls(two.bodies, wall, 1, 0, nullptr, 1, &two.walls, 1),
                 TANGENCY_BAD_ROW, 0, "walls: row 0: nx = 0: a normal must not be 0");
  expect_refused(tangency_rays(two.bodies, ray, 1, nullptr, 1, &two.rays, 1), TANGENCY_BAD_ROW, 0,
                 "rays: row 0: t1 = 1: must not be below t0");
  const double ball[4] = {0, 0, 0, -1};
  expect_refused(tangency_balls(two.bodies, ball, 1, nullptr, 1, &two.contacts, 1),
                 TANGENCY_BAD_ROW, 0, "balls: row 0: r = -1: a radius must be >= 0");
  expect_refused(tangency_walls(two.bodies, wall, 1, 0, nullptr, 2, &two.walls, 1),
                 TANGENCY_BAD_ARGUMENT, kNoRow,
                 "count = 2: without pairs must be at most 1, the number of walls");
  const double motions[18] = {0, kNan};
  expect_refused(tangency_times_of_contact(two.bodies, two.pairs, 1, nullptr, motions, 100, 1e-6,
                                           &two.times, 1),
                 TANGENCY_BAD_ROW, 0, "motions: row 0: vy = nan: must be finite");
  const double coefficients[10] = {1, kNan};
  expect_refused(tangency_classify(coefficients, 1, 80, &two.quadrics, 1), TANGENCY_BAD_ROW, 0,
                 "coefficients: row 0: B = nan: a coefficient must be finite");
}

TEST(CErrors, OfSingleValues) {
  Two two;
  const double motions[18] = {};
  const auto time = [&](double horizon, double tolerance) {
    return tangency_times_of_contact(two.bodies, two.pairs, 1, nullptr, motions, horizon, tolerance,
                                     &two.times, 1);
  };
  expect_refused(time(-1, 1), TANGENCY_BAD_ARGUMENT, kNoRow,
                 "horizon = -1: must be finite and >= 0");
  expect_refused(time(1, 0), TANGENCY_BAD_ARGUMENT, kNoRow, "tolerance = 0: must be > 0");
  expect_refused(tangency_common_volumes(two.bodies, two.pairs, 1, nullptr, kNan, &two.volumes, 1),
                 TANGENCY_BAD_ARGUMENT, kNoRow, "tolerance = nan: must be > 0");
  expect_refused(tangency_other_gaps(two.bodies, two.pairs, 1, nullptr, 3, &two.others, 1),
                 TANGENCY_BAD_ARGUMENT, kNoRow, "definition = 3: must be a tangency_definition");
  expect_refused(create(two.rows.data(), 2, 9), TANGENCY_BAD_ARGUMENT, kNoRow,
                 "form = 9: must be a tangency_form");
  expect_refused(create(two.rows.data(), 2, TANGENCY_FORM_AXES, 1.0, 2), TANGENCY_BAD_ARGUMENT,
                 kNoRow, "number = 2: must be a tangency_number");
  expect_refused(create(two.rows.data(), 2, TANGENCY_FORM_AXES, -1.0), TANGENCY_BAD_ARGUMENT,
                 kNoRow, "level = -1: must be finite and > 0");
  const tangency_accuracy accuracy{sizeof accuracy, -1, 0, 0, 0, 0};
  expect_refused(two.contact(nullptr, nullptr, &accuracy), TANGENCY_BAD_ARGUMENT, kNoRow,
                 "accuracy.of_size = -1: must be >= 0");
  const tangency_accuracy limited{sizeof limited, 0, 0, 0, 1, kNan};
  expect_refused(two.contact(nullptr, nullptr, &limited), TANGENCY_BAD_ARGUMENT, kNoRow,
                 "accuracy.cutoff = nan: must be >= 0");
  double level = 0;
  expect_refused(tangency_level_of_confidence(1.5, 3, &level), TANGENCY_BAD_ARGUMENT, kNoRow,
                 "confidence = 1.5: must be > 0 and < 1");
  expect_refused(tangency_level_of_confidence(0.5, 7, &level), TANGENCY_BAD_ARGUMENT, kNoRow,
                 "dimensions = 7: must be 2 or 3");
  tangency_neighbour_question question{};
  question.size = sizeof question;
  question.reach = -1;
  tangency_neighbours* list = nullptr;
  EXPECT_EQ(tangency_neighbours_create(&list, two.bodies, &question, nullptr, 1),
            TANGENCY_BAD_ARGUMENT);
  EXPECT_EQ(list, nullptr);
}

TEST(CErrors, OfNullPointers) {
  Two two;
  const auto is_null = [](int code, const char* argument) {
    expect_refused(code, TANGENCY_BAD_ARGUMENT, kNoRow,
                   std::string(argument) + ": must not be NULL");
  };
  is_null(create(nullptr, 1), "rows");
  is_null(tangency_bodies_create(nullptr, 0, two.rows.data(), 0, 1, 80, 1), "bodies");
  is_null(tangency_contacts(nullptr, two.pairs, 1, nullptr, nullptr, nullptr, &two.contacts, 1),
          "bodies");
  is_null(tangency_contacts(two.bodies, two.pairs, 1, nullptr, nullptr, nullptr, nullptr, 1),
          "answers");
  is_null(tangency_overlaps(two.bodies, two.pairs, 1, nullptr, nullptr, 1), "answers");
  is_null(tangency_walls(two.bodies, nullptr, 2, 0, nullptr, 2, &two.walls, 1), "walls");
  is_null(tangency_gap_derivatives(two.bodies, two.pairs, 1, nullptr, nullptr, two.codes,
                                   &two.derivatives, 1),
          "normals");
  tangency_bodies_destroy(nullptr);
  tangency_ellipses_destroy(nullptr);
  tangency_neighbours_destroy(nullptr);
  EXPECT_EQ(tangency_bodies_count(nullptr), 0U);
}

TEST(CErrors, OfBodiesByMatricesSayWhatIsNotTaken) {
  const double shapes[2][9] = {{0, 0, 0, 1, 1, 1, 0, 0, 0}, {3, 0, 0, 1, 1, 1, 0, 0, 0}};
  const CBodies bodies(TANGENCY_FORM_SHAPE, shapes[0], 2, 9);
  ASSERT_EQ(bodies.code(), TANGENCY_OK);
  Two two;
  const double separation[3] = {1, 0, 0};
  expect_refused(tangency_common_volumes(bodies, two.pairs, 1, separation, 1e-6, &two.volumes, 1),
                 TANGENCY_BAD_ARGUMENT, kNoRow, "separations: must be NULL for bodies by matrices");
}

TEST(CStructs, OfAnOlderCallerAskForLessAndOfANewerOneForNothingUnknown) {
  struct Newer {
    tangency_contact_columns known;
    double* added;
  };
  Two two;
  double gap = -1, normal[3] = {7, 7, 7};
  Newer newer{};
  newer.known.gap = &gap;
  newer.known.normal = normal;
  newer.known.size = sizeof newer;
  const auto ask = [&] {
    return tangency_contacts(two.bodies, two.pairs, 1, nullptr, nullptr, nullptr, &newer.known, 1);
  };
  ASSERT_EQ(ask(), TANGENCY_OK);
  EXPECT_EQ(gap, 1.0);
  EXPECT_EQ(normal[0], 1.0);
  newer.added = &gap;
  expect_refused(ask(), TANGENCY_BAD_ARGUMENT, kNoRow,
                 "answers: has fields that this version of the library does not know");
  normal[0] = 7;
  newer.known.size = offsetof(tangency_contact_columns, normal);
  ASSERT_EQ(ask(), TANGENCY_OK);
  EXPECT_EQ(normal[0], 7.0);
  newer.known.size = 0;
  expect_refused(ask(), TANGENCY_BAD_ARGUMENT, kNoRow,
                 "answers.size = 0: must be sizeof of the struct");
}

TEST(CErrors, AreOfTheThreadThatAsked) {
  Two two;
  two.pairs[1] = 9;
  EXPECT_EQ(two.contact(), TANGENCY_BAD_ROW);
  const std::string here = tangency_error_message();
  std::thread([&] {
    EXPECT_STREQ(tangency_error_message(), "");
    EXPECT_EQ(create(nullptr, 1), TANGENCY_BAD_ARGUMENT);
  }).join();
  EXPECT_EQ(tangency_error_message(), here);
}

TEST(CContacts, OfNoPairNeedNoArray) {
  Two two;
  EXPECT_EQ(tangency_contacts_of_rows(nullptr, 80, nullptr, 80, 0, nullptr, &two.contacts, 1),
            TANGENCY_OK);
  EXPECT_EQ(create(nullptr, 0), TANGENCY_OK);
  EXPECT_EQ(tangency_walls(two.bodies, nullptr, 0, 0, nullptr, 0, &two.walls, 1), TANGENCY_OK);
}

}  // namespace
}  // namespace tangency::testing
