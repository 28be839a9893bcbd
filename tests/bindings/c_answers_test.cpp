// SPDX-License-Identifier: GPL-3.0-or-later
// What the interface in C answers is what the C++ calls answer, to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <tangency/geometry/bindings/c/tangency.h>
#include <tangency/geometry/bounded_gap.hpp>
#include <tangency/geometry/common_volume.hpp>
#include <tangency/geometry/containment.hpp>
#include <tangency/geometry/curvature.hpp>
#include <tangency/geometry/gap_batch.hpp>
#include <tangency/geometry/neighbours.hpp>
#include <tangency/geometry/other_gaps.hpp>
#include <tangency/geometry/primitives.hpp>
#include <tangency/geometry/question_batch.hpp>
#include <tangency/geometry/ray.hpp>
#include <tangency/geometry/time_batch.hpp>
#include <tangency/geometry/trace_contact.hpp>
#include <tangency/version.hpp>

#include "rows.hpp"

namespace tangency::testing {
namespace {

constexpr std::size_t kBodies = 60;

/// The same bodies and pairs in both languages.
struct Sample {
  explicit Sample(double box = 3.0) : rows(drawn_rows(kBodies, 21, box)), c(rows) {
    for (const Row& row : rows) all.push_back(ellipsoid_of(row));
    std::vector<Vec3> axes, centres;
    std::vector<Quaternion> turns;
    for (const Ellipsoid& body : all) {
      axes.push_back(body.semi_axes());
      turns.push_back(body.orientation());
      centres.push_back(body.centre());
    }
    moving.assign(axes, {turns, centres});
    for (std::size_t k = 0; k < pairs.size(); k += 2) list.push_back({pairs[k], pairs[k + 1]});
  }

  std::size_t size() const { return list.size(); }
  const Ellipsoid& a(std::size_t k) const { return all[list[k].a]; }
  const Ellipsoid& b(std::size_t k) const { return all[list[k].b]; }

  std::vector<Row> rows;
  CBodies c;
  std::vector<Ellipsoid> all;
  MovingBodies moving;
  std::vector<unsigned> pairs = pairs_of(kBodies);
  std::vector<IndexedPair> list;
};

/// All columns of contacts, as C writes them.
struct Contacts {
  explicit Contacts(std::size_t count)
      : gap(count),
        error(count),
        normal(3 * count),
        arm_a(3 * count),
        arm_b(3 * count),
        point(3 * count),
        status(count),
        tier(count) {
    columns.gap = gap.data();
    columns.gap_error = error.data();
    columns.normal = normal.data();
    columns.arm_a = arm_a.data();
    columns.arm_b = arm_b.data();
    columns.point = point.data();
    columns.status = status.data();
    columns.tier = tier.data();
  }

