// SPDX-License-Identifier: GPL-2.0-or-later
#include <tangency/dem/lammps/box_motion.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace tangency::inline v0::lammps {
namespace {

Mat3 matrix_of(const std::array<double, 6>& edges) {
  Mat3 matrix;
  matrix << edges[0], edges[5], edges[4], 0.0, edges[1], edges[3], 0.0, 0.0, edges[2];
  return matrix;
}

/// Whole edges that a tilt was moved by.
double flips(double now, double before, double edge) { return std::round((now - before) / edge); }

}  // namespace

void BoxMotion::start(const LAMMPS_NS::Domain& domain) {
  std::copy_n(domain.h, edges_.size(), edges_.begin());
}

Mat3 BoxMotion::advance(const LAMMPS_NS::Domain& domain, double dt) {
  const std::array<double, 6> before = edges_;
  start(domain);
  if (before == edges_) return Mat3::Zero();
  // Back to the edges before a flip: of the third edge by the second, then of both by the first.
  std::array<double, 6> now = edges_;
  const double of_yz = flips(now[3], before[3], now[1]);
  now[3] -= of_yz * now[1];
  now[4] -= of_yz * now[5];
  now[4] -= flips(now[4], before[4], now[0]) * now[0];
  now[5] -= flips(now[5], before[5], now[0]) * now[0];
  const Mat3 edges = matrix_of(before);
  const Mat3 change = matrix_of(now) - edges;
  return change * edges.inverse() / dt;
}

Vec3 BoxMotion::thickness(const LAMMPS_NS::Domain& domain) {
  std::array<double, 6> edges{};
  std::copy_n(domain.h, edges.size(), edges.begin());
  return matrix_of(edges).inverse().rowwise().norm().cwiseInverse();
}

}  // namespace tangency::inline v0::lammps
