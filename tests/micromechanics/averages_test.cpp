// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include <tangency/dem/micromechanics/averages.hpp>
#include <tangency/dem/micromechanics/fabric.hpp>
#include <tangency/dem/micromechanics/plane.hpp>

#include "fields.hpp"
#include "planted_bodies.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using tangency::Mat3;
using tangency::Quaternion;
using tangency::Vec3;

/// Bodies that keep themselves.
struct Bodies {
  std::vector<Quaternion> orientation;
  std::vector<Vec3> semi_axes;

  BodyArrays arrays() const { return {orientation, semi_axes}; }
};

Bodies random_bodies(Random& random, std::int64_t count, const Vec3& semi_axes) {
  Bodies bodies;
  for (std::int64_t i = 0; i < count; ++i) {
    bodies.orientation.emplace_back(Eigen::Quaterniond(random_rotation(random)));
    bodies.semi_axes.push_back(semi_axes);
  }
  return bodies;
}

/// In the plane: normals, branches and forces of any directions, turned about z.
Packing plane_packing(Random& random, std::size_t contacts) {
  Packing packing;
  packing.dimensions = 2;
  packing.particles = static_cast<std::int64_t>(contacts);
  packing.volume = static_cast<double>(contacts);
  for (std::size_t c = 0; c < contacts; ++c) {
    const double angle = uniform(random, 0.0, 2.0 * std::numbers::pi);
    const Vec3 n(std::cos(angle), std::sin(angle), 0.0), t(-n[1], n[0], 0.0);
    packing.normal.push_back(n);
    packing.force.push_back(uniform(random, 1.0, 3.0) * n + uniform(random, -0.5, 0.5) * t);
    packing.branch.push_back(uniform(random, 1.8, 2.2) * n + uniform(random, -0.2, 0.2) * t);
    packing.arm.push_back(0.5 * packing.branch.back());
    const auto a = static_cast<std::int64_t>(c);
    packing.bodies.push_back({a, (a + 3) % packing.particles});
  }
  return packing;
}

template <class Model>
void expect_equal(const Averages::Tensor& tensor, const Model& model, const HarmonicErrors& error,
                  double unexplained) {
  ASSERT_TRUE(tensor);
  EXPECT_EQ(tensor->mean, model.mean);
  EXPECT_EQ(tensor->mean_error, error.mean);
  EXPECT_EQ(tensor->second, model.second);
  EXPECT_EQ(tensor->second_error, error.second);
  ASSERT_TRUE(tensor->fourth && tensor->fourth_error);
  EXPECT_EQ(tensor->fourth->components, model.fourth.components);
  EXPECT_EQ(tensor->fourth_error->components, error.fourth.components);
  EXPECT_EQ(tensor->unexplained4, unexplained);
}

/// Of directions: what is left unexplained is not asked for.
void expect_equal(const Averages::Tensor& tensor, const OrientationFit& fit) {
  ASSERT_TRUE(tensor && tensor->fourth && tensor->fourth_error);
  EXPECT_EQ(tensor->mean, fit.model.mean);
  EXPECT_LT((tensor->second - fit.model.second).norm(), 1e-13);
  EXPECT_LT((tensor->second_error - fit.error.second).norm(), 1e-13);
  EXPECT_LT(distance(*tensor->fourth, fit.model.fourth), 1e-12);
  EXPECT_LT(distance(*tensor->fourth_error, fit.error.fourth), 1e-12);
}

void expect_near(const Averages::Tensor& tensor, const PlaneScalarFit& fit) {
  ASSERT_TRUE(tensor);
  EXPECT_EQ(tensor->mean, fit.mean);
  EXPECT_LT((tensor->second - fit.second).norm(), 1e-13);
  EXPECT_LT((tensor->second_error - fit.second_error).norm(), 1e-13);
}

/// Contact vectors in the axes of their bodies, by matrices.
std::vector<Vec3> local_vectors(const Packing& packing, const Bodies& bodies) {
  std::vector<Vec3> found;
  for (std::size_t c = 0; c < packing.bodies.size(); ++c) {
    const auto [a, b] = packing.bodies[c];
    const Vec3 of_a = packing.arm[c], of_b = packing.arm[c] - packing.branch[c];
    const auto axes = [&](std::int64_t body) {
      return bodies.orientation[static_cast<std::size_t>(body)].toRotationMatrix();
    };
    found.push_back(axes(a).transpose() * of_a / of_a.norm());
    found.push_back(axes(b).transpose() * of_b / of_b.norm());
  }
  return found;
}