  std::vector<double> gap, error, normal, arm_a, arm_b, point;
  std::vector<int> status, tier;
  tangency_contact_columns columns = empty_columns<tangency_contact_columns>();
};

std::vector<double> flat(const std::vector<Vec3>& vectors) {
  std::vector<double> numbers;
  for (const Vec3& v : vectors) numbers.insert(numbers.end(), {v[0], v[1], v[2]});
  return numbers;
}

Contacts by_cpp(const Sample& sample, Accuracy accuracy = {}) {
  const std::size_t n = sample.size();
  std::vector<Vec3> normal(n), arm_a(n), arm_b(n), point(n);
  std::vector<GapStatus> status(n);
  std::vector<GapTier> tier(n);
  Contacts found(n);
  signed_gaps(sample.moving, {sample.list},
              GapColumns{found.gap, found.error, normal, arm_a, arm_b, status, tier, point},
              accuracy);
  found.normal = flat(normal);
  found.arm_a = flat(arm_a);
  found.arm_b = flat(arm_b);
  found.point = flat(point);
  for (std::size_t k = 0; k < n; ++k) {
    found.status[k] = static_cast<int>(status[k]);
    found.tier[k] = static_cast<int>(tier[k]);
  }
  return found;
}

void expect_same(const Contacts& found, const Contacts& expected) {
  EXPECT_EQ(found.gap, expected.gap);
  EXPECT_EQ(found.error, expected.error);
  EXPECT_EQ(found.normal, expected.normal);
  EXPECT_EQ(found.arm_a, expected.arm_a);
  EXPECT_EQ(found.arm_b, expected.arm_b);
  EXPECT_EQ(found.point, expected.point);
  EXPECT_EQ(found.status, expected.status);
  EXPECT_EQ(found.tier, expected.tier);
}

TEST(CContacts, AreThoseOfTheBatchAtEveryAccuracyAndNumberOfThreads) {
  const Sample sample;
  const tangency_accuracy fast{sizeof fast, 0x1p-20, 0.0, 0, 0, 0},
      certified{sizeof certified, 0, 0, 1, 0, 0}, limited{sizeof limited, 0, 0, 0, 1, 0.1};
  for (const int threads : {-1, 1, 3}) {
    Contacts found(sample.size());
    const auto ask = [&](const tangency_accuracy* accuracy) {
      return tangency_contacts(sample.c, sample.pairs.data(), sample.size(), nullptr, nullptr,
                               accuracy, &found.columns, threads);
    };
    ASSERT_EQ(ask(nullptr), TANGENCY_OK) << tangency_error_message();
    expect_same(found, by_cpp(sample));
    ASSERT_EQ(ask(&fast), TANGENCY_OK);
    expect_same(found, by_cpp(sample, Accuracy::fast()));
    ASSERT_EQ(ask(&certified), TANGENCY_OK);
    expect_same(found, by_cpp(sample, Accuracy::certified()));
    ASSERT_EQ(ask(&limited), TANGENCY_OK);
    expect_same(found, by_cpp(sample, Accuracy::standard().up_to(0.1)));
    EXPECT_EQ(std::ranges::count(found.status, TANGENCY_STATUS_BEYOND) > 0, true);
  }
}

TEST(CContacts, OfRowsAreThoseOfBodiesInBlocksAndBeyond) {
  // 700: two whole blocks of rows and a part of one.
  constexpr std::size_t kPairs = 700;
  const std::vector<Row> rows = drawn_rows(2 * kPairs, 22);
  const CBodies bodies(rows);
  Contacts expected(kPairs), found(kPairs);
  ASSERT_EQ(
      tangency_contacts(bodies, nullptr, kPairs, nullptr, nullptr, nullptr, &expected.columns, 1),
      TANGENCY_OK);
  for (const int threads : {1, 2}) {
    ASSERT_EQ(tangency_contacts_of_rows(rows[0].data(), sizeof(Row), rows[kPairs].data(),
                                        sizeof(Row), kPairs, nullptr, &found.columns, threads),
              TANGENCY_OK);
    expect_same(found, expected);
  }
}

TEST(CContacts, FollowTheNormalsThatAreGiven) {
  const Sample sample;
  const Contacts before = by_cpp(sample);
  const std::size_t n = sample.size();
  Contacts found(n), expected(n);
  std::vector<Vec3> previous(n), normal(n);
  for (std::size_t k = 0; k < n; ++k) {
    previous[k] =
        k % 3 == 0 ? Vec3(Vec3::Zero())
                   : Vec3(before.normal[3 * k], before.normal[3 * k + 1], before.normal[3 * k + 2]);
  }
  follow_gaps(sample.moving, {sample.list}, previous,
              GapColumns{.gap = expected.gap, .normal = normal});
  std::ranges::copy(flat(previous), found.normal.begin());  // in place
  ASSERT_EQ(tangency_contacts(sample.c, sample.pairs.data(), n, nullptr, found.normal.data(),
                              nullptr, &found.columns, 1),
            TANGENCY_OK);
  EXPECT_EQ(found.gap, expected.gap);
  EXPECT_EQ(found.normal, flat(normal));
}

TEST(CContacts, BoundsAreThoseOfContactBounds) {
  const Sample sample;
  const std::size_t n = sample.size();
  std::vector<double> normal(n), arm_a(n), arm_b(n);
  auto columns = empty_columns<tangency_contact_columns>();
  columns.normal_bound = normal.data();
  columns.arm_a_bound = arm_a.data();
  columns.arm_b_bound = arm_b.data();
  ASSERT_EQ(
      tangency_contacts(sample.c, sample.pairs.data(), n, nullptr, nullptr, nullptr, &columns, 2),
      TANGENCY_OK);
  std::vector<Gap> gaps(n);
  const Contacts answers = by_cpp(sample);
  for (std::size_t k = 0; k < n; ++k) {
    const auto at = [&](const std::vector<double>& v) { return Vec3(&v[3 * k]); };
    const Gap gap{answers.gap[k],
                  at(answers.normal),
                  at(answers.arm_a),
                  at(answers.arm_b),
                  answers.error[k],
                  static_cast<GapStatus>(answers.status[k]),
                  static_cast<GapTier>(answers.tier[k])};
    const ContactBounds bounds = contact_bounds(sample.a(k), sample.b(k), gap);
    EXPECT_EQ(normal[k], bounds.normal);
    EXPECT_EQ(arm_a[k], bounds.arm_a);
    EXPECT_EQ(arm_b[k], bounds.arm_b);
  }
}

TEST(CBodies, MayBeFloatsOfAnyStrideAndAreAppendedAndSet) {
  struct Grain {
    int id;
    float pose[10];
  };
  std::vector<Row> rows = drawn_rows(20, 23);
  std::vector<Grain> grains(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < 10; ++k) {
      grains[i].pose[k] = static_cast<float>(rows[i][k]);
      rows[i][k] = static_cast<double>(grains[i].pose[k]);
    }
  }
  tangency_bodies* bodies = nullptr;
  const auto* const first = &grains[0].pose[0];
  ASSERT_EQ(tangency_bodies_create(&bodies, TANGENCY_FORM_AXES, &rows[3], TANGENCY_NUMBER_DOUBLE,
                                   10, sizeof(Row), 1.0),
            TANGENCY_OK);
  ASSERT_EQ(tangency_bodies_append(bodies, TANGENCY_FORM_AXES, &rows[10], TANGENCY_NUMBER_DOUBLE,
                                   10, sizeof(Row), 1.0),
            TANGENCY_OK);
  ASSERT_EQ(tangency_bodies_set(bodies, 0, first, TANGENCY_NUMBER_FLOAT, 10, sizeof(Grain)),
            TANGENCY_OK);
  EXPECT_EQ(tangency_bodies_count(bodies), 20U);
  Contacts found(10), expected(10);
  ASSERT_EQ(tangency_contacts(bodies, nullptr, 10, nullptr, nullptr, nullptr, &found.columns, 1),
            TANGENCY_OK);
  ASSERT_EQ(tangency_contacts_of_rows(rows[0].data(), sizeof(Row), rows[10].data(), sizeof(Row), 10,
                                      nullptr, &expected.columns, 1),
            TANGENCY_OK);
  expect_same(found, expected);
  tangency_bodies_destroy(bodies);
}

TEST(CRelations, AreThoseOfTheSingleCallAlsoAfterBodiesMoved) {
  Sample sample;
  const std::size_t n = sample.size();
  std::vector<int> relations(n), inner(n), tier(n);
  std::vector<unsigned char> meet(n), filtered(n);
  auto columns = empty_columns<tangency_relation_columns>();
  columns.relation = relations.data();
  columns.inner = inner.data();
  columns.tier = tier.data();
  for (int turn = 0; turn < 2; ++turn) {
    ASSERT_EQ(tangency_relations(sample.c, sample.pairs.data(), n, nullptr, &columns, 2), 0);
    ASSERT_EQ(tangency_overlaps(sample.c, sample.pairs.data(), n, nullptr, meet.data(), 1), 0);
    ASSERT_EQ(
        tangency_overlaps_by_filter(sample.c, sample.pairs.data(), n, nullptr, filtered.data(), 1),
        0);
    for (std::size_t k = 0; k < n; ++k) {
      const RelationAnswer expected = relation(sample.a(k), sample.b(k));
      EXPECT_EQ(relations[k], static_cast<int>(expected.relation));
      EXPECT_EQ(inner[k], static_cast<int>(expected.inner));
      EXPECT_EQ(tier[k], static_cast<int>(expected.tier));
      EXPECT_EQ(meet[k], overlaps(sample.a(k), sample.b(k)));
      EXPECT_EQ(filtered[k], meet[k]);
      EXPECT_EQ(tangency_name_of("relation", relations[k]), to_string(expected.relation));
    }
    for (std::size_t i = 0; i < kBodies; ++i) {
      for (std::size_t k = 0; k < 3; ++k) sample.rows[i][k] *= 0.5;
      sample.all[i] = ellipsoid_of(sample.rows[i]);
    }
    ASSERT_EQ(tangency_bodies_set(sample.c, 0, sample.rows.data(), TANGENCY_NUMBER_DOUBLE, kBodies,
                                  sizeof(Row)),
              0);
  }
}

TEST(CRelations, OfMatricesAreExactForTheirNumbers) {
  // A covariance at level 4 is a ball of radius 2 about 0; the other, a ball of radius 1, touches
  // it.
  const double shapes[2][9] = {{0, 0, 0, 1, 1, 1, 0, 0, 0}, {3, 0, 0, .25, .25, .25, 0, 0, 0}};
  tangency_bodies* bodies = nullptr;
  ASSERT_EQ(tangency_bodies_create(&bodies, TANGENCY_FORM_SHAPE, shapes, TANGENCY_NUMBER_DOUBLE, 2,
                                   sizeof shapes[0], 4.0),
            TANGENCY_OK);
  const double ball[10] = {0, 4, 0, 2, 2, 2, 1, 0, 0, 0};
  ASSERT_EQ(tangency_bodies_append(bodies, TANGENCY_FORM_AXES, ball, TANGENCY_NUMBER_DOUBLE, 1,
                                   sizeof ball, 1.0),
            TANGENCY_OK);
  const unsigned pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
  int relations[3];
  double gap[3], separations[9] = {3, 0, 0, 0, 4.5, 0, -3, 4, 0};
  auto columns = empty_columns<tangency_relation_columns>();
  columns.relation = relations;
  auto gaps = empty_columns<tangency_contact_columns>();
  gaps.gap = gap;
  ASSERT_EQ(tangency_relations(bodies, pairs[0], 3, nullptr, &columns, 1), TANGENCY_OK);
  EXPECT_EQ(relations[0], TANGENCY_RELATION_EXTERNAL_TOUCH);
  EXPECT_EQ(relations[1], TANGENCY_RELATION_EXTERNAL_TOUCH);
  EXPECT_EQ(relations[2], TANGENCY_RELATION_SEPARATE);
  ASSERT_EQ(tangency_contacts(bodies, pairs[0], 3, separations, nullptr, nullptr, &gaps, 1), 0);
  EXPECT_EQ(gap[0], 0.0);
  EXPECT_DOUBLE_EQ(gap[1], 0.5);
  EXPECT_DOUBLE_EQ(gap[2], 2.0);
  tangency_bodies_destroy(bodies);
}

TEST(CFurther, AnswersAreThoseOfTheSingleCalls) {
  const Sample sample(1.5);
  const std::size_t n = sample.size();
  const unsigned* const pairs = sample.pairs.data();
  std::vector<double> first(n), second(n), third(n), fourth(n);
  std::vector<int> status(n);

  auto factors = empty_columns<tangency_factor_columns>();
  factors.factor = first.data();
  factors.scale_error = second.data();
  ASSERT_EQ(tangency_perram_wertheim_factors(sample.c, pairs, n, nullptr, &factors, 1), 0);
  for (std::size_t k = 0; k < n; ++k) {
    const auto expected = perram_wertheim_factor(sample.a(k), sample.b(k));
    EXPECT_EQ(first[k], expected.factor);
    EXPECT_EQ(second[k], expected.scale_error);
  }

  auto volumes = empty_columns<tangency_volume_columns>();
  volumes.volume = first.data();
  volumes.volume_error = second.data();
  volumes.status = status.data();
  ASSERT_EQ(tangency_common_volumes(sample.c, pairs, n, nullptr, 1e-6, &volumes, 2), 0);
  for (std::size_t k = 0; k < n; ++k) {
    const CommonVolume expected = common_volume(sample.a(k), sample.b(k), 1e-6);
    EXPECT_EQ(first[k], expected.volume);
    EXPECT_EQ(second[k], expected.volume_error);
    EXPECT_EQ(status[k], static_cast<int>(expected.status));
  }

  auto containments = empty_columns<tangency_containment_columns>();
  containments.clearance = first.data();
  containments.margin = second.data();
  ASSERT_EQ(tangency_containments(sample.c, pairs, 6, nullptr, &containments, 1), 0);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(first[k], clearance(sample.a(k), sample.b(k)).clearance);
    EXPECT_EQ(second[k], containment_margin(sample.a(k), sample.b(k)).margin);
  }

