// SPDX-License-Identifier: MIT
#include <tangency/geometry/curvature.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

#include <tangency/geometry/bodies/plane_tensor.hpp>
#include <tangency/geometry/numbers/double_double.hpp>
#include <tangency/geometry/numbers/floating_point_environment.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency::inline v0 {
namespace {

using detail::PlaneBasis;
using detail::PlaneTensor;

// Of |n|^2 from 1: chosen, far wider than rounding and far narrower than a mistake.
[[maybe_unused]] constexpr double kUnitTolerance = 0x1p-40;

// The tensors of two bodies are nearly parallel where the product of their traces is beyond this
// times the determinant of their sum (1 for spheres): chosen. Below it rounding of the mixed
// determinant is bounded as docs/derivations/derivatives-and-curvature.md says.
constexpr double kParallel = 4.0;

/// Exponent of the largest semi-axis.
int size_exponent(const Ellipsoid& body) { return exponent_of(body.largest_semi_axis()); }

/// The body in units of 2^exponent, so that no square leaves the range of doubles; a semi-axis
/// below kThinnestAxis, far beyond what is promised, becomes that: of 0 there is no body.
Ellipsoid in_unit(const Ellipsoid& body, int exponent) {
  const Vec3 axes = scaled_by_power(body.semi_axes(), -exponent);
  return {Vec3::Zero(), axes.cwiseMax(detail::kThinnestAxis), body.orientation()};
}

PlaneTensor tensor_of(const Ellipsoid& unit, const PlaneBasis& basis, const Vec3& normal) {
  return detail::curvature_tensor(unit, basis, unit.support(normal));
}

/// detail::mixed_determinant() of the curvature tensors in double-double, for which the rotations
/// and the tangents are formed anew: rounded, they would turn nearly parallel tensors apart.
double mixed_determinant(const Ellipsoid& a, const Ellipsoid& b, const Vec3& n) {
  using detail::DoubleDoubleVector;
  // Tangents as they are, not unit: sqrt(squares) and sqrt(squares) |n| long, at right angles.
  int k;
  n.cwiseAbs().minCoeff(&k);
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const auto at = [](int axis) { return static_cast<std::size_t>(axis); };
  const auto square_i = detail::two_product(n[i], n[i]), square_j = detail::two_product(n[j], n[j]);
  DoubleDoubleVector first, second;
  first[at(i)] = -n[j], first[at(j)] = n[i], first[at(k)] = 0.0;
  second[at(i)] = -detail::two_product(n[k], n[i]),
  second[at(j)] = -detail::two_product(n[k], n[j]);
  second[at(k)] = square_i + square_j;
  const double squares = second[at(k)].high;

  struct Factor {
    DoubleDoubleVector first, second;
  };
  const auto factor = [&](const Ellipsoid& body) {
    const auto rotation = detail::double_double_rotation(body.orientation());
    Factor f{turned_back(rotation, first), turned_back(rotation, second)};
    for (std::size_t row = 0; row < 3; ++row) {
      const detail::DoubleDouble axis = body.semi_axes()[static_cast<int>(row)];
      f.first[row] = f.first[row] / axis, f.second[row] = f.second[row] / axis;
    }
    return f;
  };
  const Factor s = factor(a), t = factor(b);
  double sum = 0.0;
  for (std::size_t p = 0; p < 3; ++p) {
    for (std::size_t q = 0; q < 3; ++q) {
      const double minor = (s.first[p] * t.second[q] - s.second[p] * t.first[q]).high / squares;
      sum += minor * minor;
    }
  }
  return a.support(n) * b.support(n) * sum / n.squaredNorm();
}

/// @param turn  1, or -1 where the body's outer normal is minus the third vector of the basis
PrincipalCurvatures principal(double xx, double yy, double xy, double determinant,
                              const PlaneBasis& basis, double turn, int exponent) {
  const auto values = detail::principal_values(xx, yy, xy, determinant);
  // Each rounds by itself: of a sphere the smaller one may come out above the larger.
  const double smaller = std::min(values.smaller, values.larger);
  return {{std::scalbn(values.larger, -exponent), std::scalbn(smaller, -exponent)},
          {values.cosine * basis.col(0) + values.sine * basis.col(1),
           turn * (values.cosine * basis.col(1) - values.sine * basis.col(0))}};
}

PrincipalCurvatures principal(const PlaneTensor& k, const PlaneBasis& basis, double turn,
                              int exponent) {
  return principal(k.xx(), k.yy(), k.xy(), k.determinant, basis, turn, exponent);
}

PrincipalCurvatures curvature_at(const Ellipsoid& body, const Vec3& normal) {
  assert(std::abs(normal.squaredNorm() - 1.0) <= kUnitTolerance);
  const PlaneBasis basis = detail::tangent_basis(normal);
  const int exponent = size_exponent(body);
  return principal(tensor_of(in_unit(body, exponent), basis, normal), basis, 1.0, exponent);
}

ContactCurvature curvature_between(const Ellipsoid& a, const Ellipsoid& b, const Vec3& normal) {
  assert(std::abs(normal.squaredNorm() - 1.0) <= kUnitTolerance);
  const PlaneBasis basis = detail::tangent_basis(normal);
  const int exponent = std::max(size_exponent(a), size_exponent(b));
  const Ellipsoid unit_a = in_unit(a, exponent), unit_b = in_unit(b, exponent);
  const PlaneTensor ka = tensor_of(unit_a, basis, normal), kb = tensor_of(unit_b, basis, normal);
  const double alone = ka.determinant + kb.determinant;
  double determinant = alone + detail::mixed_determinant(ka, kb);
  if (ka.trace() * kb.trace() > kParallel * determinant) {
    determinant = alone + mixed_determinant(unit_a, unit_b, normal);
  }
  return {principal(ka, basis, 1.0, exponent), principal(kb, basis, -1.0, exponent),
          principal(ka.xx() + kb.xx(), ka.yy() + kb.yy(), ka.xy() + kb.xy(), determinant, basis,
                    1.0, exponent)};
}

}  // namespace

PrincipalCurvatures surface_curvature(const Ellipsoid& body, const Vec3& normal) noexcept {
  return in_default_environment([&] { return curvature_at(body, normal); });
}

ContactCurvature contact_curvature(const Ellipsoid& a, const Ellipsoid& b,
                                   const Vec3& normal) noexcept {
  return in_default_environment([&] { return curvature_between(a, b, normal); });
}

}  // namespace tangency::inline v0
