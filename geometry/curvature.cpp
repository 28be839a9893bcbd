// SPDX-License-Identifier: MIT
#include <tangency/geometry/curvature.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

#include <tangency/geometry/floating_point_environment.hpp>
#include <tangency/geometry/methods/plane_tensor.hpp>
#include <tangency/geometry/power_of_two.hpp>

namespace tangency {
namespace {

using methods::PlaneBasis;
using methods::PlaneTensor;

// Of |n|^2 from 1: chosen, far wider than rounding and far narrower than a mistake.
[[maybe_unused]] constexpr double kUnitTolerance = 0x1p-40;

/// Exponent of the largest semi-axis.
int size_exponent(const Ellipsoid& body) { return exponent_of(body.largest_semi_axis()); }

/// The tensor of the body in units of 2^exponent, so that no square leaves the range of doubles.
PlaneTensor tensor_of(const Ellipsoid& body, const PlaneBasis& basis, const Vec3& normal,
                      int exponent) {
  const auto scaled = [&](double length) { return scaled_by_power(length, -exponent); };
  const Ellipsoid unit(Vec3::Zero(), body.semi_axes().unaryExpr(scaled), body.orientation());
  return methods::curvature_tensor(unit, basis, unit.support(normal));
}

/// @param turn  1, or -1 where the body's outer normal is minus the third vector of the basis
PrincipalCurvatures principal(double xx, double yy, double xy, double determinant,
                              const PlaneBasis& basis, double turn, int exponent) {
  const auto values = methods::principal_values(xx, yy, xy, determinant);
  return {{std::scalbn(values.larger, -exponent), std::scalbn(values.smaller, -exponent)},
          {values.cosine * basis.col(0) + values.sine * basis.col(1),
           turn * (values.cosine * basis.col(1) - values.sine * basis.col(0))}};
}

PrincipalCurvatures principal(const PlaneTensor& k, const PlaneBasis& basis, double turn,
                              int exponent) {
  return principal(k.xx(), k.yy(), k.xy(), k.determinant, basis, turn, exponent);
}

PrincipalCurvatures curvature_at(const Ellipsoid& body, const Vec3& normal) {
  assert(std::abs(normal.squaredNorm() - 1.0) <= kUnitTolerance);
  const PlaneBasis basis = methods::tangent_basis(normal);
  const int exponent = size_exponent(body);
  return principal(tensor_of(body, basis, normal, exponent), basis, 1.0, exponent);
}

ContactCurvature curvature_between(const Ellipsoid& a, const Ellipsoid& b, const Vec3& normal) {
  assert(std::abs(normal.squaredNorm() - 1.0) <= kUnitTolerance);
  const PlaneBasis basis = methods::tangent_basis(normal);
  const int exponent = std::max(size_exponent(a), size_exponent(b));
  const PlaneTensor ka = tensor_of(a, basis, normal, exponent);
  const PlaneTensor kb = tensor_of(b, basis, normal, exponent);
  const double determinant = ka.determinant + kb.determinant + mixed_determinant(ka, kb);
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

}  // namespace tangency