  auto bounded = empty_columns<tangency_bounded_columns>();
  bounded.gap = first.data();
  bounded.above = second.data();
  std::vector<double> gap(n), above(n);
  ASSERT_EQ(tangency_bounded_gaps(sample.c, pairs, n, nullptr, nullptr, &bounded, 1), 0);
  bounded_gaps(sample.moving, {sample.list}, {{.gap = gap}, above});
  EXPECT_EQ(first, gap);
  EXPECT_EQ(second, above);

  auto others = empty_columns<tangency_other_gap_columns>();
  others.gap = first.data();
  others.status = status.data();
  const auto ask = [&](int definition, const auto& by_cpp_call) {
    ASSERT_EQ(tangency_other_gaps(sample.c, pairs, n, nullptr, definition, &others, 1), 0);
    for (std::size_t k = 0; k < n; ++k) {
      const auto expected = by_cpp_call(sample.a(k), sample.b(k));
      EXPECT_EQ(first[k], expected.gap);
      EXPECT_EQ(status[k] == TANGENCY_OTHER_STATUS_OK, static_cast<int>(expected.status) == 0);
    }
  };
  ask(TANGENCY_DEFINITION_PERRAM_WERTHEIM,
      [](const auto& a, const auto& b) { return perram_wertheim_gap(a, b); });
  ask(TANGENCY_DEFINITION_MIDPOINT_POTENTIAL,
      [](const auto& a, const auto& b) { return midpoint_potential_gap(a, b); });
  ask(TANGENCY_DEFINITION_TRACE, [](const auto& a, const auto& b) { return trace_contact(a, b); });
}