std::vector<Vec3> axes_of(const Bodies& bodies, int axis) {
  std::vector<Vec3> found;
  for (const Quaternion& q : bodies.orientation) found.push_back(q.toRotationMatrix().col(axis));
  return found;
}

void expect_equal(const Averages::Tensor& tensor, const PlaneScalarFit& fit) {
  ASSERT_TRUE(tensor);
  EXPECT_EQ(tensor->mean, fit.mean);
  EXPECT_EQ(tensor->second, fit.second);
  EXPECT_EQ(tensor->second_error, fit.second_error);
  EXPECT_FALSE(tensor->fourth);
  EXPECT_TRUE(std::isnan(tensor->unexplained4));
}

// dem/micromechanics/averages.hpp (1)
TEST(Averages, InSpaceAreThoseOfTheFitsAlone) {
  Random random(71);
  const Packing packing = draw(random, random_planted(random, true), 2000, 0.3);
  const Bodies bodies = random_bodies(random, packing.particles, {3.0, 2.0, 2.0});
  for (const Classes& classes : {Classes{}, Classes{Classes::Kind::polar, 9}})
    for (const Estimator estimator :
         {Estimator::published, Estimator::unbiased, Estimator::contact_sums}) {
      const Averages found = averages_of(packing.arrays(), bodies.arrays(), classes, estimator);
      const Fabric fabric = fabric_of(packing.arrays(), classes.partition(), estimator);
      EXPECT_EQ(found.stress, fabric.stress);
      EXPECT_EQ(found.contact_density, fabric.contact_density);
      EXPECT_EQ(found.empty_classes, fabric.empty_classes);
      const OrientationFit &normals = *fabric.normals, &vectors = *fabric.contact_vectors;
      expect_equal(found.normals, normals.model, normals.error, fabric.normals_unexplained);
      const ScalarFit &fn = fabric.force->normal, &zn = fabric.branch->normal;
      const TangentialFit &ft = fabric.force->tangential, &zt = fabric.branch->tangential;
      expect_equal(found.force_normal, fn.model, fn.error, fn.unexplained);
      expect_equal(found.force_tangential, ft.model, ft.error, ft.unexplained);
      expect_equal(found.branch_normal, zn.model, zn.error, zn.unexplained);
      expect_equal(found.branch_tangential, zt.model, zt.error, zt.unexplained);
      const ScalarFit& length = *fabric.branch_length;
      expect_equal(found.branch_length, length.model, length.error, length.unexplained);
      expect_equal(found.contact_vectors, vectors);
      expect_equal(found.long_axes, *fit_orientations(axes_of(bodies, 0)));
      expect_equal(found.local_contacts, *fit_orientations(local_vectors(packing, bodies)));
      EXPECT_EQ(found.force_asymmetry, ft.asymmetry);
      EXPECT_EQ(found.branch_asymmetry, zt.asymmetry);
    }
}

TEST(Averages, StatesAndStressAreThoseOfTheFabric) {
  Random random(72);
  const Packing packing = draw(random, random_planted(random, true), 3000, 0.1);
  const Averages found = averages_of(packing.arrays(), {});
  const Fabric fabric = fabric_of(packing.arrays(), SpherePartition::near_uniform(4));
  const auto state = second_order_state(found, 3), other = second_order_state(fabric);
  ASSERT_TRUE(state && other);
  EXPECT_EQ(stress_parts(*state).sum(), stress_parts(*other).sum());
  EXPECT_FALSE(second_order_state(found, 2));
  EXPECT_FALSE(plane_state(found, 3));
  const auto both = found.stress_of_both_orders();
  ASSERT_TRUE(both);
  EXPECT_LT((*both - found.stress).norm(), 0.02 * found.stress.norm());
  EXPECT_LT((*both - found.stress).norm(),
            0.5 * (stress_parts(*state).sum() - found.stress).norm());
}

