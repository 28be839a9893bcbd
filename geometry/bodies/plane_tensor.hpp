// SPDX-License-Identifier: MIT
/// @file
/// Symmetric tensors of a tangent plane, and the curvature of an ellipsoid in it.
///
/// Everywhere the plane's basis (e_1, e_2) completes a unit normal n to a right-handed frame.
#pragma once

#include <cmath>

#include <tangency/geometry/ellipsoid.hpp>

namespace tangency::inline v0::detail {

using PlaneBasis = Eigen::Matrix<double, 3, 2>;  ///< columns e_1, e_2

/// A positive tensor F'F of the plane, with its determinant known apart: xx yy - xy^2 would lose
/// the smaller principal value of a long and narrow one.
struct PlaneTensor {
  PlaneBasis factor;  ///< F; its columns belong to e_1 and e_2
  double determinant;

  double xx() const noexcept { return factor.col(0).squaredNorm(); }
  double yy() const noexcept { return factor.col(1).squaredNorm(); }
  double xy() const noexcept { return factor.col(0).dot(factor.col(1)); }
  double trace() const noexcept { return xx() + yy(); }
};

/// det(S + T) - det S - det T of two tensors: the squares of F's minors that take a row of each
/// (Cauchy and Binet), so that nothing cancels.
inline double mixed_determinant(const PlaneTensor& s, const PlaneTensor& t) noexcept {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double minor = s.factor(i, 0) * t.factor(j, 1) - s.factor(i, 1) * t.factor(j, 0);
      sum += minor * minor;
    }
  }
  return sum;
}

/// The principal values of a symmetric tensor of the plane and the direction of the larger one.
struct PrincipalValues {
  double larger, smaller;
  double cosine, sine;  ///< direction cosine e_1 + sine e_2; e_1 where the two are equal
};

/// Requires a positive trace. Nothing but roots: no bit depends on the machine's library.
inline PrincipalValues principal_values(double xx, double yy, double xy,
                                        double determinant) noexcept {
  const double mean = 0.5 * (xx + yy), difference = 0.5 * (xx - yy);
  const double size = std::fmax(std::abs(difference), std::abs(xy));
  if (size == 0.0) return {mean, determinant / mean, 1.0, 0.0};
  const double d = difference / size, o = xy / size;
  const double root = std::sqrt(d * d + o * o);
  // Twice the direction's angle is that of (d, o); what is added has one sign.
  const double large = root + std::abs(d), length = std::sqrt(large * large + o * o);
  const double larger = mean + size * root;
  return d >= 0.0 ? PrincipalValues{larger, determinant / larger, large / length, o / length}
                  : PrincipalValues{larger, determinant / larger, std::abs(o) / length,
                                    std::copysign(large, o) / length};
}

inline PlaneBasis tangent_basis(const Vec3& n) noexcept {
  PlaneBasis basis;
  basis.col(0) = n.unitOrthogonal();
  basis.col(1) = n.cross(basis.col(0));
  return basis;
}

/// The curvature tensor K = h E'M^-1 E of the surface where its outer normal is n or -n, of
/// determinant h^4 / det M.
/// @param support  h(n)
inline PlaneTensor curvature_tensor(const Ellipsoid& body, const PlaneBasis& basis,
                                    double support) noexcept {
  const Vec3& a = body.semi_axes();
  const Vec3 row = std::sqrt(support) * a.cwiseInverse();
  const double root = (support / a[0]) * (support / a[1]) / a[2];
  return {row.asDiagonal() * (body.rotation().transpose() * basis), root * root};
}

/// Its inverse E' Hess h E, the tensor of the radii of curvature, of determinant det M / h^4. With
/// A = R diag(a), y = A'n/h: Hess h = A (I - y y') A' / h, and the part of A'e_1 normal to y is a
/// quarter turn from y x A'e_1 = adj(A)(n x e_1) / h = adj(A) e_2 / h, where nothing cancels.
inline PlaneTensor radius_tensor(const Ellipsoid& body, const PlaneBasis& basis,
                                 double support) noexcept {
  const Vec3& a = body.semi_axes();
  const Vec3 b = a / support,
             row = Vec3(a[1] * b[2], a[2] * b[0], a[0] * b[1]) / std::sqrt(support);
  const double root = b[0] * b[1] * a[2];
  const PlaneBasis e = row.asDiagonal() * (body.rotation().transpose() * basis);
  PlaneTensor tensor{e, root * root};
  tensor.factor.col(0) = e.col(1);
  tensor.factor.col(1) = -e.col(0);
  return tensor;
}

}  // namespace tangency::inline v0::detail