TEST(CFurther, DerivativesAndCurvaturesAreThoseAtTheContact) {
  const Sample sample;
  const std::size_t n = sample.size();
  const Contacts at = by_cpp(sample);
  std::vector<double> gradient(18 * n), hessian(324 * n), relative(2 * n), directions(6 * n);
  std::vector<int> status(n);
  auto derivatives = empty_columns<tangency_derivative_columns>();
  derivatives.gradient = gradient.data();
  derivatives.hessian = hessian.data();
  derivatives.status = status.data();
  ASSERT_EQ(tangency_gap_derivatives(sample.c, sample.pairs.data(), n, nullptr, at.normal.data(),
                                     at.status.data(), &derivatives, 1),
            TANGENCY_OK)
      << tangency_error_message();
  auto curvatures = empty_columns<tangency_curvature_columns>();
  curvatures.relative = relative.data();
  curvatures.b_directions = directions.data();
  ASSERT_EQ(tangency_contact_curvatures(sample.c, sample.pairs.data(), n, at.normal.data(),
                                        &curvatures, 1),
            TANGENCY_OK);
  for (std::size_t k = 0; k < n; ++k) {
    Gap gap{};
    gap.normal = Vec3(&at.normal[3 * k]);
    gap.status = static_cast<GapStatus>(at.status[k]);
    const GapDerivatives expected = gap_derivatives(sample.a(k), sample.b(k), gap);
    EXPECT_EQ(GapGradient(&gradient[18 * k]), expected.gradient);
    EXPECT_EQ(GapHessian(&hessian[324 * k]), expected.hessian);
    EXPECT_EQ(status[k], static_cast<int>(expected.status));
    const ContactCurvature curved = contact_curvature(sample.a(k), sample.b(k), gap.normal);
    EXPECT_EQ(relative[2 * k], curved.relative.curvature[0]);
    EXPECT_EQ(relative[2 * k + 1], curved.relative.curvature[1]);
    EXPECT_EQ(Vec3(&directions[6 * k]), curved.b.direction[0]);
    EXPECT_EQ(Vec3(&directions[6 * k + 3]), curved.b.direction[1]);
  }
}