// dem/micromechanics/averages.hpp (1)
TEST(Averages, InThePlaneAreThoseOfTheFitsAlone) {
  Random random(73);
  const Packing packing = plane_packing(random, 800);
  Bodies bodies;
  for (std::int64_t i = 0; i < packing.particles; ++i) {
    const double half = uniform(random, 0.0, std::numbers::pi);
    bodies.orientation.emplace_back(std::cos(half), 0.0, 0.0, std::sin(half));
    bodies.semi_axes.emplace_back(2.0, 1.5, 1.5);
  }
  const Averages found = averages_of(packing.arrays(), bodies.arrays());
  const PlaneFabric fabric = plane_fabric_of(packing.arrays(), 32);
  expect_equal(found.normals, *fabric.normals);
  expect_equal(found.force_normal, fabric.force->normal);
  expect_equal(found.force_tangential, fabric.force->tangential);
  expect_equal(found.branch_normal, fabric.branch->normal);
  expect_equal(found.branch_tangential, fabric.branch->tangential);
  EXPECT_EQ(found.classes, 32u);
  ASSERT_TRUE(found.branch_length);
  expect_near(found.long_axes, *fit_plane_orientations(axes_of(bodies, 0)));
  expect_near(found.local_contacts, *fit_plane_orientations(local_vectors(packing, bodies)));
  expect_near(found.contact_vectors, *fit_plane_orientations(contact_vectors(packing.arrays())));
  EXPECT_EQ(found.body_axis, 0);
  // Long along the other axis, half of them upside down.
  for (Vec3& r : bodies.semi_axes) r = {1.5, 2.0, 1.5};
  for (std::size_t i = 0; i < bodies.orientation.size(); i += 2)
    bodies.orientation[i] = bodies.orientation[i] * Quaternion(0.0, 1.0, 0.0, 0.0);
  const Averages across = averages_of(packing.arrays(), bodies.arrays());
  expect_near(across.long_axes, *fit_plane_orientations(axes_of(bodies, 1)));
  expect_near(across.local_contacts, *fit_plane_orientations(local_vectors(packing, bodies)));
  EXPECT_EQ(across.body_axis, 1);
  const auto state = plane_state(found, 2);
  ASSERT_TRUE(state);
  EXPECT_EQ(plane_stress(*state), plane_stress(*plane_state(fabric)));
  EXPECT_FALSE(second_order_state(found, 2));
  EXPECT_FALSE(found.stress_of_both_orders());
}

TEST(Averages, OfBodiesTurnWithThemInSpaceAndStayInBodyAxes) {
  Random random(74);
  const Packing packing = draw(random, random_planted(random, true), 600, 0.3);
  const Mat3 rotation = random_rotation(random);
  for (const Vec3& shape : {Vec3(3.0, 2.0, 2.0), Vec3(2.0, 2.0, 1.2), Vec3(3.0, 2.0, 1.0)}) {
    const Bodies bodies = random_bodies(random, packing.particles, shape);
    Bodies turned = bodies;
    for (Quaternion& q : turned.orientation)
      q = Eigen::Quaterniond(rotation) * Eigen::Quaterniond(q);
    const Packing other = rotated(packing, rotation);
    const Averages before = averages_of(packing.arrays(), bodies.arrays());
    const Averages after = averages_of(other.arrays(), turned.arrays());
    const auto turns = [&](const Averages::Tensor& a, const Averages::Tensor& b) {
      EXPECT_LT((rotation * a->second * rotation.transpose() - b->second).norm(), 1e-12);
      EXPECT_LT(distance(a->fourth->rotated(rotation), *b->fourth), 1e-11);
    };
    turns(before.long_axes, after.long_axes);
    turns(before.contact_vectors, after.contact_vectors);
    EXPECT_LT((before.local_contacts->second - after.local_contacts->second).norm(), 1e-12);
    EXPECT_LT(distance(*before.local_contacts->fourth, *after.local_contacts->fourth), 1e-11);
    EXPECT_GT(before.local_contacts->second.norm(), 1e-3);
  }
}

// dem/micromechanics/averages.hpp (2)
TEST(Averages, RenumberingBodiesChangesNothing) {
  Random random(75);
  const Packing packing = draw(random, random_planted(random, true), 500, 0.3);
  const Bodies bodies = random_bodies(random, packing.particles, {3.0, 2.0, 2.0});
  std::vector<std::size_t> place(packing.normal.size());
  std::iota(place.begin(), place.end(), 0u);
  std::shuffle(place.begin(), place.end(), random);
  Bodies moved = bodies;
  for (std::size_t i = 0; i < place.size(); ++i) {
    moved.orientation[place[i]] = bodies.orientation[i];
    moved.semi_axes[place[i]] = bodies.semi_axes[i];
  }
  Packing renumbered = packing;
  for (auto& pair : renumbered.bodies)
    for (std::int64_t& i : pair) i = static_cast<std::int64_t>(place[static_cast<std::size_t>(i)]);
  const Averages before = averages_of(packing.arrays(), bodies.arrays());
  const Averages after = averages_of(renumbered.arrays(), moved.arrays());
  EXPECT_EQ(before.force_normal->second, after.force_normal->second);
  EXPECT_EQ(before.local_contacts->second, after.local_contacts->second);
  EXPECT_LT((before.long_axes->second - after.long_axes->second).norm(), 1e-13);
  const Averages wrong = averages_of(renumbered.arrays(), bodies.arrays());
  EXPECT_GT((before.local_contacts->second - wrong.local_contacts->second).norm(), 1e-3);
}

