// SPDX-License-Identifier: GPL-3.0-or-later
// Fabric and stress of contacts that no simulation made: six normals along the axes.
#include <iostream>
#include <vector>

#include <tangency/dem/micromechanics/stress_force_fabric.hpp>

int main() {
  namespace micro = tangency::micromechanics;
  using tangency::Vec3;
  const std::vector<Vec3> normals = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const std::vector<Vec3> branches = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  const std::vector<Vec3> forces = {{3, 0, 0}, {0, 3, 0}, {0, 0, 6}};
  micro::ContactArrays contacts{normals, branches, forces};
  contacts.volume = 8.0;
  const micro::Fabric fabric = micro::fabric_of(contacts, micro::SpherePartition::near_uniform(1),
                                                micro::Estimator::published, 2);
  const double mean = fabric.stress.trace() / 3.0;
  std::cout << "mean stress " << mean << ", a^r_xx " << fabric.normals->model.second(0, 0) << '\n';
  return mean == 1.0 && fabric.stress(2, 2) == 1.5 ? 0 : 1;
}