TEST(CTimes, AreThoseOfTheBatch) {
  const Sample sample(6.0);
  const std::size_t n = sample.size();
  std::vector<double> rows;
  std::vector<Motion> motions;
  for (const Row& row : drawn_rows(kBodies, 24)) {
    motions.push_back({{row[0], row[1], row[2]}, {row[6], row[7], row[8]}, {0.1, 0.2, 0.3}});
    rows.insert(rows.end(), {row[0], row[1], row[2], row[6], row[7], row[8], 0.1, 0.2, 0.3});
  }
  std::vector<double> time(n), latest(n), expected(n);
  std::vector<ContactTimeStatus> statuses(n);
  std::vector<int> status(n);
  times_of_contact(sample.moving, motions, {sample.list}, 1.0, 1e-6,
                   {.status = statuses, .time = expected});
  auto columns = empty_columns<tangency_time_columns>();
  columns.status = status.data();
  columns.time = time.data();
  columns.latest = latest.data();
  ASSERT_EQ(tangency_times_of_contact(sample.c, sample.pairs.data(), n, nullptr, rows.data(), 1.0,
                                      1e-6, &columns, 2),
            TANGENCY_OK)
      << tangency_error_message();
  EXPECT_EQ(time, expected);
  int touching = 0;
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_EQ(status[k], static_cast<int>(statuses[k]));
    touching += status[k] == TANGENCY_TIME_STATUS_CONTACT ? 1 : 0;
    EXPECT_GE(latest[k], time[k]);
  }
  EXPECT_GT(touching, 0);
}

