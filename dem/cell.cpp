// SPDX-License-Identifier: MIT
#include <tangency/dem/cell.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <vector>

#include <tangency/dem/lanes/elementary.hpp>

namespace tangency::inline v0::dem {
namespace {

/// Eigenvalues and vectors of F F', F the deformation from `before` to `now`.
Eigen::SelfAdjointEigenSolver<Mat3> squared_stretch(const Mat3& before, const Mat3& now) {
  const Mat3 gradient = now * before.inverse();
  return Eigen::SelfAdjointEigenSolver<Mat3>(gradient * gradient.transpose());
}

/// A period as a sum of edges.
struct Period {
  Image image;
  Vec3 along;

  Period plus(const Period& other, double times) const {
    Period sum{image, along + times * other.along};
    for (std::size_t k = 0; k < 3; ++k)
      sum.image[k] += static_cast<std::int32_t>(times) * other.image[k];
    return sum;
  }
  /// Takes the other's place if it is shorter by more than rounding.
  bool shorten_to(const Period& other) {
    const bool shorter = other.along.squaredNorm() < (1.0 - 1e-12) * along.squaredNorm();
    if (shorter) *this = other;
    return shorter;
  }
};

/// One round of a reduction: is a period shorter than before?
bool shorten(std::vector<Period>& basis) {
  bool shorter = false;
  for (std::size_t k = 0; k < basis.size(); ++k) {
    for (std::size_t j = 0; j < basis.size(); ++j) {
      if (j == k) continue;
      const Vec3& by = basis[j].along;
      const double times = std::round(basis[k].along.dot(by) / by.squaredNorm());
      shorter = basis[k].shorten_to(basis[k].plus(basis[j], -times)) || shorter;
    }
    if (basis.size() < 3) continue;
    const Period &one = basis[(k + 1) % 3], &other = basis[(k + 2) % 3];
    for (const double s : {-1.0, 1.0})
      for (const double t : {-1.0, 1.0})
        shorter = basis[k].shorten_to(basis[k].plus(one, s).plus(other, t)) || shorter;
  }
  return shorter;
}

}  // namespace

Mat3 Reset::edges(const Mat3& before) const {
  Mat3 now = before;
  now.col(1) -= xy * now.col(0);
  now.col(2) -= yz * now.col(1);
  now.col(2) -= xz * now.col(0);
  return now;
}

Image Reset::image(const Image& before) const {
  return {before[0] + xy * before[1] + xz * before[2], before[1] + yz * before[2], before[2]};
}

Vec3 Reset::reduced(const Vec3& before) const {
  return {before[0] + xy * before[1] + xz * before[2], before[1] + yz * before[2], before[2]};
}

Reset Reset::then(const Reset& next) const {
  return {xy + next.xy, yz + next.yz, xz + next.xz + next.xy * yz};
}

Reset Reset::inverse() const { return {-xy, -yz, xy * yz - xz}; }

Reset Cell::reset() const {
  if (is_box() || edges(1, 0) != 0.0 || edges(2, 0) != 0.0 || edges(2, 1) != 0.0) return {};
  // Beyond a half by more than rounding, lest two descriptions take turns.
  const auto off = [](double along, double edge) {
    constexpr double half = 0.5 + 0x1p-40;
    return std::abs(along) > half * edge ? static_cast<std::int32_t>(std::round(along / edge)) : 0;
  };
  Reset reset;
  reset.xy = off(edges(0, 1), edges(0, 0));
  reset.yz = off(edges(1, 2), edges(1, 1));
  reset.xz = off(edges(0, 2) - reset.yz * reset.edges(edges)(0, 1), edges(0, 0));
  return reset;
}

Cell Cell::box(const Vec3& lengths, int dimensions, std::array<bool, 3> walled) {
  const Mat3 edges = lengths.asDiagonal();
  return {edges, Mat3::Zero(), edges, dimensions, walled, {}};
}

double Cell::volume() const {
  return is_box() ? edges.diagonal().prod() : std::abs(edges.determinant());
}

Vec3 Cell::heights() const {
  if (is_box()) return edges.diagonal();
  return edges.inverse().rowwise().norm().cwiseInverse();
}

Image Cell::shortest_period() const {
  std::vector<Period> basis;
  for (int axis = 0; axis < dimensions; ++axis) {
    if (walled[static_cast<std::size_t>(axis)]) continue;
    Image image{};
    image[static_cast<std::size_t>(axis)] = 1;
    basis.push_back({image, edges.col(axis)});
  }
  if (basis.empty()) return {};
  // Where no round shortens a period the basis is Minkowski-reduced: its shortest period is that of
  // the lattice (docs/derivations/thin-cells.md).
  if (!is_box())
    while (shorten(basis)) {
    }
  return std::min_element(basis.begin(), basis.end(),
                          [](const Period& a, const Period& b) {
                            return a.along.squaredNorm() < b.along.squaredNorm();
                          })
      ->image;
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
    return Vec3(edges.diagonal().cwiseQuotient(reference_edges.diagonal()).unaryExpr(&logarithm))
        .asDiagonal();
  const auto stretch = squared_stretch(reference_edges, edges);
  const Vec3 strains = 0.5 * stretch.eigenvalues().unaryExpr(&logarithm);
  return stretch.eigenvectors() * strains.asDiagonal() * stretch.eigenvectors().transpose();
}

Vec3 Cell::shear_strain() const {
  if (is_box() && reference_edges.isDiagonal(0.0)) return Vec3::Zero();
  const Mat3 moved = edges * reference_edges.inverse();
  const auto closed = [&](int a, int b) {
    return moved(a, b) / moved(b, b) + moved(b, a) / moved(a, a);
  };
  return {closed(0, 1), closed(1, 2), closed(2, 0)};
}

}  // namespace tangency::inline v0::dem