TEST(Averages, OfSpheresAndOfNoContactAreEmptyAndNotZero) {
  Random random(76);
  const Packing packing = draw(random, random_planted(random, false), 400, 0.3);
  Bodies bodies = random_bodies(random, packing.particles, {2.0, 2.0, 2.0});
  const Averages spheres = averages_of(packing.arrays(), bodies.arrays());
  EXPECT_TRUE(spheres.normals && spheres.contact_vectors && spheres.force_normal);
  EXPECT_FALSE(spheres.long_axes || spheres.local_contacts || spheres.body_axis);
  // One long body among them has all the axes.
  bodies.semi_axes[0] = {3.0, 2.0, 2.0};
  const Averages one = averages_of(packing.arrays(), bodies.arrays());
  EXPECT_NEAR(one.long_axes->second.norm(), 7.5 * std::sqrt(2.0 / 3.0), 1e-12);
  EXPECT_EQ(one.body_axis, 0);
  bodies.semi_axes[1] = {2.0, 2.0, 1.0};
  EXPECT_FALSE(averages_of(packing.arrays(), bodies.arrays()).body_axis);

  for (const int dimensions : {2, 3}) {
    Packing none;
    none.particles = 3;
    none.dimensions = dimensions;
    const Bodies three{std::vector<Quaternion>(3, Quaternion(1.0, 0.0, 0.0, 0.0)),
                       std::vector<Vec3>(3, {2.0, 1.0, 1.0})};
    const Averages found = averages_of(none.arrays(), three.arrays());
    EXPECT_FALSE(found.normals || found.force_normal || found.force_tangential);
    EXPECT_FALSE(found.branch_normal || found.branch_length || found.contact_vectors);
    EXPECT_FALSE(found.local_contacts);
    EXPECT_TRUE(found.long_axes);
    EXPECT_EQ(found.empty_classes, found.classes);
    EXPECT_FALSE(found.stress_of_both_orders() || second_order_state(found, dimensions) ||
                 plane_state(found, dimensions));
  }
}

TEST(Averages, OrderFourLeavesLessOfWhatIsPlantedUnexplained) {
  Random random(77);
  const Packing packing = draw(random, random_planted(random, true), 6000, 0.0);
  const Averages found = averages_of(packing.arrays(), {});
  for (const auto* tensor : {&found.force_normal, &found.force_tangential, &found.branch_normal,
                             &found.branch_tangential}) {
    EXPECT_LT((*tensor)->unexplained4, 0.1);
    EXPECT_GT((*tensor)->unexplained2, (*tensor)->unexplained4);
  }
}

TEST(Averages, AxisThatTellsHowABodyLiesIsThatOfRevolutionOrTheLongest) {
  EXPECT_EQ(telling_axis({3.0, 2.0, 2.0}), 0);
  EXPECT_EQ(telling_axis({2.0, 3.0, 2.0}), 1);
  EXPECT_EQ(telling_axis({2.0, 2.0, 1.0}), 2);
  EXPECT_EQ(telling_axis({3.0, 2.0, 1.0}), 0);
  EXPECT_EQ(telling_axis({1.0, 2.0, 3.0}), 2);
  EXPECT_FALSE(telling_axis({2.0, 2.0, 2.0}));
  EXPECT_FALSE(telling_axis({2.0, 2.0 * (1.0 + 1e-12), 2.0}));
  EXPECT_EQ(telling_axis({2.0, 1.0, 1.0}, 2), 0);
  EXPECT_FALSE(telling_axis({2.0, 2.0, 1.0}, 2));
}

TEST(Averages, ClassesAreAsManyAsTheirNumberSays) {
  EXPECT_EQ(Classes{}.partition().size(), 384u);
  EXPECT_EQ((Classes{Classes::Kind::polar, 18}.partition().size()), 648u);
  EXPECT_EQ(Classes{}.arcs(), 32);
  EXPECT_EQ((Classes{Classes::Kind::polar, 18}.arcs()), 36);
}

