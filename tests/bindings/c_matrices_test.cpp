// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies by matrices have every answer that bodies by axes have, with what is rounded in the
// errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include <tangency/geometry/bindings/c/tangency.h>
#include <tangency/geometry/bounded_gap.hpp>
#include <tangency/geometry/matrix_ellipsoid.hpp>
#include <tangency/geometry/neighbours.hpp>
#include <tangency/geometry/relation.hpp>

#include "rows.hpp"

namespace tangency::testing {
namespace {

constexpr std::size_t kBodies = 40;

/// The same bodies by their semi-axes and, rounded, by their shape matrices.
struct Both {
  Both() {
    for (const Row& row : rows) {
      const Ellipsoid body = ellipsoid_of(row);
      const Vec3 squares = body.semi_axes().cwiseAbs2();
      Mat3 m = body.rotation() * squares.asDiagonal() * body.rotation().transpose();
      m = Mat3(0.5 * (m + m.transpose()));
      const Vec3& c = body.centre();
      for (const double x :
           {c.x(), c.y(), c.z(), m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(1, 2), m(2, 0)})
        shapes.push_back(x);
      given.push_back(MatrixEllipsoid::from_shape(c, m));
    }
  }
  std::size_t count() const { return pairs.size() / 2; }

  std::vector<Row> rows = drawn_rows(kBodies, 2026);
  std::vector<double> shapes;
  std::vector<MatrixEllipsoid> given;
  std::vector<unsigned> pairs = pairs_of(kBodies);
};

/// Of both forms; of matrices with a larger error.
template <class Ask>
void expect_within_both_errors(const Both& both, std::size_t count, const Ask& ask) {
  const CBodies axes(both.rows), matrices(TANGENCY_FORM_SHAPE, both.shapes.data(), kBodies, 9);
  std::vector<double> gap(count), error(count), other(count), other_error(count);
  ASSERT_EQ(ask(axes, gap.data(), error.data()), TANGENCY_OK) << tangency_error_message();
  ASSERT_EQ(ask(matrices, other.data(), other_error.data()), TANGENCY_OK)
      << tangency_error_message();
  for (std::size_t k = 0; k < count; ++k) {
    // The rows are no more than 100 roundings of the size away from the matrices.
    EXPECT_NEAR(gap[k], other[k], error[k] + other_error[k] + 1e-13) << k;
    EXPECT_GT(other_error[k], 0.0) << k;
    EXPECT_LT(other_error[k], 1e-12) << k;
  }
}

TEST(CMatrices, BallsAreThoseOfTheAxes) {
  const Both both;
  const double balls[8] = {0, 0, 0, 0.5, 1, -2, 0.25, 0};
  std::vector<unsigned> meetings;
  for (unsigned i = 0; i < kBodies; ++i) meetings.insert(meetings.end(), {i, i % 2});
  expect_within_both_errors(both, kBodies, [&](tangency_bodies* c, double* gap, double* error) {
    auto to = empty_columns<tangency_contact_columns>();
    to.gap = gap, to.gap_error = error;
    return tangency_balls(c, balls, 2, meetings.data(), kBodies, &to, 1);
  });
  const CBodies matrices(TANGENCY_FORM_SHAPE, both.shapes.data(), kBodies, 9);
  std::vector<double> error(kBodies);
  auto to = empty_columns<tangency_contact_columns>();
  to.gap_error = error.data();
  ASSERT_EQ(tangency_balls(matrices, balls, 2, meetings.data(), kBodies, &to, 1), TANGENCY_OK);
  for (std::size_t k = 0; k < kBodies; ++k)
    EXPECT_GE(error[k], both.given[k].rounding()) << "what was rounded is in it: " << k;
}

TEST(CMatrices, BoundedGapsHoldTheTrueOne) {
  const Both both;
  const CBodies c(TANGENCY_FORM_SHAPE, both.shapes.data(), kBodies, 9);
  const std::size_t count = both.count();
  std::vector<double> gap(count), below(count), above(count), true_gap(count), error(count);
  auto to = empty_columns<tangency_bounded_columns>();
  to.gap = gap.data(), to.gap_error = below.data(), to.above = above.data();
  ASSERT_EQ(tangency_bounded_gaps(c, both.pairs.data(), count, nullptr, nullptr, &to, 2),
            TANGENCY_OK);
  auto whole = empty_columns<tangency_contact_columns>();
  whole.gap = true_gap.data(), whole.gap_error = error.data();
  ASSERT_EQ(tangency_contacts(c, both.pairs.data(), count, nullptr, nullptr, nullptr, &whole, 1),
            TANGENCY_OK);
  std::vector<unsigned char> meet(count), known(count);
  ASSERT_EQ(tangency_overlaps(c, both.pairs.data(), count, nullptr, meet.data(), 1), TANGENCY_OK);
  ASSERT_EQ(tangency_overlaps_by_filter(c, both.pairs.data(), count, nullptr, known.data(), 1),
            TANGENCY_OK);
  std::size_t open = 0;
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_LE(gap[k] - below[k], true_gap[k] + error[k]) << k;
    EXPECT_GE(gap[k] + above[k], true_gap[k] - error[k]) << k;
    const unsigned a = both.pairs[2 * k], b = both.pairs[2 * k + 1];
    const MatrixEllipsoid &of_a = both.given[a], &of_b = both.given[b];
    const BoundedGap rounded = bounded_gap(of_a.ellipsoid(), of_b.ellipsoid());
    const double off = of_a.rounding() + of_b.rounding();
    ASSERT_GT(off, 0.0) << k;
    EXPECT_GE(below[k], rounded.gap_error + off) << k;
    EXPECT_GE(above[k], rounded.above + off) << k;
    if (known[k] == 2) {
      ++open;
    } else {
      EXPECT_EQ(known[k], meet[k]) << k;
    }
  }
  EXPECT_EQ(open, 0U);  // of drawn pairs none is within rounding of a touch
}

TEST(CMatrices, FilterLeavesTouchesOpen) {
  const double shapes[18] = {0, 0, 0, 1, 1, 1, 0, 0, 0, 3, 0, 0, 4, 4, 4, 0, 0, 0};
  const CBodies c(TANGENCY_FORM_SHAPE, shapes, 2, 9);
  const unsigned pair[2] = {0, 1};
  unsigned char known = 7;
  ASSERT_EQ(tangency_overlaps_by_filter(c, pair, 1, nullptr, &known, 1), TANGENCY_OK);
  EXPECT_EQ(known, 2);
}

TEST(CMatrices, NeighboursAreAllThatShareAPoint) {
  const Both both;
  const CBodies c(TANGENCY_FORM_SHAPE, both.shapes.data(), kBodies, 9);
  auto question = empty_columns<tangency_neighbour_question>();
  question.answers = TANGENCY_NEIGHBOUR_ANSWERS_CONTACTS;
  tangency_neighbours* list = nullptr;
  ASSERT_EQ(tangency_neighbours_create(&list, c, &question, nullptr, 2), TANGENCY_OK)
      << tangency_error_message();
  auto to = empty_columns<tangency_neighbour_columns>();
  ASSERT_EQ(tangency_neighbours_columns(list, &to), TANGENCY_OK);
  std::size_t at = 0;
  const std::size_t found = tangency_neighbours_count(list);
  for (unsigned a = 0; a < kBodies; ++a) {
    for (unsigned b = a + 1; b < kBodies; ++b) {
      const Relation lies = relation(both.given[a], both.given[b]).relation;
      if (lies == Relation::separate) continue;
      ASSERT_LT(at, found);
      EXPECT_EQ(to.pairs[2 * at], a);
      EXPECT_EQ(to.pairs[2 * at + 1], b);
      EXPECT_EQ(to.overlaps[at], lies != Relation::external_touch ? 1 : 0);
      EXPECT_EQ(to.gap[at], signed_gap(both.given[a], both.given[b]).gap);
      ++at;
    }
  }
  EXPECT_EQ(at, found);
  EXPECT_GT(found, 20U);
  tangency_neighbours_destroy(list);
}

TEST(CMatrices, NeighboursWithinAReachLeaveOutNoneThatIsNearer) {
  const Both both;
  const CBodies c(TANGENCY_FORM_SHAPE, both.shapes.data(), kBodies, 9);
  std::vector<double> least;  // of the true gaps, of all pairs
  for (unsigned a = 0; a < kBodies; ++a) {
    for (unsigned b = a + 1; b < kBodies; ++b) {
      const Gap gap = signed_gap(both.given[a], both.given[b]);
      least.push_back(gap.gap - gap.gap_error);
    }
  }
  std::vector<double> sorted = least;
  std::ranges::sort(sorted);
  // Also at the least gap of a pair, which its gap_error alone brings within the reach.
  for (const double reach : {0.7, *std::ranges::upper_bound(sorted, 0.5)}) {
    auto question = empty_columns<tangency_neighbour_question>();
    question.reach = reach, question.answers = TANGENCY_NEIGHBOUR_ANSWERS_GAPS;
    tangency_neighbours* list = nullptr;
    ASSERT_EQ(tangency_neighbours_create(&list, c, &question, nullptr, 2), TANGENCY_OK);
    auto found = empty_columns<tangency_neighbour_columns>();
    ASSERT_EQ(tangency_neighbours_columns(list, &found), TANGENCY_OK);
    const std::size_t count = tangency_neighbours_count(list);
    std::size_t at = 0, of_all = 0;
    for (unsigned a = 0; a < kBodies; ++a) {
      for (unsigned b = a + 1; b < kBodies; ++b) {
        const bool listed = at < count && found.pairs[2 * at] == a && found.pairs[2 * at + 1] == b;
        EXPECT_EQ(listed, least[of_all++] <= reach) << a << ' ' << b << ' ' << reach;
        if (!listed) continue;
        EXPECT_EQ(found.gap[at++], signed_gap(both.given[a], both.given[b]).gap);
      }
    }
    EXPECT_EQ(at, count);
    EXPECT_GT(count, 20U);
    tangency_neighbours_destroy(list);
  }
}

TEST(CMatrices, OtherGapsHaveNoErrorAndDerivativesNoSemiAxes) {
  const Both both;
  const CBodies axes(both.rows), c(TANGENCY_FORM_SHAPE, both.shapes.data(), kBodies, 9);
  const std::size_t count = both.count();
  std::vector<double> gap(count), other(count), error(count);
  auto to = empty_columns<tangency_other_gap_columns>();
  const auto ask = [&](tangency_bodies* bodies, double* column) {
    to.gap = column, to.gap_error = error.data();
    return tangency_other_gaps(bodies, both.pairs.data(), count, nullptr,
                               TANGENCY_DEFINITION_PERRAM_WERTHEIM, &to, 1);
  };
  ASSERT_EQ(ask(axes, gap.data()), TANGENCY_OK);
  ASSERT_EQ(ask(c, other.data()), TANGENCY_OK);
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_NEAR(gap[k], other[k], 1e-12) << k;
    EXPECT_TRUE(std::isinf(error[k])) << k;
  }

