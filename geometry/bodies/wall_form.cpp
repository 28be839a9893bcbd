// SPDX-License-Identifier: MIT
#include <tangency/geometry/bodies/wall_form.hpp>

#include <gmpxx.h>

#include <array>
#include <cstddef>

#include <tangency/geometry/bodies/ellipsoid_form.hpp>
#include <tangency/geometry/numbers/integer_forms.hpp>

namespace tangency::inline v0::exact {
namespace {

std::array<mpq_class, 3> to_rationals(const Vec3& v) {
  return {to_rational(v[0]), to_rational(v[1]), to_rational(v[2])};
}

}  // namespace

RationalSolid<3> rational_solid(const Ellipsoid& body) {
  const ScaledRotation rotation = scaled_rotation(body.orientation());
  const mpq_class scale(1, mpz_class(rotation.squared_length * rotation.squared_length));
  const std::array<mpq_class, 3> axes = to_rationals(body.semi_axes());
  RationalSolid<3> solid{to_rationals(body.centre()), {}};
  for (std::size_t k = 0; k < 3; ++k) {
    const mpq_class square = scale * axes[k] * axes[k];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j)
        solid.shape[i][j] += square * rotation.matrix[i][k] * rotation.matrix[j][k];
    }
  }
  return solid;
}

WallSigns wall_signs(const RationalSolid<3>& body, const Vec3& normal, double offset) {
  const std::array<mpq_class, 3> n = to_rationals(normal);
  mpq_class height = -to_rational(offset), square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    height += n[i] * body.centre[i];
    for (std::size_t j = 0; j < 3; ++j) square += n[i] * body.shape[i][j] * n[j];
  }
  return {sgn(height), sgn(mpq_class(height * height - square))};
}

}  // namespace tangency::inline v0::exact
