// SPDX-License-Identifier: MIT
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <tangency/dem/cell.hpp>

namespace tangency::dem {
namespace {

/// Eigenvalues and vectors of F F', F the deformation from `before` to `now`.
Eigen::SelfAdjointEigenSolver<Mat3> squared_stretch(const Mat3& before, const Mat3& now) {
  const Mat3 gradient = now * before.inverse();
  return Eigen::SelfAdjointEigenSolver<Mat3>(gradient * gradient.transpose());
}

}  // namespace

Cell Cell::box(const Vec3& lengths, int dimensions, std::array<bool, 3> walled) {
  const Mat3 edges = lengths.asDiagonal();
  return {edges, Mat3::Zero(), edges, dimensions, walled};
}

double Cell::volume() const {
  return is_box() ? edges.diagonal().prod() : std::abs(edges.determinant());
}

Vec3 Cell::heights() const {
  if (is_box()) return edges.diagonal();
  return edges.inverse().rowwise().norm().cwiseInverse();
}

Vec3 Cell::reduced(const Vec3& x) const {
  if (is_box()) return x.cwiseQuotient(edges.diagonal());
  return edges.inverse() * x;
}

Image Cell::image_of(const Vec3& x) const {
  const Vec3 at = reduced(x);
  Image image{};
  for (int k = 0; k < 3; ++k)
    if (const auto axis = static_cast<std::size_t>(k); !walled[axis])
      image[axis] = static_cast<std::int32_t>(std::floor(at[k]));
  return image;
}

Mat3 Cell::isotropic(double r) const { return Vec3(r, r, dimensions == 3 ? r : 0.0).asDiagonal(); }

Mat3 Cell::logarithmic_strain() const {
  if (is_box() && reference_edges.isDiagonal(0.0))
    return Vec3((edges.diagonal().array() / reference_edges.diagonal().array()).log()).asDiagonal();
  const auto stretch = squared_stretch(reference_edges, edges);
  const Vec3 strains = 0.5 * stretch.eigenvalues().array().log();
  return stretch.eigenvectors() * strains.asDiagonal() * stretch.eigenvectors().transpose();
}

double Cell::least_stretch_since(const Mat3& before) const {
  if (is_box() && before.isDiagonal(0.0))
    return edges.diagonal().cwiseQuotient(before.diagonal()).minCoeff();
  return std::sqrt(squared_stretch(before, edges).eigenvalues().minCoeff());
}

}  // namespace tangency::dem