TEST(CMeetings, OfWallsPointsBallsAndRaysAreThoseOfTheSingleCalls) {
  const Sample sample;
  const double walls[2][4] = {{0, 0, 2, -1}, {1, 1, 0, 0.5}};
  const double points[2][3] = {{0, 0, 0}, {3, 2, 1}};
  const double balls[2][4] = {{0, 0, 0, 1}, {3, 2, 1, 0.25}};
  const double infinity = std::numeric_limits<double>::infinity();
  const double rays[2][8] = {{-9, 0, 0, 1, 0, 0, 0, infinity}, {0, 0, 9, 0, 0, -2, -infinity, 4}};
  std::vector<unsigned> pairs;
  for (unsigned i = 0; i < kBodies; ++i) pairs.insert(pairs.end(), {i, i % 2});
  std::vector<double> gap(kBodies), error(kBodies), t(2 * kBodies);
  std::vector<int> relations(kBodies), status(kBodies), count(kBodies);

  auto of_walls = empty_columns<tangency_wall_columns>();
  of_walls.gap = gap.data();
  of_walls.gap_error = error.data();
  of_walls.relation = relations.data();
  ASSERT_EQ(tangency_walls(sample.c, walls[0], 2, 0, pairs.data(), kBodies, &of_walls, 1), 0);
  for (std::size_t i = 0; i < kBodies; ++i) {
    const double* const w = walls[i % 2];
    const Plane plane{{w[0], w[1], w[2]}, w[3]};
    const WallGap expected = signed_gap(sample.all[i], plane);
    EXPECT_NEAR(gap[i], expected.gap, error[i] + expected.gap_error);
    EXPECT_EQ(relations[i], static_cast<int>(relation(sample.all[i], plane).relation));
  }
  std::vector<double> of_sheet(kBodies);
  of_walls.gap = of_sheet.data();
  ASSERT_EQ(tangency_walls(sample.c, walls[0], 2, 1, pairs.data(), kBodies, &of_walls, 1), 0);
  EXPECT_NE(of_sheet, gap);

  auto of_points = empty_columns<tangency_point_columns>();
  of_points.distance = gap.data();
  of_points.distance_error = error.data();
  ASSERT_EQ(tangency_points(sample.c, points[0], 2, pairs.data(), kBodies, &of_points, 1), 0);
  for (std::size_t i = 0; i < kBodies; ++i) {
    const double* const p = points[i % 2];
    const auto expected = closest_point(sample.all[i], {p[0], p[1], p[2]});
    EXPECT_NEAR(gap[i], expected.distance, error[i] + expected.distance_error);
  }

  auto of_balls = empty_columns<tangency_contact_columns>();
  of_balls.gap = gap.data();
  of_balls.gap_error = error.data();
  ASSERT_EQ(tangency_balls(sample.c, balls[0], 2, pairs.data(), kBodies, &of_balls, 1), 0);
  for (std::size_t i = 0; i < kBodies; ++i) {
    const double* const ball = balls[i % 2];
    const Gap expected = signed_gap(sample.all[i], Sphere{{ball[0], ball[1], ball[2]}, ball[3]});
    EXPECT_NEAR(gap[i], expected.gap, error[i] + expected.gap_error);
  }

  auto of_rays = empty_columns<tangency_ray_columns>();
  of_rays.status = status.data();
  of_rays.count = count.data();
  of_rays.t = t.data();
  ASSERT_EQ(tangency_rays(sample.c, rays[0], 2, pairs.data(), kBodies, &of_rays, 2), 0);
  for (std::size_t i = 0; i < kBodies; ++i) {
    const double* const r = rays[i % 2];
    const RayHit expected =
        intersect(sample.all[i], {{r[0], r[1], r[2]}, {r[3], r[4], r[5]}}, r[6], r[7]);
    EXPECT_EQ(status[i], static_cast<int>(expected.status));
    EXPECT_EQ(count[i], expected.count);
    EXPECT_EQ(t[2 * i], expected.points[0].t);
    EXPECT_EQ(t[2 * i + 1], expected.points[1].t);
  }
}

