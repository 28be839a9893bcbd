// SPDX-License-Identifier: GPL-3.0-or-later
#include <tangency/verify/oracles/classification.hpp>

#include <array>
#include <cstddef>
#include <utility>

#include <tangency/verify/oracles/inertia.hpp>

namespace tangency::inline v0::verify {
namespace {

// The inertia of a form and of its negative are the same evidence: keep the one whose quadratic
// part, and after it the whole, has no fewer positive than negative squares.
bool must_negate(const Inertia& q4, const Inertia& q3) {
  if (q3.positive != q3.negative) return q3.positive < q3.negative;
  return q4.positive < q4.negative;
}

QuadricType type_of(const Inertia& q4, const Inertia& q3) {
  using enum QuadricType;
  const bool definite3 = q3.negative == 0;
  const bool definite4 = q4.negative == 0;
  const int lift = q4.rank() - q3.rank();  // 0: on the vertex; 1: a constant; 2: a linear term
  switch (q3.rank()) {
    case 3:
      if (lift == 0) return definite3 ? imaginary_elliptic_cone : real_elliptic_cone;
      if (definite3) return definite4 ? imaginary_ellipsoid : real_ellipsoid;
      return q4.negative == 2 ? hyperboloid_one_sheet : hyperboloid_two_sheets;
    case 2:
      if (lift == 0) return definite3 ? imaginary_intersecting_planes : real_intersecting_planes;
      if (lift == 2) return definite3 ? elliptic_paraboloid : hyperbolic_paraboloid;
      if (!definite3) return hyperbolic_cylinder;
      return definite4 ? imaginary_elliptic_cylinder : real_elliptic_cylinder;
    case 1:
      if (lift == 0) return coincident_planes;
      if (lift == 2) return parabolic_cylinder;
      return definite4 ? imaginary_parallel_planes : real_parallel_planes;
    default:
      if (lift == 0) return all_space;
      return lift == 2 ? plane : no_points;
  }
}

}  // namespace

Classification classify(const RawQuadric& quadric) {
  const IntegerMatrix matrix = discriminant_matrix(quadric);
  Inertia q4 = inertia(matrix, 4);
  Inertia q3 = inertia(matrix, 3);
  if (must_negate(q4, q3)) {
    std::swap(q4.positive, q4.negative);
    std::swap(q3.positive, q3.negative);
  }
  return {type_of(q4, q3), q4.rank(), q3.rank()};
}

}  // namespace tangency::inline v0::verify
