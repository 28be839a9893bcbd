// SPDX-License-Identifier: GPL-3.0-or-later
// A part of a user's program that has nothing to do with the libraries, but uses templates of Eigen
// that they use as well, for another processor and with other optimisations: at equal names a
// linker keeps one of both.
#include <Eigen/Dense>

double norm_of_factor(const double* numbers);

double norm_of_factor(const double* numbers) {
  using Tall = Eigen::Matrix<double, 6, 3>;
  const Eigen::HouseholderQR<Tall> factors(Eigen::Map<const Tall>{numbers});
  const Eigen::Matrix3d r = factors.matrixQR().topLeftCorner<3, 3>();
  const Eigen::Vector3d v = r.col(2);
  return v.stableNorm() + v.cwiseProduct(v).stableNorm() + r.row(1).stableNorm();
}
