// SPDX-License-Identifier: GPL-3.0-or-later
// `compute fabric` of LAMMPS by its documented formulas, written out:
// docs.lammps.org/compute_fabric.html. There tr is a third of the trace. Debian 12's LAMMPS is too
// old to have it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include <tangency/dem/micromechanics/fabric.hpp>

#include "fields.hpp"

namespace {

using namespace tangency::micromechanics;
using namespace tangency::testing;
using tangency::Mat3;
using tangency::Vec3;

struct ComputeFabric {
  Mat3 contact, branch, normal_force, tangential_force;
};
double third(const Mat3& a) { return a.trace() / 3.0; }
Mat3 deviator(const Mat3& a) { return a - third(a) * Mat3::Identity(); }

ComputeFabric compute_fabric(const Packing& packing) {
  const auto contacts = static_cast<double>(packing.branch.size());
  Mat3 phi = Mat3::Zero();
  for (const Vec3& r : packing.branch) phi += r * r.transpose() / (r.squaredNorm() * contacts);
  ComputeFabric found;
  found.contact = 15.0 / 2.0 * deviator(phi);
  Mat3 d = Mat3::Zero(), n = Mat3::Zero(), t = Mat3::Zero();
  for (std::size_t c = 0; c < packing.branch.size(); ++c) {
    const Vec3& r = packing.branch[c];
    const double squared = r.squaredNorm(), length = std::sqrt(squared);
    const double weight = 1.0 / (contacts * (squared + r.dot(found.contact * r)));
    const double along = packing.force[c].dot(r) / length;
    const double across = (packing.force[c] - along * r / length).norm();
    const Mat3 product = weight * r * r.transpose();
    d += length * product;
    n += along * product;
    t += across * product;
  }
  found.branch = 15.0 / (6.0 * third(d)) * deviator(d);
  found.normal_force = 15.0 / (6.0 * third(n)) * deviator(n);
  found.tangential_force = 15.0 / (9.0 * third(n)) * deviator(t);
  return found;
}

/// Spheres of many sizes: branches along normals.
Packing spheres(Random& random) {
  Planted planted = random_planted(random, false);
  planted.tangential_branch = {};
  Packing packing = draw(random, planted, 3000, 0.3);
  for (std::size_t c = 0; c < packing.branch.size(); ++c)
    packing.branch[c] = uniform(random, 0.5, 1.5) * packing.branch[c].norm() * packing.normal[c];
  return packing;
}

TEST(ComputeFabric, ContactSumsOfSpheresAreItsContactBranchAndNormalForceTensors) {
  Random random(151);
  for (int repeat = 0; repeat < 5; ++repeat) {
    const Packing packing = spheres(random);
    const ComputeFabric expected = compute_fabric(packing);
    const Fabric found =
        fabric_of(packing.arrays(), SpherePartition::near_uniform(1), Estimator::contact_sums, 2);
    EXPECT_LT((found.normals->model.second - expected.contact).norm(), 1e-12);
    EXPECT_LT((found.branch->normal.model.second - expected.branch).norm(), 1e-12);
    EXPECT_LT((found.branch_length->model.second - expected.branch).norm(), 1e-12);
    EXPECT_LT((found.force->normal.model.second - expected.normal_force).norm(), 1e-12);
  }
}

// Its tangential tensor takes the magnitude of the force in the place of the vector, as a scalar of
// the normal: (2/3) times the scalar's anisotropy times its mean over f0, and not a^t.
TEST(ComputeFabric, TangentialTensorIsThatOfTheMagnitude) {
  Random random(152);
  const Packing packing = spheres(random);
  const ComputeFabric expected = compute_fabric(packing);
  const DirectionGroups groups(SpherePartition::near_uniform(1), packing.normal);
  const auto across = tangential_components(packing.normal, packing.force);
  const auto magnitude = fit_scalars(groups, lengths(across), Estimator::contact_sums, 2);
  const auto force = fit_vectors(groups, packing.force, Estimator::contact_sums, 2);
  const double share = magnitude->model.mean / force->normal.model.mean;
  EXPECT_LT((2.0 / 3.0 * share * magnitude->model.second - expected.tangential_force).norm(),
            1e-12);
  EXPECT_GT((force->tangential.model.second - expected.tangential_force).norm(), 0.05);
}

}  // namespace