  std::vector<double> normals(3 * count), gradient(18 * count), hessian(324 * count);
  std::vector<int> statuses(count);
  auto contacts = empty_columns<tangency_contact_columns>();
  contacts.normal = normals.data(), contacts.status = statuses.data();
  ASSERT_EQ(tangency_contacts(c, both.pairs.data(), count, nullptr, nullptr, nullptr, &contacts, 1),
            TANGENCY_OK);
  auto derivatives = empty_columns<tangency_derivative_columns>();
  derivatives.gradient = gradient.data(), derivatives.hessian = hessian.data();
  ASSERT_EQ(tangency_gap_derivatives(c, both.pairs.data(), count, nullptr, normals.data(),
                                     statuses.data(), &derivatives, 1),
            TANGENCY_OK);
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < 18; ++i) {
      const bool axis = i % 9 >= 6;
      EXPECT_EQ(std::isnan(gradient[18 * k + i]), axis) << k << ' ' << i;
      for (std::size_t j = 0; j < 18; ++j)
        EXPECT_EQ(std::isnan(hessian[324 * k + 18 * i + j]), axis || j % 9 >= 6) << i << ' ' << j;
    }
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(gradient[18 * k + 9 + i], normals[3 * k + i], 1e-9);
  }
}

TEST(CMatrices, BodiesThatAreSetByAxesAreThose) {
  const Both both;
  const CBodies c(TANGENCY_FORM_SHAPE, both.shapes.data(), kBodies, 9);
  const Row ball{100, 0, 0, 1, 1, 1, 1, 0, 0, 0}, touching{102, 0, 0, 1, 1, 1, 1, 0, 0, 0};
  const std::vector<Row> rows{ball, touching};
  ASSERT_EQ(tangency_bodies_set(c, 3, rows.data(), TANGENCY_NUMBER_DOUBLE, 2, sizeof(Row)),
            TANGENCY_OK);
  const unsigned pairs[4] = {3, 4, 3, 5};
  int relations[2] = {-1, -1};
  auto to = empty_columns<tangency_relation_columns>();
  to.relation = relations;
  ASSERT_EQ(tangency_relations(c, pairs, 2, nullptr, &to, 1), TANGENCY_OK);
  EXPECT_EQ(relations[0], TANGENCY_RELATION_EXTERNAL_TOUCH);
  EXPECT_EQ(relations[1], TANGENCY_RELATION_SEPARATE);
}

}  // namespace
}  // namespace tangency::testing