TEST(CNeighbours, AreThoseOfTheLatticeWithTheAnswersThatAreAskedFor) {
  const Sample sample;
  const double edges[9] = {7, 0, 0, 0, 7, 0, 0, 0, 7};
  const int periodic[3] = {1, 0, 1};
  tangency_neighbour_question question{};
  question.size = sizeof question;
  question.reach = 0.125;
  question.edges = edges;
  question.periodic = periodic;
  question.answers = TANGENCY_NEIGHBOUR_ANSWERS_GAPS;
  tangency_neighbours* list = nullptr;
  ASSERT_EQ(tangency_neighbours_create(&list, sample.c, &question, nullptr, 2), TANGENCY_OK)
      << tangency_error_message();
  NeighbourQuestion asked{.reach = 0.125, .answers = NeighbourAnswers::gaps};
  asked.lattice = {7.0 * Mat3::Identity(), {true, false, true}};
  const Neighbours expected = neighbours(sample.moving, asked);
  ASSERT_EQ(tangency_neighbours_count(list), expected.size());
  ASSERT_GT(expected.size(), kBodies);
  auto columns = empty_columns<tangency_neighbour_columns>();
  ASSERT_EQ(tangency_neighbours_columns(list, &columns), TANGENCY_OK);
  EXPECT_EQ(columns.normal, nullptr);
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_EQ(columns.pairs[2 * k], expected.pairs[k].a);
    EXPECT_EQ(columns.pairs[2 * k + 1], expected.pairs[k].b);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(columns.images[3 * k + i], expected.pairs[k].image[i]);
    }
    EXPECT_EQ(columns.gap[k], expected.gap[k]);
    EXPECT_EQ(columns.overlaps[k], expected.overlaps[k]);
  }
  tangency_neighbours_destroy(list);
}

TEST(CLibrary, TellsItsVersionInstructionSetAndLevels) {
  EXPECT_STREQ(tangency_version(), TANGENCY_VERSION_STRING);
  EXPECT_GT(std::string(tangency_instruction_set()).size(), 2U);
  double level = 0;
  ASSERT_EQ(tangency_level_of_confidence(0.95, 3, &level), TANGENCY_OK);
  EXPECT_EQ(level, level_of_confidence(0.95, 3));
  EXPECT_EQ(tangency_name_of("relation", 7), nullptr);
  EXPECT_EQ(tangency_name_of("nothing", 0), nullptr);
  EXPECT_STREQ(tangency_name_of("time_status", 4), "not_converged");
}

}  // namespace
}  // namespace tangency::testing