TEST(Averages, BodiesThatAreNotWhatTheySayAreRefusedByNameAndPlace) {
  Random random(78);
  const Packing packing = draw(random, random_planted(random, false), 20, 0.3);
  const Bodies good = random_bodies(random, 20, {3.0, 2.0, 2.0});
  const auto message = [](const Packing& of, const Bodies& bodies) {
    return refusal([&] { averages_of(of.arrays(), bodies.arrays()); });
  };
  EXPECT_EQ(message(packing, good), "");
  EXPECT_EQ(message(packing, random_bodies(random, 19, {3.0, 2.0, 2.0})),
            "orientation: 19 entries, and there are 20 particles");
  Bodies bad = good;
  bad.semi_axes.pop_back();
  EXPECT_EQ(message(packing, bad), "semi_axes: 19 entries, and there are 20 particles");
  bad = good;
  bad.orientation[3].coeffs() *= 0.5;
  EXPECT_EQ(message(packing, bad), "orientation[3]: length 0.500000: must be 1");
  bad.orientation[3].coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(message(packing, bad).substr(0, 14), "orientation[3]");
  bad = good;
  bad.semi_axes[7][1] = 0.0;
  EXPECT_EQ(message(packing, bad), "semi_axes[7]: 0.000000: must be finite and > 0");
  bad.semi_axes[7][1] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(message(packing, bad), "semi_axes[7]: inf: must be finite and > 0");

  // In the plane the third body axis stands upright, or upside down, and no other.
  const Packing plane = plane_packing(random, 20);
  Bodies flat{std::vector<Quaternion>(20, Quaternion(0.0, 1.0, 0.0, 0.0)),
              std::vector<Vec3>(20, {2.0, 1.0, 1.0})};
  EXPECT_EQ(message(plane, flat), "");
  const double half = std::sqrt(0.5);
  for (const Quaternion& lying :
       {Quaternion(half, half, 0.0, 0.0), Quaternion(half, 0.0, half, 0.0)}) {
    flat.orientation[4] = lying;
    EXPECT_EQ(message(plane, flat), "orientation[4]: body axis 2 must be that of z in the plane");
  }
}

// A table of six digits is a packing too: what it rounds off changes nothing by more.
TEST(Averages, OrientationsNeedBeUnitsToSixDigitsAlone) {
  Random random(79);
  const Packing packing = draw(random, random_planted(random, true), 300, 0.3);
  Bodies bodies = random_bodies(random, packing.particles, {3.0, 2.0, 2.0});
  const Averages before = averages_of(packing.arrays(), bodies.arrays());
  for (Quaternion& q : bodies.orientation) q.coeffs() *= 1.0 + 0.9 * kUnitTolerance;
  const Averages after = averages_of(packing.arrays(), bodies.arrays());
  EXPECT_LT((before.long_axes->second - after.long_axes->second).norm(), 1e-12);
  EXPECT_LT((before.local_contacts->second - after.local_contacts->second).norm(), 1e-12);
}

// dem/micromechanics/distributions.hpp (3)
TEST(AxisGroups, AreThoseOfTheLargestComponentAndAddUpToAll) {
  const std::vector<Vec3> normals{Vec3(0.8, 0.6, 0.0), Vec3(0.0, 0.6, -0.8), Vec3(-0.8, 0.0, 0.6),
                                  Vec3(std::sqrt(0.5), std::sqrt(0.5), 0.0)};
  const std::vector<Vec3> forces{2.0 * normals[0], 7.0 * normals[1], 4.0 * normals[2],
                                 3.0 * normals[3]};
  const auto groups = axis_groups(normals, forces);
  EXPECT_EQ(groups[0].contacts, 3);
  EXPECT_EQ(groups[1].contacts, 0);
  EXPECT_EQ(groups[2].contacts, 1);
  EXPECT_DOUBLE_EQ(groups[0].fraction, 0.75);
  EXPECT_DOUBLE_EQ(groups[0].mean_normal_force, 3.0);
  EXPECT_DOUBLE_EQ(groups[2].mean_normal_force, 7.0);
  EXPECT_TRUE(std::isnan(groups[1].mean_normal_force));
  EXPECT_TRUE(std::isnan(axis_groups({}, {})[0].fraction));
}

}  // namespace
